// SPDX-License-Identifier: Apache-2.0
// How far a view of the pad is from being believed.
#ifndef TOUCHDOWN_DOUBT_H
#define TOUCHDOWN_DOUBT_H

#include "reading.h"

// The misfit, and what is missing or does not belong; a negative number if the view cannot be believed at all.
double doubt_of(const struct detect_context *context, const struct reading *reading, const struct pad_view *view,
                double misfit, double worst);

// From the camera along its axis to the pad's plane.
double pad_plane_height_m(const struct pad_plane *plane);

#endif

// SPDX-License-Identifier: Apache-2.0
// What a fitted view and what was seen of it say together about the pad.
#ifndef TOUCHDOWN_ESTIMATE_H
#define TOUCHDOWN_ESTIMATE_H

#include "reading.h"

// Fills in `pad` from its view; its misfit and doubt stay. Fails when the camera cannot see it.
int estimate_of(const struct detect_context *context, const struct reading *reading, struct pad_estimate *pad);

#endif

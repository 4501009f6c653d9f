// SPDX-License-Identifier: Apache-2.0
// How the ground lies before the camera, by the autopilot's attitude.
#ifndef TOUCHDOWN_ATTITUDE_H
#define TOUCHDOWN_ATTITUDE_H

#include <stdbool.h>
#include <stdint.h>

#include "pad_fit.h"

struct attitude {
    bool known;
    uint64_t received_us;
    double roll_rad;
    double pitch_rad;
};

// Takes what an ATTITUDE message said; what is no attitude at all is left out.
void attitude_set(struct attitude *attitude, double roll_rad, double pitch_rad, uint64_t now_us);

// Tilt of level ground. False, and `tilt` is left as it is, without a fresh attitude.
bool attitude_tilt(const struct attitude *attitude, uint64_t now_us, struct tilt_hint *tilt);

#endif

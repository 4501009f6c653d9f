// SPDX-License-Identifier: Apache-2.0
#include "attitude.h"

#include <math.h>

// A few messages at the least rate that is of use.
#define MAX_AGE_US 250000U
// Beyond it no one lands, and the tangents grow without bound.
#define ANGLE_MAX_RAD 1.0
// Of the message, of the camera's mounting, and of the ground, which is not quite level.
#define TILT_SIGMA 0.025

void attitude_set(struct attitude *attitude, double roll_rad, double pitch_rad, uint64_t now_us)
{
    // Also false for NaN.
    if (!(fabs(roll_rad) <= ANGLE_MAX_RAD) || !(fabs(pitch_rad) <= ANGLE_MAX_RAD)) {
        attitude->known = false;
        return;
    }
    attitude->known = true;
    attitude->received_us = now_us;
    attitude->roll_rad = roll_rad;
    attitude->pitch_rad = pitch_rad;
}

bool attitude_tilt(const struct attitude *attitude, uint64_t now_us, struct tilt_hint *tilt)
{
    if (!attitude->known || now_us > attitude->received_us + MAX_AGE_US) {
        return false;
    }
    // Down, turned by pitch and roll, in camera axes: (sin r cos p, sin p, cos r cos p).
    tilt->x = tan(attitude->roll_rad);
    tilt->y = tan(attitude->pitch_rad) / cos(attitude->roll_rad);
    tilt->sigma = TILT_SIGMA;
    return true;
}

// SPDX-License-Identifier: Apache-2.0
// How the ground lies before the camera, by the autopilot's attitude: now, and
// at the time at which a frame was exposed.
#ifndef TOUCHDOWN_ATTITUDE_H
#define TOUCHDOWN_ATTITUDE_H

#include <stdbool.h>
#include <stdint.h>

#include "pad_fit.h"

// A few messages at the least rate that is of use.
#define ATTITUDE_MAX_AGE_US 250000U
#define ATTITUDE_SAMPLES 16U

struct attitude_sample {
    uint64_t time_us;
    double roll_rad;
    double pitch_rad;
};

struct attitude {
    bool known;
    uint64_t received_us;
    double roll_rad; // the newest
    double pitch_rad;
    uint32_t count; // samples that are held, the newest at `newest`
    uint32_t newest;
    struct attitude_sample samples[ATTITUDE_SAMPLES];
};

// Takes what an ATTITUDE message said that was true at `time_us` and arrived at `now_us`; what is no attitude at all
// is left out.
void attitude_set(struct attitude *attitude, double roll_rad, double pitch_rad, uint64_t time_us, uint64_t now_us);

// Roll and pitch at `time_us`: between two samples by a line, after the newest by the line on for as long as the two
// are apart and 50 ms at most, and before the oldest as the oldest. False, and both are left as they are, without a
// fresh attitude.
bool attitude_at(const struct attitude *attitude, uint64_t time_us, uint64_t now_us, double *roll_rad,
                 double *pitch_rad);

// Tilt of level ground at `time_us`. False, and `tilt` is left as it is, without a fresh attitude.
bool attitude_tilt(const struct attitude *attitude, uint64_t time_us, uint64_t now_us, struct tilt_hint *tilt);

#endif

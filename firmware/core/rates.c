// SPDX-License-Identifier: Apache-2.0
#include "rates.h"

// The autopilot's estimator wants LANDING_TARGET at 10 Hz or more, its pre-arm
// check a distance every 500 ms, steering a velocity every 500 ms.
static const struct rates full = {
    .distance_period_us = 50000U,
    .velocity_period_us = 33000U,
    .attitude_interval_us = 20000U,
    .rc_interval_us = 100000U,
};
static const struct rates narrow_autopilot = {
    .frame_period_us = 42000U, // each third of 60 frames a second, with half a frame to spare either way
    .distance_period_us = 100000U,
    .velocity_period_us = 50000U,
    .attitude_interval_us = 40000U,
    .rc_interval_us = 200000U,
};
static const struct rates narrow_ground = {
    .frame_period_us = 25000U, // each second
};

const struct rates *rates_of(enum rates_wire wire, uint32_t baud)
{
    if (baud == 0U || baud >= RATES_FULL_BAUD) {
        return &full;
    }
    return wire == RATES_AUTOPILOT ? &narrow_autopilot : &narrow_ground;
}

bool rates_frame_is_due(uint32_t period_us, uint64_t now_us, uint64_t *last_us)
{
    if (*last_us != 0U && now_us < *last_us + period_us) {
        return false;
    }
    *last_us = now_us;
    return true;
}

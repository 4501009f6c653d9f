// SPDX-License-Identifier: Apache-2.0
#include "rates.h"

// The autopilot's estimator wants LANDING_TARGET at 10 Hz or more, its pre-arm
// check a distance every 500 ms, steering a velocity every 500 ms.
static const struct rates full = {
    .frames_a_message = 1U,
    .distance_period_us = 50000U,
    .velocity_period_us = 33000U,
    .attitude_interval_us = 20000U,
    .rc_interval_us = 100000U,
};
static const struct rates narrow_autopilot = {
    .frames_a_message = 3U,
    .distance_period_us = 100000U,
    .velocity_period_us = 50000U,
    .attitude_interval_us = 40000U,
    .rc_interval_us = 200000U,
};
static const struct rates narrow_ground = {
    .frames_a_message = 2U,
};

const struct rates *rates_of(enum rates_wire wire, uint32_t baud)
{
    if (baud == 0U || baud >= RATES_FULL_BAUD) {
        return &full;
    }
    return wire == RATES_AUTOPILOT ? &narrow_autopilot : &narrow_ground;
}

bool rates_frame_is_due(uint32_t frames, uint32_t number, uint32_t *last)
{
    // Numbers wrap.
    if (number % frames != 0U && *last != 0U && number - *last < frames) {
        return false;
    }
    *last = number;
    return true;
}

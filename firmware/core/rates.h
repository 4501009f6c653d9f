// SPDX-License-Identifier: Apache-2.0
// How often each message goes out, by what its wire carries. docs/firmware.md
// has the table, firmware/test_rates.py counts the bytes.
#ifndef TOUCHDOWN_RATES_H
#define TOUCHDOWN_RATES_H

#include <stdbool.h>
#include <stdint.h>

// At this baud rate and above, everything goes out as often as it is known anew.
#define RATES_FULL_BAUD 115200U

// Of one wire.
struct rates {
    uint32_t frame_period_us; // at least, from one LANDING_TARGET or PAD to the next; 0 = with each frame
    uint32_t distance_period_us;
    uint32_t velocity_period_us;
    uint32_t attitude_interval_us; // asked of the autopilot, whose direction is as narrow
    uint32_t rc_interval_us;
};

enum rates_wire { RATES_AUTOPILOT, RATES_GROUND };

// `baud` 0: no wire that would set a limit.
const struct rates *rates_of(enum rates_wire wire, uint32_t baud);

// True when so much time has passed since the last such frame, at `last_us`; 0 = there was none.
bool rates_frame_is_due(uint32_t period_us, uint64_t now_us, uint64_t *last_us);

#endif

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
    uint32_t frames_a_message; // one LANDING_TARGET or PAD for so many frames
    uint32_t distance_period_us;
    uint32_t velocity_period_us;
    uint32_t attitude_interval_us; // asked of the autopilot, whose direction is as narrow
    uint32_t rc_interval_us;
};

enum rates_wire { RATES_AUTOPILOT, RATES_GROUND };

// `baud` 0: no wire that would set a limit.
const struct rates *rates_of(enum rates_wire wire, uint32_t baud);

// True when a message belongs to this frame: its number divides by `frames`, or that many have passed since the
// last one, when frames were lost or the pad came back. `last` is the number of the last such frame.
bool rates_frame_is_due(uint32_t frames, uint32_t number, uint32_t *last);

#endif

// SPDX-License-Identifier: Apache-2.0
// Whether the board still does its work: what it may feed its watchdog by, and
// how busy it is.
#ifndef TOUCHDOWN_VITALS_H
#define TOUCHDOWN_VITALS_H

#include <stdbool.h>
#include <stdint.h>

#define VITALS_WIRES 2U
#define VITALS_ROUND_MAX_US 200000U // of the main loop; a frame takes a tenth of it
#define VITALS_WIRE_MAX_US 500000U  // for which bytes may wait while none leaves

// At the end of a round of the main loop.
struct vitals_signs {
    uint64_t now_us; // by the clock that all messages go by
    uint32_t ticks;  // of the timer's interrupt so far
    struct {
        bool waiting;  // bytes wait to leave
        uint32_t sent; // that have left so far
    } wires[VITALS_WIRES];
};

struct vitals {
    uint64_t round_us; // of the round before
    uint64_t fed_us;
    uint32_t fed_ticks;
    struct {
        uint64_t moved_us; // when bytes left or none waited
        uint32_t sent;
    } wires[VITALS_WIRES];

    uint64_t since_us; // busy_us counts from here
    uint64_t busy_us;
    uint32_t frame_worst_us;
};

void vitals_init(struct vitals *vitals, uint64_t now_us);

// True when the watchdog may be fed: since it last was, interrupts have come and time has passed; this round was not
// too long; and no wire is stuck. A round that may not feed is no harm, a row of them ends in a reset.
bool vitals_may_feed(struct vitals *vitals, const struct vitals_signs *signs);

// A round of the main loop, from waking to the next sleep.
void vitals_round(struct vitals *vitals, uint64_t woke_us, uint64_t sleeps_us);

// A frame's share of a round.
void vitals_frame(struct vitals *vitals, uint64_t from_us, uint64_t to_us);

// The share of the time since the last call that was not slept.
uint32_t vitals_busy_permille(struct vitals *vitals, uint64_t now_us);

#endif

// SPDX-License-Identifier: Apache-2.0
// How far the autopilot's clock is ahead of ours, by TIMESYNC: what it says is
// its time was so at some moment between question and answer, so the shortest of
// the last round trips tells most. Integers only.
#ifndef TOUCHDOWN_TIMESYNC_H
#define TOUCHDOWN_TIMESYNC_H

#include <stdbool.h>
#include <stdint.h>

#define TIMESYNC_PERIOD_US 1000000U
#define TIMESYNC_SAMPLES 8U
#define TIMESYNC_LEAST_SAMPLES 3U
#define TIMESYNC_ROUND_TRIP_MAX_US 100000U
#define TIMESYNC_FORGET_US 10000000U // of silence

struct timesync_sample {
    int64_t ahead_us; // the autopilot's clock, of ours
    uint32_t round_trip_us;
};

struct timesync {
    bool waiting;
    uint64_t asked_us;
    uint64_t next_us;
    uint64_t answered_us;
    uint32_t taken; // samples since it was last begun
    struct timesync_sample samples[TIMESYNC_SAMPLES];
};

void timesync_init(struct timesync *sync);

// True once a period, with what TIMESYNC.ts1 has to be. To be sent at once.
bool timesync_ask(struct timesync *sync, uint64_t now_us, int64_t *request_ns);

// An answer: what was asked with (ts1) and the autopilot's time (tc1). Answers to others' questions do not count.
void timesync_on_answer(struct timesync *sync, int64_t request_ns, int64_t answer_ns, uint64_t now_us);

// True when the clocks are known to each other: then with the shortest of the last round trips.
bool timesync_is_known(const struct timesync *sync, uint64_t now_us, uint32_t *round_trip_us);

// A time of the autopilot's clock in ours. When that is not known, or comes out in the future or more than
// `age_max_us` ago, it is `now_us`: of what has just arrived, no better is known.
uint64_t timesync_to_ours(const struct timesync *sync, uint64_t theirs_us, uint64_t age_max_us, uint64_t now_us);

#endif

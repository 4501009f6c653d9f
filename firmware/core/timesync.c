// SPDX-License-Identifier: Apache-2.0
#include "timesync.h"

#include <stddef.h>
#include <string.h>

#define NS_PER_US 1000
// Beyond it, clocks are nonsense; up to it, no sum below overflows.
#define TIME_MAX_US (INT64_MAX / NS_PER_US / 4)
// What two crystals drift apart within TIMESYNC_SAMPLES periods, at 100 parts in a million each.
#define DRIFT_US 2000

void timesync_init(struct timesync *sync)
{
    memset(sync, 0, sizeof *sync);
}

static const struct timesync_sample *best(const struct timesync *sync)
{
    const struct timesync_sample *least = NULL;

    for (uint32_t i = 0; i < TIMESYNC_SAMPLES && i < sync->taken; i++) {
        if (least == NULL || sync->samples[i].round_trip_us < least->round_trip_us) {
            least = &sync->samples[i];
        }
    }
    return least;
}

bool timesync_ask(struct timesync *sync, uint64_t now_us, int64_t *request_ns)
{
    // 0 is how MAVLink says "none".
    if (now_us < sync->next_us || now_us == 0U || now_us > (uint64_t)TIME_MAX_US) {
        return false;
    }
    sync->next_us = now_us + TIMESYNC_PERIOD_US;
    sync->asked_us = now_us;
    sync->waiting = true;
    *request_ns = (int64_t)now_us * NS_PER_US;
    return true;
}

void timesync_on_answer(struct timesync *sync, int64_t request_ns, int64_t answer_ns, uint64_t now_us)
{
    if (!sync->waiting || request_ns != (int64_t)sync->asked_us * NS_PER_US) {
        return;
    }
    sync->waiting = false;
    const uint64_t round_trip_us = now_us - sync->asked_us;
    const int64_t theirs_us = answer_ns / NS_PER_US;

    if (now_us < sync->asked_us || round_trip_us > TIMESYNC_ROUND_TRIP_MAX_US || theirs_us <= 0 ||
        theirs_us > TIME_MAX_US) {
        return;
    }
    const struct timesync_sample sample = {
        .ahead_us = theirs_us - (int64_t)(sync->asked_us + round_trip_us / 2U),
        .round_trip_us = (uint32_t)round_trip_us,
    };
    const struct timesync_sample *before = best(sync);

    // Each is off by at most half its round trip: two that differ by more are of two clocks, as when the autopilot
    // has started anew.
    if (before != NULL) {
        const int64_t apart_us = sample.ahead_us - before->ahead_us;
        const int64_t limit_us = (int64_t)(sample.round_trip_us / 2U + before->round_trip_us / 2U) + DRIFT_US;
        if (apart_us > limit_us || apart_us < -limit_us || now_us > sync->answered_us + TIMESYNC_FORGET_US) {
            sync->taken = 0U;
        }
    }
    sync->samples[sync->taken % TIMESYNC_SAMPLES] = sample;
    // Counts on in a circle, never back to fewer than there are.
    sync->taken = sync->taken + 1U < 2U * TIMESYNC_SAMPLES ? sync->taken + 1U : TIMESYNC_SAMPLES;
    sync->answered_us = now_us;
}

bool timesync_is_known(const struct timesync *sync, uint64_t now_us, uint32_t *round_trip_us)
{
    if (sync->taken < TIMESYNC_LEAST_SAMPLES || now_us > sync->answered_us + TIMESYNC_FORGET_US) {
        return false;
    }
    *round_trip_us = best(sync)->round_trip_us;
    return true;
}

uint64_t timesync_to_ours(const struct timesync *sync, uint64_t theirs_us, uint64_t age_max_us, uint64_t now_us)
{
    uint32_t round_trip_us;

    if (!timesync_is_known(sync, now_us, &round_trip_us) || theirs_us > (uint64_t)TIME_MAX_US) {
        return now_us;
    }
    const int64_t ours_us = (int64_t)theirs_us - best(sync)->ahead_us;
    const int64_t age_us = (int64_t)now_us - ours_us;

    return age_us >= 0 && age_us <= (int64_t)age_max_us ? (uint64_t)ours_us : now_us;
}

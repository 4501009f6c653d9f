// SPDX-License-Identifier: Apache-2.0
#include "release.h"

// A tracked frame of 256 objects is told of by then; one that is searched for longer goes out when it is done.
#define AFTER_LAST_PIXEL_US 950U
// Longer than the longest message takes at 921600 baud, with the tick's period.
#define KEEP_FREE_BEFORE_US 1900U
// A frame that does not come keeps nothing waiting.
#define KEEP_FREE_AFTER_US 500U
// At least 10 frames a second, or there is no next one to wait for. More than 125, and little time would be left for all
// that has to wait.
#define PERIOD_MAX_US 100000U
#define PERIOD_MIN_US 8000U

uint64_t release_of(const struct landing_result_header *header)
{
    return header->start_time_us + header->scan_time_us + AFTER_LAST_PIXEL_US;
}

void release_note(struct release *release, uint64_t due_us)
{
    const uint64_t period_us = due_us - release->last_us;

    const bool regular = release->last_us != 0U && period_us >= PERIOD_MIN_US && period_us <= PERIOD_MAX_US;

    release->period_us = regular ? period_us : 0U;
    release->last_us = due_us;
}

bool release_is_near(const struct release *release, uint64_t now_us)
{
    const uint64_t next_us = release->last_us + release->period_us;

    return release->period_us != 0U && now_us + KEEP_FREE_BEFORE_US >= next_us && now_us < next_us + KEEP_FREE_AFTER_US;
}

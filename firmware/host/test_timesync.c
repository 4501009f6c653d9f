// SPDX-License-Identifier: Apache-2.0
#include <stdint.h>

#include "test.h"
#include "timesync.h"

#define SECOND 1000000U
#define AGE_MAX_US 250000U

static struct timesync sync;
static uint32_t round_trip_us;

// One question at `now_us` to a clock that is ahead by `ahead_us`, answered after so long on either way.
static void exchange(uint64_t now_us, int64_t ahead_us, uint32_t there_us, uint32_t back_us)
{
    int64_t request_ns = 0;

    CHECK(timesync_ask(&sync, now_us, &request_ns));
    timesync_on_answer(&sync, request_ns, ((int64_t)(now_us + there_us) + ahead_us) * 1000,
                       now_us + there_us + back_us);
}

static int64_t ahead_at(uint64_t now_us)
{
    // What has just been there, by their clock, shifted until it comes out within the last quarter of a second.
    for (int64_t ahead_us = -5000000; ahead_us <= 5000000; ahead_us += 100) {
        const uint64_t theirs_us = (uint64_t)((int64_t)now_us - 100000 + ahead_us);
        if (timesync_to_ours(&sync, theirs_us, AGE_MAX_US, now_us) == now_us - 100000U) {
            return ahead_us;
        }
    }
    return INT64_MAX;
}

static void test_shortest(void)
{
    uint64_t now_us = 10U * SECOND;

    test_case("nothing is known before the third answer");
    timesync_init(&sync);
    exchange(now_us, -3000000, 5000U, 5000U);
    now_us += SECOND;
    exchange(now_us, -3000000, 5000U, 5000U);
    CHECK(!timesync_is_known(&sync, now_us + 10000U, &round_trip_us));
    CHECK(timesync_to_ours(&sync, 8U * SECOND, AGE_MAX_US, now_us) == now_us);
    now_us += SECOND;
    exchange(now_us, -3000000, 1000U, 1000U);
    CHECK(timesync_is_known(&sync, now_us + 2000U, &round_trip_us) && round_trip_us == 2000U);
    CHECK(ahead_at(now_us + 2000U) == -3000000);

    test_case("long and lopsided round trips do not count while there is a shorter one");
    for (uint32_t i = 0U; i < TIMESYNC_SAMPLES - 1U; i++) {
        now_us += SECOND;
        exchange(now_us, -3000000, 1000U, 40000U);
        CHECK(ahead_at(now_us + 41000U) == -3000000);
    }
    test_case("and are off by half of it at most when there is none");
    now_us += SECOND;
    exchange(now_us, -3000000, 1000U, 40000U);
    CHECK(timesync_is_known(&sync, now_us + 41000U, &round_trip_us) && round_trip_us == 41000U);
    const int64_t off_us = ahead_at(now_us + 41000U) + 3000000;
    CHECK(off_us >= -20500 && off_us <= 20500);
}

static void test_not_ours(void)
{
    int64_t request_ns = 0;

    test_case("once a second, and never at 0");
    timesync_init(&sync);
    CHECK(!timesync_ask(&sync, 0U, &request_ns));
    CHECK(timesync_ask(&sync, SECOND, &request_ns) && request_ns == 1000000000);
    CHECK(!timesync_ask(&sync, 2U * SECOND - 1U, &request_ns));
    CHECK(timesync_ask(&sync, 2U * SECOND, &request_ns));
    CHECK(!timesync_ask(&sync, UINT64_MAX / 2U, &request_ns));

    test_case("answers to others, twice, late, from before or beyond all times");
    timesync_on_answer(&sync, request_ns + 1, 5000000000, 2U * SECOND + 1000U);
    CHECK(sync.taken == 0U && sync.waiting);
    timesync_on_answer(&sync, request_ns, 5000000000, 2U * SECOND + 1000U);
    CHECK(sync.taken == 1U);
    timesync_on_answer(&sync, request_ns, 5000000000, 2U * SECOND + 1000U);
    CHECK(sync.taken == 1U);
    static const struct {
        int64_t answer_ns;
        uint32_t later_us;
    } rows[] = {{5000000000, TIMESYNC_ROUND_TRIP_MAX_US + 1U}, {-5000000000, 1000U}, {INT64_MAX, 1000U},
                {INT64_MIN, 1000U}, {999, 1000U}};
    uint64_t now_us = 2U * SECOND;
    for (unsigned i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        now_us += SECOND;
        CHECK(timesync_ask(&sync, now_us, &request_ns));
        timesync_on_answer(&sync, request_ns, rows[i].answer_ns, now_us + rows[i].later_us);
        CHECK(sync.taken == 1U);
    }
    CHECK(timesync_ask(&sync, now_us + SECOND, &request_ns));
    timesync_on_answer(&sync, request_ns, 5000000000, now_us);
    CHECK(sync.taken == 1U);
}

static void know(uint64_t now_us, int64_t ahead_us)
{
    timesync_init(&sync);
    for (uint32_t i = TIMESYNC_LEAST_SAMPLES; i > 0U; i--) {
        exchange(now_us - i * SECOND, ahead_us, 1000U, 1000U);
    }
}

static void test_another_clock(void)
{
    const uint64_t start_us = 100U * SECOND;

    test_case("an autopilot that starts anew has another clock, known with its third answer");
    know(start_us, 3000000);
    exchange(start_us, -90000000, 1000U, 1000U);
    CHECK(!timesync_is_known(&sync, start_us + 2000U, &round_trip_us));
    exchange(start_us + SECOND, -90000000, 1000U, 1000U);
    exchange(start_us + 2U * SECOND, -90000000, 1000U, 1000U);
    CHECK(timesync_to_ours(&sync, 12U * SECOND, AGE_MAX_US, start_us + 2U * SECOND + 2000U) == 102U * SECOND);

    test_case("clocks drift");
    know(start_us, 3000000);
    for (uint32_t i = 0U; i < 40U; i++) {
        exchange(start_us + i * SECOND, 3000000 + 100 * (int64_t)i, 1000U, 1000U);
        CHECK(sync.taken >= TIMESYNC_LEAST_SAMPLES);
    }
    CHECK(ahead_at(start_us + 39U * SECOND) >= 3000000 + 3100);

    test_case("one that is silent is forgotten");
    know(start_us, 3000000);
    CHECK(timesync_is_known(&sync, start_us + 8U * SECOND, &round_trip_us));
    CHECK(!timesync_is_known(&sync, start_us + 10U * SECOND, &round_trip_us));
    exchange(start_us + 20U * SECOND, 3000000, 1000U, 1000U);
    CHECK(!timesync_is_known(&sync, start_us + 20U * SECOND + 2000U, &round_trip_us));
}

static void test_senseless_times(void)
{
    const uint64_t now_us = 100U * SECOND;

    know(now_us, 3000000);
    test_case("a time in the future, too long ago, or beyond all times is the time of arrival");
    CHECK(timesync_to_ours(&sync, 103U * SECOND, AGE_MAX_US, now_us) == now_us);
    CHECK(timesync_to_ours(&sync, 103U * SECOND - 1U, AGE_MAX_US, now_us) == now_us - 1U);
    CHECK(timesync_to_ours(&sync, 103U * SECOND + 1U, AGE_MAX_US, now_us) == now_us);
    CHECK(timesync_to_ours(&sync, 103U * SECOND - AGE_MAX_US, AGE_MAX_US, now_us) == now_us - AGE_MAX_US);
    CHECK(timesync_to_ours(&sync, 103U * SECOND - AGE_MAX_US - 1U, AGE_MAX_US, now_us) == now_us);
    CHECK(timesync_to_ours(&sync, 0U, AGE_MAX_US, now_us) == now_us);
    CHECK(timesync_to_ours(&sync, UINT64_MAX, AGE_MAX_US, now_us) == now_us);
}

void test_timesync(void)
{
    test_shortest();
    test_not_ours();
    test_another_clock();
    test_senseless_times();
}

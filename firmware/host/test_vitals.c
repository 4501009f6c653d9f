// SPDX-License-Identifier: Apache-2.0
#include "test.h"
#include "vitals.h"

#define START_US 5000000U
#define MS 1000U

static struct vitals vitals;
static struct vitals_signs signs;

static void start(void)
{
    vitals_init(&vitals, START_US);
    signs = (struct vitals_signs){.now_us = START_US, .ticks = 7U};
}

// The next round, so much later on either clock.
static bool fed_after(uint64_t later_us, uint32_t ticks)
{
    signs.now_us += later_us;
    signs.ticks += ticks;
    return vitals_may_feed(&vitals, &signs);
}

static void test_progress(void)
{
    test_case("a round a tick");
    start();
    for (unsigned i = 0; i < 1000U; i++) {
        CHECK(fed_after(MS, 1U));
    }
    test_case("rounds between ticks feed nothing");
    CHECK(!fed_after(100U, 0U));
    CHECK(fed_after(900U, 1U));
    test_case("without the tick's interrupt bytes may wake the loop for ever");
    for (unsigned i = 0; i < 1000U; i++) {
        CHECK(!fed_after(MS, 0U));
    }
    test_case("counts wrap");
    start();
    signs.ticks = 0xFFFFFFFFU;
    CHECK(fed_after(MS, 0U) && fed_after(MS, 1U));
    test_case("a clock that stands still or goes back keeps nothing alive");
    start();
    CHECK(fed_after(MS, 1U));
    CHECK(!fed_after(0U, 1U));
    signs.now_us -= MS;
    CHECK(!fed_after(0U, 1U));
    CHECK(!fed_after(MS, 1U));
    CHECK(fed_after(MS, 1U));
}

static void test_long_rounds(void)
{
    test_case("a round may be long, but not too long; the next one feeds again");
    start();
    CHECK(fed_after(VITALS_ROUND_MAX_US, 1U));
    CHECK(!fed_after(VITALS_ROUND_MAX_US + 1U, 200U));
    CHECK(fed_after(MS, 1U));
    test_case("nothing but long rounds");
    for (unsigned i = 0; i < 10U; i++) {
        CHECK(!fed_after(VITALS_ROUND_MAX_US + 1U, 200U));
    }
}

static void test_wires(void)
{
    for (unsigned wire = 0; wire < VITALS_WIRES; wire++) {
        test_case("bytes wait on wire %u, and leave", wire);
        start();
        signs.wires[wire].waiting = true;
        for (unsigned i = 0; i < 2000U; i++) {
            signs.wires[wire].sent += i % 100U == 0U ? 1U : 0U;
            CHECK(fed_after(MS, 1U));
        }
        test_case("bytes wait on wire %u, and do not", wire);
        start();
        signs.wires[wire].waiting = true;
        for (unsigned i = 0; i < VITALS_WIRE_MAX_US / MS; i++) {
            CHECK(fed_after(MS, 1U));
        }
        CHECK(!fed_after(MS, 1U));
        test_case("wire %u is empty again", wire);
        signs.wires[wire].waiting = false;
        CHECK(fed_after(MS, 1U));
    }
}

static void test_busy(void)
{
    test_case("the share that was not slept, of each time that is asked for");
    start();
    CHECK(vitals_busy_permille(&vitals, START_US) == 0U);
    for (uint64_t now_us = START_US; now_us < START_US + 1000U * MS; now_us += 10U * MS) {
        vitals_round(&vitals, now_us, now_us + 2500U);
    }
    CHECK(vitals_busy_permille(&vitals, START_US + 1000U * MS) == 250U);
    CHECK(vitals_busy_permille(&vitals, START_US + 2000U * MS) == 0U);
    vitals_round(&vitals, START_US + 2000U * MS, START_US + 3000U * MS);
    CHECK(vitals_busy_permille(&vitals, START_US + 3000U * MS) == 1000U);
    test_case("the worst frame stays");
    vitals_frame(&vitals, 100U, 5100U);
    vitals_frame(&vitals, 100U, 400U);
    CHECK(vitals.frame_worst_us == 5000U);
    vitals_frame(&vitals, 0U, UINT64_MAX);
    CHECK(vitals.frame_worst_us == UINT32_MAX);
}

void test_vitals(void)
{
    test_progress();
    test_long_rounds();
    test_wires();
    test_busy();
}

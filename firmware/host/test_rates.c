// SPDX-License-Identifier: Apache-2.0
#include "rates.h"
#include "test.h"

// Of 300 frames, one a period and each a little early or late.
static unsigned due_of(const struct rates *rates, uint32_t frame_us)
{
    uint64_t last_us = 0U;
    unsigned due = 0U;

    for (unsigned i = 1U; i <= 300U; i++) {
        due += rates_frame_is_due(rates->frame_period_us, (uint64_t)i * frame_us + i * 7919U % 4000U, &last_us) ? 1U : 0U;
    }
    return due;
}

void test_rates(void)
{
    uint64_t last_us = 0U;

    test_case("a wire that is wide, or none");
    CHECK(due_of(rates_of(RATES_AUTOPILOT, 0U), 16667U) == 300U);
    CHECK(due_of(rates_of(RATES_AUTOPILOT, RATES_FULL_BAUD), 16667U) == 300U);
    CHECK(due_of(rates_of(RATES_GROUND, RATES_FULL_BAUD), 16667U) == 300U);
    test_case("a narrow one: each third, each second of 60 frames a second");
    CHECK(due_of(rates_of(RATES_AUTOPILOT, 57600U), 16667U) == 100U);
    CHECK(due_of(rates_of(RATES_GROUND, 57600U), 16667U) == 150U);
    test_case("each second, each of 30 frames a second");
    CHECK(due_of(rates_of(RATES_AUTOPILOT, 57600U), 33333U) == 150U);
    CHECK(due_of(rates_of(RATES_GROUND, 57600U), 33333U) == 300U);
    test_case("the first of all, and the first after a pause");
    CHECK(rates_frame_is_due(42000U, 1U, &last_us) && !rates_frame_is_due(42000U, 2U, &last_us));
    CHECK(rates_frame_is_due(42000U, 500000U, &last_us) && !rates_frame_is_due(42000U, 541999U, &last_us));
    CHECK(rates_frame_is_due(42000U, 542000U, &last_us));
}

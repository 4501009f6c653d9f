// SPDX-License-Identifier: Apache-2.0
#include "rates.h"
#include "test.h"

static unsigned due_of(uint32_t frames, uint32_t first, uint32_t step, unsigned count)
{
    uint32_t last = 0U;
    unsigned due = 0U;

    for (unsigned i = 0; i < count; i++) {
        due += rates_frame_is_due(frames, first + i * step, &last) ? 1U : 0U;
    }
    return due;
}

void test_rates(void)
{
    uint32_t last = 0U;

    test_case("every frame, every second, every third");
    CHECK(due_of(1U, 1U, 1U, 60U) == 60U);
    CHECK(due_of(2U, 2U, 1U, 60U) == 30U);
    CHECK(due_of(3U, 3U, 1U, 60U) == 20U);
    test_case("with frames lost none of which divides, still as often as the wire takes");
    CHECK(due_of(2U, 1U, 2U, 60U) == 60U);
    CHECK(due_of(3U, 1U, 3U, 60U) == 60U);
    test_case("the first of all, the first after a pause, and then in step again");
    CHECK(rates_frame_is_due(3U, 1U, &last) && !rates_frame_is_due(3U, 2U, &last));
    CHECK(rates_frame_is_due(3U, 3U, &last));
    CHECK(rates_frame_is_due(3U, 100U, &last) && !rates_frame_is_due(3U, 101U, &last));
    CHECK(rates_frame_is_due(3U, 102U, &last));
    test_case("numbers wrap");
    last = 0xFFFFFFFFU;
    CHECK(!rates_frame_is_due(3U, 1U, &last) && rates_frame_is_due(3U, 2U, &last));
    test_case("a wire's rates");
    CHECK(rates_of(RATES_AUTOPILOT, 0U)->frames_a_message == 1U);
    CHECK(rates_of(RATES_AUTOPILOT, RATES_FULL_BAUD)->frames_a_message == 1U);
    CHECK(rates_of(RATES_AUTOPILOT, 57600U)->frames_a_message == 3U);
    CHECK(rates_of(RATES_GROUND, RATES_FULL_BAUD)->frames_a_message == 1U);
    CHECK(rates_of(RATES_GROUND, 57600U)->frames_a_message == 2U);
}

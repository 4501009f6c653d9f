// SPDX-License-Identifier: Apache-2.0
#include <string.h>

#include "crash.h"
#include "test.h"

void test_crash(void)
{
    struct crash_record record;
    uint32_t kind = 99U;
    uint32_t address = 99U;

    test_case("what was written is taken, once");
    crash_write(&record, CRASH_DATA, 0x1234abcdU);
    CHECK(crash_take(&record, &kind, &address));
    CHECK(kind == CRASH_DATA && address == 0x1234abcdU);
    CHECK(!crash_take(&record, &kind, &address));
    test_case("noise of power-up is no record, nor is one with a flipped bit");
    memset(&record, 0, sizeof record);
    CHECK(!crash_take(&record, &kind, &address));
    memset(&record, 0xFF, sizeof record);
    CHECK(!crash_take(&record, &kind, &address));
    for (uint32_t bit = 0; bit < 32U; bit++) {
        crash_write(&record, CRASH_UNDEFINED, 0U);
        record.address ^= 1U << bit;
        CHECK(!crash_take(&record, &kind, &address));
        crash_write(&record, CRASH_UNDEFINED, 0U);
        record.kind ^= 1U << bit;
        CHECK(!crash_take(&record, &kind, &address));
    }
    crash_write(&record, CRASH_KINDS, 0U);
    CHECK(!crash_take(&record, &kind, &address));
    test_case("in words");
    struct text text = {.length = 0U};
    crash_append(&text, CRASH_FAST_INTERRUPT, 0xdeadbeefU);
    CHECK(strcmp(text.chars, "fast interrupt at deadbeef") == 0);
    text.length = 0U;
    crash_append(&text, CRASH_ASYNCHRONOUS, 0x43c00000U);
    CHECK(strcmp(text.chars, "asynchronous abort at 43c00000") == 0);
    text.length = 0U;
    crash_append(&text, CRASH_KINDS, 1U);
    CHECK(strcmp(text.chars, "unknown fault at 00000001") == 0);
    test_case("numbers, and what does not fit");
    text.length = 0U;
    text_append_number(&text, 0U);
    text_append(&text, " ");
    text_append_number(&text, UINT32_MAX);
    CHECK(strcmp(text.chars, "0 4294967295") == 0);
    for (int i = 0; i < 10; i++) {
        text_append(&text, " and more");
    }
    CHECK(strlen(text.chars) == MAVLINK_OUT_STATUS_TEXT_CHARS && text.length == MAVLINK_OUT_STATUS_TEXT_CHARS);
}

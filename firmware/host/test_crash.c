// SPDX-License-Identifier: Apache-2.0
#include <string.h>

#include "crash.h"
#include "test.h"

void test_crash(void)
{
    struct crash_record record;
    char text[CRASH_TEXT_CHARS];
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
    crash_text(text, "Touchdown: ", CRASH_FAST_INTERRUPT, 0xdeadbeefU);
    CHECK(strcmp(text, "Touchdown: fast interrupt at deadbeef") == 0);
    crash_text(text, "restarted: ", CRASH_UNDEFINED, 0x00100a0cU);
    CHECK(strcmp(text, "restarted: undefined instruction at 00100a0c") == 0);
    crash_text(text, "a beginning that leaves no room for the end: ", CRASH_UNDEFINED, 0x00100a0cU);
    CHECK(strlen(text) == MAVLINK_OUT_STATUS_TEXT_CHARS);
    crash_text(text, "", CRASH_KINDS, 1U);
    CHECK(strcmp(text, "unknown fault at 00000001") == 0);
}

// SPDX-License-Identifier: Apache-2.0
// When a target leaves, and when the wire is kept free for it.
#include "release.h"
#include "test.h"

#define PERIOD_US 16667U

void test_release(void)
{
    const struct landing_result_header header = {.start_time_us = 1000000U, .scan_time_us = 16000U};
    struct release release = {.last_us = 0U, .period_us = 0U};
    const uint64_t first_us = release_of(&header);

    test_case("a target is due the same time after its frame's last pixel");
    CHECK(first_us == 1016950U);

    test_case("the wire is kept free for a target that is to come, and for no other");
    CHECK(!release_is_near(&release, first_us));
    release_note(&release, first_us);
    CHECK(!release_is_near(&release, first_us + PERIOD_US));
    release_note(&release, first_us + PERIOD_US);
    const uint64_t next_us = first_us + 2U * PERIOD_US;
    CHECK(!release_is_near(&release, next_us - 1901U));
    CHECK(release_is_near(&release, next_us - 1900U));
    CHECK(release_is_near(&release, next_us + 499U));
    CHECK(!release_is_near(&release, next_us + 500U));

    test_case("frames that come too fast keep nothing waiting");
    release_note(&release, next_us + 7999U);
    CHECK(!release_is_near(&release, next_us + 2U * 7999U));
    release_note(&release, next_us + 7999U + 8000U);
    CHECK(release_is_near(&release, next_us + 7999U + 2U * 8000U));

    test_case("after a gap there is no next one to wait for");
    release_note(&release, next_us + 7999U + 8000U + 100001U);
    CHECK(!release_is_near(&release, next_us + 7999U + 8000U + 2U * 100001U));
}

// SPDX-License-Identifier: Apache-2.0
#include "factor_search.h"
#include "test.h"

#define USUAL 128U

static struct factor_search search;

// Frames of the factor in force, none with a pad.
static void miss(int frames)
{
    for (int i = 0; i < frames; i++) {
        factor_search_update(&search, false, true, factor_search_factor(&search));
    }
}

static void test_walks(void)
{
    static const uint32_t others[] = {160U, 208U, 96U, 72U, 200U};

    search = (struct factor_search){0};
    for (int round = 0; round < 2; round++) {
        test_case("round %d: the usual factor for 18 frames, the others for 6 each", round);
        miss(17);
        CHECK(factor_search_factor(&search) == USUAL);
        miss(1);
        for (unsigned i = 0; i < sizeof others / sizeof others[0]; i++) {
            CHECK(factor_search_factor(&search) == others[i]);
            miss(5);
            CHECK(factor_search_factor(&search) == others[i]);
            miss(1);
        }
        CHECK(factor_search_factor(&search) == USUAL);
    }
}

static void test_stays(void)
{
    test_case("where the pad is found the search stays, and begins to count anew");
    search = (struct factor_search){0};
    miss(18);
    for (int i = 0; i < 100; i++) {
        factor_search_update(&search, true, true, 160U);
        miss(5);
    }
    CHECK(factor_search_factor(&search) == 160U);
    miss(1);
    CHECK(factor_search_factor(&search) == 208U);
}

static void test_factor_before(void)
{
    test_case("frames of another factor say nothing of this one");
    search = (struct factor_search){0};
    miss(18);
    for (int i = 0; i < 100; i++) {
        factor_search_update(&search, false, true, USUAL);
    }
    CHECK(factor_search_factor(&search) == 160U);
    miss(5);
    factor_search_update(&search, true, true, USUAL);
    miss(1);
    CHECK(factor_search_factor(&search) == 208U);
}

static void test_waits_for_the_search(void)
{
    test_case("a search that goes on is not cut off");
    search = (struct factor_search){0};
    for (int i = 0; i < 40; i++) {
        factor_search_update(&search, false, false, USUAL);
    }
    CHECK(factor_search_factor(&search) == USUAL);
    miss(1);
    CHECK(factor_search_factor(&search) == 160U);
}

void test_factor_search(void)
{
    test_walks();
    test_stays();
    test_factor_before();
    test_waits_for_the_search();
}

// SPDX-License-Identifier: Apache-2.0
#include "factor_search.h"

// docs/accuracy.md: which factor finds what.
static const uint32_t factors[] = {128U, 160U, 208U, 96U, 72U, 200U};
#define FACTORS (sizeof factors / sizeof factors[0])

// The usual factor gets more time, as most frames without a pad show none.
#define MISSES_USUAL 18U
#define MISSES_OTHER 6U

bool factor_search_is_usual(uint32_t factor)
{
    return factor == factors[0];
}

uint32_t factor_search_factor(const struct factor_search *search)
{
    return factors[search->place];
}

void factor_search_update(struct factor_search *search, bool found, bool ended, uint32_t factor)
{
    // A change shows a few frames later; frames of the factor before say nothing of this one.
    if (factor != factors[search->place]) {
        return;
    }
    if (found) {
        search->misses = 0U;
        return;
    }
    search->misses++;
    if (ended && search->misses >= (search->place == 0U ? MISSES_USUAL : MISSES_OTHER)) {
        search->place = (search->place + 1U) % FACTORS;
        search->misses = 0U;
    }
}

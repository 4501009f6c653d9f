// SPDX-License-Identifier: Apache-2.0
// Which threshold factor the hardware should use. One half suits most light; a
// shadow across the pad needs less, a reflection on it more. While no pad is
// seen, one factor after the other is tried; what shows the pad is kept.
#ifndef TOUCHDOWN_FACTOR_SEARCH_H
#define TOUCHDOWN_FACTOR_SEARCH_H

#include <stdbool.h>
#include <stdint.h>

// A frame whose thresholds may be those of another factor than its own.
#define FACTOR_SEARCH_MIXED UINT32_MAX

struct factor_search {
    uint32_t place;  // in the list of factors; 0 is the usual one
    uint32_t misses; // frames without a pad since the last one, or since this factor came
};

// Q1.8, as in the THRESHOLD register.
uint32_t factor_search_factor(const struct factor_search *search);

// True for the factor that most light needs.
bool factor_search_is_usual(uint32_t factor);

// One frame, taken with thresholds of `factor`. `ended`: all places in it were looked at; before, the factor stays.
void factor_search_update(struct factor_search *search, bool found, bool ended, uint32_t factor);

#endif

// SPDX-License-Identifier: Apache-2.0
#include "uart_baud.h"

#define SAMPLE_MIN 4U
#define SAMPLE_MAX 255U
#define CLOCK_MAX 65535U

struct uart_divisors uart_divisors_for(uint32_t clock_hz, uint32_t baud)
{
    struct uart_divisors best = {.clock = CLOCK_MAX, .sample = SAMPLE_MAX};
    uint32_t best_error = UINT32_MAX;

    for (uint32_t sample = SAMPLE_MIN; sample <= SAMPLE_MAX; sample++) {
        const uint32_t steps = baud * (sample + 1U);
        const uint32_t clock = (clock_hz + steps / 2U) / steps;
        if (clock < 1U || clock > CLOCK_MAX) {
            continue;
        }
        const uint32_t actual = clock_hz / (clock * (sample + 1U));
        const uint32_t error = actual > baud ? actual - baud : baud - actual;
        if (error < best_error) {
            best_error = error;
            best.clock = clock;
            best.sample = sample;
        }
    }
    return best;
}

// SPDX-License-Identifier: Apache-2.0
// The Cortex-A9's own timers.
#ifndef TOUCHDOWN_TIMER_H
#define TOUCHDOWN_TIMER_H

#include <stdint.h>

void timer_init(void);

// Microseconds since timer_init(), from the global timer.
uint64_t timer_now_us(void);

// How often the tick, one a millisecond, has interrupted.
uint32_t timer_ticks(void);

#endif

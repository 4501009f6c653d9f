// SPDX-License-Identifier: Apache-2.0
// Generic interrupt controller: who is called for which interrupt.
#ifndef TOUCHDOWN_GIC_H
#define TOUCHDOWN_GIC_H

#include <stdint.h>

typedef void (*gic_handler)(void);

void gic_init(void);

// Level-sensitive, to this core. `handler` runs with interrupts masked.
void gic_enable(uint32_t interrupt, gic_handler handler);

// From start.S.
void gic_dispatch(void);

static inline void interrupts_enable(void)
{
    __asm__ volatile("cpsie i" ::: "memory");
}

static inline void interrupts_disable(void)
{
    __asm__ volatile("cpsid i" ::: "memory");
}

#endif

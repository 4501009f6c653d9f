// SPDX-License-Identifier: Apache-2.0
#include "gic.h"

#include <stddef.h>

#include "zynq.h"

#define INTERRUPTS 96U
#define SPURIOUS 1023U
#define FIRST_SHARED 32U

#define CPU_CONTROL (ZYNQ_GIC_CPU_BASE + 0x00U)
#define CPU_PRIORITY_MASK (ZYNQ_GIC_CPU_BASE + 0x04U)
#define CPU_ACKNOWLEDGE (ZYNQ_GIC_CPU_BASE + 0x0CU)
#define CPU_END (ZYNQ_GIC_CPU_BASE + 0x10U)
#define DIST_CONTROL (ZYNQ_GIC_DISTRIBUTOR_BASE + 0x000U)
#define DIST_SET_ENABLE (ZYNQ_GIC_DISTRIBUTOR_BASE + 0x100U)
#define DIST_CLEAR_ENABLE (ZYNQ_GIC_DISTRIBUTOR_BASE + 0x180U)
#define DIST_CLEAR_PENDING (ZYNQ_GIC_DISTRIBUTOR_BASE + 0x280U)
#define DIST_PRIORITY (ZYNQ_GIC_DISTRIBUTOR_BASE + 0x400U)
#define DIST_TARGET (ZYNQ_GIC_DISTRIBUTOR_BASE + 0x800U)
#define DIST_CONFIG (ZYNQ_GIC_DISTRIBUTOR_BASE + 0xC00U)

#define PRIORITY 0xA0U
#define THIS_CORE 1U

static gic_handler handlers[INTERRUPTS];

void gic_init(void)
{
    register_write(DIST_CONTROL, 0U);
    for (uint32_t i = 0; i < INTERRUPTS; i += 32U) {
        register_write(DIST_CLEAR_ENABLE + i / 8U, 0xFFFFFFFFU);
        register_write(DIST_CLEAR_PENDING + i / 8U, 0xFFFFFFFFU);
    }
    register_write(CPU_PRIORITY_MASK, 0xFFU);
    register_write(CPU_CONTROL, 1U);
    register_write(DIST_CONTROL, 1U);
}

static void write_field(uintptr_t base, uint32_t interrupt, uint32_t bits, uint32_t value)
{
    const uint32_t in_word = 32U / bits;
    const uintptr_t address = base + interrupt / in_word * 4U;
    const uint32_t shift = interrupt % in_word * bits;
    const uint32_t mask = ((1U << bits) - 1U) << shift;

    register_write(address, (register_read(address) & ~mask) | (value << shift));
}

void gic_enable(uint32_t interrupt, gic_handler handler)
{
    handlers[interrupt] = handler;
    write_field(DIST_PRIORITY, interrupt, 8U, PRIORITY);
    if (interrupt >= FIRST_SHARED) {
        write_field(DIST_TARGET, interrupt, 8U, THIS_CORE);
        write_field(DIST_CONFIG, interrupt, 2U, 1U); // level; bit 0 reads as one for shared interrupts
    }
    register_write(DIST_SET_ENABLE + interrupt / 32U * 4U, 1U << (interrupt % 32U));
}

void gic_dispatch(void)
{
    const uint32_t acknowledge = register_read(CPU_ACKNOWLEDGE);
    const uint32_t interrupt = acknowledge & 0x3FFU;

    if (interrupt == SPURIOUS) {
        return;
    }
    if (interrupt < INTERRUPTS && handlers[interrupt] != NULL) {
        handlers[interrupt]();
    }
    register_write(CPU_END, acknowledge);
}

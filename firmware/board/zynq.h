// SPDX-License-Identifier: Apache-2.0
// Addresses and interrupt numbers of the Zynq-7000 (Technical Reference Manual,
// UG585) that this firmware uses.
#ifndef TOUCHDOWN_ZYNQ_H
#define TOUCHDOWN_ZYNQ_H

#include <stdint.h>

#define ZYNQ_UART0_BASE 0xE0000000U
#define ZYNQ_UART1_BASE 0xE0001000U
#define ZYNQ_SLCR_BASE 0xF8000000U
#define ZYNQ_GIC_CPU_BASE 0xF8F00100U
#define ZYNQ_GLOBAL_TIMER_BASE 0xF8F00200U
#define ZYNQ_PRIVATE_TIMER_BASE 0xF8F00600U
#define ZYNQ_WATCHDOG_BASE 0xF8F00620U
#define ZYNQ_GIC_DISTRIBUTOR_BASE 0xF8F01000U
#define ZYNQ_LANDING_CORE_BASE 0x43C00000U // M_AXI_GP0, as the block design maps it
#define ZYNQ_DISPLAY_BASE 0x43C10000U

#define ZYNQ_IRQ_PRIVATE_TIMER 29U
#define ZYNQ_IRQ_UART0 59U
#define ZYNQ_IRQ_LANDING_CORE 61U // IRQ_F2P[0]
#define ZYNQ_IRQ_UART1 82U

static inline uint32_t register_read(uintptr_t address)
{
    return *(const volatile uint32_t *)address;
}

static inline void register_write(uintptr_t address, uint32_t value)
{
    *(volatile uint32_t *)address = value;
}

static inline void finish_memory_accesses(void)
{
    __asm__ volatile("dsb" ::: "memory");
}

#endif

// SPDX-License-Identifier: Apache-2.0
#include "timer.h"

#include "board.h"
#include "gic.h"
#include "zynq.h"

#define GLOBAL_LOW (ZYNQ_GLOBAL_TIMER_BASE + 0x00U)
#define GLOBAL_HIGH (ZYNQ_GLOBAL_TIMER_BASE + 0x04U)
#define GLOBAL_CONTROL (ZYNQ_GLOBAL_TIMER_BASE + 0x08U)
#define PRIVATE_LOAD (ZYNQ_PRIVATE_TIMER_BASE + 0x00U)
#define PRIVATE_CONTROL (ZYNQ_PRIVATE_TIMER_BASE + 0x08U)
#define PRIVATE_STATUS (ZYNQ_PRIVATE_TIMER_BASE + 0x0CU)
#define PRIVATE_ENABLE_RELOAD_INTERRUPT 7U

#define TICKS_PER_SECOND 1000U
#define TIMER_PER_US (BOARD_PERIPHCLK_HZ / 1000000U)

// Read and written whole; only the interrupt writes it.
static volatile uint32_t ticks;

// The tick ends the main loop's sleep, and shows that interrupts come.
static void handle_tick(void)
{
    ticks++;
    register_write(PRIVATE_STATUS, 1U);
}

void timer_init(void)
{
    register_write(GLOBAL_CONTROL, 0U);
    register_write(GLOBAL_LOW, 0U);
    register_write(GLOBAL_HIGH, 0U);
    register_write(GLOBAL_CONTROL, 1U);
    gic_enable(ZYNQ_IRQ_PRIVATE_TIMER, handle_tick);
    register_write(PRIVATE_LOAD, BOARD_PERIPHCLK_HZ / TICKS_PER_SECOND - 1U);
    register_write(PRIVATE_CONTROL, PRIVATE_ENABLE_RELOAD_INTERRUPT);
}

uint32_t timer_ticks(void)
{
    return ticks;
}

uint64_t timer_now_us(void)
{
    uint32_t high = register_read(GLOBAL_HIGH);
    uint32_t low = register_read(GLOBAL_LOW);
    const uint32_t high_after = register_read(GLOBAL_HIGH);

    if (high_after != high) {
        high = high_after;
        low = register_read(GLOBAL_LOW);
    }
    return (((uint64_t)high << 32) | low) / TIMER_PER_US;
}

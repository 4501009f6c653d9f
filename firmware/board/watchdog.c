// SPDX-License-Identifier: Apache-2.0
#include "watchdog.h"

#include "board.h"
#include "zynq.h"

#define LOAD (ZYNQ_WATCHDOG_BASE + 0x00U) // writing it reloads the counter
#define CONTROL (ZYNQ_WATCHDOG_BASE + 0x08U)
#define RESET_STATUS (ZYNQ_WATCHDOG_BASE + 0x10U)
#define CONTROL_ENABLE (1U << 0)
#define CONTROL_WATCHDOG (1U << 3)
#define RESET_STATUS_BITTEN (1U << 0)

#define SLCR_LOCK (ZYNQ_SLCR_BASE + 0x004U)
#define SLCR_UNLOCK (ZYNQ_SLCR_BASE + 0x008U)
#define SLCR_REBOOT_STATUS (ZYNQ_SLCR_BASE + 0x258U)
#define SLCR_LOCK_KEY 0x767BU
#define SLCR_UNLOCK_KEY 0xDF0DU
#define REBOOT_BY_WATCHDOG_0 (1U << 17)

// Longer than any round of the main loop, shorter than the gap that an autopilot
// takes for the end of a target.
#define LIMIT_MS 500U
#define LOAD_VALUE (BOARD_PERIPHCLK_HZ / 1000U * LIMIT_MS)

bool watchdog_has_bitten(void)
{
    // The watchdog's own note may not outlast the reset that it asks for; the system's does.
    const bool own = (register_read(RESET_STATUS) & RESET_STATUS_BITTEN) != 0U;
    const uint32_t reboot = register_read(SLCR_REBOOT_STATUS);

    if (own) {
        register_write(RESET_STATUS, RESET_STATUS_BITTEN);
    }
    if ((reboot & REBOOT_BY_WATCHDOG_0) != 0U) {
        register_write(SLCR_UNLOCK, SLCR_UNLOCK_KEY);
        register_write(SLCR_REBOOT_STATUS, reboot & ~REBOOT_BY_WATCHDOG_0);
        register_write(SLCR_LOCK, SLCR_LOCK_KEY);
    }
    return own || (reboot & REBOOT_BY_WATCHDOG_0) != 0U;
}

void watchdog_start(void)
{
    register_write(LOAD, LOAD_VALUE);
    register_write(CONTROL, CONTROL_WATCHDOG | CONTROL_ENABLE);
}

void watchdog_feed(void)
{
    register_write(LOAD, LOAD_VALUE);
}

// SPDX-License-Identifier: Apache-2.0
// The watchdog's driver against registers that are made up here; firmware/test_watchdog.py sees it on QEMU.
#include <stdint.h>

// In place of board/zynq.h, which needs the processor.
#define TOUCHDOWN_ZYNQ_H
#define ZYNQ_WATCHDOG_BASE 0x1000U
#define ZYNQ_SLCR_BASE 0x0U

static uint32_t register_read(uintptr_t address);
static void register_write(uintptr_t address, uint32_t value);

#include "../board/watchdog.c"

#include "test.h"

#define OTHER_REASONS 0x00400055U

static uint32_t load;
static uint32_t control;
static uint32_t reset_status;
static uint32_t reboot_status;
static bool locked;
static unsigned loads;

static uint32_t register_read(uintptr_t address)
{
    return address == RESET_STATUS ? reset_status : address == SLCR_REBOOT_STATUS ? reboot_status : 0U;
}

static void register_write(uintptr_t address, uint32_t value)
{
    switch (address) {
    case LOAD:
        load = value;
        loads++;
        break;
    case CONTROL:
        control = value;
        break;
    case RESET_STATUS:
        reset_status &= ~value;
        break;
    case SLCR_LOCK:
        locked = locked || value == SLCR_LOCK_KEY;
        break;
    case SLCR_UNLOCK:
        locked = locked && value != SLCR_UNLOCK_KEY;
        break;
    case SLCR_REBOOT_STATUS:
        reboot_status = locked ? reboot_status : value;
        break;
    default:
        CHECK(false);
    }
}

static void power_up(uint32_t own, uint32_t of_system)
{
    reset_status = own;
    reboot_status = of_system;
    locked = true;
    loads = 0U;
    control = 0U;
}

void test_watchdog(void)
{
    test_case("power-up is no bite");
    power_up(0U, OTHER_REASONS);
    CHECK(!watchdog_has_bitten());
    CHECK(reboot_status == OTHER_REASONS && locked);
    test_case("either note is enough, and is told once; other reasons stay noted");
    for (unsigned i = 1U; i < 4U; i++) {
        power_up(i & 1U, OTHER_REASONS | ((i & 2U) != 0U ? REBOOT_BY_WATCHDOG_0 : 0U));
        CHECK(watchdog_has_bitten());
        CHECK(!watchdog_has_bitten());
        CHECK(reboot_status == OTHER_REASONS && locked);
    }
    test_case("it has its time before it runs, as a watchdog and not as a timer, and gets it again with each feed");
    power_up(0U, 0U);
    watchdog_start();
    CHECK(loads == 1U && load == BOARD_PERIPHCLK_HZ / 2U && control == (CONTROL_WATCHDOG | CONTROL_ENABLE));
    watchdog_feed();
    CHECK(loads == 2U && load == BOARD_PERIPHCLK_HZ / 2U);
}

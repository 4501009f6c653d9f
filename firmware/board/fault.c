// SPDX-License-Identifier: Apache-2.0
#include "fault.h"

#include "crash.h"
#include "keep.h"
#include "mavlink_out.h"
#include "uart.h"

_Noreturn void fault_report(uint32_t kind, uint32_t address)
{
    struct mavlink_out out = {.sequence = 0};
    uint8_t bytes[MAVLINK_OUT_MAX_BYTES];
    struct text text = {.length = 0U};

    crash_write(&keep.crash, kind, address);
    text_append(&text, "Touchdown: ");
    crash_append(&text, kind, address);
    uart_write_polled(UART_1, bytes, mavlink_out_status_text(&out, MAVLINK_OUT_CRITICAL, text.chars, bytes));
    // Endless: what is to be said has been said.
    for (;;) {
        __asm__ volatile("wfi");
    }
}

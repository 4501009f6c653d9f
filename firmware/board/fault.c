// SPDX-License-Identifier: Apache-2.0
#include "fault.h"

#include <stddef.h>

#include "mavlink_out.h"
#include "uart.h"

static const char *const kinds[] = {"undefined instruction", "supervisor call", "prefetch abort", "data abort",
                                    "fast interrupt"};

static size_t append(char *text, size_t length, const char *more)
{
    for (size_t i = 0; more[i] != '\0' && length < MAVLINK_OUT_STATUS_TEXT_CHARS; i++) {
        text[length++] = more[i];
    }
    return length;
}

_Noreturn void fault_report(uint32_t kind, uint32_t address)
{
    struct mavlink_out out = {.sequence = 0};
    uint8_t bytes[MAVLINK_OUT_MAX_BYTES];
    char text[MAVLINK_OUT_STATUS_TEXT_CHARS + 1U] = {0};
    char hexadecimal[9] = {0};

    for (uint32_t i = 0; i < 8U; i++) {
        hexadecimal[i] = "0123456789abcdef"[(address >> (28U - 4U * i)) & 0xFU];
    }
    size_t length = append(text, 0, "Touchdown: ");
    length = append(text, length, kinds[kind]);
    length = append(text, length, " at ");
    append(text, length, hexadecimal);
    uart_write_polled(UART_1, bytes, mavlink_out_status_text(&out, MAVLINK_OUT_CRITICAL, text, bytes));
    for (;;) {
        __asm__ volatile("wfi");
    }
}

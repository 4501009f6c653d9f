// SPDX-License-Identifier: Apache-2.0
#ifndef TOUCHDOWN_UART_BAUD_H
#define TOUCHDOWN_UART_BAUD_H

#include <stdint.h>

struct uart_divisors {
    uint32_t clock;  // BAUDGEN.CD, 1 to 65535
    uint32_t sample; // BAUDDIV.BDIV, 4 to 255
};

// The divisors with the least error: baud = clock_hz / (CD * (BDIV + 1)).
struct uart_divisors uart_divisors_for(uint32_t clock_hz, uint32_t baud);

#endif

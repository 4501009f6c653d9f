// SPDX-License-Identifier: Apache-2.0
// Both UARTs of the PS, 8N1, driven by interrupts through rings. Sending never
// blocks: a message that finds no room, or that would leave 100 ms late, is dropped
// whole.
#ifndef TOUCHDOWN_UART_H
#define TOUCHDOWN_UART_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum uart_id { UART_0, UART_1, UARTS };

void uart_init(enum uart_id id, uint32_t baud);

// False when it would have to wait too long; then nothing is sent.
bool uart_write(enum uart_id id, const uint8_t *bytes, size_t size);

size_t uart_read(enum uart_id id, uint8_t *bytes, size_t limit);
bool uart_has_input(enum uart_id id);

// What arrived and was lost since uart_init(), so that a command that never came can be told from one never sent.
struct uart_losses {
    uint32_t full_bytes; // that the ring had no room for: the main loop was too slow
    uint32_t overruns;   // times that the FIFO was found to have lost bytes: interrupts were off too long
};

struct uart_losses uart_lost(enum uart_id id);

// How many bytes have left for the FIFO so far, and whether more wait.
uint32_t uart_sent(enum uart_id id);
bool uart_is_sending(enum uart_id id);

// For faults and starts: without interrupts; sends what is in the ring, then the bytes. Gives
// up on a UART that takes nothing.
void uart_write_polled(enum uart_id id, const uint8_t *bytes, size_t size);

#endif

// SPDX-License-Identifier: Apache-2.0
#include "uart.h"

#include "board.h"
#include "byte_ring.h"
#include "gic.h"
#include "uart_baud.h"
#include "zynq.h"

#define CONTROL 0x00U
#define MODE 0x04U
#define INTERRUPT_ENABLE 0x08U
#define INTERRUPT_DISABLE 0x0CU
#define INTERRUPT_STATUS 0x14U
#define BAUD_GENERATOR 0x18U
#define RX_TIMEOUT 0x1CU
#define RX_WATERMARK 0x20U
#define STATUS 0x2CU
#define FIFO 0x30U
#define BAUD_DIVIDER 0x34U

#define CONTROL_RX_RESET (1U << 0)
#define CONTROL_TX_RESET (1U << 1)
#define CONTROL_RX_ENABLE (1U << 2)
#define CONTROL_TX_ENABLE (1U << 4)
#define CONTROL_RESTART_TIMEOUT (1U << 6)
#define MODE_8N1 0x20U
#define INTERRUPT_RX_WATERMARK (1U << 0)
#define INTERRUPT_TX_EMPTY (1U << 3)
#define INTERRUPT_RX_OVERRUN (1U << 5)
#define INTERRUPT_RX_TIMEOUT (1U << 8)
#define INTERRUPT_RX (INTERRUPT_RX_WATERMARK | INTERRUPT_RX_OVERRUN | INTERRUPT_RX_TIMEOUT)
#define INTERRUPT_ALL 0x1FFFU
#define STATUS_RX_EMPTY (1U << 1)
#define STATUS_TX_FULL (1U << 4)

// 8 of 64 bytes: early enough at 921600 baud, and within the 16 that QEMU models.
#define WATERMARK 8U
// In units of 4 bit times: the end of a burst is noticed after 4 characters.
#define TIMEOUT 10U
#define POLL_LIMIT 1000000U

// What waits longer than this to leave is dropped instead. Of the 10 bit times that a byte takes.
#define WAIT_MS 100U
#define BITS_A_BYTE 10U
#define FIFO_DEPTH 64U

#define RX_BYTES 1024U
#define TX_BYTES 4096U

struct uart {
    uintptr_t base;
    struct byte_ring rx;
    struct byte_ring tx;
    uint32_t tx_limit; // bytes that may wait in the ring
    // Each read and written whole; only the interrupt writes them.
    volatile uint32_t rx_full_bytes;
    volatile uint32_t rx_overruns;
    uint8_t rx_storage[RX_BYTES];
    uint8_t tx_storage[TX_BYTES];
};

static struct uart uarts[UARTS] = {{.base = ZYNQ_UART0_BASE}, {.base = ZYNQ_UART1_BASE}};

// Moves what fits from the ring into the FIFO; the TX interrupt stays on while
// the ring is not empty. Runs with interrupts masked.
static void pump(struct uart *uart)
{
    uint8_t byte;

    // Bounded: each turn takes a byte out of the ring, and nobody puts one in.
    while ((register_read(uart->base + STATUS) & STATUS_TX_FULL) == 0U && byte_ring_take(&uart->tx, &byte, 1U) == 1U) {
        register_write(uart->base + FIFO, byte);
    }
    register_write(uart->base + (byte_ring_is_empty(&uart->tx) ? INTERRUPT_DISABLE : INTERRUPT_ENABLE),
                   INTERRUPT_TX_EMPTY);
}

static void handle(struct uart *uart)
{
    const uint32_t status = register_read(uart->base + INTERRUPT_STATUS);

    register_write(uart->base + INTERRUPT_STATUS, status);
    if ((status & INTERRUPT_RX_OVERRUN) != 0U) {
        uart->rx_overruns++;
    }
    // A UART that never runs empty is left to its next interrupt.
    for (uint32_t i = 0; i < RX_BYTES && (register_read(uart->base + STATUS) & STATUS_RX_EMPTY) == 0U; i++) {
        const uint8_t byte = (uint8_t)register_read(uart->base + FIFO);
        // The checksum of the message tells that a byte is missing.
        if (!byte_ring_put(&uart->rx, &byte, 1U)) {
            uart->rx_full_bytes++;
        }
    }
    pump(uart);
}

static void handle_uart_0(void)
{
    handle(&uarts[UART_0]);
}

static void handle_uart_1(void)
{
    handle(&uarts[UART_1]);
}

void uart_init(enum uart_id id, uint32_t baud)
{
    struct uart *uart = &uarts[id];
    const struct uart_divisors divisors = uart_divisors_for(BOARD_UART_CLOCK_HZ, baud);

    byte_ring_init(&uart->rx, uart->rx_storage, RX_BYTES);
    byte_ring_init(&uart->tx, uart->tx_storage, TX_BYTES);
    uart->rx_full_bytes = 0U;
    uart->rx_overruns = 0U;
    uart->tx_limit = baud / BITS_A_BYTE * WAIT_MS / 1000U - FIFO_DEPTH;
    register_write(uart->base + INTERRUPT_DISABLE, INTERRUPT_ALL);
    register_write(uart->base + CONTROL, 0U);
    register_write(uart->base + MODE, MODE_8N1);
    register_write(uart->base + BAUD_GENERATOR, divisors.clock);
    register_write(uart->base + BAUD_DIVIDER, divisors.sample);
    register_write(uart->base + RX_WATERMARK, WATERMARK);
    register_write(uart->base + RX_TIMEOUT, TIMEOUT);
    register_write(uart->base + CONTROL, CONTROL_RX_RESET | CONTROL_TX_RESET);
    register_write(uart->base + CONTROL, CONTROL_RX_ENABLE | CONTROL_TX_ENABLE | CONTROL_RESTART_TIMEOUT);
    register_write(uart->base + INTERRUPT_STATUS, INTERRUPT_ALL);
    register_write(uart->base + INTERRUPT_ENABLE, INTERRUPT_RX);
    if (id == UART_0) {
        gic_enable(ZYNQ_IRQ_UART0, handle_uart_0);
    } else {
        gic_enable(ZYNQ_IRQ_UART1, handle_uart_1);
    }
}

bool uart_write(enum uart_id id, const uint8_t *bytes, size_t size)
{
    struct uart *uart = &uarts[id];

    if (byte_ring_count(&uart->tx) + size > uart->tx_limit || !byte_ring_put(&uart->tx, bytes, size)) {
        return false;
    }
    interrupts_disable();
    pump(uart);
    interrupts_enable();
    return true;
}

size_t uart_read(enum uart_id id, uint8_t *bytes, size_t limit)
{
    return byte_ring_take(&uarts[id].rx, bytes, limit);
}

bool uart_has_input(enum uart_id id)
{
    return !byte_ring_is_empty(&uarts[id].rx);
}

struct uart_losses uart_lost(enum uart_id id)
{
    const struct uart_losses losses = {.full_bytes = uarts[id].rx_full_bytes, .overruns = uarts[id].rx_overruns};

    return losses;
}

uint32_t uart_sent(enum uart_id id)
{
    return byte_ring_taken(&uarts[id].tx);
}

bool uart_is_sending(enum uart_id id)
{
    return !byte_ring_is_empty(&uarts[id].tx);
}

static bool send_polled(uintptr_t base, uint8_t byte)
{
    for (uint32_t polls = 0; polls < POLL_LIMIT; polls++) {
        if ((register_read(base + STATUS) & STATUS_TX_FULL) == 0U) {
            register_write(base + FIFO, byte);
            return true;
        }
    }
    return false;
}

void uart_write_polled(enum uart_id id, const uint8_t *bytes, size_t size)
{
    struct uart *uart = &uarts[id];
    uint8_t byte;

    // A message that is cut off would swallow the start of this one.
    // Bounded: each turn takes a byte out of the ring, and nobody puts one in.
    while (byte_ring_take(&uart->tx, &byte, 1U) == 1U) {
        if (!send_polled(uart->base, byte)) {
            return;
        }
    }
    for (size_t i = 0; i < size; i++) {
        if (!send_polled(uart->base, bytes[i])) {
            return;
        }
    }
}

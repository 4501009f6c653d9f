// SPDX-License-Identifier: Apache-2.0
// The UART driver against a FIFO that is made up here.
#include <stdint.h>
#include <string.h>

// In place of board/zynq.h and board/gic.h, which need the processor.
#define TOUCHDOWN_ZYNQ_H
#define TOUCHDOWN_GIC_H
#define ZYNQ_UART0_BASE 0x0U
#define ZYNQ_UART1_BASE 0x1000U
#define ZYNQ_IRQ_UART0 0U
#define ZYNQ_IRQ_UART1 1U

static uint32_t register_read(uintptr_t address);
static void register_write(uintptr_t address, uint32_t value);

static void (*interrupt_of[2])(void);

static void gic_enable(uint32_t interrupt, void (*handler)(void))
{
    interrupt_of[interrupt] = handler;
}

static void interrupts_enable(void)
{
}

static void interrupts_disable(void)
{
}

#include "../board/uart.c"

#include "test.h"

#define FIFO_BYTES 64

static uint8_t wire[8192];
static size_t sent;
static int room;
static bool stuck;
static bool babbling;
static uint32_t reads;
static uint32_t arriving; // bytes that wait in the receive FIFO
static uint32_t interrupts; // INTERRUPT_STATUS

// A full FIFO sends one byte between two looks at it, unless it is stuck.
static uint32_t register_read(uintptr_t address)
{
    reads++;
    if (address % 0x1000U == INTERRUPT_STATUS) {
        return interrupts;
    }
    if (address % 0x1000U == FIFO && arriving > 0U) {
        arriving--;
    }
    if (address % 0x1000U != STATUS) {
        return 0U;
    }
    if (arriving > 0U) {
        return 0U;
    }
    if (babbling) {
        return STATUS_TX_FULL;
    }
    if (room == 0) {
        room = stuck ? 0 : 1;
        return STATUS_TX_FULL | STATUS_RX_EMPTY;
    }
    return STATUS_RX_EMPTY;
}

// Writing ones clears them.
static void register_write(uintptr_t address, uint32_t value)
{
    if (address % 0x1000U == INTERRUPT_STATUS) {
        interrupts &= ~value;
    }
    if (address == ZYNQ_UART1_BASE + FIFO) {
        CHECK(room > 0 && sent < sizeof wire);
        wire[sent++] = (uint8_t)value;
        room--;
    }
}

static void start(void)
{
    sent = 0;
    room = FIFO_BYTES;
    stuck = false;
    reads = 0;
    arriving = 0;
    interrupts = 0;
    uart_init(UART_1, 57600U);
}

static void arrive(uint32_t bytes, uint32_t status)
{
    arriving = bytes;
    interrupts = status;
    interrupt_of[1]();
    CHECK(arriving == 0U && interrupts == 0U);
}

static void test_losses(void)
{
    uint8_t bytes[16];

    test_case("what finds no room in the ring is counted, byte by byte");
    start();
    arrive(RX_BYTES, INTERRUPT_RX_WATERMARK);
    CHECK(uart_lost(UART_1).full_bytes == 0U && uart_lost(UART_1).overruns == 0U);
    arrive(5U, INTERRUPT_RX_TIMEOUT);
    CHECK(uart_lost(UART_1).full_bytes == 5U);
    CHECK(uart_read(UART_1, bytes, sizeof bytes) == sizeof bytes);
    arrive(17U, INTERRUPT_RX_WATERMARK);
    CHECK(uart_lost(UART_1).full_bytes == 6U && uart_lost(UART_1).overruns == 0U);
    test_case("each overrun of the FIFO is counted once, though nothing may be left to read");
    arrive(0U, INTERRUPT_RX_OVERRUN);
    arrive(0U, INTERRUPT_RX_OVERRUN | INTERRUPT_RX_TIMEOUT);
    arrive(0U, INTERRUPT_RX_TIMEOUT | INTERRUPT_TX_EMPTY);
    CHECK(uart_lost(UART_1).full_bytes == 6U && uart_lost(UART_1).overruns == 2U);
    test_case("of each UART its own");
    CHECK(uart_lost(UART_0).full_bytes == 0U && uart_lost(UART_0).overruns == 0U);
    start();
    CHECK(uart_lost(UART_1).full_bytes == 0U && uart_lost(UART_1).overruns == 0U);
}

void test_uart(void)
{
    uint8_t message[200];

    for (size_t i = 0; i < sizeof message; i++) {
        message[i] = (uint8_t)i;
    }
    test_case("a last word waits for the messages before it, whole");
    start();
    CHECK(uart_write(UART_1, message, sizeof message));
    CHECK(sent == FIFO_BYTES);
    uart_write_polled(UART_1, (const uint8_t *)"last", 4U);
    CHECK(sent == sizeof message + 4U);
    CHECK(memcmp(wire, message, sizeof message) == 0);
    CHECK(memcmp(wire + sizeof message, "last", 4U) == 0);

    test_case("what would leave 100 ms late is not sent, whole messages at a time");
    start();
    room = 0;
    stuck = true;
    size_t taken = 0;
    while (uart_write(UART_1, message, 50U)) {
        taken += 50U;
    }
    CHECK(taken == 500U); // 512 and the 64 of the FIFO are 100 ms at 57600 baud
    CHECK(uart_is_sending(UART_1) && uart_sent(UART_1) == 0U);
    CHECK(uart_write(UART_1, message, 12U) && !uart_write(UART_1, message, 1U));
    test_case("as it leaves there is room again");
    room = FIFO_BYTES;
    interrupt_of[1]();
    CHECK(uart_sent(UART_1) == FIFO_BYTES && uart_write(UART_1, message, 50U));
    stuck = false;
    uart_write_polled(UART_1, message, 0U);
    CHECK(!uart_is_sending(UART_1) && uart_sent(UART_1) == sent);
    test_case("a faster wire takes more, as much as there is memory");
    uart_init(UART_1, 115200U);
    CHECK(uarts[UART_1].tx_limit == 1088U);
    uart_init(UART_1, 921600U);
    CHECK(uarts[UART_1].tx_limit > TX_BYTES);

    test_case("a UART that takes nothing does not hold the processor for long");
    start();
    CHECK(uart_write(UART_1, message, sizeof message));
    stuck = true;
    room = 0;
    reads = 0;
    uart_write_polled(UART_1, (const uint8_t *)"last", 4U);
    CHECK(sent == FIFO_BYTES);
    CHECK(reads <= POLL_LIMIT);

    test_case("a UART that never runs empty does not hold an interrupt for ever");
    start();
    babbling = true;
    reads = 0;
    handle_uart_1();
    babbling = false;
    CHECK(reads <= 2U * RX_BYTES + 4U);
    CHECK(uart_has_input(UART_1));
    test_losses();
}

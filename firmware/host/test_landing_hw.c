// SPDX-License-Identifier: Apache-2.0
// landing_core's driver against registers that are made up here.
#include <stdint.h>
#include <string.h>

// In place of board/zynq.h and board/gic.h, which need the processor.
#define TOUCHDOWN_ZYNQ_H
#define TOUCHDOWN_GIC_H
#define ZYNQ_LANDING_CORE_BASE 0U
#define ZYNQ_IRQ_LANDING_CORE 0U

static uint32_t register_read(uintptr_t address);
static void register_write(uintptr_t address, uint32_t value);
static void (*interrupt)(void);

static void gic_enable(uint32_t number, void (*handler)(void))
{
    (void)number;
    interrupt = handler;
}

static void finish_memory_accesses(void)
{
}

static void interrupts_enable(void)
{
}

static void interrupts_disable(void)
{
}

#include "../board/landing_hw.c"

#include "test.h"

static uint32_t registers[32];
static struct landing_record record;

static uint32_t register_read(uintptr_t address)
{
    return registers[address / 4U];
}

static void register_write(uintptr_t address, uint32_t value)
{
    uint32_t *place = &registers[address / 4U];

    *place = address == LANDING_REG_IRQ_STATUS_OFFSET ? *place & ~value : value;
}

static void complete_frame(uint32_t number, uint32_t index)
{
    ring[index * BUFFER_WORDS + offsetof(struct landing_result_header, frame_number) / sizeof(uint32_t)] = number;
    registers[LANDING_REG_FRAME_NUMBER_OFFSET / 4U] = number;
    registers[LANDING_REG_RING_HEAD_OFFSET / 4U] = LANDING_REG_RING_HEAD_VALID_MASK | index;
    registers[LANDING_REG_IRQ_STATUS_OFFSET / 4U] |= LANDING_REG_IRQ_STATUS_FRAME_DONE_MASK;
    interrupt();
}

// What the application asks for, whatever it is.
#define THRESHOLD 0x00100080U

static void test_adaptation(void)
{
    test_case("the application's choices reach their registers, at the start and later");
    landing_hw_start(100U, THRESHOLD);
    CHECK(registers[LANDING_REG_MIN_AREA_OFFSET / 4U] == 100U);
    CHECK(registers[LANDING_REG_THRESHOLD_OFFSET / 4U] == THRESHOLD);
    landing_hw_adapt(77U, 0x00200060U);
    CHECK(registers[LANDING_REG_MIN_AREA_OFFSET / 4U] == 77U);
    CHECK(registers[LANDING_REG_THRESHOLD_OFFSET / 4U] == 0x00200060U);
}

static void test_frames(void)
{
    test_case("each frame is read from its buffer, late or not");
    landing_hw_start(100U, THRESHOLD);
    CHECK(!landing_hw_frame_pending());
    complete_frame(7U, 0U);
    complete_frame(8U, 1U);
    CHECK(landing_hw_take_frame(&record) == 64 && record.header.frame_number == 7U);
    CHECK(landing_hw_take_frame(&record) == 64 && record.header.frame_number == 8U);
    CHECK(!landing_hw_frame_pending());

    test_case("a buffer that was used again is not taken for the frame that was in it");
    for (uint32_t number = 9U; number <= 13U; number++) {
        complete_frame(number, (number - 7U) % LANDING_RING_BUFFERS);
    }
    CHECK(landing_hw_take_frame(&record) == RECORD_E_TORN);
    for (uint32_t number = 10U; number <= 13U; number++) {
        CHECK(landing_hw_take_frame(&record) == 64 && record.header.frame_number == number);
    }
    CHECK(!landing_hw_frame_pending());
}

static void test_complaints(void)
{
    uint32_t *status = &registers[LANDING_REG_IRQ_STATUS_OFFSET / 4U];

    test_case("only what is handled is acknowledged");
    landing_hw_start(100U, THRESHOLD);
    *status = LANDING_REG_IRQ_STATUS_AXI_ERROR_MASK | LANDING_REG_IRQ_STATUS_FRAME_OVERFLOW_MASK;
    registers[LANDING_REG_FRAMES_UNWRITTEN_OFFSET / 4U] = 3U;
    complete_frame(1U, 0U);
    CHECK(*status == (LANDING_REG_IRQ_STATUS_AXI_ERROR_MASK | LANDING_REG_IRQ_STATUS_FRAME_OVERFLOW_MASK));
    struct app_complaints complaints = landing_hw_complaints();
    CHECK(complaints.write_error && !complaints.lidar_fault && complaints.frames_unwritten == 3U);
    CHECK(*status == LANDING_REG_IRQ_STATUS_FRAME_OVERFLOW_MASK);
    *status |= LANDING_REG_IRQ_STATUS_LIDAR_FAULT_MASK;
    complaints = landing_hw_complaints();
    CHECK(!complaints.write_error && complaints.lidar_fault);
}

static void fit(void)
{
    registers[LANDING_REG_ID_OFFSET / 4U] = LANDING_REG_ID_VALUE_RESET;
    registers[LANDING_REG_VERSION_OFFSET / 4U] = (LANDING_REG_VERSION_MAJOR_RESET << LANDING_REG_VERSION_MAJOR_SHIFT) +
                                                 (LANDING_REG_VERSION_MINOR_RESET << LANDING_REG_VERSION_MINOR_SHIFT);
    registers[LANDING_REG_RING_INFO_OFFSET / 4U] =
        LANDING_RING_BUFFERS << LANDING_REG_RING_INFO_BUFFERS_SHIFT |
        LANDING_RECORD_MAX_OBJECTS << LANDING_REG_RING_INFO_MAX_OBJECTS_SHIFT;
}

static bool refuses(const char *about)
{
    const char *fault = landing_hw_fault();

    return fault != NULL && strstr(fault, about) != NULL && strlen(fault) <= 50U;
}

static void test_faults(void)
{
    test_case("hardware that fits");
    fit();
    CHECK(landing_hw_fault() == NULL);
    registers[LANDING_REG_RING_INFO_OFFSET / 4U] -= 1U << LANDING_REG_RING_INFO_MAX_OBJECTS_SHIFT;
    CHECK(landing_hw_fault() == NULL);
    test_case("hardware that is not there, of another version, or with another ring");
    fit();
    registers[LANDING_REG_ID_OFFSET / 4U] = 0U;
    CHECK(refuses("no landing_core"));
    fit();
    registers[LANDING_REG_VERSION_OFFSET / 4U] += 1U << LANDING_REG_VERSION_MAJOR_SHIFT;
    CHECK(refuses("do not match"));
    fit();
    registers[LANDING_REG_VERSION_OFFSET / 4U] -= 1U << LANDING_REG_VERSION_MINOR_SHIFT;
    CHECK(refuses("older"));
    registers[LANDING_REG_VERSION_OFFSET / 4U] += 2U << LANDING_REG_VERSION_MINOR_SHIFT;
    CHECK(landing_hw_fault() == NULL);
    fit();
    registers[LANDING_REG_RING_INFO_OFFSET / 4U] -= 1U << LANDING_REG_RING_INFO_BUFFERS_SHIFT;
    CHECK(refuses("another size"));
    fit();
    registers[LANDING_REG_RING_INFO_OFFSET / 4U] += 1U << LANDING_REG_RING_INFO_MAX_OBJECTS_SHIFT;
    CHECK(refuses("another size"));
}

void test_landing_hw(void)
{
    test_faults();
    test_adaptation();
    test_frames();
    test_complaints();
}

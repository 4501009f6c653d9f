// SPDX-License-Identifier: Apache-2.0
#include "landing_hw.h"

#include <stddef.h>

#include "board.h"
#include "frame_queue.h"
#include "gic.h"
#include "record.h"
#include "zynq.h"

#define RING_WORDS (LANDING_RING_BUFFERS * LANDING_RING_STRIDE_BYTES / sizeof(uint32_t))
#define BUFFER_WORDS (LANDING_RING_STRIDE_BYTES / sizeof(uint32_t))
#define ALL_INTERRUPTS                                                                                                 \
    (LANDING_REG_IRQ_ENABLE_FRAME_DONE_MASK | LANDING_REG_IRQ_ENABLE_FRAME_MALFORMED_MASK |                            \
     LANDING_REG_IRQ_ENABLE_FRAME_OVERFLOW_MASK | LANDING_REG_IRQ_ENABLE_AXI_ERROR_MASK |                              \
     LANDING_REG_IRQ_ENABLE_LIDAR_FAULT_MASK)

static volatile uint32_t ring[RING_WORDS] __attribute__((aligned(4096), section(".ring")));

static struct frame_queue pending;

static uint32_t get(uint32_t offset)
{
    return register_read(ZYNQ_LANDING_CORE_BASE + offset);
}

static void set(uint32_t offset, uint32_t value)
{
    register_write(ZYNQ_LANDING_CORE_BASE + offset, value);
}

static void handle(void)
{
    const uint32_t status = get(LANDING_REG_IRQ_STATUS_OFFSET);

    if ((status & LANDING_REG_IRQ_STATUS_FRAME_DONE_MASK) != 0U) {
        // Acknowledged before the head is read: a frame that completes in between
        // raises the interrupt again instead of being lost. The rest is not ours.
        set(LANDING_REG_IRQ_STATUS_OFFSET, LANDING_REG_IRQ_STATUS_FRAME_DONE_MASK);
        // A frame that completes between the two reads makes a pair that the copy
        // refuses; its own interrupt brings the pair that fits.
        const uint32_t number = get(LANDING_REG_FRAME_NUMBER_OFFSET);
        frame_queue_put(&pending, number, get(LANDING_REG_RING_HEAD_OFFSET) & LANDING_REG_RING_HEAD_INDEX_MASK);
    }
}

const char *landing_hw_fault(void)
{
    const uint32_t info = get(LANDING_REG_RING_INFO_OFFSET);
    const uint32_t version = get(LANDING_REG_VERSION_OFFSET);

    if (get(LANDING_REG_ID_OFFSET) != LANDING_REG_ID_VALUE_RESET) {
        return "Touchdown: no landing_core, load the bitstream";
    }
    if ((version & LANDING_REG_VERSION_MAJOR_MASK) >> LANDING_REG_VERSION_MAJOR_SHIFT !=
        LANDING_REG_VERSION_MAJOR_RESET) {
        return "Touchdown: bitstream and firmware do not match";
    }
    // A younger bitstream only has more.
    if ((version & LANDING_REG_VERSION_MINOR_MASK) >> LANDING_REG_VERSION_MINOR_SHIFT <
        LANDING_REG_VERSION_MINOR_RESET) {
        return "Touchdown: bitstream older than the firmware";
    }
    if ((info & LANDING_REG_RING_INFO_BUFFERS_MASK) >> LANDING_REG_RING_INFO_BUFFERS_SHIFT != LANDING_RING_BUFFERS ||
        (info & LANDING_REG_RING_INFO_MAX_OBJECTS_MASK) >> LANDING_REG_RING_INFO_MAX_OBJECTS_SHIFT >
            LANDING_RECORD_MAX_OBJECTS) {
        return "Touchdown: result ring of another size";
    }
    return NULL;
}

void landing_hw_start(uint32_t min_area_px, uint32_t threshold)
{
    frame_queue_init(&pending);
    for (uint32_t i = 0; i < LANDING_RING_BUFFERS; i++) {
        ring[i * BUFFER_WORDS + offsetof(struct landing_result_header, frame_number) / sizeof(uint32_t)] = 0U;
    }
    set(LANDING_REG_CTRL_OFFSET, LANDING_REG_CTRL_DARK_IS_ONE_MASK);
    set(LANDING_REG_RING_BASE_OFFSET, (uint32_t)(uintptr_t)ring);
    set(LANDING_REG_FRAME_SIZE_OFFSET, (BOARD_FRAME_WIDTH_PX << LANDING_REG_FRAME_SIZE_WIDTH_SHIFT) |
                                           (BOARD_FRAME_HEIGHT_PX << LANDING_REG_FRAME_SIZE_HEIGHT_SHIFT));
    landing_hw_adapt(min_area_px, threshold);
    set(LANDING_REG_LIDAR_CTRL_OFFSET, LANDING_REG_LIDAR_CTRL_ENABLE_MASK);
    set(LANDING_REG_IRQ_STATUS_OFFSET, ALL_INTERRUPTS);
    set(LANDING_REG_IRQ_ENABLE_OFFSET, LANDING_REG_IRQ_ENABLE_FRAME_DONE_MASK);
    gic_enable(ZYNQ_IRQ_LANDING_CORE, handle);
    // The ring is memory, the registers are device: the zeros must be there first.
    finish_memory_accesses();
    set(LANDING_REG_CTRL_OFFSET, LANDING_REG_CTRL_DARK_IS_ONE_MASK | LANDING_REG_CTRL_ENABLE_MASK);
}

void landing_hw_adapt(uint32_t min_area_px, uint32_t threshold)
{
    set(LANDING_REG_THRESHOLD_OFFSET, threshold);
    set(LANDING_REG_MIN_AREA_OFFSET, min_area_px);
}

uint64_t landing_hw_time_us(void)
{
    const uint64_t low = get(LANDING_REG_TIME_LO_OFFSET);

    return ((uint64_t)get(LANDING_REG_TIME_HI_OFFSET) << 32) | low;
}

struct lidar_reading landing_hw_lidar(void)
{
    const struct lidar_reading reading = {
        .valid = (get(LANDING_REG_LIDAR_STATUS_OFFSET) & LANDING_REG_LIDAR_STATUS_VALID_MASK) != 0U,
        .distance_mm = get(LANDING_REG_LIDAR_DISTANCE_OFFSET),
        .age_us = get(LANDING_REG_LIDAR_AGE_OFFSET),
    };

    return reading;
}

struct app_complaints landing_hw_complaints(void)
{
    const uint32_t status = get(LANDING_REG_IRQ_STATUS_OFFSET) &
                            (LANDING_REG_IRQ_STATUS_AXI_ERROR_MASK | LANDING_REG_IRQ_STATUS_LIDAR_FAULT_MASK);
    const struct app_complaints complaints = {
        .write_error = (status & LANDING_REG_IRQ_STATUS_AXI_ERROR_MASK) != 0U,
        .lidar_fault = (status & LANDING_REG_IRQ_STATUS_LIDAR_FAULT_MASK) != 0U,
        .frames_unwritten = get(LANDING_REG_FRAMES_UNWRITTEN_OFFSET),
    };

    if (status != 0U) {
        set(LANDING_REG_IRQ_STATUS_OFFSET, status);
    }
    return complaints;
}

bool landing_hw_frame_pending(void)
{
    return !frame_queue_is_empty(&pending);
}

int landing_hw_take_frame(struct landing_record *record)
{
    struct frame_queue_entry frame;

    interrupts_disable();
    const enum frame_queue_result result = frame_queue_take(&pending, &frame);
    interrupts_enable();
    if (result != FRAME_QUEUE_TAKEN || frame.index >= LANDING_RING_BUFFERS) {
        return RECORD_E_TORN;
    }
    return record_copy_from_ring(record, &ring[frame.index * BUFFER_WORDS], frame.number);
}

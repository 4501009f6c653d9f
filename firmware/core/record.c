// SPDX-License-Identifier: Apache-2.0
#include "record.h"

#include <stdatomic.h>
#include <stdbool.h>
#include <string.h>

#define WORD_BYTES sizeof(uint32_t)
#define HEADER_WORDS (sizeof(struct landing_result_header) / WORD_BYTES)
#define OBJECT_WORDS (sizeof(struct landing_object) / WORD_BYTES)
#define BLOCK_WORDS 4U
_Static_assert(HEADER_WORDS % BLOCK_WORDS == 0U && OBJECT_WORDS % BLOCK_WORDS == 0U, "records are copied by blocks");
#define FRAME_NUMBER_WORD (offsetof(struct landing_result_header, frame_number) / WORD_BYTES)

static void copy_words(unsigned char *to, const volatile uint32_t *from, size_t count)
{
    // Four at a time: a third of the loop is counting otherwise.
    for (size_t i = 0; i < count; i += BLOCK_WORDS) {
        unsigned char *const block = to + i * WORD_BYTES;
        const uint32_t a = from[i];
        const uint32_t b = from[i + 1U];
        const uint32_t c = from[i + 2U];
        const uint32_t d = from[i + 3U];
        memcpy(block, &a, WORD_BYTES);
        memcpy(block + WORD_BYTES, &b, WORD_BYTES);
        memcpy(block + 2U * WORD_BYTES, &c, WORD_BYTES);
        memcpy(block + 3U * WORD_BYTES, &d, WORD_BYTES);
    }
}

// The ring is memory to the processor, not device: without fences it may read
// what stands between in any order.
static uint32_t closing_number(const volatile uint32_t *source)
{
    atomic_thread_fence(memory_order_acquire);
    return source[FRAME_NUMBER_WORD];
}

int record_copy_from_ring(struct landing_record *copy, const volatile uint32_t *source, uint32_t number)
{
    // The hardware zeroes the frame number before it touches a buffer and writes
    // it after everything else: the same number before and after the copy means
    // that nothing was written in between.
    const bool complete = source[FRAME_NUMBER_WORD] == number && number != 0U;

    atomic_thread_fence(memory_order_acquire);
    copy_words((unsigned char *)&copy->header, source, HEADER_WORDS);
    if (copy->header.object_count > LANDING_RECORD_MAX_OBJECTS) {
        return complete && closing_number(source) == number ? RECORD_E_COUNT : RECORD_E_TORN;
    }
    copy_words((unsigned char *)copy->objects, source + HEADER_WORDS, copy->header.object_count * OBJECT_WORDS);
    if (!complete || copy->header.frame_number != number || closing_number(source) != number) {
        return RECORD_E_TORN;
    }
    return (int)(sizeof copy->header + copy->header.object_count * sizeof copy->objects[0]);
}

// What is less than `least` wraps, and is more than any range here: one comparison for both ends.
static bool within(uint64_t value, uint64_t least, uint64_t greatest)
{
    return value - least <= greatest - least;
}

// One instruction for two numbers of 32 bits.
static uint64_t product(uint32_t a, uint32_t b)
{
    return (uint64_t)a * b;
}

static bool object_is_sane(const struct landing_object *object, uint32_t width_px, uint32_t height_px)
{
    const uint32_t area = object->area;
    const uint32_t x_min = object->box_min_x;
    const uint32_t x_max = object->box_max_x;
    const uint32_t y_min = object->box_min_y;
    const uint32_t y_max = object->box_max_y;

    if (x_min > x_max || y_min > y_max || x_max >= width_px || y_max >= height_px) {
        return false;
    }
    // No product overflows: coordinates have 13 bits, so two of them 26.
    if (area < 1U || area > (x_max - x_min + 1U) * (y_max - y_min + 1U)) {
        return false;
    }
    return within(object->sum_x, product(area, x_min), product(area, x_max)) &&
           within(object->sum_y, product(area, y_min), product(area, y_max)) &&
           within(object->sum_xx, product(area, x_min * x_min), product(area, x_max * x_max)) &&
           within(object->sum_yy, product(area, y_min * y_min), product(area, y_max * y_max)) &&
           within(object->sum_xy, product(area, x_min * y_min), product(area, x_max * y_max));
}

int record_check(const struct landing_record *record, size_t size_bytes)
{
    const struct landing_result_header *header = &record->header;

    if (size_bytes < sizeof *header) {
        return RECORD_E_SIZE;
    }
    if (header->id_magic != LANDING_HEADER_ID_MAGIC_RESET || header->id_version != LANDING_HEADER_ID_VERSION_RESET) {
        return RECORD_E_MAGIC;
    }
    if (header->frame_number == 0U) {
        return RECORD_E_TORN;
    }
    if (header->object_count > LANDING_RECORD_MAX_OBJECTS) {
        return RECORD_E_COUNT;
    }
    if (size_bytes < sizeof *header + header->object_count * sizeof record->objects[0]) {
        return RECORD_E_SIZE;
    }
    if (!within(header->frame_size_width, 1U, RECORD_MAX_FRAME_SIDE_PX) ||
        !within(header->frame_size_height, 1U, RECORD_MAX_FRAME_SIDE_PX)) {
        return RECORD_E_FRAME;
    }
    for (uint32_t i = 0; i < header->object_count; i++) {
        if (!object_is_sane(&record->objects[i], header->frame_size_width, header->frame_size_height)) {
            return RECORD_E_OBJECT;
        }
    }
    return 0;
}

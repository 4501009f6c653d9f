// SPDX-License-Identifier: Apache-2.0
// Copying out of a ring that changes meanwhile. The copy's fences stand where
// the order of reads matters; here each of them lets the hardware write.
#include <stdatomic.h>
#include <stdint.h>
#include <string.h>

static void hardware_writes(void);

#undef atomic_thread_fence
#define atomic_thread_fence(order) hardware_writes()
#define record_copy_from_ring copy_while_hardware_writes
#define record_check check_unused
#include "../core/record.c"

#include "test.h"

#define COUNT_WORD (offsetof(struct landing_result_header, object_count) / sizeof(uint32_t))

static uint32_t ring[sizeof(struct landing_record) / sizeof(uint32_t)];
static struct landing_record torn;
static int fences;
static int write_at;
static uint32_t written_number;

static void hardware_writes(void)
{
    fences++;
    if (fences == write_at) {
        ring[FRAME_NUMBER_WORD] = written_number;
    }
}

static int copy_with_write(uint32_t object_count, int at, uint32_t number)
{
    memset(ring, 0, sizeof ring);
    ring[FRAME_NUMBER_WORD] = 7U;
    ring[COUNT_WORD] = object_count;
    fences = 0;
    write_at = at;
    written_number = number;
    return copy_while_hardware_writes(&torn, ring, 7U);
}

void test_record_torn(void)
{
    test_case("a ring that stands still");
    CHECK(copy_with_write(2U, 0, 0U) == 192);
    CHECK(fences == 2);
    CHECK(copy_with_write(257U, 0, 0U) == RECORD_E_COUNT);
    CHECK(fences == 2);
    test_case("a ring that the hardware writes during the copy");
    for (int at = 1; at <= 2; at++) {
        CHECK(copy_with_write(2U, at, 0U) == RECORD_E_TORN);
        CHECK(copy_with_write(2U, at, 11U) == RECORD_E_TORN);
        CHECK(copy_with_write(257U, at, 0U) == RECORD_E_TORN);
    }
}

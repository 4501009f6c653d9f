// SPDX-License-Identifier: Apache-2.0
#include "frame_queue.h"
#include "test.h"

void test_frame_queue(void)
{
    struct frame_queue queue;
    struct frame_queue_entry entry;

    test_case("frames come out in order, each with its buffer");
    frame_queue_init(&queue);
    CHECK(frame_queue_is_empty(&queue));
    CHECK(frame_queue_take(&queue, &entry) == FRAME_QUEUE_EMPTY);
    for (uint32_t number = 1; number <= 10U; number += 2U) {
        frame_queue_put(&queue, number, number % 4U);
        frame_queue_put(&queue, number + 1U, (number + 1U) % 4U);
        CHECK(!frame_queue_is_empty(&queue));
        for (uint32_t i = 0; i < 2U; i++) {
            CHECK(frame_queue_take(&queue, &entry) == FRAME_QUEUE_TAKEN);
            CHECK(entry.number == number + i && entry.index == (number + i) % 4U);
        }
    }
    CHECK(frame_queue_is_empty(&queue));

    test_case("more frames than buffers: the newest stay, the rest are told of");
    for (uint32_t number = 1; number <= 6U; number++) {
        frame_queue_put(&queue, number, number % 4U);
    }
    CHECK(frame_queue_take(&queue, &entry) == FRAME_QUEUE_LOST);
    CHECK(frame_queue_take(&queue, &entry) == FRAME_QUEUE_LOST);
    for (uint32_t number = 3; number <= 6U; number++) {
        CHECK(frame_queue_take(&queue, &entry) == FRAME_QUEUE_TAKEN);
        CHECK(entry.number == number && entry.index == number % 4U);
    }
    CHECK(frame_queue_take(&queue, &entry) == FRAME_QUEUE_EMPTY);
}

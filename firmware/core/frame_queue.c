// SPDX-License-Identifier: Apache-2.0
#include "frame_queue.h"

void frame_queue_init(struct frame_queue *queue)
{
    queue->first = 0U;
    queue->count = 0U;
    queue->lost = 0U;
}

void frame_queue_put(struct frame_queue *queue, uint32_t number, uint32_t index)
{
    if (queue->count == LANDING_RING_BUFFERS) {
        queue->first = (queue->first + 1U) % LANDING_RING_BUFFERS;
        queue->count--;
        queue->lost++;
    }
    struct frame_queue_entry *entry = &queue->entries[(queue->first + queue->count) % LANDING_RING_BUFFERS];
    entry->number = number;
    entry->index = index;
    queue->count++;
}

bool frame_queue_is_empty(const struct frame_queue *queue)
{
    return queue->count == 0U && queue->lost == 0U;
}

enum frame_queue_result frame_queue_take(struct frame_queue *queue, struct frame_queue_entry *entry)
{
    if (queue->lost != 0U) {
        queue->lost--;
        return FRAME_QUEUE_LOST;
    }
    if (queue->count == 0U) {
        return FRAME_QUEUE_EMPTY;
    }
    *entry = queue->entries[queue->first];
    queue->first = (queue->first + 1U) % LANDING_RING_BUFFERS;
    queue->count--;
    return FRAME_QUEUE_TAKEN;
}

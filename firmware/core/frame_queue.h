// SPDX-License-Identifier: Apache-2.0
// Frames that the hardware has completed and nobody has read yet, oldest first.
#ifndef TOUCHDOWN_FRAME_QUEUE_H
#define TOUCHDOWN_FRAME_QUEUE_H

#include <stdbool.h>
#include <stdint.h>

#include "landing_regs.h"

struct frame_queue_entry {
    uint32_t number; // of the frame
    uint32_t index;  // of its buffer
};

// The caller keeps an interrupt that puts away from a take.
struct frame_queue {
    struct frame_queue_entry entries[LANDING_RING_BUFFERS];
    uint32_t first;
    uint32_t count;
    uint32_t lost;
};

void frame_queue_init(struct frame_queue *queue);

// With as many frames waiting as the ring has buffers, the oldest is overwritten
// in the ring by now: it makes room, and is lost.
void frame_queue_put(struct frame_queue *queue, uint32_t number, uint32_t index);

bool frame_queue_is_empty(const struct frame_queue *queue);

enum frame_queue_result { FRAME_QUEUE_EMPTY, FRAME_QUEUE_TAKEN, FRAME_QUEUE_LOST };

// The oldest frame, or word of one that was lost, each once.
enum frame_queue_result frame_queue_take(struct frame_queue *queue, struct frame_queue_entry *entry);

#endif

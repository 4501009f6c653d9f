// SPDX-License-Identifier: Apache-2.0
// Bytes from one producer to one consumer, of which one may be an interrupt.
#ifndef TOUCHDOWN_BYTE_RING_H
#define TOUCHDOWN_BYTE_RING_H

#include <stdatomic.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

struct byte_ring {
    uint8_t *storage;
    uint32_t size; // a power of two
    _Atomic uint32_t written;
    _Atomic uint32_t taken;
};

void byte_ring_init(struct byte_ring *ring, uint8_t *storage, uint32_t size);

// All bytes or, when they do not fit, none.
bool byte_ring_put(struct byte_ring *ring, const uint8_t *bytes, size_t count);

// Takes up to `limit` bytes and returns how many.
size_t byte_ring_take(struct byte_ring *ring, uint8_t *bytes, size_t limit);

// Bytes taken so far; wraps.
uint32_t byte_ring_taken(const struct byte_ring *ring);

// Bytes that wait.
size_t byte_ring_count(const struct byte_ring *ring);

bool byte_ring_is_empty(const struct byte_ring *ring);

#endif

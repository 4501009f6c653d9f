// SPDX-License-Identifier: Apache-2.0
#include "byte_ring.h"

void byte_ring_init(struct byte_ring *ring, uint8_t *storage, uint32_t size)
{
    ring->storage = storage;
    ring->size = size;
    atomic_store(&ring->written, 0U);
    atomic_store(&ring->taken, 0U);
}

// Both counts run on past the size and wrap at 2^32, so that full and empty differ.
bool byte_ring_put(struct byte_ring *ring, const uint8_t *bytes, size_t count)
{
    const uint32_t written = atomic_load_explicit(&ring->written, memory_order_relaxed);
    const uint32_t taken = atomic_load_explicit(&ring->taken, memory_order_acquire);

    if (count > ring->size - (written - taken)) {
        return false;
    }
    for (size_t i = 0; i < count; i++) {
        ring->storage[(written + i) & (ring->size - 1U)] = bytes[i];
    }
    atomic_store_explicit(&ring->written, written + (uint32_t)count, memory_order_release);
    return true;
}

size_t byte_ring_take(struct byte_ring *ring, uint8_t *bytes, size_t limit)
{
    const uint32_t taken = atomic_load_explicit(&ring->taken, memory_order_relaxed);
    const uint32_t available = atomic_load_explicit(&ring->written, memory_order_acquire) - taken;
    const size_t count = available < limit ? available : limit;

    for (size_t i = 0; i < count; i++) {
        bytes[i] = ring->storage[(taken + i) & (ring->size - 1U)];
    }
    atomic_store_explicit(&ring->taken, taken + (uint32_t)count, memory_order_release);
    return count;
}

uint32_t byte_ring_taken(const struct byte_ring *ring)
{
    return atomic_load_explicit(&ring->taken, memory_order_relaxed);
}

size_t byte_ring_count(const struct byte_ring *ring)
{
    return atomic_load_explicit(&ring->written, memory_order_acquire) -
           atomic_load_explicit(&ring->taken, memory_order_acquire);
}

bool byte_ring_is_empty(const struct byte_ring *ring)
{
    return byte_ring_count(ring) == 0U;
}

// SPDX-License-Identifier: Apache-2.0
#include "byte_ring.h"
#include "test.h"

void test_byte_ring(void)
{
    uint8_t storage[8];
    uint8_t out[8];
    struct byte_ring ring;
    uint8_t next_in = 0;
    uint8_t next_out = 0;

    test_case("all or nothing");
    byte_ring_init(&ring, storage, sizeof storage);
    CHECK(byte_ring_is_empty(&ring));
    CHECK(byte_ring_put(&ring, (const uint8_t *)"abcdef", 6));
    CHECK(!byte_ring_put(&ring, (const uint8_t *)"ghi", 3));
    CHECK(byte_ring_put(&ring, (const uint8_t *)"gh", 2));
    CHECK(!byte_ring_put(&ring, (const uint8_t *)"i", 1));
    CHECK(byte_ring_take(&ring, out, sizeof out) == 8 && out[0] == 'a' && out[7] == 'h');
    CHECK(byte_ring_take(&ring, out, sizeof out) == 0);

    test_case("order holds over the end and over the wrap of the counts");
    byte_ring_init(&ring, storage, sizeof storage);
    atomic_init(&ring.written, UINT32_MAX - 10U);
    atomic_init(&ring.taken, UINT32_MAX - 10U);
    for (int i = 0; i < 1000; i++) {
        const uint8_t bytes[3] = {next_in, (uint8_t)(next_in + 1), (uint8_t)(next_in + 2)};
        if (byte_ring_put(&ring, bytes, 3)) {
            next_in = (uint8_t)(next_in + 3);
        }
        const size_t count = byte_ring_take(&ring, out, (size_t)(i % 5));
        for (size_t j = 0; j < count; j++) {
            CHECK(out[j] == next_out);
            next_out++;
        }
    }
}

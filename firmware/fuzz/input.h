// SPDX-License-Identifier: Apache-2.0
// The bytes of one execution, taken piece by piece. After the last there are zeros.
#ifndef TOUCHDOWN_FUZZ_INPUT_H
#define TOUCHDOWN_FUZZ_INPUT_H

#include <stddef.h>
#include <stdint.h>

struct input {
    const uint8_t *bytes;
    size_t left;
};

// Fills `to` and returns how many of its bytes came from the input.
size_t input_take(struct input *input, void *to, size_t size);

uint8_t input_u8(struct input *input);
uint16_t input_u16(struct input *input);
uint32_t input_u32(struct input *input);
uint64_t input_u64(struct input *input);

// Any bits, so also NaN and infinities.
float input_float(struct input *input);

// From 0 to 1 in steps of 1/255.
double input_share(struct input *input);

#endif

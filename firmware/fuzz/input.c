// SPDX-License-Identifier: Apache-2.0
#include "input.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "target.h"

void demand(bool ok, const char *file, int line, const char *text)
{
    if (!ok) {
        (void)fprintf(stderr, "%s:%d: must always hold: %s\n", file, line, text);
        abort();
    }
}

size_t input_take(struct input *input, void *to, size_t size)
{
    const size_t count = input->left < size ? input->left : size;

    memset(to, 0, size);
    if (count != 0U) {
        memcpy(to, input->bytes, count);
    }
    input->bytes += count;
    input->left -= count;
    return count;
}

uint8_t input_u8(struct input *input)
{
    uint8_t value;

    (void)input_take(input, &value, sizeof value);
    return value;
}

uint16_t input_u16(struct input *input)
{
    uint16_t value;

    (void)input_take(input, &value, sizeof value);
    return value;
}

uint32_t input_u32(struct input *input)
{
    uint32_t value;

    (void)input_take(input, &value, sizeof value);
    return value;
}

uint64_t input_u64(struct input *input)
{
    uint64_t value;

    (void)input_take(input, &value, sizeof value);
    return value;
}

float input_float(struct input *input)
{
    float value;

    (void)input_take(input, &value, sizeof value);
    return value;
}

double input_share(struct input *input)
{
    return (double)input_u8(input) / 255.0;
}

// SPDX-License-Identifier: Apache-2.0
#include "stack.h"

#include <stddef.h>

#define PAINT 0x5AFE57ACU // as in start.S

// From touchdown.ld: addresses, not variables.
extern const uint32_t stack_bottom[];
extern const uint32_t stack_top[];

uint32_t stack_used_bytes(void)
{
    const size_t words = (size_t)((uintptr_t)stack_top - (uintptr_t)stack_bottom) / sizeof(uint32_t);
    size_t untouched = 0U;

    // Bounded: by the words of the stack.
    while (untouched < words && stack_bottom[untouched] == PAINT) {
        untouched++;
    }
    return (uint32_t)((words - untouched) * sizeof(uint32_t));
}

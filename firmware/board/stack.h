// SPDX-License-Identifier: Apache-2.0
#ifndef TOUCHDOWN_STACK_H
#define TOUCHDOWN_STACK_H

#include <stdint.h>

// The most that the system-mode stack has held since the start, which painted it.
uint32_t stack_used_bytes(void);

#endif

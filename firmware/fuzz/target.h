// SPDX-License-Identifier: Apache-2.0
// What each fuzz target defines, and how it says that something is wrong.
#ifndef TOUCHDOWN_FUZZ_TARGET_H
#define TOUCHDOWN_FUZZ_TARGET_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

// One execution. The same bytes always do the same; nothing is left for the next.
int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size);

// Ends the process as a crash does when something that must always hold does not.
#define DEMAND(condition) demand((condition), __FILE__, __LINE__, #condition)
void demand(bool ok, const char *file, int line, const char *text);

#endif

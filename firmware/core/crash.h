// SPDX-License-Identifier: Apache-2.0
// What an abort leaves behind for the next start: a few words that survive in
// memory which no one clears, with a check, since after power-up they are noise.
#ifndef TOUCHDOWN_CRASH_H
#define TOUCHDOWN_CRASH_H

#include <stdbool.h>
#include <stdint.h>

#include "text.h"

// The numbers that board/start.S gives.
enum crash_kind {
    CRASH_UNDEFINED,
    CRASH_SUPERVISOR_CALL,
    CRASH_PREFETCH,
    CRASH_DATA,
    CRASH_FAST_INTERRUPT,
    CRASH_ASYNCHRONOUS, // a bus refused an access, usually a write, some instructions before the address
    CRASH_KINDS
};

struct crash_record {
    uint32_t magic;
    uint32_t kind; // enum crash_kind
    uint32_t address;
    uint32_t check;
};

void crash_write(volatile struct crash_record *record, uint32_t kind, uint32_t address);

// True, with what it says, when the record is one; it is then no longer.
bool crash_take(volatile struct crash_record *record, uint32_t *kind, uint32_t *address);

// "<kind> at <address>" after what is there.
void crash_append(struct text *text, uint32_t kind, uint32_t address);

#endif

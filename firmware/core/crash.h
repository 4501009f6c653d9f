// SPDX-License-Identifier: Apache-2.0
// What an abort leaves behind for the next start: a few words that survive in
// memory which no one clears, with a check, since after power-up they are noise.
#ifndef TOUCHDOWN_CRASH_H
#define TOUCHDOWN_CRASH_H

#include <stdbool.h>
#include <stdint.h>

#include "mavlink_out.h"

#define CRASH_TEXT_CHARS (MAVLINK_OUT_STATUS_TEXT_CHARS + 1U)

// In the order of the exception entries of board/start.S.
enum crash_kind {
    CRASH_UNDEFINED,
    CRASH_SUPERVISOR_CALL,
    CRASH_PREFETCH,
    CRASH_DATA,
    CRASH_FAST_INTERRUPT,
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

// "<before><kind> at <address>", cut off after CRASH_TEXT_CHARS - 1.
void crash_text(char *text, const char *before, uint32_t kind, uint32_t address);

#endif

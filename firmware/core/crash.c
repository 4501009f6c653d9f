// SPDX-License-Identifier: Apache-2.0
#include "crash.h"

#define MAGIC 0x48535243U // "CRSH"

static const char *const kinds[CRASH_KINDS] = {"undefined instruction", "supervisor call", "prefetch abort",
                                               "data abort", "fast interrupt", "asynchronous abort"};

static uint32_t check_of(uint32_t kind, uint32_t address)
{
    return ~(MAGIC ^ kind ^ address);
}

void crash_write(volatile struct crash_record *record, uint32_t kind, uint32_t address)
{
    record->kind = kind;
    record->address = address;
    record->check = check_of(kind, address);
    record->magic = MAGIC;
}

bool crash_take(volatile struct crash_record *record, uint32_t *kind, uint32_t *address)
{
    const struct crash_record read = {
        .magic = record->magic, .kind = record->kind, .address = record->address, .check = record->check};

    record->magic = 0U;
    if (read.magic != MAGIC || read.kind >= CRASH_KINDS || read.check != check_of(read.kind, read.address)) {
        return false;
    }
    *kind = read.kind;
    *address = read.address;
    return true;
}

void crash_append(struct text *text, uint32_t kind, uint32_t address)
{
    text_append(text, kind < CRASH_KINDS ? kinds[kind] : "unknown fault");
    text_append(text, " at ");
    text_append_hexadecimal(text, address);
}

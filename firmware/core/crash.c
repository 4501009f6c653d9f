// SPDX-License-Identifier: Apache-2.0
#include "crash.h"

#include <stddef.h>

#define MAGIC 0x48535243U // "CRSH"
#define HEX_DIGITS 8U

static const char *const kinds[CRASH_KINDS] = {"undefined instruction", "supervisor call", "prefetch abort",
                                               "data abort", "fast interrupt"};

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

static size_t append(char *text, size_t at, const char *more)
{
    for (size_t i = 0; more[i] != '\0' && at + 1U < CRASH_TEXT_CHARS; i++) {
        text[at++] = more[i];
    }
    text[at] = '\0';
    return at;
}

void crash_text(char *text, const char *before, uint32_t kind, uint32_t address)
{
    char hexadecimal[HEX_DIGITS + 1U] = {0};

    for (uint32_t i = 0; i < HEX_DIGITS; i++) {
        hexadecimal[i] = "0123456789abcdef"[(address >> (28U - 4U * i)) & 0xFU];
    }
    size_t at = append(text, 0U, before);
    at = append(text, at, kind < CRASH_KINDS ? kinds[kind] : "unknown fault");
    at = append(text, at, " at ");
    (void)append(text, at, hexadecimal);
}

// SPDX-License-Identifier: Apache-2.0
#include "parameters.h"

#include <string.h>

#define STORED_MAGIC 0x50445431U // "1TDP"
#define MAGIC_AT 0U
#define COUNT_AT 4U
#define CHECKSUM_AT 8U
#define VALUES_AT 16U
#define CHECKSUM_START 2166136261U
#define CHECKSUM_FACTOR 16777619U

struct row {
    const char *name;
    float least;
    float most;
    float usual;
};

static const struct row rows[PARAMETERS_COUNT] = {
#define PARAMETERS_ROW(member, name, least, most, usual) {name, least, most, usual},
    LANDING_PARAMETERS(PARAMETERS_ROW)
#undef PARAMETERS_ROW
};

_Static_assert(sizeof(float) == sizeof(uint32_t), "a value is four bytes");

// All members are floats, one after another.
static void put(struct parameters *parameters, size_t index, float value)
{
    memcpy((uint8_t *)parameters + index * sizeof value, &value, sizeof value);
}

float parameters_get(const struct parameters *parameters, size_t index)
{
    float value = 0.0F;

    if (index < PARAMETERS_COUNT) {
        memcpy(&value, (const uint8_t *)parameters + index * sizeof value, sizeof value);
    }
    return value;
}

void parameters_init(struct parameters *parameters)
{
    for (size_t i = 0; i < PARAMETERS_COUNT; i++) {
        put(parameters, i, rows[i].usual);
    }
}

const char *parameters_name(size_t index)
{
    return index < PARAMETERS_COUNT ? rows[index].name : NULL;
}

int parameters_find(const char *name)
{
    for (size_t i = 0; i < PARAMETERS_COUNT; i++) {
        if (strcmp(rows[i].name, name) == 0) {
            return (int)i;
        }
    }
    return PARAMETERS_E_NAME;
}

int parameters_set(struct parameters *parameters, size_t index, float value)
{
    if (index >= PARAMETERS_COUNT) {
        return PARAMETERS_E_NAME;
    }
    // Also true for NaN.
    if (!(value >= rows[index].least && value <= rows[index].most)) {
        return PARAMETERS_E_RANGE;
    }
    put(parameters, index, value);
    return 0;
}

static void put_word(uint8_t *bytes, uint32_t word)
{
    for (size_t i = 0; i < sizeof word; i++) {
        bytes[i] = (uint8_t)(word >> (8U * i));
    }
}

static uint32_t word_of(const uint8_t *bytes)
{
    uint32_t word = 0U;

    for (size_t i = 0; i < sizeof word; i++) {
        word |= (uint32_t)bytes[i] << (8U * i);
    }
    return word;
}

// FNV-1a: a flipped bit or a torn write shows.
static uint32_t checksum(const uint8_t *bytes, size_t size)
{
    uint32_t sum = CHECKSUM_START;

    for (size_t i = 0; i < size; i++) {
        sum = (sum ^ bytes[i]) * CHECKSUM_FACTOR;
    }
    return sum;
}

void parameters_store(const struct parameters *parameters, uint8_t *bytes)
{
    memset(bytes, 0, PARAMETERS_STORED_BYTES);
    put_word(bytes + MAGIC_AT, STORED_MAGIC);
    put_word(bytes + COUNT_AT, (uint32_t)PARAMETERS_COUNT);
    memcpy(bytes + VALUES_AT, parameters, sizeof *parameters);
    put_word(bytes + CHECKSUM_AT, checksum(bytes + VALUES_AT, sizeof *parameters));
}

int parameters_load(struct parameters *parameters, const uint8_t *bytes, size_t size)
{
    if (size < PARAMETERS_STORED_BYTES || word_of(bytes + MAGIC_AT) != STORED_MAGIC ||
        word_of(bytes + COUNT_AT) != PARAMETERS_COUNT ||
        word_of(bytes + CHECKSUM_AT) != checksum(bytes + VALUES_AT, sizeof *parameters)) {
        return PARAMETERS_E_STORED;
    }
    for (size_t i = 0; i < PARAMETERS_COUNT; i++) {
        float value;

        memcpy(&value, bytes + VALUES_AT + i * sizeof value, sizeof value);
        (void)parameters_set(parameters, i, value);
    }
    return 0;
}

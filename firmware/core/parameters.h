// SPDX-License-Identifier: Apache-2.0
// What the ground may set, each with its limits. The values that are kept over a
// restart are a block of bytes with a checksum; where it lies is the board's affair.
#ifndef TOUCHDOWN_PARAMETERS_H
#define TOUCHDOWN_PARAMETERS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "landing_parameters.h"

struct parameters {
#define PARAMETERS_MEMBER(member, name, least, most, usual) float member;
    LANDING_PARAMETERS(PARAMETERS_MEMBER)
#undef PARAMETERS_MEMBER
};

#define PARAMETERS_COUNT (sizeof(struct parameters) / sizeof(float))
#define PARAMETERS_STORED_BYTES (16U + sizeof(struct parameters))

enum {
    PARAMETERS_E_NAME = -1,  // there is none of that name or index
    PARAMETERS_E_RANGE = -2, // beyond its limits, or no number
    PARAMETERS_E_STORED = -3 // no block of ours, or a damaged one
};

void parameters_init(struct parameters *parameters);

// NULL beyond the last.
const char *parameters_name(size_t index);

float parameters_get(const struct parameters *parameters, size_t index);

// Index of a name, or PARAMETERS_E_NAME.
int parameters_find(const char *name);

// Returns 0, or a PARAMETERS_E_* and leaves the value as it was.
int parameters_set(struct parameters *parameters, size_t index, float value);

// Writes PARAMETERS_STORED_BYTES.
void parameters_store(const struct parameters *parameters, uint8_t *bytes);

// Returns 0, or PARAMETERS_E_STORED and leaves all as it was. A value that is beyond its limits is left as it was.
int parameters_load(struct parameters *parameters, const uint8_t *bytes, size_t size);

#endif

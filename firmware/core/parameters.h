// SPDX-License-Identifier: Apache-2.0
// What the ground may set, each with its limits. The values that are kept over a
// restart are a block of bytes with a checksum; where it lies is the board's affair.
#ifndef TOUCHDOWN_PARAMETERS_H
#define TOUCHDOWN_PARAMETERS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

// X(member, name on the wire, least, greatest, default)
#define PARAMETERS(X)                                                                                                  \
    X(search_height_m, "TD_SEARCH_M", 1.0F, 3.0F, 1.8F)                                                                \
    X(align_height_m, "TD_ALIGN_M", 0.6F, 1.5F, 1.0F)                                                                  \
    X(commit_height_m, "TD_COMMIT_M", 0.2F, 0.8F, 0.4F)                                                                \
    X(speed_m_s, "TD_SPEED", 0.1F, 1.0F, 0.5F)                                                                         \
    X(descent_m_s, "TD_DESCENT", 0.1F, 0.5F, 0.25F)                                                                    \
    X(gain_per_s, "TD_GAIN", 0.2F, 1.5F, 0.7F)                                                                         \
    X(yaw_rate_deg_s, "TD_YAW_RATE", 5.0F, 45.0F, 20.0F)                                                               \
    X(tries, "TD_TRIES", 1.0F, 10.0F, 3.0F)                                                                            \
    X(rc_channel, "TD_RC_CHAN", 0.0F, 18.0F, 8.0F)                                                                     \
    X(battery_min_percent, "TD_BATT_MIN", 0.0F, 80.0F, 20.0F)                                                          \
    X(ground_needed, "TD_GCS_NEEDED", 0.0F, 1.0F, 0.0F)

struct parameters {
#define PARAMETERS_MEMBER(member, name, least, greatest, standard) float member;
    PARAMETERS(PARAMETERS_MEMBER)
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

// SPDX-License-Identifier: Apache-2.0
// What outlasts a restart, as long as the memory has power: parameters and the
// record of a crash. It lies beside the result ring, where nothing is cached.
#ifndef TOUCHDOWN_KEEP_H
#define TOUCHDOWN_KEEP_H

#include <stdint.h>

#include "crash.h"
#include "parameters.h"

struct keep {
    struct crash_record crash;
    uint8_t parameters[PARAMETERS_STORED_BYTES];
};

extern struct keep keep;

#endif

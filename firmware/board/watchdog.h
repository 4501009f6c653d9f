// SPDX-License-Identifier: Apache-2.0
// The Cortex-A9's own watchdog: it resets the system when it is not fed in time.
#ifndef TOUCHDOWN_WATCHDOG_H
#define TOUCHDOWN_WATCHDOG_H

#include <stdbool.h>

// True when it was the watchdog that ended the run before; after that no longer.
bool watchdog_has_bitten(void);

// From here on it has to be fed; nothing but a reset stops it.
void watchdog_start(void);

void watchdog_feed(void);

#endif

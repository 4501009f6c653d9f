// SPDX-License-Identifier: Apache-2.0
#ifndef TOUCHDOWN_FAULT_H
#define TOUCHDOWN_FAULT_H

#include <stdint.h>

// From start.S. Tells the ground station and stops: the autopilot sees the
// heartbeat and the distance end, which it knows how to handle.
_Noreturn void fault_report(uint32_t kind, uint32_t address);

#endif

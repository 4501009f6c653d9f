// SPDX-License-Identifier: Apache-2.0
// When LANDING_TARGET leaves: the same time after each frame's last pixel,
// however long the pad took to be found, on a wire that nothing else holds.
#ifndef TOUCHDOWN_RELEASE_H
#define TOUCHDOWN_RELEASE_H

#include <stdbool.h>
#include <stdint.h>

#include "landing_regs.h"

struct release {
    uint64_t last_us;   // 0 = none yet
    uint64_t period_us; // of the frames; 0 = not known
};

// When the target of a frame is due.
uint64_t release_of(const struct landing_result_header *header);

// A target left that was due at `due_us`.
void release_note(struct release *release, uint64_t due_us);

// True while another message might still be on the wire when the next target is due.
bool release_is_near(const struct release *release, uint64_t now_us);

#endif

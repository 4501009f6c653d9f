// SPDX-License-Identifier: Apache-2.0
// Which of the shapes of a frame are the pad's ring, square, rectangle and
// small ring. All tests are ratios that no affine map changes, so neither
// height nor heading nor tilt matters, and altitude is not needed.
#ifndef TOUCHDOWN_CLASSIFY_H
#define TOUCHDOWN_CLASSIFY_H

#include <stdbool.h>
#include <stdint.h>

#include "landing_regs.h"
#include "shapes.h"

enum { CLASSIFY_E_NO_PAD = -1 };

// Which shapes of a frame carry the decision. A ring that is broken or cut by
// the border is no ring; then the three inner shapes together serve.
struct pad_shapes {
    struct shape square;
    struct shape rectangle;
    struct shape ring;       // meaningful while has_ring
    struct shape small_ring; // meaningful while has_small_ring
    bool has_ring;
    bool has_small_ring;
    double error; // 0 = all ratios ideal; compares candidates of one frame
};

// Work space, kept by the caller because it is too large for a stack.
struct classify_scratch {
    uint32_t count;
    uint8_t kinds[LANDING_RECORD_MAX_OBJECTS];
    struct shape shapes[LANDING_RECORD_MAX_OBJECTS];
};

// 0 and the best candidate, or CLASSIFY_E_NO_PAD. The record must have passed
// record_check().
int classify_pad(const struct landing_record *record, struct classify_scratch *scratch, struct pad_shapes *pad);

#endif

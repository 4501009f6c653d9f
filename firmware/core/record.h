// SPDX-License-Identifier: Apache-2.0
// Result record of one frame: copy it out of the ring, then distrust it.
// The layout is rtl/landing_regs/landing_core.rdl.
#ifndef TOUCHDOWN_RECORD_H
#define TOUCHDOWN_RECORD_H

#include <stddef.h>
#include <stdint.h>

#include "landing_regs.h"

#define RECORD_MAX_FRAME_SIDE_PX 8192U

enum {
    RECORD_E_SIZE = -1,   // fewer bytes than a header, or than its objects need
    RECORD_E_MAGIC = -2,  // not a record, or one of another layout version
    RECORD_E_TORN = -3,   // being written, or overwritten while it was copied
    RECORD_E_COUNT = -4,  // more objects than a buffer can hold
    RECORD_E_FRAME = -5,  // a frame size that cannot be
    RECORD_E_OBJECT = -6, // an object whose numbers contradict each other
    RECORD_E_OLD = -7,    // not newer than the last one
};

// Copies what is valid of a buffer that the hardware may overwrite at any time:
// the header and object_count objects. `number` is the frame that the hardware
// said it left there. Returns the bytes copied, or RECORD_E_*.
// `source` must not be served by a cache.
int record_copy_from_ring(struct landing_record *copy, const volatile uint32_t *source, uint32_t number);

// 0, or RECORD_E_*. After 0 no number in the record can lead later code astray:
// counts, boxes, areas and sums agree with each other and with the frame.
int record_check(const struct landing_record *record, size_t size_bytes);

#endif

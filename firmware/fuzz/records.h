// SPDX-License-Identifier: Apache-2.0
// Records that pass the check, or nearly: pads as the camera would see them, things
// whose numbers are at the edge of what can be, and damage.
#ifndef TOUCHDOWN_FUZZ_RECORDS_H
#define TOUCHDOWN_FUZZ_RECORDS_H

#include "input.h"
#include "landing_regs.h"

// The bytes that count: header and objects, of these at most as many as fit.
size_t records_size(const struct landing_record *record);

// The next frame after what `record` holds: anew, or the same objects again.
void records_next(struct input *input, struct landing_record *record);

// A record without objects of a 1280x720 frame; its number is that of no frame yet.
void records_clear(struct landing_record *record);

// Beside `kinds`. A hundred times as slow, so it is the input's to ask for.
#define RECORDS_CUT 0x10U

// Appends the shapes in `kinds` of a pad that lies `height_m` below, moved by (x, y) pixels from the middle
// of the frame and turned by `yaw_rad`. Those that the border crosses are left out, or cut there with RECORDS_CUT.
void records_paint(struct landing_record *record, unsigned kinds, double x_px, double y_px, double height_m,
                   double yaw_rad, double tilt_x, double tilt_y);

#endif

// SPDX-License-Identifier: Apache-2.0
// What a monitor shows over a frame: a box around each shape that was seen, the pad's centre and direction, two lines of
// text. Places are pixels of the frame, and may lie outside of it.
#ifndef TOUCHDOWN_PICTURE_H
#define TOUCHDOWN_PICTURE_H

#include <stdbool.h>
#include <stdint.h>

#include "detect.h"
#include "fusion.h"

#define PICTURE_LINES 2U
#define PICTURE_COLUMNS 64U
#define PICTURE_PLACE_MIN_PX (-8192)
#define PICTURE_PLACE_MAX_PX 8191

enum picture_shape { PICTURE_RING, PICTURE_SQUARE, PICTURE_RECTANGLE, PICTURE_SMALL_RING, PICTURE_SHAPES };

struct picture_place {
    int32_t x_px;
    int32_t y_px;
};

// Ends included.
struct picture_box {
    bool shown;
    struct picture_place from;
    struct picture_place to;
};

struct picture {
    struct picture_box boxes[PICTURE_SHAPES];
    bool has_pad;
    struct picture_place centre;
    struct picture_place tip;                    // where the pad's direction, from its centre to its square, ends
    char text[PICTURE_LINES][PICTURE_COLUMNS]; // filled up with spaces
};

// `pad` is NULL when none is seen. `phase` is what the landing does, in one word.
void picture_of(struct picture *picture, const struct camera *camera, const struct pad_estimate *pad,
                const struct altitude *altitude, const char *phase);

#endif

// SPDX-License-Identifier: Apache-2.0
// What a view of the pad makes of a record: which object is which shape, what is
// missing, and what does not belong.
#ifndef TOUCHDOWN_READING_H
#define TOUCHDOWN_READING_H

#include "detect.h"
#include "grid.h"

// Of the ring's print: less is no witness, more is something else, and this much is the whole ring.
#define RING_SHARE_MIN 0.3
#define RING_SHARE_MAX 1.5
#define RING_SHARE_WHOLE 0.85
#define RING_SHARE_WHOLE_AGAIN 0.92

struct detect_context {
    struct detect_scratch *scratch;
    const struct grid *grid;
    const struct camera *camera;
    const struct detect_hint *hint;
    uint32_t options;
    struct work *work;
    bool crowded; // so many objects that some lie as a pad's would
};

// What a view makes of the record.
struct reading {
    struct pad_evidence evidence;
    double ring_share;
    double ring_arcs;   // the same of pieces that lie along the ring, as arcs of it do
    double ring_inside; // share of the ring's print inside the frame
    double clutter;     // dark things inside the ring that are not of the pad, in rectangles
    int missing;        // inner shapes that should be seen and are not
    double ring_width_px;
    double ring_thin; // share of the ring's print that is so thin in the image that the opening may take it
    unsigned kinds;
};

// By a view that is a guess more belongs to the ring than by one that is not.
// Fails when the view is of nothing that the camera could see.
int reading_take(const struct detect_context *context, const struct hypothesis *hypothesis, struct reading *reading);

// True when the same objects were taken for the same shapes.
bool reading_same(const struct reading *a, const struct reading *b);

// True when all of these shapes were found, each for itself.
bool reading_has(const struct reading *reading, unsigned kinds);

// True when square and rectangle were found, and no border cuts them.
bool reading_has_whole_pair(const struct reading *reading);

// The sighting of one shape by itself; NULL if there is none.
const struct sighting *reading_of(const struct reading *reading, unsigned kind);

#endif

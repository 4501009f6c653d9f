// SPDX-License-Identifier: Apache-2.0
// Places where the pad may be, from shapes that are cheap to recognise.
#ifndef TOUCHDOWN_HYPOTHESIS_H
#define TOUCHDOWN_HYPOTHESIS_H

#include "detect.h"
#include "grid.h"

// What the lists are made from.
struct hypothesis_source {
    const struct grid *grid;
    const struct camera *camera;
    double height_m; // as the LiDAR says; 0 = not known
    uint32_t options;
};

// Each begins a list with the candidate `from` and stops when the frame's time is over.
// Returns with which one it goes on; 0 when there is nothing left.

// Square and rectangle, by the ratios that no tilt changes. Each pair needs
// something else of the pad around it: pieces of the ring, or the small ring, or
// from afar, where both are too thin to be seen, a height that the LiDAR confirms.
int hypotheses_from_pairs(const struct hypothesis_source *source, int from, struct work *work,
                          struct hypotheses *found);

// A small ring seen from close by, with large shapes on one side or both.
int hypotheses_from_small_rings(const struct hypothesis_source *source, int from, struct work *work,
                                struct hypotheses *found);

// A whole ring with dark things inside that weigh and lie as the inner shapes do together.
int hypotheses_from_rings(const struct hypothesis_source *source, int from, struct work *work,
                          struct hypotheses *found);

#endif

// SPDX-License-Identifier: Apache-2.0
// Places where the pad may be, from shapes that are cheap to recognise.
#ifndef TOUCHDOWN_HYPOTHESIS_H
#define TOUCHDOWN_HYPOTHESIS_H

#include "detect.h"

#define HYPOTHESES 6

struct hypothesis {
    struct pad_view view; // near enough to be fitted
    bool fused;           // the inner shapes have run together
    double error;         // the least is tried first
};

struct hypotheses {
    int count;
    struct hypothesis list[HYPOTHESES]; // the best of all, by rising error
};

// Square and rectangle, by the ratios that no tilt changes. Each pair needs
// something else of the pad around it: pieces of the ring, or the small ring, or
// from afar, where both are too thin to be seen, a height that the LiDAR confirms.
void hypotheses_from_pairs(const struct detect_scratch *scratch, const struct camera *camera, double height_m,
                           uint32_t options, struct hypotheses *found);

// A small ring seen from close by, with large shapes on one side or both.
void hypotheses_from_small_rings(const struct detect_scratch *scratch, const struct camera *camera,
                                 struct hypotheses *found);

// A whole ring with dark things inside that weigh and lie as the inner shapes do together.
void hypotheses_from_rings(const struct detect_scratch *scratch, const struct camera *camera,
                           struct hypotheses *found);

#endif

// SPDX-License-Identifier: Apache-2.0
// Fits the pad's view to what was seen of its shapes: Gauss-Newton on centroids,
// areas and second moments, each weighted by how well it can be known.
#ifndef TOUCHDOWN_PAD_FIT_H
#define TOUCHDOWN_PAD_FIT_H

#include <stdbool.h>

#include "pad_view.h"
#include "work.h"

// UNFINISHED: no time is left; the view is better than it was, and another call goes on from there.
enum { PAD_FIT_E_LOST = -1, PAD_FIT_UNFINISHED = 1 };

#define PAD_FIT_SIGHTINGS 4
#define PAD_FIT_STEPS 16

// One object of the record, or several taken as one, and which shapes it is.
struct sighting {
    unsigned kinds; // PAD_* bits
    bool clipped;   // the frame's border cuts it: only the part inside was seen
    bool pieces;    // of a broken shape: parts are missing
    struct shape seen;
};

struct pad_evidence {
    int count;
    struct sighting sightings[PAD_FIT_SIGHTINGS];
};

// How the pad's plane is expected to lie, from the autopilot's attitude.
struct tilt_hint {
    double x; // as PAD_TILT_X, PAD_TILT_Y
    double y;
    double sigma;
};

// How far a fit has come. All zero is the beginning.
struct pad_fit_progress {
    int steps;
    double damping; // of the next step
};

// Improves `view`, which has to be near. `misfit`: mean square of the residuals
// in standard deviations for each degree of freedom; 1 is what noise alone gives.
// `worst`: the greatest residual. After PAD_FIT_STEPS steps it ends where it is.
int pad_fit(const struct pad_evidence *evidence, const struct camera *camera, const struct tilt_hint *tilt,
            struct pad_view *view, double *misfit, double *worst, struct pad_fit_progress *progress,
            struct work *work);

#endif

// SPDX-License-Identifier: Apache-2.0
// What looking for the pad costs in one frame, so that it ends in time: estimates in instructions of the Cortex-A9, from
// what QEMU counted. Whoever does something costly adds it up; fits and lists of hypotheses stop where the frame's share
// is used up, and go on in the next frame.
#ifndef TOUCHDOWN_WORK_H
#define TOUCHDOWN_WORK_H

#include <stdbool.h>

// sim/flight/test_frame_time.py holds what a whole frame may take.
#define WORK_A_FRAME 240000
#define WORK_OBJECT 390 // each object of the record: copied, checked, made a shape and sorted
#define WORK_LEAST 45000 // with less no list of hypotheses is begun, and no hypothesis tried

#define WORK_POINT 128         // a point of the print, projected and summed up
#define WORK_CLIPPED_POINT 168 // and where the border is near
#define WORK_VIEW 900  // a view's plane, and what its residuals cost beside the points
#define WORK_STEP 7000 // of a fit, once the slopes are known
#define WORK_NEAR 130  // a search in the grid,
#define WORK_LOOK 15   // and each object in the cells that it goes through
#define WORK_PIECE 190 // an object that may be a piece of a ring
#define WORK_AROUND 50 // an object around a pair or inside a ring
#define WORK_PAIR 75   // two objects that may be square and rectangle
#define WORK_HYPOTHESIS 1800

struct work {
    int done;
    bool granted; // the first step of a frame is free, so that every fit comes to its end
};

// Time for little more.
static inline bool work_is_scarce(const struct work *work)
{
    return work->done + WORK_LEAST > WORK_A_FRAME;
}

static inline bool work_is_over(const struct work *work)
{
    return work->done >= WORK_A_FRAME;
}

// False when the rest has to wait for the next frame.
static inline bool work_take(struct work *work, int cost)
{
    if (!work->granted && work->done + cost > WORK_A_FRAME) {
        return false;
    }
    work->granted = false;
    work->done += cost;
    return true;
}

#endif

// SPDX-License-Identifier: Apache-2.0
// Finds the pad among the objects of a record. Hypotheses come from what is
// cheap to recognise; each is fitted with the whole pad's geometry, and only one
// that explains all that should be there is taken.
#ifndef TOUCHDOWN_DETECT_H
#define TOUCHDOWN_DETECT_H

#include <stdint.h>

#include "landing_regs.h"
#include "pad_fit.h"

// GOES_ON: none so far, but the frame's time was over before all places were looked at.
enum { DETECT_E_NO_PAD = -1, DETECT_E_GOES_ON = -2 };

// What can be left out, to see what it is worth.
#define DETECT_RING_PIECES 1U // a ring that is broken or cut by the border still counts
#define DETECT_CLOSE 2U       // from the small ring, when the border cuts the shapes
#define DETECT_FUSED 4U       // inner shapes that have run together, inside a whole ring
#define DETECT_PERSPECTIVE 8U // the centre from the fitted view, not from the plain line between square and rectangle
#define DETECT_FAR 16U        // square and rectangle alone, where the ring is too thin to be seen and the LiDAR agrees
#define DETECT_TRACK 32U      // refuse what cannot be the same pad, bridge a frame or two
#define DETECT_FACTORS 64U    // try other threshold factors while no pad is seen
#define DETECT_ALL 127U

// A shape of the record, and whether the frame's border touches it.
struct candidate {
    struct shape shape;
    bool clipped;
    enum { SIGHT_UNKNOWN, SIGHT_KNOWN, SIGHT_NONE } sight;
    double direction[3]; // of its centroid, once it was asked for and if the camera can see there
};

// Where the pad may be.
struct hypothesis {
    struct pad_view view; // near enough to be fitted
    bool fused;           // the inner shapes have run together
    double error;         // of its list, the least is tried first
    bool followed;        // it was the pad a moment ago, so that the ring lies where it says
    bool ringless;        // it was fitted without the ring, of which too much or too little was seen
    bool fitted;          // all shapes are in reach; else the view is a guess still
    struct pad_fit_progress progress;
    bool mirrored;        // it came from its mirror image, which had its turn
};

#define HYPOTHESES 6

struct hypotheses {
    int count;
    struct hypothesis list[HYPOTHESES]; // the best of all, by rising error
};

// How far a search has come that takes more than one frame: one list of hypotheses after the other.
struct search_round {
    bool under_way; // not all places were looked at
    enum { SEARCH_PAIRS, SEARCH_SMALL_RINGS, SEARCH_RINGS, SEARCH_LISTS } kind;
    bool listed; // there is a list
    struct hypotheses list;
    int list_frames; // since it was made
    int from;        // with which candidate it begins,
    int next;        // and the one after it,
    int of;          // of how many
    int lists;       // of this kind so far
    int turn;        // hypotheses of it that had theirs
    bool found;      // something that may be a pad
    bool fitting;    // one that had no time to be fitted to its end
    struct hypothesis fit;
    int fit_frames; // for which it has been going on
};

struct detect_scratch {
    struct search_round round;
    int missed; // frames in a row with a last view and no pad
    int work; // that the last frame took: see work.h
    int count;
    struct candidate candidates[LANDING_RECORD_MAX_OBJECTS];
};

struct pad_estimate {
    struct pad_view view;
    double x_px; // image of the ring's physical centre
    double y_px;
    double angle_deg;   // (-180, 180], clockwise in the image; 0 = square above rectangle
    double right_m;     // pad's centre in camera axes, as its size says
    double forward_m;
    double depth_m;
    double height_m;    // from the camera along its axis to the pad's plane
    double misfit;      // 1 = noise alone
    double doubt;       // misfit, and what is missing or does not belong
    double ring_share;  // of the ring's visible print that was seen
    unsigned kinds;     // PAD_* that were seen
    bool fused;         // the inner shapes as one
    bool ringless;      // fitted without the ring
    double search_doubt; // left by this pad when it was last searched for
};

// What is known before a record is read.
struct detect_hint {
    struct tilt_hint tilt; // how the plane is expected to lie
    double height_m;       // of the camera, along its axis, as the LiDAR says; 0 = not known
    bool searching;        // the thresholds have not the usual factor: most of what is seen is clutter
    const struct pad_view *last; // of the pad a moment ago, or NULL: tried first, and if it leaves little doubt, alone
    bool last_fused;             // its inner shapes were seen as one
    bool last_ringless;          // it was fitted without the ring
    double last_doubt;           // that it may leave: what it left when nothing better was found
};

// Level ground, roughly, and no altitude.
extern const struct detect_hint detect_no_hint;

int detect_pad(const struct landing_record *record, const struct camera *camera, const struct detect_hint *hint,
               uint32_t options, struct detect_scratch *scratch, struct pad_estimate *pad);

#endif

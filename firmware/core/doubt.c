// SPDX-License-Identifier: Apache-2.0
#include "doubt.h"

#include <math.h>
#include <stddef.h>

#include "bounds.h"

#define METRES_PER_MM 0.001

// Weights of what is missing or does not belong, beside the misfit.
#define DOUBT_RING 3.0    // for all of the ring's print, where the frame would show it
#define DOUBT_CLUTTER 2.0 // for dark things inside the ring or beside it that weigh as much as the rectangle
#define DOUBT_NO_RING 0.5
// Share of the ring that may be missing where it is too thin to be seen, unless it is all round.
#define EXCUSED_MAX 0.4
#define EXCUSED_THIN_MAX 0.99
// So much doubt from the ring alone: about half of it is missing.
#define NO_RING_BROKEN_MIN 1.0
#define DOUBT_MISSING 1.5 // for a square, rectangle or small ring that should be there
// How far the LiDAR may be off: over grass or mounted elsewhere, and where all hangs on it.
#define ROUGH_TOLERANCE 0.25
#define ROUGH_TOLERANCE_M 0.1
#define CLOSE_TOLERANCE 0.12
#define CLOSE_TOLERANCE_M 0.05
#define DOUBT_HEIGHT 1.0 // for a LiDAR reading that contradicts the size
// Of a ring in pieces that is not whole enough to be fitted, any grass may be a part.
#define PIECES_DOUBT_MAX 1.2
#define PIECES_DOUBT_SEARCHING_MAX 1.08 // under other thresholds than the usual ones
#define PIECES_DOUBT_CROWDED_MAX 0.8    // among many objects
#define PIECES_DOUBT_CLUTTER_MAX 0.6    // both
#define PATCHED_DOUBT_CROWDED_MAX 1.0   // pieces that make a whole ring
#define WHOLE_DOUBT_CROWDED_MAX 1.4     // a ring in one piece that has grown together with something
#define LACKING_DOUBT_CROWDED_MAX 1.8   // one that wants a shape: all else must fit well
#define CUT_DOUBT_MAX 0.5               // the border cuts the square, the rectangle or both
#define CUT_DOUBT_CLUTTER_MAX 0.2       // the same under other thresholds or in a crowd: the ring in one piece, all fits
// The same of a pair that all else confirms: attitude and LiDAR, a fit as good as noise allows, nothing that does not
// belong, and pieces that are arcs of the ring. docs/accuracy.md: nothing in frames without a pad is that.
#define CONFIRMED_DOUBT_MAX 1.9
#define CONFIRMED_MISFIT_MAX 0.95
#define CONFIRMED_CLUTTER_MAX 0.05
#define CONFIRMED_ARCS_MIN 0.9 // of what was seen of the ring
#define CONFIRMED_TOLERANCE 0.05
#define CONFIRMED_TOLERANCE_M 0.04
#define UNCONFIRMED_TILT 0.4
#define UNCONFIRMED_DOUBT_MAX 1.0
// With only one of square and rectangle there is little to contradict a view.
#define CLOSE_DOUBT_MAX 1.0
// Ring and what is inside as one: few numbers, so they have to be right.
#define FUSED_DOUBT_MAX 0.8
// From afar the opening takes the ring. What is left must be nearly ideal, of the
// right size, lie as the autopilot's attitude says, and be seen with the usual
// factor: other factors, tried for long enough, show two such specks in any grass.
#define FAR_DOUBT_MAX 0.42
#define FAR_ARCS_MIN 0.12 // so much of the ring is enough where all else confirms the pair, whatever the factor
#define ATTITUDE_SIGMA 0.1
#define FAR_RING_WIDTH_PX 6.5
#define FAR_FACING_MIN 0.7 // 45 degrees: farther off the axis too little of a square is left

// Beyond these no view is one of a pad.
#define WORST_MAX 5.0
#define NO_RING_SMALL_RING_AREA_MIN_PX 150.0
#define EDGE_MAX_PX 3.0
#define TILT_MAX 1.3

double pad_plane_height_m(const struct pad_plane *plane)
{
    return METRES_PER_MM *
           (plane->centre[0] * plane->normal[0] + plane->centre[1] * plane->normal[1] +
            plane->centre[2] * plane->normal[2]) /
           plane->normal[2];
}

// True when there is no reading of the LiDAR, or the view has its height, nearly enough.
static bool agrees_with_lidar(const struct detect_context *context, const struct pad_plane *plane, double tolerance,
                              double tolerance_m)
{
    const double expected_m = context->hint->height_m;

    return !(expected_m > 0.0) || fabs(pad_plane_height_m(plane) - expected_m) <= tolerance * expected_m + tolerance_m;
}

// True where the ring cannot be seen any more, and the LiDAR says so too.
static bool far_enough(const struct detect_context *context, const struct reading *reading,
                       const struct pad_plane *plane)
{
    return (context->options & DETECT_FAR) != 0U && !context->hint->searching &&
           context->hint->tilt.sigma <= ATTITUDE_SIGMA && context->hint->height_m > 0.0 &&
           reading->ring_width_px <= FAR_RING_WIDTH_PX && pad_plane_facing(plane) >= FAR_FACING_MIN &&
           agrees_with_lidar(context, plane, CLOSE_TOLERANCE, CLOSE_TOLERANCE_M);
}

// True where attitude, LiDAR and what was seen of the ring all say the same as the pair.
static bool is_confirmed(const struct detect_context *context, const struct reading *reading,
                         const struct pad_plane *plane, double misfit)
{
    return reading_has_whole_pair(reading) && context->hint->tilt.sigma <= ATTITUDE_SIGMA &&
           context->hint->height_m > 0.0 &&
           agrees_with_lidar(context, plane, CONFIRMED_TOLERANCE, CONFIRMED_TOLERANCE_M) &&
           misfit <= CONFIRMED_MISFIT_MAX && reading->clutter <= CONFIRMED_CLUTTER_MAX &&
           reading->ring_arcs >= CONFIRMED_ARCS_MIN * reading->ring_share;
}

// How much doubt is allowed where the pair has no other witness than the ring.
static double pieces_doubt_max(const struct detect_context *context, const struct reading *reading)
{
    const bool searching = context->hint->searching;
    const bool in_one_piece = reading_has(reading, PAD_RING) && !reading_of(reading, PAD_RING)->pieces;

    if (!reading_has_whole_pair(reading)) {
        const double clutter = in_one_piece ? CUT_DOUBT_CLUTTER_MAX : 0.0;

        return searching || context->crowded ? clutter : CUT_DOUBT_MAX;
    }
    const double pieces = context->crowded ? (searching ? PIECES_DOUBT_CLUTTER_MAX : PIECES_DOUBT_CROWDED_MAX)
                                           : (searching ? PIECES_DOUBT_SEARCHING_MAX : PIECES_DOUBT_MAX);
    if (!reading_has(reading, PAD_RING)) {
        return pieces;
    }
    // Clutter can be pieced together to anything, a whole ring too.
    const double patched = searching ? pieces : context->crowded ? PATCHED_DOUBT_CROWDED_MAX : HUGE_VAL;
    const double lacking = reading->missing > 0 ? LACKING_DOUBT_CROWDED_MAX : WHOLE_DOUBT_CROWDED_MAX;
    const double single = context->crowded ? lacking : HUGE_VAL;
    return in_one_piece ? single : patched;
}

// What of the ring is missing and should not be.
static double broken_of(const struct detect_context *context, const struct reading *reading)
{
    const double share = at_most(reading->ring_share, 1.0);
    const double missing = at_most(2.0 * reading->ring_inside, 1.0) * (1.0 - share);
    // Pieces of a ring that is thin all round, or among clutter, are found anywhere.
    const bool clutter = context->hint->searching || context->crowded;
    const double thin = clutter || reading->ring_thin > EXCUSED_THIN_MAX ? 0.0 : at_most(reading->ring_thin, EXCUSED_MAX);

    return DOUBT_RING * at_least(missing - at_least(thin, 1.0 - RING_SHARE_WHOLE), 0.0);
}

// True of square and rectangle where too little of the ring is seen to say anything by itself.
static bool is_far_pair(const struct detect_context *context, const struct reading *reading,
                        const struct pad_plane *plane, double misfit, double doubt)
{
    const bool traces = reading->ring_width_px <= FAR_RING_WIDTH_PX && reading->ring_arcs >= FAR_ARCS_MIN &&
                        is_confirmed(context, reading, plane, misfit) && doubt <= CONFIRMED_MISFIT_MAX;

    return reading_has_whole_pair(reading) &&
           (traces || (far_enough(context, reading, plane) && doubt <= FAR_DOUBT_MAX));
}

// How far the view is from being believed; a negative number if it cannot be at all.
double doubt_of(const struct detect_context *context, const struct reading *reading, const struct pad_view *view,
                double misfit, double worst)
{
    const double tilt = at_least(fabs(view->value[PAD_TILT_X]), fabs(view->value[PAD_TILT_Y]));
    const bool small_ring =
        reading_has(reading, PAD_SMALL_RING) &&
        reading_of(reading, PAD_SMALL_RING)->seen.area_px >= NO_RING_SMALL_RING_AREA_MIN_PX;
    const bool ring = reading->ring_share >= RING_SHARE_MIN && reading->ring_share <= RING_SHARE_MAX;
    const bool pair = reading_has(reading, PAD_SQUARE | PAD_RECTANGLE);
    const bool fused = reading->evidence.count == 2 && reading->evidence.sightings[0].kinds == PAD_INNER;

    struct pad_plane plane;

    if (fabs(view->value[PAD_EDGE_PX]) > EDGE_MAX_PX || tilt > TILT_MAX || worst > WORST_MAX ||
        pad_plane_of(view, context->camera, &plane) != 0) {
        return -1.0;
    }
    const double height = agrees_with_lidar(context, &plane, ROUGH_TOLERANCE, ROUGH_TOLERANCE_M) ? 0.0 : DOUBT_HEIGHT;
    const double doubt = misfit + DOUBT_CLUTTER * reading->clutter + DOUBT_MISSING * reading->missing + height;
    if (fused) {
        return reading_has(reading, PAD_RING) && doubt <= FUSED_DOUBT_MAX ? doubt : -1.0;
    }
    // A tilt that no attitude confirms can make a false pad of many things.
    if (doubt > UNCONFIRMED_DOUBT_MAX && context->hint->tilt.sigma > ATTITUDE_SIGMA &&
        hypot(view->value[PAD_TILT_X], view->value[PAD_TILT_Y]) > UNCONFIRMED_TILT) {
        return -1.0;
    }
    const double broken = broken_of(context, reading);
    // Two of three that do not depend on each other, one of them the pair or half of it.
    if (pair && small_ring) {
        // Small shapes inside a wrong ring are a pad seen from higher up, but for the LiDAR.
        return broken < NO_RING_BROKEN_MIN || agrees_with_lidar(context, &plane, CLOSE_TOLERANCE, CLOSE_TOLERANCE_M)
                   ? doubt + DOUBT_NO_RING * broken
                   : -1.0;
    }
    if (pair && ring) {
        const double confirmed = is_confirmed(context, reading, &plane, misfit) ? CONFIRMED_DOUBT_MAX : 0.0;

        return doubt + broken <= at_least(pieces_doubt_max(context, reading), confirmed) ? doubt + broken : -1.0;
    }
    if ((reading->kinds & (PAD_SQUARE | PAD_RECTANGLE)) != 0U && ring && small_ring) {
        return doubt + broken <= CLOSE_DOUBT_MAX ? doubt + broken : -1.0;
    }
    return is_far_pair(context, reading, &plane, misfit, doubt) ? doubt : -1.0;
}

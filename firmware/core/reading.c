// SPDX-License-Identifier: Apache-2.0
#include "reading.h"

#include <math.h>
#include <stddef.h>

#include "bounds.h"
#include "pad_geometry.h"

// A shape smaller than this has edges that are as large as itself.
#define AREA_MIN_PX 20.0

// How far a shape may be from where the view expects it, before the view is fitted.
#define MATCH_DISTANCE_SIZE 0.45
#define MATCH_DISTANCE_PX 2.0
#define MATCH_AREA_RATIO 1.9
// Of the small ring bloom and the opening can leave a third, or close its hole.
#define MATCH_SMALL_RING_RATIO 3.0
// Standard deviation along the shorter axis, nearly the width of its print. From
// a thinner one the opening takes so much that the rest is not in the middle.
#define SMALL_RING_SHORT_MIN_PX 5.0
// Less than this inside the frame is a sliver that the opening may have taken.
#define MATCH_INSIDE_MIN 0.25
#define MATCH_INSIDE_WHOLE 0.999

// The ring: root mean square distance of a piece from the centre, and how much must be seen.
#define PIECE_RADIUS_MIN_MM 90.0
#define PIECE_RADIUS_MAX_MM 135.0
// The same once the view is fitted; what lies on the paper beside it, up to its edge, does not belong.
#define FITTED_PIECE_RADIUS_MIN_MM 95.0
#define FITTED_PIECE_RADIUS_MAX_MM 131.0
#define MARGIN_MM 145.0
// A ring of which nothing is missing and to which nothing has grown: its own is 2.76.
#define CLEAN_RING_INVARIANT_MIN 2.55
#define CLEAN_RING_INVARIANT_MAX 3.1
#define RING_REACH 1.7 // of its root mean square radius in the image
#define THIN_WIDTH_PX 7.0
// Variance of an arc of the ring across the line from its centre, to that along it: 2.6 for 20 degrees, 9 for 40.
#define ARC_VARIANCES 2.0
#define THIN_PLACES 8

// How much doubt a view may leave: its misfit, and what is missing or does not belong.
#define MISSING_INSIDE_MIN 0.9
#define MISSING_SMALL_RING_AREA_MIN_PX 400.0

const struct sighting *reading_of(const struct reading *reading, unsigned kind)
{
    for (int i = 0; i < reading->evidence.count; i++) {
        if (reading->evidence.sightings[i].kinds == kind) {
            return &reading->evidence.sightings[i];
        }
    }
    return NULL;
}

bool reading_same(const struct reading *a, const struct reading *b)
{
    bool same = a->evidence.count == b->evidence.count;

    for (int i = 0; same && i < a->evidence.count; i++) {
        const struct sighting *one = &a->evidence.sightings[i];
        const struct sighting *other = &b->evidence.sightings[i];
        same = one->kinds == other->kinds && one->clipped == other->clipped &&
               one->seen.area_px == other->seen.area_px && one->seen.x_px == other->seen.x_px &&
               one->seen.y_px == other->seen.y_px;
    }
    return same;
}

bool reading_has(const struct reading *reading, unsigned kinds)
{
    return (reading->kinds & kinds) == kinds;
}

bool reading_has_whole_pair(const struct reading *reading)
{
    return reading_has(reading, PAD_SQUARE | PAD_RECTANGLE) && !reading_of(reading, PAD_SQUARE)->clipped &&
           !reading_of(reading, PAD_RECTANGLE)->clipped;
}

static void add_sighting(struct reading *reading, unsigned kinds, const struct shape *seen, bool clipped, bool pieces)
{
    struct pad_evidence *evidence = &reading->evidence;
    struct sighting *sighting = &evidence->sightings[evidence->count];

    sighting->kinds = kinds;
    sighting->clipped = clipped;
    sighting->pieces = pieces;
    sighting->seen = *seen;
    reading->kinds |= kinds != PAD_INNER ? kinds : 0U;
    evidence->count++;
}

// Standard deviation along the shorter axis.
static double short_side(const struct shape *shape)
{
    double long_px;
    double short_px;
    struct vector axis;

    shape_axes(shape, &long_px, &short_px, &axis);
    return short_px;
}

// What the view expects inside the frame of one shape; returns the share of its print that is there.
static double expected_of(const struct detect_context *context, const struct pad_plane *plane, unsigned kind,
                          struct shape *expected)
{
    const struct camera *camera = context->camera;

    context->work->done += pad_plane_work(kind, PAD_WHOLE);
    if (!(pad_plane_moments(plane, camera, kind, PAD_WHOLE, expected) > 0.0)) {
        return 0.0;
    }
    // Roughly how far it reaches: only near the border is the finer grid worth its time.
    const double reach = 2.0 * sqrt(expected->cov_xx + expected->cov_yy);
    const bool inside = expected->x_px >= reach && expected->y_px >= reach &&
                        expected->x_px <= camera->width_px - 1.0 - reach &&
                        expected->y_px <= camera->height_px - 1.0 - reach;
    if (inside) {
        return 1.0;
    }
    context->work->done += pad_plane_work(kind, PAD_CLIPPED);
    return pad_plane_moments(plane, camera, kind, PAD_CLIPPED, expected);
}

// The object that is nearest to what the view expects of one of the inner shapes.
static void match(const struct detect_context *context, const struct pad_plane *plane, double edge_px, unsigned kind,
                  struct reading *reading)
{
    struct shape expected;
    const struct candidate *nearest = NULL;
    double least = 0.0;
    const double inside = expected_of(context, plane, kind, &expected);

    if (inside < MATCH_INSIDE_MIN) {
        return;
    }
    const bool whole = inside > MATCH_INSIDE_WHOLE;
    if (kind == PAD_SMALL_RING && short_side(&expected) < SMALL_RING_SHORT_MIN_PX) {
        return;
    }
    if (!whole && (context->options & DETECT_CLOSE) == 0U) {
        return;
    }
    const double area_px = at_least(expected.area_px + edge_px * pad_edges_px(kind, &expected, inside), AREA_MIN_PX);
    const double ratio = kind == PAD_SMALL_RING ? MATCH_SMALL_RING_RATIO : MATCH_AREA_RATIO;
    const double reachable = MATCH_DISTANCE_PX + MATCH_DISTANCE_SIZE * sqrt(expected.area_px);
    struct grid_near near;
    grid_near(context->grid, expected.x_px, expected.y_px, reachable * reachable, &near);
    context->work->done += WORK_NEAR + WORK_LOOK * near.looked_at;
    for (int i = 0; i < near.count; i++) {
        const struct candidate *candidate = &context->scratch->candidates[near.list[i]];
        const struct shape *shape = &candidate->shape;
        const double x = shape->x_px - expected.x_px;
        const double y = shape->y_px - expected.y_px;
        const double squared = x * x + y * y;
        if (shape->area_px > ratio * area_px || shape->area_px * ratio < area_px) {
            continue;
        }
        if (nearest == NULL || squared < least) {
            nearest = candidate;
            least = squared;
        }
    }
    if (nearest != NULL) {
        add_sighting(reading, kind, &nearest->shape, nearest->clipped || !whole, false);
    } else if (inside > MISSING_INSIDE_MIN && (kind != PAD_SMALL_RING || area_px > MISSING_SMALL_RING_AREA_MIN_PX)) {
        reading->missing++;
    }
}

// Where a candidate is seen; NULL outside of what the camera can see. Asked for again and again in a frame.
static const double *direction_of(const struct detect_context *context, struct candidate *candidate)
{
    if (candidate->sight == SIGHT_UNKNOWN) {
        const struct shape *shape = &candidate->shape;
        const bool seen = camera_direction(context->camera, shape->x_px, shape->y_px, candidate->direction) == 0;
        candidate->sight = seen ? SIGHT_KNOWN : SIGHT_NONE;
    }
    return candidate->sight == SIGHT_KNOWN ? candidate->direction : NULL;
}

// What a pixel is in mm of the pad, near one place of the image: a covariance there becomes a mean square distance.
struct pixel_mm {
    double xx;
    double xy;
    double yy;
};

// Fails where a pixel there looks past the plane.
static bool pixel_mm_at(const struct detect_context *context, const struct pad_plane *plane, const struct shape *place,
                        struct pixel_mm *pixel)
{
    double x;
    double y;
    double right_x;
    double right_y;
    double below_x;
    double below_y;

    context->work->done += 3 * WORK_PIECE;
    if (pad_plane_unproject(plane, context->camera, place->x_px, place->y_px, &x, &y) != 0 ||
        pad_plane_unproject(plane, context->camera, place->x_px + 1.0, place->y_px, &right_x, &right_y) != 0 ||
        pad_plane_unproject(plane, context->camera, place->x_px, place->y_px + 1.0, &below_x, &below_y) != 0) {
        return false;
    }
    pixel->xx = (right_x - x) * (right_x - x) + (right_y - y) * (right_y - y);
    pixel->yy = (below_x - x) * (below_x - x) + (below_y - y) * (below_y - y);
    pixel->xy = (right_x - x) * (below_x - x) + (right_y - y) * (below_y - y);
    return true;
}

// Mean square distance of a shape's print from the pad's centre, mm^2; negative if it looks past the plane.
static double square_radius(const struct detect_context *context, const struct pad_plane *plane,
                            const struct pixel_mm *pixel, struct candidate *candidate)
{
    const struct shape *shape = &candidate->shape;
    const double *direction = direction_of(context, candidate);
    double x;
    double y;

    context->work->done += WORK_PIECE;
    if (direction == NULL || pad_plane_meet(plane, direction, &x, &y) != 0) {
        return -1.0;
    }
    return x * x + y * y + pixel->xx * shape->cov_xx + 2.0 * pixel->xy * shape->cov_xy + pixel->yy * shape->cov_yy;
}

static bool is_sighted(const struct reading *reading, const struct shape *shape)
{
    for (int i = 0; i < reading->evidence.count; i++) {
        const struct shape *seen = &reading->evidence.sightings[i].seen;
        if (seen->x_px == shape->x_px && seen->y_px == shape->y_px) {
            return true;
        }
    }
    return false;
}

// Share of a ring's outline where it is too thin: seen obliquely, it is thinnest
// where it lies across the line of sight.
static double thin_share(const struct shape *ring, double mean_width_px)
{
    double long_px;
    double short_px;
    struct vector axis;
    int thin = 0;

    shape_axes(ring, &long_px, &short_px, &axis);
    const double least = short_px / long_px;
    // Width along the outline of an ellipse, in parts of its greatest.
    double widths[THIN_PLACES];
    double sum = 0.0;
    for (int i = 0; i < THIN_PLACES; i++) {
        const double square = (i + 0.5) / THIN_PLACES; // of the sine: places are denser at the ends, as print is
        widths[i] = least / sqrt(square + least * least * (1.0 - square));
        sum += widths[i];
    }
    for (int i = 0; i < THIN_PLACES; i++) {
        thin += widths[i] * THIN_PLACES * mean_width_px < THIN_WIDTH_PX * sum ? 1 : 0;
    }
    return (double)thin / THIN_PLACES;
}

// True of a piece that is longer across the line from the ring's centre than along it.
static bool lies_along(const struct shape *piece, const struct vector *centre)
{
    const double x = piece->x_px - centre->x;
    const double y = piece->y_px - centre->y;
    const double along = x * x * piece->cov_xx + 2.0 * x * y * piece->cov_xy + y * y * piece->cov_yy;
    const double across = y * y * piece->cov_xx - 2.0 * x * y * piece->cov_xy + x * x * piece->cov_yy;

    return across > ARC_VARIANCES * along;
}

// Mean square distances from the pad's centre, mm^2.
struct annuli {
    double piece_least; // of the ring
    double piece_greatest;
    double clutter_least; // of what does not belong
    double clutter_greatest;
};

static const struct annuli guessed = {
    .piece_least = PIECE_RADIUS_MIN_MM * PIECE_RADIUS_MIN_MM,
    .piece_greatest = PIECE_RADIUS_MAX_MM * PIECE_RADIUS_MAX_MM,
    .clutter_least = SMALL_RING_OUTER_RADIUS_MM * SMALL_RING_OUTER_RADIUS_MM,
    .clutter_greatest = PIECE_RADIUS_MIN_MM * PIECE_RADIUS_MIN_MM,
};
static const struct annuli known = {
    .piece_least = FITTED_PIECE_RADIUS_MIN_MM * FITTED_PIECE_RADIUS_MIN_MM,
    .piece_greatest = FITTED_PIECE_RADIUS_MAX_MM * FITTED_PIECE_RADIUS_MAX_MM,
    .clutter_least = SMALL_RING_OUTER_RADIUS_MM * SMALL_RING_OUTER_RADIUS_MM,
    .clutter_greatest = MARGIN_MM * MARGIN_MM,
};

// What lies where the ring does.
struct pieces {
    struct shape_sum sum;
    double arcs_px;    // of those that lie along it
    double clutter_px; // of what lies elsewhere within reach and was not taken for an inner shape
    int count;
    double invariant; // of the last
    bool clipped;
};

// `reach`: of the disc, from the expected shape. Nothing larger than `most_px` belongs.
static bool gather(const struct detect_context *context, const struct pad_plane *plane, const struct annuli *annuli,
                   const struct reading *reading, const struct shape *expected, double reach, double most_px,
                   struct pieces *pieces)
{
    struct pixel_mm pixel;
    struct grid_near near;
    struct vector centre;

    *pieces = (struct pieces){.sum = {.origin = *expected}};
    if (!pixel_mm_at(context, plane, expected, &pixel)) {
        return false;
    }
    (void)camera_image(context->camera, plane->centre, &centre.x, &centre.y);
    grid_near(context->grid, expected->x_px, expected->y_px, reach * reach, &near);
    context->work->done += WORK_NEAR + WORK_LOOK * near.looked_at;
    for (int i = 0; i < near.count; i++) {
        struct candidate *candidate = &context->scratch->candidates[near.list[i]];
        const struct shape *shape = &candidate->shape;
        if (shape->area_px > most_px) {
            continue;
        }
        const double square = square_radius(context, plane, &pixel, candidate);
        if (square > annuli->piece_least && square < annuli->piece_greatest) {
            shape_sum_add(&pieces->sum, shape);
            pieces->arcs_px += lies_along(shape, &centre) ? shape->area_px : 0.0;
            pieces->clipped = pieces->clipped || candidate->clipped;
            pieces->invariant = shape->invariant;
            pieces->count++;
        } else if (square > annuli->clutter_least && square < annuli->clutter_greatest && !is_sighted(reading, shape)) {
            pieces->clutter_px += shape->area_px;
        }
    }
    return true;
}

static void match_ring(const struct detect_context *context, const struct pad_plane *plane,
                       const struct hypothesis *hypothesis, struct reading *reading)
{
    const double edge_px = hypothesis->view.value[PAD_EDGE_PX];
    const struct annuli *annuli = hypothesis->fitted || hypothesis->followed ? &known : &guessed;
    struct shape expected;
    struct pieces pieces;
    const double inside = expected_of(context, plane, PAD_RING, &expected);

    reading->ring_inside = inside;
    if (!(inside > 0.05)) {
        return;
    }
    const double edges_px = pad_edges_px(PAD_RING, &expected, inside);
    const double area_px = at_least(expected.area_px + edge_px * edges_px, expected.area_px / 3.0);
    reading->ring_width_px = 2.0 * area_px / edges_px;
    reading->ring_thin = thin_share(&expected, reading->ring_width_px);
    // The disc, in any direction, from wherever the border has moved the centroid to.
    const double reach = RING_REACH * sqrt(expected.cov_xx + expected.cov_yy) / at_least(inside, 0.3);
    if (!gather(context, plane, annuli, reading, &expected, reach, RING_SHARE_MAX * area_px, &pieces)) {
        return;
    }
    reading->ring_share = pieces.sum.area_px / area_px;
    reading->ring_arcs = pieces.arcs_px / area_px;
    // One part of clutter weighs as much as the rectangle would.
    reading->clutter = pieces.clutter_px / (area_px / inside) * pad_area_mm2(PAD_RING) / pad_area_mm2(PAD_RECTANGLE);
    // One that is whole by its own looks is what it is, though it has too much or too little print for this view.
    const bool clean = pieces.count == 1 && pieces.invariant >= CLEAN_RING_INVARIANT_MIN &&
                       pieces.invariant <= CLEAN_RING_INVARIANT_MAX;
    // A ring that was not whole a moment ago is not whole for a pixel more: the fit would jump from frame to frame.
    const double least = hypothesis->ringless ? RING_SHARE_WHOLE_AGAIN : RING_SHARE_WHOLE;
    const bool whole = reading->ring_share >= least && reading->ring_share <= 1.0 / least;
    if ((!clean && !whole) ||
        ((context->options & DETECT_RING_PIECES) == 0U && (pieces.count != 1 || pieces.clipped))) {
        return;
    }
    const struct shape seen = shape_of_sum(&pieces.sum);
    add_sighting(reading, PAD_RING, &seen, pieces.clipped || inside < MATCH_INSIDE_WHOLE, pieces.count > 1);
}

// All that lies inside the ring, as one: the inner shapes have run together.
static void match_fused(const struct detect_context *context, const struct pad_plane *plane, struct reading *reading)
{
    struct shape_sum inner = {.area_px = 0.0};
    struct shape expected;
    struct shape ring;

    context->work->done += pad_plane_work(PAD_INNER | PAD_RING, PAD_WHOLE);
    if (!(pad_plane_moments(plane, context->camera, PAD_INNER, PAD_WHOLE, &expected) > 0.0) ||
        !(pad_plane_moments(plane, context->camera, PAD_RING, PAD_WHOLE, &ring) > 0.0)) {
        return;
    }
    inner.origin = expected;
    struct pixel_mm pixel;
    struct grid_near near;
    if (!pixel_mm_at(context, plane, &ring, &pixel)) {
        return;
    }
    grid_near(context->grid, ring.x_px, ring.y_px, RING_REACH * RING_REACH * (ring.cov_xx + ring.cov_yy), &near);
    context->work->done += WORK_NEAR + WORK_LOOK * near.looked_at;
    for (int i = 0; i < near.count; i++) {
        struct candidate *candidate = &context->scratch->candidates[near.list[i]];
        const double square = square_radius(context, plane, &pixel, candidate);
        if (square >= 0.0 && square < PIECE_RADIUS_MIN_MM * PIECE_RADIUS_MIN_MM && !candidate->clipped) {
            shape_sum_add(&inner, &candidate->shape);
        }
    }
    if (inner.area_px > expected.area_px / MATCH_AREA_RATIO && inner.area_px < expected.area_px * MATCH_AREA_RATIO) {
        const struct shape seen = shape_of_sum(&inner);
        add_sighting(reading, PAD_INNER, &seen, false, false);
    }
}

int reading_take(const struct detect_context *context, const struct hypothesis *hypothesis, struct reading *reading)
{
    struct pad_plane plane;
    const double edge_px = hypothesis->view.value[PAD_EDGE_PX];

    *reading = (struct reading){.kinds = 0U};
    if (pad_plane_of(&hypothesis->view, context->camera, &plane) != 0) {
        return DETECT_E_NO_PAD;
    }
    if (hypothesis->fused) {
        match_fused(context, &plane, reading);
    } else {
        match(context, &plane, edge_px, PAD_SQUARE, reading);
        match(context, &plane, edge_px, PAD_RECTANGLE, reading);
        match(context, &plane, edge_px, PAD_SMALL_RING, reading);
    }
    match_ring(context, &plane, hypothesis, reading);
    return 0;
}

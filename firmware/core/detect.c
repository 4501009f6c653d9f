// SPDX-License-Identifier: Apache-2.0
#include "detect.h"

#include <math.h>
#include <stddef.h>

#include "hypothesis.h"
#include "pad_geometry.h"

#define DEGREES_PER_RADIAN 57.29577951308232
#define METRES_PER_MM 0.001
#define BASELINE (RECTANGLE_CENTRE_Y_MM - SQUARE_CENTRE_Y_MM)
#define CENTRE_FRACTION (RECTANGLE_CENTRE_Y_MM / BASELINE)

// A shape smaller than this has edges that are as large as itself.
#define AREA_MIN_PX 20.0
#define SOLID_INVARIANT_MIN 10.3
#define SOLID_INVARIANT_MAX 13.4

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
#define RING_SHARE_MIN 0.3
#define RING_SHARE_MAX 1.5
#define RING_SHARE_WHOLE 0.85

// How much doubt a view may leave: its misfit, and what is missing or does not belong.
#define DOUBT_MAX 2.5
#define DOUBT_RING 3.0    // for all of the ring's print, where the frame would show it
#define DOUBT_CLUTTER 2.0 // for dark things inside the ring that weigh as much as the rectangle
#define DOUBT_NO_RING 0.5
#define DOUBT_MISSING 1.5 // for a square, rectangle or small ring that should be there
#define MISSING_INSIDE_MIN 0.9
#define MISSING_SMALL_RING_AREA_MIN_PX 400.0
#define HEIGHT_TOLERANCE 0.25
#define HEIGHT_TOLERANCE_M 0.1
#define DOUBT_HEIGHT 1.5 // for a LiDAR reading that contradicts the size
// With only one of square and rectangle there is little to contradict a view.
#define CLOSE_DOUBT_MAX 1.0
// Ring and what is inside as one: few numbers, so they have to be right.
#define FUSED_DOUBT_MAX 0.8
// From afar the opening takes the ring. What is left must be nearly ideal and of the right size.
#define FAR_DOUBT_MAX 1.0
#define FAR_RING_WIDTH_PX 6.5
#define FAR_HEIGHT_TOLERANCE 0.12
#define FAR_HEIGHT_TOLERANCE_M 0.05
// A view this bad may be the mirror image of a better one.
#define MIRROR_MISFIT 1.5
#define WORST_MAX 5.0
#define NO_RING_SMALL_RING_AREA_MIN_PX 150.0
#define EDGE_MAX_PX 3.0
#define TILT_MAX 1.3

// How well each way of telling the centre knows it.
#define SMALL_RING_SIGMA_PX 0.04
#define SMALL_RING_PRECISE_AREA_PX 150.0 // below it the hole closes
#define LINE_SIGMA_PX 0.03
#define LINE_SIGMA_RING 0.001 // of the ring's diameter

const struct detect_hint detect_no_hint = {.tilt = {.x = 0.0, .y = 0.0, .sigma = 0.25}, .height_m = 0.0};

// What a view makes of the record.
struct reading {
    struct pad_evidence evidence;
    int place[PAD_KINDS]; // sighting of square, rectangle, small ring, ring; -1 = none
    double ring_share;
    double ring_inside; // share of the ring's print inside the frame
    double clutter;     // dark things inside the ring that are not of the pad, in rectangles
    int missing;        // inner shapes that should be seen and are not
    double ring_width_px;
    unsigned kinds;
};

struct context {
    const struct detect_scratch *scratch;
    const struct camera *camera;
    const struct detect_hint *hint;
    uint32_t options;
};

static void collect(const struct landing_record *record, const struct camera *camera, struct detect_scratch *scratch)
{
    const double right = camera->width_px - 1.0;
    const double bottom = camera->height_px - 1.0;

    scratch->count = 0;
    scratch->solid_count = 0;
    for (uint32_t i = 0; i < record->header.object_count; i++) {
        const struct landing_object *object = &record->objects[i];
        struct candidate *candidate = &scratch->candidates[scratch->count];
        if ((double)object->area < AREA_MIN_PX || shape_from_object(object, &candidate->shape) != 0) {
            continue;
        }
        candidate->clipped = object->box_min_x == 0U || object->box_min_y == 0U ||
                             (double)object->box_max_x >= right || (double)object->box_max_y >= bottom;
        const double invariant = candidate->shape.invariant;
        if (!candidate->clipped && invariant >= SOLID_INVARIANT_MIN && invariant <= SOLID_INVARIANT_MAX) {
            // Sorted by insertion: bounded by the 256 of a record.
            int place = scratch->solid_count;
            for (; place > 0 && scratch->candidates[scratch->solids[place - 1]].shape.area_px > candidate->shape.area_px;
                 place--) {
                scratch->solids[place] = scratch->solids[place - 1];
            }
            scratch->solids[place] = (uint16_t)scratch->count;
            scratch->solid_count++;
        }
        scratch->count++;
    }
}

// Of one shape. Several in one have no place of their own.
static int index_of(unsigned kind)
{
    return kind == PAD_SQUARE ? 0 : kind == PAD_RECTANGLE ? 1 : kind == PAD_SMALL_RING ? 2 : 3;
}

static void add_sighting(struct reading *reading, unsigned kinds, const struct shape *seen, bool clipped, bool pieces)
{
    struct pad_evidence *evidence = &reading->evidence;
    struct sighting *sighting = &evidence->sightings[evidence->count];

    sighting->kinds = kinds;
    sighting->clipped = clipped;
    sighting->pieces = pieces;
    sighting->seen = *seen;
    if (kinds != PAD_INNER) {
        reading->place[index_of(kinds)] = evidence->count;
        reading->kinds |= kinds;
    }
    evidence->count++;
}

// The object that is nearest to what the view expects of one of the inner shapes.
static void match(const struct context *context, const struct pad_plane *plane, double edge_px, unsigned kind,
                  struct reading *reading)
{
    struct shape expected;
    const struct candidate *nearest = NULL;
    double least = 0.0;
    double inside = pad_plane_moments(plane, context->camera, kind, false, &expected);

    if (!(inside > 0.0)) {
        return;
    }
    inside = 1.0;
    // Roughly how far it reaches: only near the border is the finer grid worth its time.
    const double reach = 2.0 * sqrt(expected.cov_xx + expected.cov_yy);
    if (expected.x_px < reach || expected.y_px < reach || expected.x_px > context->camera->width_px - 1.0 - reach ||
        expected.y_px > context->camera->height_px - 1.0 - reach) {
        inside = pad_plane_moments(plane, context->camera, kind, true, &expected);
        if (inside < MATCH_INSIDE_MIN) {
            return;
        }
    }
    const bool whole = inside > MATCH_INSIDE_WHOLE;
    double long_px;
    double short_px;
    struct vector axis;
    shape_axes(&expected, &long_px, &short_px, &axis);
    if (kind == PAD_SMALL_RING && short_px < SMALL_RING_SHORT_MIN_PX) {
        return;
    }
    if (!whole && (context->options & DETECT_CLOSE) == 0U) {
        return;
    }
    const double edges_px = inside * pad_edge_mm(kind) * sqrt(expected.area_px / (inside * pad_area_mm2(kind)));
    const double area_px = fmax(expected.area_px + edge_px * edges_px, AREA_MIN_PX);
    const double ratio = kind == PAD_SMALL_RING ? MATCH_SMALL_RING_RATIO : MATCH_AREA_RATIO;
    const double reachable = MATCH_DISTANCE_PX + MATCH_DISTANCE_SIZE * sqrt(expected.area_px);
    for (int i = 0; i < context->scratch->count; i++) {
        const struct candidate *candidate = &context->scratch->candidates[i];
        const struct shape *shape = &candidate->shape;
        const double x = shape->x_px - expected.x_px;
        const double y = shape->y_px - expected.y_px;
        const double squared = x * x + y * y;
        if (squared > reachable * reachable || shape->area_px > ratio * area_px || shape->area_px * ratio < area_px ||
            (candidate->clipped && whole && inside < 1.0 - 1e-9)) {
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

// Mean square distance of a shape's print from the pad's centre, mm^2; negative if it looks past the plane.
static double square_radius(const struct context *context, const struct pad_plane *plane, const struct shape *shape)
{
    double x;
    double y;
    double right_x;
    double right_y;
    double below_x;
    double below_y;

    if (pad_plane_unproject(plane, context->camera, shape->x_px, shape->y_px, &x, &y) != 0 ||
        pad_plane_unproject(plane, context->camera, shape->x_px + 1.0, shape->y_px, &right_x, &right_y) != 0 ||
        pad_plane_unproject(plane, context->camera, shape->x_px, shape->y_px + 1.0, &below_x, &below_y) != 0) {
        return -1.0;
    }
    const double xx = (right_x - x) * (right_x - x) + (right_y - y) * (right_y - y);
    const double yy = (below_x - x) * (below_x - x) + (below_y - y) * (below_y - y);
    const double xy = (right_x - x) * (below_x - x) + (right_y - y) * (below_y - y);

    return x * x + y * y + xx * shape->cov_xx + 2.0 * xy * shape->cov_xy + yy * shape->cov_yy;
}

// Several shapes taken as one, summed up near where they are expected.
struct merged {
    struct shape origin; // only its place is used
    double area;
    double x;
    double y;
    double xx;
    double xy;
    double yy;
};

static void merge(struct merged *merged, const struct shape *shape)
{
    const struct vector offset = shape_offset(&merged->origin, shape);

    merged->area += shape->area_px;
    merged->x += shape->area_px * offset.x;
    merged->y += shape->area_px * offset.y;
    merged->xx += shape->area_px * (shape->cov_xx + offset.x * offset.x);
    merged->xy += shape->area_px * (shape->cov_xy + offset.x * offset.y);
    merged->yy += shape->area_px * (shape->cov_yy + offset.y * offset.y);
}

static struct shape shape_of(const struct merged *merged)
{
    const double x = merged->x / merged->area;
    const double y = merged->y / merged->area;
    const struct shape shape = {.area_px = merged->area,
                                .x_px = merged->origin.x_px + x,
                                .y_px = merged->origin.y_px + y,
                                .cov_xx = merged->xx / merged->area - x * x,
                                .cov_xy = merged->xy / merged->area - x * y,
                                .cov_yy = merged->yy / merged->area - y * y};

    return shape;
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

static void match_ring(const struct context *context, const struct pad_plane *plane, double edge_px,
                       struct reading *reading)
{
    struct shape expected;
    struct merged ring = {.area = 0.0};
    int pieces = 0;
    bool clipped = false;
    const double inside = pad_plane_moments(plane, context->camera, PAD_RING, true, &expected);

    reading->ring_inside = inside;
    ring.origin = expected;
    if (!(inside > 0.05)) {
        return;
    }
    const double edges_px = inside * pad_edge_mm(PAD_RING) * sqrt(expected.area_px / (inside * pad_area_mm2(PAD_RING)));
    const double area_px = fmax(expected.area_px + edge_px * edges_px, expected.area_px / 3.0);
    reading->ring_width_px = 2.0 * area_px / edges_px;
    for (int i = 0; i < context->scratch->count; i++) {
        const struct candidate *candidate = &context->scratch->candidates[i];
        const struct shape *shape = &candidate->shape;
        if (shape->area_px > RING_SHARE_MAX * area_px) {
            continue;
        }
        const double square = square_radius(context, plane, shape);
        if (square > SMALL_RING_OUTER_RADIUS_MM * SMALL_RING_OUTER_RADIUS_MM &&
            square < PIECE_RADIUS_MIN_MM * PIECE_RADIUS_MIN_MM && !is_sighted(reading, shape)) {
            reading->clutter += shape->area_px / (area_px / inside) * pad_area_mm2(PAD_RING) / pad_area_mm2(PAD_RECTANGLE);
        }
        if (!(square > PIECE_RADIUS_MIN_MM * PIECE_RADIUS_MIN_MM) ||
            !(square < PIECE_RADIUS_MAX_MM * PIECE_RADIUS_MAX_MM)) {
            continue;
        }
        merge(&ring, shape);
        clipped = clipped || candidate->clipped;
        pieces++;
    }
    reading->ring_share = ring.area / area_px;
    if (reading->ring_share < RING_SHARE_WHOLE || reading->ring_share > 1.0 / RING_SHARE_WHOLE ||
        ((context->options & DETECT_RING_PIECES) == 0U && (pieces != 1 || clipped))) {
        return;
    }
    const struct shape seen = shape_of(&ring);
    add_sighting(reading, PAD_RING, &seen, clipped || inside < MATCH_INSIDE_WHOLE, pieces > 1);
}

// All that lies inside the ring, as one: the inner shapes have run together.
static void match_fused(const struct context *context, const struct pad_plane *plane, struct reading *reading)
{
    struct merged inner = {.area = 0.0};
    struct shape expected;

    pad_plane_moments(plane, context->camera, PAD_INNER, false, &expected);
    inner.origin = expected;
    for (int i = 0; i < context->scratch->count; i++) {
        const struct candidate *candidate = &context->scratch->candidates[i];
        const double square = square_radius(context, plane, &candidate->shape);
        if (square >= 0.0 && square < PIECE_RADIUS_MIN_MM * PIECE_RADIUS_MIN_MM && !candidate->clipped) {
            merge(&inner, &candidate->shape);
        }
    }
    if (inner.area > expected.area_px / MATCH_AREA_RATIO && inner.area < expected.area_px * MATCH_AREA_RATIO) {
        const struct shape seen = shape_of(&inner);
        add_sighting(reading, PAD_INNER, &seen, false, false);
    }
}

static int read_record(const struct context *context, const struct pad_view *view, bool fused, struct reading *reading)
{
    struct pad_plane plane;
    const double edge_px = view->value[PAD_EDGE_PX];

    *reading = (struct reading){.place = {-1, -1, -1, -1}};
    if (pad_plane_of(view, context->camera, &plane) != 0) {
        return DETECT_E_NO_PAD;
    }
    if (fused) {
        match_fused(context, &plane, reading);
    } else {
        match(context, &plane, edge_px, PAD_SQUARE, reading);
        match(context, &plane, edge_px, PAD_RECTANGLE, reading);
        match(context, &plane, edge_px, PAD_SMALL_RING, reading);
    }
    match_ring(context, &plane, edge_px, reading);
    return 0;
}

static bool has(const struct reading *reading, unsigned kinds)
{
    return (reading->kinds & kinds) == kinds;
}

static double height_of(const struct pad_plane *plane)
{
    return METRES_PER_MM *
           (plane->centre[0] * plane->normal[0] + plane->centre[1] * plane->normal[1] +
            plane->centre[2] * plane->normal[2]) /
           plane->normal[2];
}

static bool contradicts_lidar(const struct context *context, const struct pad_view *view)
{
    struct pad_plane plane;
    const double expected_m = context->hint->height_m;

    return expected_m > 0.0 && pad_plane_of(view, context->camera, &plane) == 0 &&
           fabs(height_of(&plane) - expected_m) > HEIGHT_TOLERANCE * expected_m + HEIGHT_TOLERANCE_M;
}

// True where the ring cannot be seen any more, and the LiDAR says so too.
static bool far_enough(const struct context *context, const struct reading *reading, const struct pad_view *view)
{
    struct pad_plane plane;

    if ((context->options & DETECT_FAR) == 0U || reading->ring_width_px > FAR_RING_WIDTH_PX ||
        pad_plane_of(view, context->camera, &plane) != 0) {
        return false;
    }
    const double expected_m = context->hint->height_m;
    return fabs(height_of(&plane) - expected_m) <= FAR_HEIGHT_TOLERANCE * expected_m + FAR_HEIGHT_TOLERANCE_M;
}

// How far the view is from being believed; a negative number if it cannot be at all.
static double doubt_of(const struct context *context, const struct reading *reading, const struct pad_view *view, double misfit, double worst)
{
    const double tilt = fmax(fabs(view->value[PAD_TILT_X]), fabs(view->value[PAD_TILT_Y]));
    const double share = fmin(reading->ring_share, 1.0);
    const double missing = fmin(1.0, 2.0 * reading->ring_inside) * (1.0 - share);
    const bool small_ring =
        has(reading, PAD_SMALL_RING) &&
        reading->evidence.sightings[reading->place[2]].seen.area_px >= NO_RING_SMALL_RING_AREA_MIN_PX;
    const bool ring = reading->ring_share >= RING_SHARE_MIN && reading->ring_share <= RING_SHARE_MAX;
    const bool pair = has(reading, PAD_SQUARE | PAD_RECTANGLE);
    const bool fused = reading->evidence.count == 2 && reading->evidence.sightings[0].kinds == PAD_INNER;

    if (fabs(view->value[PAD_EDGE_PX]) > EDGE_MAX_PX || tilt > TILT_MAX || worst > WORST_MAX) {
        return -1.0;
    }
    const double doubt = misfit + DOUBT_CLUTTER * reading->clutter + DOUBT_MISSING * reading->missing +
                         (contradicts_lidar(context, view) ? DOUBT_HEIGHT : 0.0);
    if (fused) {
        return reading->place[3] >= 0 && doubt <= FUSED_DOUBT_MAX ? doubt : -1.0;
    }
    // Two of three that do not depend on each other, one of them the pair or half of it.
    if (pair && (ring || small_ring)) {
        return doubt +
               DOUBT_RING * fmax(0.0, missing - (1.0 - RING_SHARE_WHOLE)) * (small_ring ? DOUBT_NO_RING : 1.0);
    }
    if ((reading->kinds & (PAD_SQUARE | PAD_RECTANGLE)) != 0U && ring && small_ring) {
        const double all = doubt + DOUBT_RING * fmax(0.0, missing - (1.0 - RING_SHARE_WHOLE));
        return all <= CLOSE_DOUBT_MAX ? all : -1.0;
    }
    return pair && far_enough(context, reading, view) && doubt <= FAR_DOUBT_MAX ? doubt : -1.0;
}

// What was seen of a shape less what the view expects of it, at its centroid.
static struct vector left_over(const struct context *context, const struct pad_plane *plane,
                               const struct reading *reading, unsigned kind)
{
    const struct sighting *sighting = &reading->evidence.sightings[reading->place[index_of(kind)]];
    struct shape expected;

    pad_plane_moments(plane, context->camera, kind, sighting->clipped, &expected);
    return shape_offset(&expected, &sighting->seen);
}

static bool has_whole_pair(const struct reading *reading)
{
    return has(reading, PAD_SQUARE | PAD_RECTANGLE) && !reading->evidence.sightings[reading->place[0]].clipped &&
           !reading->evidence.sightings[reading->place[1]].clipped;
}

// The view explains all shapes together; near the centre the shapes that are
// there know better, as paper is curled and shutters roll. What they leave over
// moves the centre, each by its weight.
static void centre_of(const struct context *context, const struct pad_plane *plane, const struct reading *reading,
                      struct pad_estimate *pad)
{
    double weight = 0.0;
    double x = 0.0;
    double y = 0.0;

    if (has(reading, PAD_SMALL_RING) && !reading->evidence.sightings[reading->place[2]].clipped) {
        const double area = reading->evidence.sightings[reading->place[2]].seen.area_px;
        const double blur = SMALL_RING_PRECISE_AREA_PX / area;
        const double sigma = SMALL_RING_SIGMA_PX + blur * blur;
        const struct vector left = left_over(context, plane, reading, PAD_SMALL_RING);
        weight += 1.0 / (sigma * sigma);
        x += left.x / (sigma * sigma);
        y += left.y / (sigma * sigma);
    }
    if (has_whole_pair(reading)) {
        const struct vector square = left_over(context, plane, reading, PAD_SQUARE);
        const struct vector rectangle = left_over(context, plane, reading, PAD_RECTANGLE);
        const struct shape *seen = &reading->evidence.sightings[reading->place[1]].seen;
        const double ring_px = 2.0 * RING_OUTER_RADIUS_MM * sqrt(seen->area_px / pad_area_mm2(PAD_RECTANGLE));
        const double sigma = LINE_SIGMA_PX + LINE_SIGMA_RING * ring_px;
        weight += 1.0 / (sigma * sigma);
        x += (CENTRE_FRACTION * square.x + (1.0 - CENTRE_FRACTION) * rectangle.x) / (sigma * sigma);
        y += (CENTRE_FRACTION * square.y + (1.0 - CENTRE_FRACTION) * rectangle.y) / (sigma * sigma);
    }
    pad->x_px = pad->view.value[PAD_X_PX] + (weight > 0.0 ? x / weight : 0.0);
    pad->y_px = pad->view.value[PAD_Y_PX] + (weight > 0.0 ? y / weight : 0.0);
}

// From the rectangle's centre to the square's. What is seen are centroids of
// their images, which perspective moves apart; what they leave over is right.
static struct vector direction_up(const struct context *context, const struct pad_plane *plane,
                                  const struct reading *reading)
{
    struct vector square;
    struct vector rectangle;

    pad_plane_project(plane, context->camera, SQUARE_CENTRE_X_MM, SQUARE_CENTRE_Y_MM, &square.x, &square.y);
    pad_plane_project(plane, context->camera, RECTANGLE_CENTRE_X_MM, RECTANGLE_CENTRE_Y_MM, &rectangle.x,
                      &rectangle.y);
    struct vector up = {.x = square.x - rectangle.x, .y = square.y - rectangle.y};
    if (has_whole_pair(reading)) {
        const struct vector square_left = left_over(context, plane, reading, PAD_SQUARE);
        const struct vector rectangle_left = left_over(context, plane, reading, PAD_RECTANGLE);
        up.x += square_left.x - rectangle_left.x;
        up.y += square_left.y - rectangle_left.y;
    }
    return up;
}

static int report(const struct context *context, const struct reading *reading, struct pad_estimate *pad)
{
    struct pad_plane plane;

    if (pad_plane_of(&pad->view, context->camera, &plane) != 0) {
        return DETECT_E_NO_PAD;
    }
    if ((context->options & DETECT_PERSPECTIVE) != 0U) {
        centre_of(context, &plane, reading, pad);
    } else if (has(reading, PAD_SQUARE | PAD_RECTANGLE)) {
        const struct shape *square = &reading->evidence.sightings[reading->place[0]].seen;
        const struct shape *rectangle = &reading->evidence.sightings[reading->place[1]].seen;
        pad->x_px = rectangle->x_px + CENTRE_FRACTION * (square->x_px - rectangle->x_px);
        pad->y_px = rectangle->y_px + CENTRE_FRACTION * (square->y_px - rectangle->y_px);
    }
    const struct vector up = direction_up(context, &plane, reading);
    // Turned by 90 degrees: up in the image becomes 0.
    pad->angle_deg = atan2(up.x, -up.y) * DEGREES_PER_RADIAN;
    struct camera_ray ray;
    if (camera_unproject(context->camera, pad->x_px, pad->y_px, &ray) != 0) {
        return DETECT_E_NO_PAD;
    }
    pad->depth_m = plane.centre[2] * METRES_PER_MM;
    pad->right_m = ray.right * pad->depth_m;
    pad->forward_m = ray.forward * pad->depth_m;
    pad->height_m = height_of(&plane);
    pad->ring_share = reading->ring_share;
    pad->kinds = reading->kinds | (reading->ring_share >= RING_SHARE_MIN ? (unsigned)PAD_RING : 0U);
    return 0;
}

// The same picture to first order: a plane that is tilted the other way about the ray to its centre.
static bool mirror(const struct context *context, struct pad_view *view)
{
    struct pad_plane plane;
    double direction[3];

    if (pad_plane_of(view, context->camera, &plane) != 0 ||
        camera_direction(context->camera, view->value[PAD_X_PX], view->value[PAD_Y_PX], direction) != 0) {
        return false;
    }
    const double along = plane.normal[0] * direction[0] + plane.normal[1] * direction[1] + plane.normal[2] * direction[2];
    const double z = 2.0 * along * direction[2] - plane.normal[2];
    if (!(z > 0.3)) {
        return false;
    }
    view->value[PAD_TILT_X] = (2.0 * along * direction[0] - plane.normal[0]) / z;
    view->value[PAD_TILT_Y] = (2.0 * along * direction[1] - plane.normal[1]) / z;
    return true;
}

static int fit(const struct context *context, bool fused, struct pad_view *view, struct reading *reading,
               double *misfit, double *worst)
{
    // The first fit brings all shapes into reach; the second uses them.
    for (int round = 0; round < 2; round++) {
        if (read_record(context, view, fused, reading) != 0 || reading->evidence.count < 2 ||
            pad_fit(&reading->evidence, context->camera, &context->hint->tilt, view, misfit, worst) != 0) {
            return DETECT_E_NO_PAD;
        }
    }
    return 0;
}

static int try_view(const struct context *context, const struct hypothesis *hypothesis, struct pad_estimate *pad)
{
    struct reading reading;
    double worst;

    pad->view = hypothesis->view;
    if (fit(context, hypothesis->fused, &pad->view, &reading, &pad->misfit, &worst) != 0) {
        return DETECT_E_NO_PAD;
    }
    pad->doubt = doubt_of(context, &reading, &pad->view, pad->misfit, worst);
    if (pad->misfit > MIRROR_MISFIT && reading.evidence.count >= 3) {
        struct pad_estimate other = {.view = pad->view};
        struct reading mirrored;
        if (mirror(context, &other.view) && fit(context, hypothesis->fused, &other.view, &mirrored, &other.misfit, &worst) == 0) {
            other.doubt = doubt_of(context, &mirrored, &other.view, other.misfit, worst);
            if (other.doubt >= 0.0 && (pad->doubt < 0.0 || other.doubt < pad->doubt)) {
                *pad = other;
                reading = mirrored;
            }
        }
    }
    if (pad->doubt < 0.0 || pad->doubt > DOUBT_MAX) {
        return DETECT_E_NO_PAD;
    }
    return report(context, &reading, pad);
}

static int try_all(const struct context *context, const struct hypotheses *hypotheses, struct pad_estimate *pad)
{
    int result = DETECT_E_NO_PAD;

    for (int i = 0; i < hypotheses->count; i++) {
        struct pad_estimate tried;
        if (try_view(context, &hypotheses->list[i], &tried) != 0) {
            continue;
        }
        if (result != 0 || tried.doubt < pad->doubt) {
            *pad = tried;
            result = 0;
        }
    }
    return result;
}

int detect_pad(const struct landing_record *record, const struct camera *camera, const struct detect_hint *hint,
               uint32_t options, struct detect_scratch *scratch, struct pad_estimate *pad)
{
    const struct context context = {.scratch = scratch, .camera = camera, .hint = hint, .options = options};
    struct hypotheses hypotheses = {.count = 0};

    collect(record, camera, scratch);
    hypotheses_from_pairs(scratch, camera, hint->height_m, options, &hypotheses);
    if (try_all(&context, &hypotheses, pad) == 0) {
        return 0;
    }
    if ((options & DETECT_CLOSE) != 0U) {
        hypotheses.count = 0;
        hypotheses_from_small_rings(scratch, camera, &hypotheses);
        if (try_all(&context, &hypotheses, pad) == 0) {
            return 0;
        }
    }
    if ((options & DETECT_FUSED) != 0U) {
        hypotheses.count = 0;
        hypotheses_from_rings(scratch, camera, &hypotheses);
        if (try_all(&context, &hypotheses, pad) == 0) {
            return 0;
        }
    }
    return DETECT_E_NO_PAD;
}

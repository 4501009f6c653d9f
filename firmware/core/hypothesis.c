// SPDX-License-Identifier: Apache-2.0
#include "hypothesis.h"

#include <math.h>
#include <stddef.h>

#include "bounds.h"
#include "grid.h"
#include "pad_geometry.h"

#define PI 3.14159265358979323846

// Ideal values, all from the dimensions of the pad.
#define SQUARE_AREA (SQUARE_SIDE_MM * SQUARE_SIDE_MM)
#define RECTANGLE_AREA (RECTANGLE_WIDTH_MM * RECTANGLE_HEIGHT_MM)
#define SMALL_RING_AREA                                                                                                \
    (PI * (SMALL_RING_OUTER_RADIUS_MM * SMALL_RING_OUTER_RADIUS_MM -                                                   \
           SMALL_RING_INNER_RADIUS_MM * SMALL_RING_INNER_RADIUS_MM))
#define RING_AREA (PI * (RING_OUTER_RADIUS_MM * RING_OUTER_RADIUS_MM - RING_INNER_RADIUS_MM * RING_INNER_RADIUS_MM))
#define BASELINE (RECTANGLE_CENTRE_Y_MM - SQUARE_CENTRE_Y_MM)
// Variance of the rectangle along the line to the square and across it.
#define RECTANGLE_VARIANCE (RECTANGLE_HEIGHT_MM * RECTANGLE_HEIGHT_MM / 12.0)
#define RECTANGLE_VARIANCE_ACROSS (RECTANGLE_WIDTH_MM * RECTANGLE_WIDTH_MM / 12.0)
// Of the ring: mean square of the radius.
#define RING_SQUARE_RADIUS                                                                                             \
    ((RING_OUTER_RADIUS_MM * RING_OUTER_RADIUS_MM + RING_INNER_RADIUS_MM * RING_INNER_RADIUS_MM) / 2.0)

struct range {
    double least;
    double greatest;
};

// What photographs of the real pad need: blur and the opening of the mask take
// from thin shapes first, and bloom eats the smallest most.
static const struct range solid_invariant = {10.3, 13.4};
static const struct range square_to_rectangle_area = {0.33, 0.72};
// Standard deviations of the rectangle, along the line, from it to the square: 7.18.
static const struct range baseline_to_rectangle = {5.6, 9.2};
static const struct range square_to_rectangle_variance = {0.5, 2.0};
static const struct range small_ring_invariant = {6.5, 13.2};
static const struct range small_ring_to_rectangle_area = {0.05, 0.27};
static const struct range ring_invariant = {1.3, 4.6};
static const struct range inner_to_ring_area = {0.3, 0.75};
// From afar: a ring of 25 mm is 7 px wide where the rectangle has 400.
#define FAR_RECTANGLE_AREA_MAX_PX 400.0
#define FAR_HEIGHT_TOLERANCE 0.25
// From close by the small ring is large, and looks like itself.
static const struct range near_small_ring_invariant = {7.6, 9.8};
#define NEAR_SMALL_RING_AREA_MIN_PX 700.0
// Area of a square or rectangle that the border may cut, to that of the small ring: whole ones have 3.2 and 6.4.
static const struct range cut_to_small_ring_area = {0.5, 9.0};
static const struct range cut_distance_mm = {22.0, 85.0};
static const struct range near_height = {0.5, 2.0}; // as a level view has it, to what the LiDAR says
// Where the LiDAR says otherwise, only the best are tried: from far away, clutter has many such.
#define CONTRADICTED_ERROR 100.0
#define CONTRADICTED_MAX 2
// Places are in parts of the line between square and rectangle.
#define SMALL_RING_MISS 0.10
// A piece of the ring, wherever its other pieces are: root mean square of the distances to the centre.
static const struct range piece_radius_mm = {82.0, 148.0};
#define RING_SHARE_MIN 0.25
// Grass has pairs of any kind; what is between and around them tells them from the pad.
#define PIECE_ERROR 0.05
#define HEIGHT_ERROR_MAX 0.3
// Shapes smaller than this have edges that are as large as themselves.
#define INNER_RADIUS_MAX_MM 92.0

static bool in_range(double value, struct range range)
{
    return value >= range.least && value <= range.greatest;
}

// Squared relative deviation, alike for too large and too small.
static double deviation(double value, double ideal)
{
    const double logarithm = log(value / ideal);

    return logarithm * logarithm;
}

static void keep(struct hypotheses *found, const struct hypothesis *hypothesis)
{
    int place = found->count;

    if (place == HYPOTHESES) {
        place--;
        if (!(hypothesis->error < found->list[place].error)) {
            return;
        }
    } else {
        found->count++;
    }
    for (; place > 0 && hypothesis->error < found->list[place - 1].error; place--) {
        found->list[place] = found->list[place - 1];
    }
    found->list[place] = *hypothesis;
}

// Pad to image near one point: px = origin + across * x_mm + down * y_mm.
struct affine {
    struct vector origin; // image of the pad's centre
    struct vector across;
    struct vector down;
    double det;
};

static struct vector to_pad(const struct affine *affine, double x_px, double y_px)
{
    const double x = x_px - affine->origin.x;
    const double y = y_px - affine->origin.y;
    const struct vector mm = {.x = (affine->down.y * x - affine->down.x * y) / affine->det,
                              .y = (affine->across.x * y - affine->across.y * x) / affine->det};

    return mm;
}

// Mean square distance of a shape's print from the pad's centre, mm^2.
static double square_radius(const struct affine *affine, const struct shape *shape)
{
    const struct vector mm = to_pad(affine, shape->x_px, shape->y_px);
    const double xx = affine->across.y * affine->across.y + affine->down.y * affine->down.y;
    const double yy = affine->across.x * affine->across.x + affine->down.x * affine->down.x;
    const double xy = affine->across.x * affine->across.y + affine->down.x * affine->down.y;
    const double spread = (xx * shape->cov_xx - 2.0 * xy * shape->cov_xy + yy * shape->cov_yy) /
                          (affine->det * affine->det);

    return mm.x * mm.x + mm.y * mm.y + spread;
}

// The level pad that looks like this to first order.
static bool view_of(const struct affine *affine, const struct camera *camera, struct pad_view *view)
{
    double direction[3];
    double x_px;
    double y_px;

    if (!(affine->det > 0.0) || camera_direction(camera, affine->origin.x, affine->origin.y, direction) != 0) {
        return false;
    }
    const double scale = camera_image(camera, direction, &x_px, &y_px);
    view->value[PAD_X_PX] = affine->origin.x;
    view->value[PAD_Y_PX] = affine->origin.y;
    view->value[PAD_LOG_DISTANCE_MM] = 0.5 * log(scale * direction[2] / affine->det);
    view->value[PAD_YAW_RAD] = atan2(-affine->down.x, affine->down.y);
    view->value[PAD_TILT_X] = 0.0;
    view->value[PAD_TILT_Y] = 0.0;
    view->value[PAD_EDGE_PX] = 0.0;
    return true;
}

// The map of a pair. Its line gives one axis; the other is what the line leaves of the rectangle's covariance.
static bool affine_of_pair(const struct shape *square, const struct shape *rectangle, struct affine *affine)
{
    const struct vector line = shape_offset(square, rectangle);
    const struct vector down = {.x = line.x / BASELINE, .y = line.y / BASELINE};
    const double xx = rectangle->cov_xx - RECTANGLE_VARIANCE * down.x * down.x;
    const double xy = rectangle->cov_xy - RECTANGLE_VARIANCE * down.x * down.y;
    const double yy = rectangle->cov_yy - RECTANGLE_VARIANCE * down.y * down.y;
    const double trace = xx + yy;
    // Direction of the greater variance.
    const double angle = 0.5 * atan2(2.0 * xy, xx - yy);
    const double length = sqrt(at_least(trace, 0.0) / RECTANGLE_VARIANCE_ACROSS);

    affine->down = down;
    affine->across.x = length * cos(angle);
    affine->across.y = length * sin(angle);
    affine->det = affine->across.x * down.y - affine->across.y * down.x;
    if (affine->det < 0.0) {
        affine->across.x = -affine->across.x;
        affine->across.y = -affine->across.y;
        affine->det = -affine->det;
    }
    affine->origin.x = rectangle->x_px - RECTANGLE_CENTRE_Y_MM * down.x;
    affine->origin.y = rectangle->y_px - RECTANGLE_CENTRE_Y_MM * down.y;
    return affine->det > 0.0;
}

// How many pixels a mm of the pad is at most, squared.
static double square_scale(const struct affine *affine)
{
    return affine->across.x * affine->across.x + affine->across.y * affine->across.y +
           affine->down.x * affine->down.x + affine->down.y * affine->down.y;
}

// What lies around a pair.
struct surroundings {
    double ring_share; // of the ring's print
    int pieces;        // that it is in
    double clutter;    // dark things inside the ring that are not of the pad, in rectangles
};

// What is whole and looks like a ring counts without DETECT_RING_PIECES.
static struct surroundings surroundings_of(const struct hypothesis_source *source, const struct affine *affine,
                                           const struct shape *square_shape, const struct shape *rectangle,
                                           struct work *work)
{
    const struct grid *grid = source->grid;
    const bool pieces = (source->options & DETECT_RING_PIECES) != 0U;
    struct surroundings around = {.ring_share = 0.0};
    struct grid_near near;

    // Whatever has its centroid farther away than this is no piece.
    grid_near(grid, affine->origin.x, affine->origin.y,
              piece_radius_mm.greatest * piece_radius_mm.greatest * square_scale(affine), &near);
    work->done += WORK_NEAR + WORK_LOOK * near.looked_at + WORK_AROUND * near.count;
    for (int i = 0; i < near.count; i++) {
        const struct candidate *candidate = &grid->scratch->candidates[near.list[i]];
        const double square = square_radius(affine, &candidate->shape);
        const bool whole = !candidate->clipped && in_range(candidate->shape.invariant, ring_invariant);
        if (square >= piece_radius_mm.least * piece_radius_mm.least &&
            square <= piece_radius_mm.greatest * piece_radius_mm.greatest && (pieces || whole)) {
            around.ring_share += candidate->shape.area_px / (affine->det * RING_AREA);
            around.pieces++;
        } else if (square < piece_radius_mm.least * piece_radius_mm.least &&
                   square > SMALL_RING_OUTER_RADIUS_MM * SMALL_RING_OUTER_RADIUS_MM &&
                   &candidate->shape != square_shape && &candidate->shape != rectangle) {
            around.clutter += candidate->shape.area_px / rectangle->area_px;
        }
    }
    return around;
}

static bool has_small_ring(const struct grid *grid, const struct affine *affine, const struct shape *rectangle,
                           struct work *work)
{
    const double miss_mm = SMALL_RING_MISS * BASELINE;
    struct grid_near near;

    grid_near(grid, affine->origin.x, affine->origin.y, miss_mm * miss_mm * square_scale(affine), &near);
    work->done += WORK_NEAR + WORK_LOOK * near.looked_at;
    for (int i = 0; i < near.count; i++) {
        const struct shape *shape = &grid->scratch->candidates[near.list[i]].shape;
        if (!in_range(shape->area_px / rectangle->area_px, small_ring_to_rectangle_area) ||
            !in_range(shape->invariant, small_ring_invariant)) {
            continue;
        }
        const struct vector miss = to_pad(affine, shape->x_px, shape->y_px);
        if (miss.x * miss.x + miss.y * miss.y <= miss_mm * miss_mm) {
            return true;
        }
    }
    return false;
}

// Height of the camera as a level view has it, m; 0 if it looks past the ground.
static double height_of(const struct camera *camera, const struct pad_view *view)
{
    double direction[3];

    if (camera_direction(camera, view->value[PAD_X_PX], view->value[PAD_Y_PX], direction) != 0) {
        return 0.0;
    }
    return 0.001 * exp(view->value[PAD_LOG_DISTANCE_MM]) * at_least(direction[2], 0.0);
}

// True where the ring may be too thin to be seen and the LiDAR says the same of the distance.
static bool is_far(const struct shape *rectangle, double seen_m, double height_m)
{
    return rectangle->area_px <= FAR_RECTANGLE_AREA_MAX_PX && seen_m > (1.0 - FAR_HEIGHT_TOLERANCE) * height_m &&
           seen_m < (1.0 + FAR_HEIGHT_TOLERANCE) * height_m;
}

static void consider_pair(const struct hypothesis_source *source, const struct shape *square,
                          const struct shape *rectangle, struct work *work, struct hypotheses *found)
{
    const double height_m = source->height_m;
    const struct vector line = shape_offset(rectangle, square);
    const double squared = shape_inner(rectangle, line, line);
    struct affine affine;

    work->done += WORK_PAIR;
    if (!(squared >= baseline_to_rectangle.least * baseline_to_rectangle.least) ||
        !(squared <= baseline_to_rectangle.greatest * baseline_to_rectangle.greatest)) {
        return;
    }
    const double variance = shape_variance_along(rectangle, square, line);
    if (!in_range(variance, square_to_rectangle_variance) || !affine_of_pair(square, rectangle, &affine)) {
        return;
    }
    work->done += WORK_HYPOTHESIS;
    const struct surroundings around = surroundings_of(source, &affine, square, rectangle, work);
    struct hypothesis hypothesis = {.fused = false};
    if (!view_of(&affine, source->camera, &hypothesis.view)) {
        return;
    }
    const double seen_m = height_of(source->camera, &hypothesis.view);
    if (!(seen_m > 0.0) ||
        (around.ring_share < RING_SHARE_MIN && !has_small_ring(source->grid, &affine, rectangle, work) &&
         !((source->options & DETECT_FAR) != 0U && is_far(rectangle, seen_m, height_m)))) {
        return;
    }
    hypothesis.error = deviation(square->area_px / rectangle->area_px, SQUARE_AREA / RECTANGLE_AREA) +
                       deviation(sqrt(squared), BASELINE / sqrt(RECTANGLE_VARIANCE)) +
                       deviation(variance, SQUARE_SIDE_MM * SQUARE_SIDE_MM / 12.0 / RECTANGLE_VARIANCE) +
                       deviation(square->invariant, SHAPE_INVARIANT_RECTANGLE) +
                       deviation(rectangle->invariant, SHAPE_INVARIANT_RECTANGLE) + at_least(0.7 - around.ring_share, 0.0) +
                       PIECE_ERROR * around.pieces + around.clutter;
    if (height_m > 0.0) {
        // Tilt and a beam that meets something else make it differ; more than that does not make it worse.
        hypothesis.error += at_most(deviation(seen_m, height_m), HEIGHT_ERROR_MAX);
    }
    keep(found, &hypothesis);
}

// Where a list goes on that was cut short at a candidate: there, unless that one alone took all the time.
static int next_from(int candidate, int from)
{
    return candidate > from ? candidate : candidate + 1;
}

// No variance exceeds the greater of both axes; their sum and their product say how great that is.
static double greatest_variance(const struct shape *shape)
{
    const double difference = (shape->cov_xx - shape->cov_yy) / 2.0;

    return (shape->cov_xx + shape->cov_yy) / 2.0 + sqrt(difference * difference + shape->cov_xy * shape->cov_xy);
}

int hypotheses_from_pairs(const struct hypothesis_source *source, int from, struct work *work,
                          struct hypotheses *found)
{
    const struct detect_scratch *scratch = source->grid->scratch;
    struct grid_near near;

    for (int i = from; i < scratch->count; i++) {
        const struct shape *rectangle = &scratch->candidates[i].shape;
        // One that touches the border may be whole all the same.
        if (!in_range(rectangle->invariant, solid_invariant)) {
            continue;
        }
        const double least = square_to_rectangle_area.least * rectangle->area_px;
        const double greatest = square_to_rectangle_area.greatest * rectangle->area_px;
        grid_near(source->grid, rectangle->x_px, rectangle->y_px,
                  baseline_to_rectangle.greatest * baseline_to_rectangle.greatest * greatest_variance(rectangle),
                  &near);
        work->done += WORK_NEAR + WORK_LOOK * (near.looked_at + near.count);
        for (int j = 0; j < near.count; j++) {
            const struct shape *square = &scratch->candidates[near.list[j]].shape;
            if (work_is_over(work)) {
                return next_from(i, from);
            }
            if (square->area_px >= least && square->area_px <= greatest &&
                in_range(square->invariant, solid_invariant)) {
                consider_pair(source, square, rectangle, work, found);
            }
        }
    }
    return 0;
}

// `other` as rectangle (below) or square (above) of the pad whose small ring this is.
static void consider_close(const struct hypothesis_source *source, const struct shape *small_ring,
                           const struct shape *other, bool below, struct work *work, struct hypotheses *found)
{
    const double height_m = source->height_m;
    const double scale = sqrt(small_ring->area_px / SMALL_RING_AREA);
    const struct vector offset = shape_offset(small_ring, other);
    const double distance = sqrt(offset.x * offset.x + offset.y * offset.y);
    const double sign = below ? scale / distance : -scale / distance;
    const struct affine affine = {
        .origin = {.x = small_ring->x_px, .y = small_ring->y_px},
        .down = {.x = sign * offset.x, .y = sign * offset.y},
        .across = {.x = sign * offset.y, .y = -sign * offset.x},
        .det = scale * scale,
    };
    struct hypothesis hypothesis = {.fused = false};

    if (!in_range(distance / scale, cut_distance_mm)) {
        return;
    }
    work->done += WORK_HYPOTHESIS;
    if (!view_of(&affine, source->camera, &hypothesis.view)) {
        return;
    }
    hypothesis.error = deviation(distance / scale, below ? RECTANGLE_CENTRE_Y_MM : -SQUARE_CENTRE_Y_MM) +
                       deviation(other->area_px / small_ring->area_px,
                                 (below ? RECTANGLE_AREA : SQUARE_AREA) / SMALL_RING_AREA) +
                       deviation(small_ring->invariant,
                                 SHAPE_INVARIANT_RING(SMALL_RING_INNER_RADIUS_MM / SMALL_RING_OUTER_RADIUS_MM));
    if (height_m > 0.0 && !in_range(height_of(source->camera, &hypothesis.view) / height_m, near_height)) {
        hypothesis.error += CONTRADICTED_ERROR;
    }
    keep(found, &hypothesis);
}

static int list_small_rings(const struct hypothesis_source *source, int from, struct work *work,
                            struct hypotheses *found)
{
    const struct detect_scratch *scratch = source->grid->scratch;
    struct grid_near near;

    for (int i = from; i < scratch->count; i++) {
        const struct candidate *small_ring = &scratch->candidates[i];
        if (small_ring->clipped || small_ring->shape.area_px < NEAR_SMALL_RING_AREA_MIN_PX ||
            !in_range(small_ring->shape.invariant, near_small_ring_invariant)) {
            continue;
        }
        grid_near(source->grid, small_ring->shape.x_px, small_ring->shape.y_px,
                  cut_distance_mm.greatest * cut_distance_mm.greatest * small_ring->shape.area_px / SMALL_RING_AREA,
                  &near);
        work->done += WORK_NEAR + WORK_LOOK * (near.looked_at + near.count);
        for (int j = 0; j < near.count; j++) {
            const struct shape *other = &scratch->candidates[near.list[j]].shape;
            if (work_is_over(work)) {
                return next_from(i, from);
            }
            if (near.list[j] != i && in_range(other->area_px / small_ring->shape.area_px, cut_to_small_ring_area)) {
                work->done += WORK_PAIR;
                consider_close(source, &small_ring->shape, other, true, work, found);
                consider_close(source, &small_ring->shape, other, false, work, found);
            }
        }
    }
    return 0;
}

int hypotheses_from_small_rings(const struct hypothesis_source *source, int from, struct work *work,
                                struct hypotheses *found)
{
    const int next = list_small_rings(source, from, work, found);

    // Bounded: count falls by one each time.
    while (found->count > CONTRADICTED_MAX && found->list[found->count - 1].error > CONTRADICTED_ERROR) {
        found->count--;
    }
    return next;
}

// All that lies inside a ring as one shape. False when it weighs too little or too much.
static bool merge_inner(const struct grid *grid, const struct shape *ring, struct work *work, struct shape *merged)
{
    struct shape_sum inner = {.origin = *ring};
    struct grid_near near;

    grid_near(grid, ring->x_px, ring->y_px,
              INNER_RADIUS_MAX_MM * INNER_RADIUS_MAX_MM * greatest_variance(ring) / (RING_SQUARE_RADIUS / 2.0), &near);
    work->done += WORK_NEAR + WORK_LOOK * near.looked_at + WORK_AROUND * near.count;
    for (int i = 0; i < near.count; i++) {
        const struct shape *shape = &grid->scratch->candidates[near.list[i]].shape;
        const struct vector offset = shape_offset(ring, shape);
        const double squared = RING_SQUARE_RADIUS / 2.0 * shape_inner(ring, offset, offset);
        if (shape == ring || !(squared < INNER_RADIUS_MAX_MM * INNER_RADIUS_MAX_MM) ||
            shape->area_px > ring->area_px) {
            continue;
        }
        shape_sum_add(&inner, shape);
    }
    if (!in_range(inner.area_px / ring->area_px, inner_to_ring_area)) {
        return false;
    }
    *merged = shape_of_sum(&inner);
    return true;
}

int hypotheses_from_rings(const struct hypothesis_source *source, int from, struct work *work,
                          struct hypotheses *found)
{
    const struct detect_scratch *scratch = source->grid->scratch;

    for (int i = from; i < scratch->count; i++) {
        const struct candidate *ring = &scratch->candidates[i];
        struct shape merged;
        if (work_is_over(work)) {
            return next_from(i, from);
        }
        if (ring->clipped || !in_range(ring->shape.invariant, ring_invariant) ||
            !merge_inner(source->grid, &ring->shape, work, &merged)) {
            continue;
        }
        work->done += WORK_HYPOTHESIS;
        // The shapes lie along one line through the centre; which end is which, the fit will say.
        double long_px;
        double short_px;
        struct vector axis;
        shape_axes(&merged, &long_px, &short_px, &axis);
        const double scale = sqrt(ring->shape.area_px / RING_AREA);
        const struct vector offset = shape_offset(&ring->shape, &merged);
        for (int sign = -1; sign <= 1; sign += 2) {
            const struct affine affine = {
                .origin = {.x = ring->shape.x_px, .y = ring->shape.y_px},
                .down = {.x = sign * scale * axis.x, .y = sign * scale * axis.y},
                .across = {.x = sign * scale * axis.y, .y = -sign * scale * axis.x},
                .det = scale * scale,
            };
            struct hypothesis hypothesis = {.fused = true};
            if (view_of(&affine, source->camera, &hypothesis.view)) {
                // The rectangle weighs more.
                hypothesis.error = (axis.x * offset.x + axis.y * offset.y) * sign < 0.0 ? 1.0 : 0.0;
                hypothesis.error +=
                    deviation(merged.area_px / ring->shape.area_px, pad_area_mm2(PAD_INNER) / RING_AREA);
                keep(found, &hypothesis);
            }
        }
    }
    return 0;
}

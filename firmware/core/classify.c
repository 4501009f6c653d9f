// SPDX-License-Identifier: Apache-2.0
#include "classify.h"

#include <math.h>
#include <stdbool.h>

#include "pad_geometry.h"

#define PI 3.14159265358979323846

// Ideal values, all from the dimensions of the pad.
#define SQUARE_AREA (SQUARE_SIDE_MM * SQUARE_SIDE_MM)
#define RECTANGLE_AREA (RECTANGLE_WIDTH_MM * RECTANGLE_HEIGHT_MM)
#define RING_AREA (PI * (RING_OUTER_RADIUS_MM * RING_OUTER_RADIUS_MM - RING_INNER_RADIUS_MM * RING_INNER_RADIUS_MM))
#define SMALL_RING_AREA                                                                                                \
    (PI * (SMALL_RING_OUTER_RADIUS_MM * SMALL_RING_OUTER_RADIUS_MM -                                                   \
           SMALL_RING_INNER_RADIUS_MM * SMALL_RING_INNER_RADIUS_MM))
#define BASELINE (RECTANGLE_CENTRE_Y_MM - SQUARE_CENTRE_Y_MM)
// Variance of the rectangle along the line to the square, and of the ring along any.
#define RECTANGLE_VARIANCE (RECTANGLE_HEIGHT_MM * RECTANGLE_HEIGHT_MM / 12.0)
#define RING_VARIANCE                                                                                                  \
    ((RING_OUTER_RADIUS_MM * RING_OUTER_RADIUS_MM + RING_INNER_RADIUS_MM * RING_INNER_RADIUS_MM) / 4.0)
#define SMALL_RING_INVARIANT SHAPE_INVARIANT_RING(SMALL_RING_INNER_RADIUS_MM / SMALL_RING_OUTER_RADIUS_MM)
#define RING_INVARIANT SHAPE_INVARIANT_RING(RING_INNER_RADIUS_MM / RING_OUTER_RADIUS_MM)

// Where the ring's centre lies on the way from the rectangle to the square.
#define CENTRE_FRACTION (RECTANGLE_CENTRE_Y_MM / BASELINE)

// A shape smaller than this has edges that are as large as itself.
#define INNER_AREA_MIN_PX 30.0
#define RING_AREA_MIN_PX 300.0

struct range {
    double least;
    double greatest;
};

// What photographs of the real pad need: blur and the opening of the mask take
// from thin shapes first, so areas of ring and small ring vary most.
static const struct range solid_invariant = {10.5, 13.2};
static const struct range ring_invariant = {1.6, 4.4};
static const struct range small_ring_invariant = {6.5, 13.2};
static const struct range square_to_rectangle_area = {0.36, 0.68};
static const struct range square_to_ring_area = {0.07, 0.24};
static const struct range small_ring_to_rectangle_area = {0.06, 0.26};
// Standard deviations of the rectangle, along the line, from it to the square: 7.18.
static const struct range baseline_to_rectangle = {5.9, 8.6};
static const struct range baseline_to_ring = {1.0, 1.6};
static const struct range square_to_rectangle_variance = {0.55, 1.8};
// Distance of a centre from where it should be, as a part of the baseline.
#define RING_CENTRE_TOLERANCE 0.35
#define SMALL_RING_CENTRE_TOLERANCE 0.08
// Without the ring the pad is so close that the inner shapes are large and sharp:
// then all of them must be nearly ideal. Grass has small shapes of any ratio.
#define NO_RING_SMALL_RING_AREA_MIN_PX 150.0
#define NO_RING_ERROR_MAX 0.15
// Makes any candidate with the ring better than any without.
#define NO_RING_PENALTY 10.0

enum { SOLID = 1, RING = 2, SMALL_RING = 4 };

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

static unsigned kinds_of(const struct shape *shape)
{
    unsigned kinds = 0;

    if (shape->area_px >= INNER_AREA_MIN_PX) {
        kinds |= in_range(shape->invariant, solid_invariant) ? SOLID : 0U;
        kinds |= in_range(shape->invariant, small_ring_invariant) ? SMALL_RING : 0U;
    }
    if (shape->area_px >= RING_AREA_MIN_PX) {
        kinds |= in_range(shape->invariant, ring_invariant) ? RING : 0U;
    }
    return kinds;
}

struct pair {
    const struct shape *square;
    const struct shape *rectangle;
    struct vector baseline; // from the rectangle to the square
    struct shape centre;    // only its position is used
    double error;
};

static bool make_pair(struct pair *pair, const struct shape *square, const struct shape *rectangle)
{
    const double area = square->area_px / rectangle->area_px;

    if (!in_range(area, square_to_rectangle_area)) {
        return false;
    }
    const struct vector baseline = shape_offset(rectangle, square);
    const double length = sqrt(shape_inner(rectangle, baseline, baseline));
    if (!in_range(length, baseline_to_rectangle)) {
        return false;
    }
    const double variance = shape_variance_along(rectangle, square, baseline);
    if (!in_range(variance, square_to_rectangle_variance)) {
        return false;
    }
    pair->square = square;
    pair->rectangle = rectangle;
    pair->baseline = baseline;
    pair->centre = *rectangle;
    pair->centre.x_px += CENTRE_FRACTION * baseline.x;
    pair->centre.y_px += CENTRE_FRACTION * baseline.y;
    pair->error = deviation(area, SQUARE_AREA / RECTANGLE_AREA) +
                  deviation(length, BASELINE / sqrt(RECTANGLE_VARIANCE)) +
                  deviation(variance, SQUARE_SIDE_MM * SQUARE_SIDE_MM / 12.0 / RECTANGLE_VARIANCE) +
                  deviation(square->invariant, SHAPE_INVARIANT_RECTANGLE) +
                  deviation(rectangle->invariant, SHAPE_INVARIANT_RECTANGLE);
    return true;
}

// Distance of a shape from where the pair says the centre is, as a part of the
// baseline, in the metric of `measure`.
static double miss_of(const struct pair *pair, const struct shape *shape, const struct shape *measure)
{
    const struct vector miss = shape_offset(&pair->centre, shape);

    return sqrt(shape_inner(measure, miss, miss) / shape_inner(measure, pair->baseline, pair->baseline));
}

// Error of `shape` as the ring around the pair, or a negative number.
static double ring_error(const struct pair *pair, const struct shape *shape)
{
    const double area = pair->square->area_px / shape->area_px;

    if (!in_range(area, square_to_ring_area)) {
        return -1.0;
    }
    const double length = sqrt(shape_inner(shape, pair->baseline, pair->baseline));
    const double miss = miss_of(pair, shape, shape);
    if (!in_range(length, baseline_to_ring) || !(miss <= RING_CENTRE_TOLERANCE)) {
        return -1.0;
    }
    return deviation(area, SQUARE_AREA / RING_AREA) + deviation(length, BASELINE / sqrt(RING_VARIANCE)) +
           deviation(shape->invariant, RING_INVARIANT) + miss * miss;
}

// Error of `shape` as the small ring between the pair, or a negative number.
static double small_ring_error(const struct pair *pair, const struct shape *shape)
{
    const double area = shape->area_px / pair->rectangle->area_px;

    if (!in_range(area, small_ring_to_rectangle_area)) {
        return -1.0;
    }
    const double miss = miss_of(pair, shape, pair->rectangle);
    if (!(miss <= SMALL_RING_CENTRE_TOLERANCE)) {
        return -1.0;
    }
    return deviation(area, SMALL_RING_AREA / RECTANGLE_AREA) + deviation(shape->invariant, SMALL_RING_INVARIANT) +
           miss * miss;
}

struct best {
    const struct shape *shape;
    double error;
};

static struct best best_of(const struct classify_scratch *scratch, const struct pair *pair, unsigned kind,
                           double (*error_of)(const struct pair *, const struct shape *))
{
    struct best best = {.shape = NULL, .error = 0.0};

    for (uint32_t i = 0; i < scratch->count; i++) {
        const struct shape *shape = &scratch->shapes[i];
        if ((scratch->kinds[i] & kind) == 0U || shape == pair->square || shape == pair->rectangle) {
            continue;
        }
        const double error = error_of(pair, shape);
        if (error >= 0.0 && (best.shape == NULL || error < best.error)) {
            best.shape = shape;
            best.error = error;
        }
    }
    return best;
}

// Takes the pair, with what surrounds it, into `pad` if that is the best so far.
static bool consider(const struct classify_scratch *scratch, const struct pair *pair, struct pad_shapes *pad,
                     bool found)
{
    const struct best ring = best_of(scratch, pair, RING, ring_error);
    const struct best small_ring = best_of(scratch, pair, SMALL_RING, small_ring_error);

    double error = pair->error + ring.error;

    if (ring.shape == NULL) {
        error = pair->error + small_ring.error;
        if (small_ring.shape == NULL || small_ring.shape->area_px < NO_RING_SMALL_RING_AREA_MIN_PX ||
            error > NO_RING_ERROR_MAX) {
            return found;
        }
        error += NO_RING_PENALTY;
    }
    if (found && error >= pad->error) {
        return found;
    }
    pad->square = *pair->square;
    pad->rectangle = *pair->rectangle;
    pad->has_ring = ring.shape != NULL;
    pad->has_small_ring = small_ring.shape != NULL;
    if (ring.shape != NULL) {
        pad->ring = *ring.shape;
    }
    if (small_ring.shape != NULL) {
        pad->small_ring = *small_ring.shape;
    }
    pad->error = error;
    return true;
}

static void collect(const struct landing_record *record, struct classify_scratch *scratch)
{
    scratch->count = 0;
    for (uint32_t i = 0; i < record->header.object_count; i++) {
        struct shape *shape = &scratch->shapes[scratch->count];
        if (shape_from_object(&record->objects[i], shape) != 0) {
            continue;
        }
        scratch->kinds[scratch->count] = (uint8_t)kinds_of(shape);
        if (scratch->kinds[scratch->count] != 0U) {
            scratch->count++;
        }
    }
}

int classify_pad(const struct landing_record *record, struct classify_scratch *scratch, struct pad_shapes *pad)
{
    bool found = false;

    collect(record, scratch);
    for (uint32_t i = 0; i < scratch->count; i++) {
        if ((scratch->kinds[i] & SOLID) == 0U) {
            continue;
        }
        for (uint32_t j = 0; j < scratch->count; j++) {
            struct pair pair;
            if ((scratch->kinds[j] & SOLID) != 0U && i != j &&
                make_pair(&pair, &scratch->shapes[j], &scratch->shapes[i])) {
                found = consider(scratch, &pair, pad, found);
            }
        }
    }
    return found ? 0 : CLASSIFY_E_NO_PAD;
}

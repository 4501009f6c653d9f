// SPDX-License-Identifier: Apache-2.0
#include "shapes.h"

#include <math.h>

#include "bounds.h"

// A pixel is a unit square, not a point: its own variance is 1/12 along each axis.
#define PIXEL_VARIANCE (1.0 / 12.0)

// The ARM has no instruction for this, and the library's function takes thrice as long. Exact but for one rounding.
static double from_u64(uint64_t value)
{
    return (double)(uint32_t)(value >> 32) * 4294967296.0 + (double)(uint32_t)value;
}

int shape_from_object(const struct landing_object *object, struct shape *shape)
{
    const double area = (double)object->area;

    if (object->area == 0U) {
        return SHAPE_E_DEGENERATE;
    }
    const double x = from_u64(object->sum_x) / area;
    const double y = from_u64(object->sum_y) / area;
    const double xx = from_u64(object->sum_xx) / area - x * x;
    const double yy = from_u64(object->sum_yy) / area - y * y;
    const double xy = from_u64(object->sum_xy) / area - x * y;
    const double det = (xx + PIXEL_VARIANCE) * (yy + PIXEL_VARIANCE) - xy * xy;

    // The least determinant of real pixels is that of a line of them.
    if (!(xx > -PIXEL_VARIANCE / 2.0) || !(yy > -PIXEL_VARIANCE / 2.0) ||
        !(det > PIXEL_VARIANCE * PIXEL_VARIANCE / 4.0)) {
        return SHAPE_E_DEGENERATE;
    }
    shape->area_px = area;
    shape->x_px = x;
    shape->y_px = y;
    shape->cov_xx = xx + PIXEL_VARIANCE;
    shape->cov_xy = xy;
    shape->cov_yy = yy + PIXEL_VARIANCE;
    shape->invariant = area / sqrt(det);
    return 0;
}

struct vector shape_offset(const struct shape *from, const struct shape *to)
{
    const struct vector offset = {.x = to->x_px - from->x_px, .y = to->y_px - from->y_px};

    return offset;
}

static double determinant(const struct shape *shape)
{
    return shape->cov_xx * shape->cov_yy - shape->cov_xy * shape->cov_xy;
}

// inverse(covariance) * v
static struct vector solve(const struct shape *shape, struct vector v)
{
    const double det = determinant(shape);
    const struct vector result = {
        .x = (shape->cov_yy * v.x - shape->cov_xy * v.y) / det,
        .y = (shape->cov_xx * v.y - shape->cov_xy * v.x) / det,
    };

    return result;
}

double shape_inner(const struct shape *shape, struct vector a, struct vector b)
{
    const struct vector solved = solve(shape, b);

    return a.x * solved.x + a.y * solved.y;
}

double shape_variance_along(const struct shape *shape, const struct shape *part, struct vector direction)
{
    const struct vector d = solve(shape, direction);
    const double variance = d.x * d.x * part->cov_xx + 2.0 * d.x * d.y * part->cov_xy + d.y * d.y * part->cov_yy;

    return variance / shape_inner(shape, direction, direction);
}

void shape_axes(const struct shape *shape, double *long_px, double *short_px, struct vector *long_axis)
{
    const double mean = (shape->cov_xx + shape->cov_yy) / 2.0;
    const double difference = (shape->cov_xx - shape->cov_yy) / 2.0;
    const double radius = sqrt(difference * difference + shape->cov_xy * shape->cov_xy);
    const double angle = 0.5 * atan2(shape->cov_xy, difference);

    *long_px = sqrt(mean + radius);
    *short_px = sqrt(at_least(mean - radius, 0.0));
    long_axis->x = cos(angle);
    long_axis->y = sin(angle);
}

void shape_sum_add(struct shape_sum *sum, const struct shape *shape)
{
    const struct vector offset = shape_offset(&sum->origin, shape);

    sum->area_px += shape->area_px;
    sum->x += shape->area_px * offset.x;
    sum->y += shape->area_px * offset.y;
    sum->xx += shape->area_px * (shape->cov_xx + offset.x * offset.x);
    sum->xy += shape->area_px * (shape->cov_xy + offset.x * offset.y);
    sum->yy += shape->area_px * (shape->cov_yy + offset.y * offset.y);
}

struct shape shape_of_sum(const struct shape_sum *sum)
{
    const double x = sum->x / sum->area_px;
    const double y = sum->y / sum->area_px;
    const struct shape shape = {.area_px = sum->area_px,
                                .x_px = sum->origin.x_px + x,
                                .y_px = sum->origin.y_px + y,
                                .cov_xx = sum->xx / sum->area_px - x * x,
                                .cov_xy = sum->xy / sum->area_px - x * y,
                                .cov_yy = sum->yy / sum->area_px - y * y};

    return shape;
}

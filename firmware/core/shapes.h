// SPDX-License-Identifier: Apache-2.0
// What the sums of a component say about its shape.
#ifndef TOUCHDOWN_SHAPES_H
#define TOUCHDOWN_SHAPES_H

#include "landing_regs.h"

// Area / sqrt(det(covariance)) does not change under any affine map, so neither
// under tilt. Ideal values:
#define SHAPE_INVARIANT_ELLIPSE 12.566370614359172   // 4 pi
#define SHAPE_INVARIANT_RECTANGLE 12.0               // any parallelogram
#define SHAPE_INVARIANT_RING(ratio) (SHAPE_INVARIANT_ELLIPSE * (1.0 - (ratio) * (ratio)) / (1.0 + (ratio) * (ratio)))

enum { SHAPE_E_DEGENERATE = -1 };

struct shape {
    double area_px;
    double x_px; // centroid; integers are pixel centres
    double y_px;
    double cov_xx; // covariance of the area, pixels^2
    double cov_xy;
    double cov_yy;
    double invariant;
};

struct vector {
    double x;
    double y;
};

// 0, or SHAPE_E_DEGENERATE when the sums belong to no set of pixels.
int shape_from_object(const struct landing_object *object, struct shape *shape);

// Several shapes that are taken as one, summed up near where they lie.
struct shape_sum {
    struct shape origin; // only its place is used
    double area_px;
    double x;
    double y;
    double xx;
    double xy;
    double yy;
};

void shape_sum_add(struct shape_sum *sum, const struct shape *shape);

// The invariant is not computed.
struct shape shape_of_sum(const struct shape_sum *sum);

struct vector shape_offset(const struct shape *from, const struct shape *to);

// Inner product of two offsets in the frame where the covariance of `shape` is
// the identity. Ratios of these, too, do not change under an affine map.
double shape_inner(const struct shape *shape, struct vector a, struct vector b);

// Variance of `part` along `direction`, in the frame where the covariance of
// `shape` is the identity.
double shape_variance_along(const struct shape *shape, const struct shape *part, struct vector direction);

// Principal axes of the covariance: standard deviations and the unit vector of
// the long one (the short one is perpendicular).
void shape_axes(const struct shape *shape, double *long_px, double *short_px, struct vector *long_axis);

#endif

// SPDX-License-Identifier: Apache-2.0
#include "pad_pose.h"

#include <math.h>
#include <stdbool.h>

#include "pad_geometry.h"

#define DEGREES_PER_RADIAN 57.29577951308232
#define METRES_PER_MM 0.001

#define BASELINE_MM (RECTANGLE_CENTRE_Y_MM - SQUARE_CENTRE_Y_MM)
#define CENTRE_FRACTION (RECTANGLE_CENTRE_Y_MM / BASELINE_MM)
#define SMALL_RING_PRECISE_AREA_PX 300.0

// Along any axis, of a ring of uniform density: (outer^2 + inner^2) / 4.
#define RING_VARIANCE_MM2                                                                                              \
    ((RING_OUTER_RADIUS_MM * RING_OUTER_RADIUS_MM + RING_INNER_RADIUS_MM * RING_INNER_RADIUS_MM) / 4.0)
#define SMALL_RING_VARIANCE_MM2                                                                                        \
    ((SMALL_RING_OUTER_RADIUS_MM * SMALL_RING_OUTER_RADIUS_MM +                                                        \
      SMALL_RING_INNER_RADIUS_MM * SMALL_RING_INNER_RADIUS_MM) /                                                       \
     4.0)

static double length_of(double right, double forward)
{
    return sqrt(right * right + forward * forward);
}

// Height at which the ring has its size, measured across the line that leads to
// it from the optical axis: there, neither a level pad beside the axis nor one
// that only a tilt has moved off the axis is stretched or shortened. Both ends
// are mapped, not a derivative: a close ring spans a third of the image.
static bool height_from_ring(const struct shape *ring, const struct camera *camera, double *height_m)
{
    // A uniform ring has the same covariance as a thin one of this radius.
    const double radius_mm = sqrt(2.0 * RING_VARIANCE_MM2);
    const double x = ring->x_px - camera->centre_x_px;
    const double y = ring->y_px - camera->centre_y_px;
    const double distance = length_of(x, y);
    const struct vector across = {.x = distance > 0.0 ? -y / distance : 1.0, .y = distance > 0.0 ? x / distance : 0.0};
    const double variance = across.x * across.x * ring->cov_xx + 2.0 * across.x * across.y * ring->cov_xy +
                            across.y * across.y * ring->cov_yy;
    const double reach = sqrt(2.0 * variance);
    struct camera_ray a;
    struct camera_ray b;

    if (camera_unproject(camera, ring->x_px + reach * across.x, ring->y_px + reach * across.y, &a) != 0 ||
        camera_unproject(camera, ring->x_px - reach * across.x, ring->y_px - reach * across.y, &b) != 0) {
        return false;
    }
    *height_m = 2.0 * radius_mm * METRES_PER_MM / length_of(a.right - b.right, a.forward - b.forward);
    return true;
}

// A tilted plane magnifies its near side, which moves centroids. To second order,
// with perspective g (relative change of scale for each mm), a shape of variance
// V along an axis has its centroid moved by -4 V g: once by the positions and
// three times by the area that each of them gets. The ring moves 71 times as far
// as the small ring; what lies between them is therefore known, and so is g.
static struct vector centre_from_small_ring(const struct pad_shapes *pad)
{
    const double part = SMALL_RING_VARIANCE_MM2 / (RING_VARIANCE_MM2 - SMALL_RING_VARIANCE_MM2);
    struct vector centre = shape_offset(&pad->rectangle, &pad->small_ring);

    if (pad->has_ring) {
        const struct vector ring = shape_offset(&pad->small_ring, &pad->ring);
        centre.x -= part * ring.x;
        centre.y -= part * ring.y;
    }
    return centre;
}

// The point that divides the line between the two centroids as the centre does on
// the pad is moved too: by -a b g along the line (a, b the distances to both).
static struct vector centre_from_line(const struct pad_shapes *pad)
{
    const double line_product = -SQUARE_CENTRE_Y_MM * RECTANGLE_CENTRE_Y_MM;
    const double part = line_product / (4.0 * RING_VARIANCE_MM2 - line_product);
    const struct vector line = shape_offset(&pad->rectangle, &pad->square);
    double fraction = CENTRE_FRACTION;

    if (pad->has_ring) {
        const struct vector ring = shape_offset(&pad->rectangle, &pad->ring);
        const double ring_fraction = (ring.x * line.x + ring.y * line.y) / (line.x * line.x + line.y * line.y);
        fraction -= part * (ring_fraction - fraction);
    }
    const struct vector centre = {.x = fraction * line.x, .y = fraction * line.y};
    return centre;
}

int pad_pose_estimate(const struct pad_shapes *pad, const struct camera *camera, struct pad_pose *pose)
{
    struct camera_ray square;
    struct camera_ray rectangle;
    // Only a direction: square seen from the rectangle.
    const struct vector up = shape_offset(&pad->rectangle, &pad->square);

    // The small ring lies on the centre itself: nothing has to be divided. When it
    // is far away its few pixels are noisier than the line.
    const bool precise =
        pad->has_small_ring && (!pad->has_ring || pad->small_ring.area_px >= SMALL_RING_PRECISE_AREA_PX);
    const struct vector centre = precise ? centre_from_small_ring(pad) : centre_from_line(pad);

    pose->x_px = pad->rectangle.x_px + centre.x;
    pose->y_px = pad->rectangle.y_px + centre.y;
    if (camera_unproject(camera, pose->x_px, pose->y_px, &pose->ray) != 0 ||
        camera_unproject(camera, pad->square.x_px, pad->square.y_px, &square) != 0 ||
        camera_unproject(camera, pad->rectangle.x_px, pad->rectangle.y_px, &rectangle) != 0) {
        return PAD_POSE_E_OUTSIDE;
    }
    // Turned by 90 degrees: up in the image becomes 0.
    pose->angle_deg = atan2(up.x, -up.y) * DEGREES_PER_RADIAN;

    if (!pad->has_ring || !height_from_ring(&pad->ring, camera, &pose->height_m)) {
        pose->height_m = BASELINE_MM * METRES_PER_MM /
                         length_of(square.right - rectangle.right, square.forward - rectangle.forward);
    }
    return 0;
}

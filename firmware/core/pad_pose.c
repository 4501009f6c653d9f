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

static double length_of(double right, double forward)
{
    return sqrt(right * right + forward * forward);
}

// Height at which the ring has its size. The axis with the largest image is
// the one that tilt shortens least. Both ends are mapped, not a derivative: a
// close ring spans a third of the image.
static bool height_from_ring(const struct shape *ring, const struct camera *camera, double *height_m)
{
    // A uniform ring has the same covariance as a thin one of this radius.
    const double radius_mm = sqrt(
        (RING_OUTER_RADIUS_MM * RING_OUTER_RADIUS_MM + RING_INNER_RADIUS_MM * RING_INNER_RADIUS_MM) / 2.0);
    double deviations[2];
    struct vector axis;
    double diameter = 0.0;

    shape_axes(ring, &deviations[0], &deviations[1], &axis);
    for (int i = 0; i < 2; i++) {
        const double reach = deviations[i] * sqrt(2.0);
        const double x = reach * (i == 0 ? axis.x : -axis.y);
        const double y = reach * (i == 0 ? axis.y : axis.x);
        struct camera_ray a;
        struct camera_ray b;
        if (camera_unproject(camera, ring->x_px + x, ring->y_px + y, &a) != 0 ||
            camera_unproject(camera, ring->x_px - x, ring->y_px - y, &b) != 0) {
            return false;
        }
        diameter = fmax(diameter, length_of(a.right - b.right, a.forward - b.forward));
    }
    *height_m = 2.0 * radius_mm * METRES_PER_MM / diameter;
    return true;
}

// Where the image of the centre is, seen from the rectangle's centroid.
//
// A tilted plane magnifies its near side, so the point that divides the line
// between the centroids as the centre does on the pad is not the centre's image.
// To second order, with perspective g (relative change of scale for each mm):
// the ring's centroid moves by -4 V g (V its variance along an axis: once for the
// positions and three times for the area that each of them gets), and the
// dividing point by -a b g along the line (a, b the distances to both centroids).
// So a known part of what lies between the two is the error.
static struct vector centre_from_line(const struct pad_shapes *pad)
{
    const double ring_variance =
        (RING_OUTER_RADIUS_MM * RING_OUTER_RADIUS_MM + RING_INNER_RADIUS_MM * RING_INNER_RADIUS_MM) / 4.0;
    const double line_product = -SQUARE_CENTRE_Y_MM * RECTANGLE_CENTRE_Y_MM;
    const double part = line_product / (4.0 * ring_variance - line_product);
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
    if (pad->has_small_ring && (!pad->has_ring || pad->small_ring.area_px >= SMALL_RING_PRECISE_AREA_PX)) {
        pose->x_px = pad->small_ring.x_px;
        pose->y_px = pad->small_ring.y_px;
    } else {
        const struct vector centre = centre_from_line(pad);
        pose->x_px = pad->rectangle.x_px + centre.x;
        pose->y_px = pad->rectangle.y_px + centre.y;
    }
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

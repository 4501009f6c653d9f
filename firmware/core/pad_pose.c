// SPDX-License-Identifier: Apache-2.0
#include "pad_pose.h"

#include <math.h>
#include <stdbool.h>

#include "pad_geometry.h"

#define DEGREES_PER_RADIAN 57.29577951308232
#define METRES_PER_MM 0.001

#define BASELINE_MM (RECTANGLE_CENTRE_Y_MM - SQUARE_CENTRE_Y_MM)
#define CENTRE_FRACTION (RECTANGLE_CENTRE_Y_MM / BASELINE_MM)

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

int pad_pose_estimate(const struct pad_shapes *pad, const struct camera *camera, struct pad_pose *pose)
{
    struct camera_ray square;
    struct camera_ray rectangle;

    if (camera_unproject(camera, pad->square.x_px, pad->square.y_px, &square) != 0 ||
        camera_unproject(camera, pad->rectangle.x_px, pad->rectangle.y_px, &rectangle) != 0) {
        return PAD_POSE_E_OUTSIDE;
    }
    // On the plane below the camera the lens is undone: the centre divides the
    // line between the two centroids as it does on the pad.
    const double right = square.right - rectangle.right;
    const double forward = square.forward - rectangle.forward;
    pose->ray.right = rectangle.right + CENTRE_FRACTION * right;
    pose->ray.forward = rectangle.forward + CENTRE_FRACTION * forward;
    camera_project(camera, &pose->ray, &pose->x_px, &pose->y_px);

    // Square minus rectangle, turned by 90 degrees: up in the image becomes 0.
    const struct vector up = shape_offset(&pad->rectangle, &pad->square);
    pose->angle_deg = atan2(up.x, -up.y) * DEGREES_PER_RADIAN;

    if (!pad->has_ring || !height_from_ring(&pad->ring, camera, &pose->height_m)) {
        pose->height_m = BASELINE_MM * METRES_PER_MM / length_of(right, forward);
    }
    return 0;
}

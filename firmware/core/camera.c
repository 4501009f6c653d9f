// SPDX-License-Identifier: Apache-2.0
#include "camera.h"

#include <math.h>

// tan(theta / 2) at theta = 80 degrees. Beyond it the plane below the camera is
// so far away that a pixel of noise is metres.
#define HALF_ANGLE_TANGENT_LIMIT 0.8390996

const struct camera camera_default = {
    .focal_px = 552.0, .centre_x_px = 640.0, .centre_y_px = 360.0, .width_px = 1280.0};

struct camera camera_scaled(const struct camera *camera, double width_px)
{
    const double scale = width_px / camera->width_px;
    const struct camera scaled = {
        .focal_px = camera->focal_px * scale,
        .centre_x_px = camera->centre_x_px * scale,
        .centre_y_px = camera->centre_y_px * scale,
        .width_px = width_px,
    };

    return scaled;
}

int camera_unproject(const struct camera *camera, double x_px, double y_px, struct camera_ray *ray)
{
    // With t = tan(theta / 2): tan(theta) = 2 t / (1 - t^2), so no angle is ever
    // computed and nothing special happens on the axis.
    const double a = (x_px - camera->centre_x_px) / camera->focal_px;
    const double b = (y_px - camera->centre_y_px) / camera->focal_px;
    const double t_squared = (a * a + b * b) / 4.0;

    if (!(t_squared < HALF_ANGLE_TANGENT_LIMIT * HALF_ANGLE_TANGENT_LIMIT)) {
        return CAMERA_E_OUTSIDE;
    }
    ray->right = a / (1.0 - t_squared);
    ray->forward = -b / (1.0 - t_squared);
    return 0;
}

void camera_project(const struct camera *camera, const struct camera_ray *ray, double *x_px, double *y_px)
{
    // tan(theta / 2) = tan(theta) / (1 + 1 / cos(theta))
    const double tangent_squared = ray->right * ray->right + ray->forward * ray->forward;
    const double scale = 2.0 * camera->focal_px / (1.0 + sqrt(1.0 + tangent_squared));

    *x_px = camera->centre_x_px + scale * ray->right;
    *y_px = camera->centre_y_px - scale * ray->forward;
}

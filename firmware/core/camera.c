// SPDX-License-Identifier: Apache-2.0
#include "camera.h"

#include <math.h>

#include "camera_default.h"

// tan(theta / 2) at theta = 80 degrees. Beyond it the plane below the camera is
// so far away that a pixel of noise is metres.
#define HALF_ANGLE_TANGENT_LIMIT 0.8390996

// Enough to invert the lens to less than 1e-6 px where its polynomial rises.
#define LENS_STEPS 6

const struct camera camera_default = {.focal_px = CAMERA_FOCAL_PX,
                                      .centre_x_px = CAMERA_CENTRE_X_PX,
                                      .centre_y_px = CAMERA_CENTRE_Y_PX,
                                      .width_px = CAMERA_WIDTH_PX,
                                      .height_px = CAMERA_HEIGHT_PX,
                                      .radial_2 = CAMERA_RADIAL_2,
                                      .radial_4 = CAMERA_RADIAL_4};

struct camera camera_scaled(const struct camera *camera, double width_px)
{
    const double scale = width_px / camera->width_px;
    struct camera scaled = *camera;

    scaled.focal_px = camera->focal_px * scale;
    scaled.centre_x_px = camera->centre_x_px * scale;
    scaled.centre_y_px = camera->centre_y_px * scale;
    scaled.width_px = width_px;
    scaled.height_px = camera->height_px * scale;
    return scaled;
}

static double lens_factor(const struct camera *camera, double q)
{
    return 1.0 + q * (camera->radial_2 + q * camera->radial_4);
}

// d(r factor) / dr
static double lens_slope(const struct camera *camera, double q)
{
    return 1.0 + q * (3.0 * camera->radial_2 + q * 5.0 * camera->radial_4);
}

// What the ideal camera would show at a pixel of the real one: a and b, in focal lengths from the principal point.
static int ideal_of(const struct camera *camera, double x_px, double y_px, double *a, double *b)
{
    const double x = (x_px - camera->centre_x_px) / camera->focal_px;
    const double y = (y_px - camera->centre_y_px) / camera->focal_px;
    double share = 1.0;

    if (camera->radial_2 != 0.0 || camera->radial_4 != 0.0) {
        const double q = x * x + y * y;
        for (int step = 0; step < LENS_STEPS; step++) {
            const double slope = lens_slope(camera, q * share * share);
            if (!(slope > 0.1)) {
                return CAMERA_E_OUTSIDE;
            }
            share -= (share * lens_factor(camera, q * share * share) - 1.0) / slope;
        }
    }
    *a = share * x;
    *b = share * y;
    return 0;
}

int camera_direction(const struct camera *camera, double x_px, double y_px, double direction[3])
{
    double a;
    double b;

    if (ideal_of(camera, x_px, y_px, &a, &b) != 0) {
        return CAMERA_E_OUTSIDE;
    }
    const double t_squared = (a * a + b * b) / 4.0;
    if (!(t_squared < HALF_ANGLE_TANGENT_LIMIT * HALF_ANGLE_TANGENT_LIMIT)) {
        return CAMERA_E_OUTSIDE;
    }
    // With t = tan(theta / 2): sin(theta) = 2 t / (1 + t^2), so no angle is ever
    // computed and nothing special happens on the axis.
    direction[0] = a / (1.0 + t_squared);
    direction[1] = b / (1.0 + t_squared);
    direction[2] = (1.0 - t_squared) / (1.0 + t_squared);
    return 0;
}

double camera_image(const struct camera *camera, const double point[3], double *x_px, double *y_px)
{
    const double squared = point[0] * point[0] + point[1] * point[1] + point[2] * point[2];
    const double length = sqrt(squared);
    // r / sin(theta) = 2 tan(theta / 2) / sin(theta) = 2 / (1 + cos(theta)), and so is dr / dtheta.
    const double ideal = 2.0 / (length + point[2]);
    const double a = ideal * point[0];
    const double b = ideal * point[1];
    const double q = a * a + b * b;
    const double factor = lens_factor(camera, q);

    *x_px = camera->centre_x_px + camera->focal_px * factor * a;
    *y_px = camera->centre_y_px + camera->focal_px * factor * b;
    return camera->focal_px * camera->focal_px * ideal * ideal * factor * lens_slope(camera, q);
}

int camera_unproject(const struct camera *camera, double x_px, double y_px, struct camera_ray *ray)
{
    double direction[3];

    if (camera_direction(camera, x_px, y_px, direction) != 0) {
        return CAMERA_E_OUTSIDE;
    }
    ray->right = direction[0] / direction[2];
    ray->forward = -direction[1] / direction[2];
    return 0;
}

void camera_project(const struct camera *camera, const struct camera_ray *ray, double *x_px, double *y_px)
{
    const double point[3] = {ray->right, -ray->forward, 1.0};

    (void)camera_image(camera, point, x_px, y_px);
}

// SPDX-License-Identifier: Apache-2.0
// Wide-angle camera that looks along body down, the top of the image forward.
// Projection r = 2 f tan(theta / 2): theta is the angle from the optical axis,
// r the distance from the principal point in pixels.
#ifndef TOUCHDOWN_CAMERA_H
#define TOUCHDOWN_CAMERA_H

enum { CAMERA_E_OUTSIDE = -1 };

struct camera {
    double focal_px;    // f, at the centre of the image
    double centre_x_px; // principal point; integers are pixel centres
    double centre_y_px;
    double width_px; // of the frame that the above refer to
};

// A direction as the point where it meets the plane one unit below the camera.
struct camera_ray {
    double right;   // tan of the angle to the right of body down
    double forward; // tan of the angle ahead of body down
};

extern const struct camera camera_default;

// The same optics in a frame of another width, all of the field of view kept.
struct camera camera_scaled(const struct camera *camera, double width_px);

// 0, or CAMERA_E_OUTSIDE when the pixel looks 80 degrees or more off axis (or is
// not a number).
int camera_unproject(const struct camera *camera, double x_px, double y_px, struct camera_ray *ray);

void camera_project(const struct camera *camera, const struct camera_ray *ray, double *x_px, double *y_px);

#endif

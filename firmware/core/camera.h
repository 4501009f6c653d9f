// SPDX-License-Identifier: Apache-2.0
// Wide-angle camera that looks along body down, the top of the image forward.
// Projection r = 2 f tan(theta / 2): theta is the angle from the optical axis,
// r the distance from the principal point in pixels; what a real lens does
// differently is a factor 1 + radial_2 q + radial_4 q^2 on r, q = (r / f)^2.
#ifndef TOUCHDOWN_CAMERA_H
#define TOUCHDOWN_CAMERA_H

enum { CAMERA_E_OUTSIDE = -1 };

struct camera {
    double focal_px;    // f, at the centre of the image
    double centre_x_px; // principal point; integers are pixel centres
    double centre_y_px;
    double width_px; // of the frame that the above refer to
    double height_px;
    double radial_2;
    double radial_4;
};

// A direction as the point where it meets the plane one unit below the camera.
struct camera_ray {
    double right;   // tan of the angle to the right of body down
    double forward; // tan of the angle ahead of body down
};

// Of firmware/camera.toml, or of the file that CAMERA named in the build.
extern const struct camera camera_default;

// The same optics in a frame of another width, all of the field of view kept.
struct camera camera_scaled(const struct camera *camera, double width_px);

// 0, or CAMERA_E_OUTSIDE when the pixel looks 80 degrees or more off axis (or is
// not a number).
int camera_unproject(const struct camera *camera, double x_px, double y_px, struct camera_ray *ray);

void camera_project(const struct camera *camera, const struct camera_ray *ray, double *x_px, double *y_px);

// Unit vector (right, down in the image, along the optical axis) through a pixel.
int camera_direction(const struct camera *camera, double x_px, double y_px, double direction[3]);

// Image of a point in the same axes, any unit of length, not behind the camera.
// Returns how many square pixels a unit of area across the ray covers there.
double camera_image(const struct camera *camera, const double point[3], double *x_px, double *y_px);

#endif

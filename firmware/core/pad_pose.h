// SPDX-License-Identifier: Apache-2.0
// Where the pad is, from its shapes: position in the image, direction from the
// camera, heading, and the height that its size implies.
#ifndef TOUCHDOWN_PAD_POSE_H
#define TOUCHDOWN_PAD_POSE_H

#include "camera.h"
#include "classify.h"

enum { PAD_POSE_E_OUTSIDE = -1 };

struct pad_pose {
    double x_px; // image of the ring's physical centre
    double y_px;
    double angle_deg; // (-180, 180], clockwise in the image; 0 = square above rectangle
    struct camera_ray ray;
    double height_m; // camera above the pad along the optical axis, as the pad's known size says
};

// 0, or PAD_POSE_E_OUTSIDE when the pad lies beyond what the camera model covers.
int pad_pose_estimate(const struct pad_shapes *pad, const struct camera *camera, struct pad_pose *pose);

#endif

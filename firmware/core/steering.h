// SPDX-License-Identifier: Apache-2.0
// Velocities for the autopilot from where the pad is. Without state but for the
// search, and never from anything old: what is not known gives zero.
#ifndef TOUCHDOWN_STEERING_H
#define TOUCHDOWN_STEERING_H

#include <stdbool.h>
#include <stdint.h>

#include "landing_table.h"
#include "mavlink_out.h"
#include "parameters.h"

// The pad in the level frame that turns with the heading; from the camera.
struct level_pad {
    double forward_m;
    double right_m;
    double down_m;
    double angle_rad; // of the pad from the heading, clockwise from above
};

// What is known and fresh.
struct steering_view {
    bool pad_known;
    struct level_pad pad;
    bool height_known;
    double height_m; // above ground, along the plumb line
    uint64_t phase_us; // time since the phase began
};

// A place in camera axes (right, forward, depth) in the level frame.
struct level_pad steering_level(double roll_rad, double pitch_rad, double right_m, double forward_m, double depth_m,
                                double angle_rad);

struct mavlink_out_velocity steering_velocity(enum landing_steer steer, const struct steering_view *view,
                                              const struct parameters *parameters);

// How far the pad may be from the point below for it to count as centred.
double steering_centred_m(double height_m);

#endif

// SPDX-License-Identifier: Apache-2.0
#include "steering.h"

#include <math.h>

#include "bounds.h"
#include "pad_geometry.h"

#define RAD_PER_DEG 0.017453292519943295
#define US_PER_S 1000000.0
#define CENTRED_M 0.08
#define CENTRED_SHARE 0.05
// Farther off than this it does not go down; twice "centred", so that a gust does not stop it.
#define DESCENT_CONE 2.0
#define CLIMB_M_S 0.4
// Aimed at a little lower, or it would come near the height and never be there.
#define BELOW_ALIGN_M 0.05
#define HEIGHT_GAIN_PER_S 0.8
// The square that it flies while it searches: each second side is longer by this.
#define SEARCH_SIDE_M 0.8
#define SEARCH_M_S 0.3
#define SEARCH_SIDES_MAX 12

static double limited(double value, double limit)
{
    return at_most(at_least(value, -limit), limit);
}

struct level_pad steering_level(double roll_rad, double pitch_rad, double right_m, double forward_m, double depth_m,
                                double angle_rad)
{
    const double cos_roll = cos(roll_rad);
    const double sin_roll = sin(roll_rad);
    const double cos_pitch = cos(pitch_rad);
    const double sin_pitch = sin(pitch_rad);
    // Body to level: first the roll back, then the pitch.
    const double right = cos_roll * right_m - sin_roll * depth_m;
    const double down = sin_roll * right_m + cos_roll * depth_m;

    return (struct level_pad){
        .forward_m = cos_pitch * forward_m + sin_pitch * down,
        .right_m = right,
        .down_m = -sin_pitch * forward_m + cos_pitch * down,
        .angle_rad = angle_rad,
    };
}

double steering_centred_m(double height_m)
{
    return CENTRED_M + CENTRED_SHARE * height_m;
}

// Towards the point above the pad, never faster than allowed.
static struct mavlink_out_velocity above_pad(const struct steering_view *view, const struct parameters *parameters)
{
    const double gain_per_s = (double)parameters->gain_per_s;
    struct mavlink_out_velocity velocity = {.forward_m_s = gain_per_s * view->pad.forward_m,
                                            .right_m_s = gain_per_s * view->pad.right_m};
    const double speed_m_s = hypot(velocity.forward_m_s, velocity.right_m_s);
    const double most_m_s = (double)parameters->speed_m_s;

    if (speed_m_s > most_m_s) {
        velocity.forward_m_s *= most_m_s / speed_m_s;
        velocity.right_m_s *= most_m_s / speed_m_s;
    }
    return velocity;
}

static double towards_height_m_s(const struct steering_view *view, double wanted_m, double most_down_m_s)
{
    const double down_m_s = HEIGHT_GAIN_PER_S * (view->height_m - wanted_m);

    return view->height_known ? at_most(at_least(down_m_s, -CLIMB_M_S), most_down_m_s) : 0.0;
}

// Ahead, right, back, left, with growing sides: where the pad may have gone out of sight is not known.
static struct mavlink_out_velocity search(const struct steering_view *view, const struct parameters *parameters)
{
    struct mavlink_out_velocity velocity = {.down_m_s = towards_height_m_s(view, (double)parameters->search_height_m,
                                                                           0.0)};
    double left_s = (double)view->phase_us / US_PER_S;

    if (!view->height_known) {
        return velocity;
    }
    for (int side = 0; side < SEARCH_SIDES_MAX; side++) {
        const int length = side / 2 + 1; // two sides of each
        const double side_s = SEARCH_SIDE_M * (double)length / SEARCH_M_S;

        if (left_s < side_s) {
            const double sign = side % 4 < 2 ? 1.0 : -1.0;
            velocity.forward_m_s = side % 2 == 0 ? sign * SEARCH_M_S : 0.0;
            velocity.right_m_s = side % 2 == 0 ? 0.0 : sign * SEARCH_M_S;
            return velocity;
        }
        left_s -= side_s;
    }
    return velocity;
}

struct mavlink_out_velocity steering_velocity(enum landing_steer steer, const struct steering_view *view,
                                              const struct parameters *parameters)
{
    struct mavlink_out_velocity velocity = {.forward_m_s = 0.0};

    if (steer == LANDING_STEER_SEARCH) {
        return search(view, parameters);
    }
    if (steer == LANDING_STEER_CLIMB) {
        velocity.down_m_s = towards_height_m_s(view, (double)parameters->search_height_m, 0.0);
        return velocity;
    }
    if (steer == LANDING_STEER_NONE || steer == LANDING_STEER_STOP || !view->pad_known) {
        return velocity;
    }
    velocity = above_pad(view, parameters);
    const bool in_cone = hypot(view->pad.forward_m, view->pad.right_m) <=
                         DESCENT_CONE * steering_centred_m(view->pad.down_m);

    if (steer == LANDING_STEER_CENTRE) {
        velocity.down_m_s = towards_height_m_s(view, (double)parameters->search_height_m,
                                               in_cone ? (double)parameters->descent_m_s : 0.0);
    }
    if (steer == LANDING_STEER_DESCEND && in_cone) {
        velocity.down_m_s = towards_height_m_s(view, (double)parameters->align_height_m - BELOW_ALIGN_M,
                                               (double)parameters->descent_m_s);
    }
    if (steer == LANDING_STEER_ALIGN) {
        const double most_rad_s = RAD_PER_DEG * (double)parameters->yaw_rate_deg_s;

        velocity.yaw_rate_rad_s = limited((double)parameters->gain_per_s * view->pad.angle_rad, most_rad_s);
    }
    return velocity;
}

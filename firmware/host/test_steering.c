// SPDX-License-Identifier: Apache-2.0
#include <math.h>

#include "parameters.h"
#include "steering.h"
#include "test.h"

static struct parameters parameters;

static void test_level(void)
{
    struct level_pad pad;

    test_case("level body: nothing changes");
    pad = steering_level(0.0, 0.0, 0.3, -0.2, 1.5, 0.1);
    NEAR(pad.right_m, 0.3, 1e-12);
    NEAR(pad.forward_m, -0.2, 1e-12);
    NEAR(pad.down_m, 1.5, 1e-12);
    NEAR(pad.angle_rad, 0.1, 1e-12);
    test_case("right side down, a pad on the axis lies to the left");
    pad = steering_level(0.1, 0.0, 0.0, 0.0, 2.0, 0.0);
    NEAR(pad.right_m, -2.0 * sin(0.1), 1e-12);
    NEAR(pad.down_m, 2.0 * cos(0.1), 1e-12);
    test_case("nose up, a pad on the axis lies ahead");
    pad = steering_level(0.0, 0.1, 0.0, 0.0, 2.0, 0.0);
    NEAR(pad.forward_m, 2.0 * sin(0.1), 1e-12);
    test_case("lengths stay");
    pad = steering_level(-0.3, 0.25, 0.4, 0.7, 1.1, 0.0);
    NEAR(pad.right_m * pad.right_m + pad.forward_m * pad.forward_m + pad.down_m * pad.down_m,
         0.4 * 0.4 + 0.7 * 0.7 + 1.1 * 1.1, 1e-12);
}

static void test_nothing_known(void)
{
    const struct steering_view blind = {.pad = {.forward_m = 5.0, .right_m = 5.0, .down_m = 5.0, .angle_rad = 1.0},
                                        .height_m = 5.0};

    test_case("what is not known moves nothing");
    for (int steer = 0; steer < LANDING_STEERS; steer++) {
        const struct mavlink_out_velocity velocity = steering_velocity((enum landing_steer)steer, &blind, &parameters);

        CHECK(velocity.forward_m_s == 0.0 && velocity.right_m_s == 0.0);
        CHECK(velocity.down_m_s == 0.0 && velocity.yaw_rate_rad_s == 0.0);
    }
}

static void test_centre(void)
{
    struct steering_view view = {.pad_known = true, .height_known = true, .height_m = 1.8};
    struct mavlink_out_velocity velocity;

    test_case("towards the pad, slower when near");
    view.pad = (struct level_pad){.forward_m = 0.1, .right_m = -0.2, .down_m = 1.8, .angle_rad = 0.5};
    velocity = steering_velocity(LANDING_STEER_CENTRE, &view, &parameters);
    NEAR(velocity.forward_m_s, 0.07, 1e-6);
    NEAR(velocity.right_m_s, -0.14, 1e-6);
    NEAR(velocity.down_m_s, 0.0, 1e-6);
    CHECK(velocity.yaw_rate_rad_s == 0.0);
    test_case("to the search height: up at any time, down while the pad is nearly below");
    view.height_m = view.pad.down_m = 1.0;
    velocity = steering_velocity(LANDING_STEER_CENTRE, &view, &parameters);
    NEAR(velocity.down_m_s, -0.4, 1e-6);
    view.pad.right_m = -2.0;
    velocity = steering_velocity(LANDING_STEER_CENTRE, &view, &parameters);
    NEAR(velocity.down_m_s, -0.4, 1e-6);
    view.height_m = view.pad.down_m = 4.0;
    velocity = steering_velocity(LANDING_STEER_CENTRE, &view, &parameters);
    CHECK(velocity.down_m_s == 0.0);
    view.pad.right_m = -0.2;
    velocity = steering_velocity(LANDING_STEER_CENTRE, &view, &parameters);
    NEAR(velocity.down_m_s, 0.25, 1e-6);
    test_case("never faster than allowed");
    view.pad.forward_m = 30.0;
    view.pad.right_m = 40.0;
    velocity = steering_velocity(LANDING_STEER_CENTRE, &view, &parameters);
    NEAR(hypot(velocity.forward_m_s, velocity.right_m_s), 0.5, 1e-6);
    NEAR(velocity.right_m_s / velocity.forward_m_s, 4.0 / 3.0, 1e-6);
}

static void test_descend_and_align(void)
{
    struct steering_view view = {.pad_known = true, .height_known = true, .height_m = 1.8};
    struct mavlink_out_velocity velocity;

    test_case("down while the pad is nearly below, not beside it");
    view.pad = (struct level_pad){.down_m = 1.8};
    velocity = steering_velocity(LANDING_STEER_DESCEND, &view, &parameters);
    NEAR(velocity.down_m_s, 0.25, 1e-6);
    view.pad.right_m = 0.5;
    velocity = steering_velocity(LANDING_STEER_DESCEND, &view, &parameters);
    CHECK(velocity.down_m_s == 0.0);
    test_case("turns with the pad, clockwise is positive, at most as fast as allowed");
    view.pad = (struct level_pad){.down_m = 1.0, .angle_rad = 0.1};
    velocity = steering_velocity(LANDING_STEER_ALIGN, &view, &parameters);
    NEAR(velocity.yaw_rate_rad_s, 0.07, 1e-6);
    view.pad.angle_rad = -3.0;
    velocity = steering_velocity(LANDING_STEER_ALIGN, &view, &parameters);
    NEAR(velocity.yaw_rate_rad_s, -20.0 * 0.017453292519943295, 1e-6);
}

static void test_search_and_climb(void)
{
    struct steering_view view = {.height_known = true, .height_m = 1.0};
    struct mavlink_out_velocity velocity;
    double forward_m = 0.0;
    double right_m = 0.0;
    double farthest_m = 0.0;

    test_case("up to the search height and no farther, never down");
    velocity = steering_velocity(LANDING_STEER_CLIMB, &view, &parameters);
    NEAR(velocity.down_m_s, -0.4, 1e-6);
    view.height_m = 2.5;
    velocity = steering_velocity(LANDING_STEER_CLIMB, &view, &parameters);
    CHECK(velocity.down_m_s == 0.0);
    test_case("the search covers a square around where it began");
    for (int i = 0; i < 400; i++) {
        view.phase_us = (uint64_t)i * 100000U;
        velocity = steering_velocity(LANDING_STEER_SEARCH, &view, &parameters);
        CHECK(hypot(velocity.forward_m_s, velocity.right_m_s) <= 0.3 + 1e-9);
        forward_m += 0.1 * velocity.forward_m_s;
        right_m += 0.1 * velocity.right_m_s;
        farthest_m = fmax(farthest_m, hypot(forward_m, right_m));
    }
    CHECK(farthest_m > 1.0 && farthest_m < 2.5);
}

void test_steering(void)
{
    parameters_init(&parameters);
    test_level();
    test_nothing_known();
    test_centre();
    test_descend_and_align();
    test_search_and_climb();
}

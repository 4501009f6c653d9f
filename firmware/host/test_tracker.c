// SPDX-License-Identifier: Apache-2.0
#include <math.h>
#include <string.h>

#include "test.h"
#include "tracker.h"

#define FRAME_US 16667U
#define CONFIRMED 6 // detections

static struct tracker tracker;
static struct pad_estimate pad;
static uint64_t now_us;

static enum track_result frame(bool found)
{
    now_us += FRAME_US;
    return tracker_update(&tracker, &camera_default, now_us, found, &pad);
}

// Where the pad is after `seconds`: 0.3 m/s to the right, 0.6 m/s nearer, turning through 180 degrees in frame 41.
static struct pad_estimate moving(double seconds)
{
    const struct pad_estimate at = {.right_m = 0.1 + 0.3 * seconds,
                                    .forward_m = -0.2,
                                    .depth_m = 1.5 - 0.6 * seconds,
                                    .height_m = 1.52 - 0.6 * seconds,
                                    .angle_deg = remainder(153.0 + 40.0 * seconds, 360.0),
                                    .doubt = 0.7,
                                    .kinds = PAD_RING};

    return at;
}

static double seconds(void)
{
    return 1e-6 * (double)now_us;
}

// `count` detections of the moving pad, from a new track on.
static void follow(int count)
{
    tracker_init(&tracker);
    now_us = 0U;
    for (int i = 0; i < count; i++) {
        pad = moving(seconds() + 1e-6 * FRAME_US);
        CHECK(frame(true) == TRACK_MEASURED);
    }
}

static enum track_result jump(double right_m)
{
    pad = moving(seconds());
    pad.right_m += right_m;
    return frame(true);
}

static void test_measured(void)
{
    test_case("what was measured goes out as it was measured");
    follow(60);
    const struct pad_estimate truth = moving(seconds());
    CHECK(memcmp(&pad, &truth, sizeof pad) == 0);
}

static void test_bridge(void)
{
    double x_px;
    double y_px;

    test_case("two frames are bridged where the pad must be by now, no more");
    follow(40);
    for (int i = 0; i < 2; i++) {
        memset(&pad, 0xFF, sizeof pad);
        CHECK(frame(false) == TRACK_BRIDGED);
        const struct pad_estimate truth = moving(seconds());
        const struct camera_ray ray = {.right = truth.right_m / truth.depth_m, .forward = truth.forward_m / truth.depth_m};
        camera_project(&camera_default, &ray, &x_px, &y_px);
        NEAR(pad.right_m, truth.right_m, 0.002);
        NEAR(pad.forward_m, truth.forward_m, 0.002);
        NEAR(pad.depth_m, truth.depth_m, 0.003);
        NEAR(pad.height_m - pad.depth_m, 0.02, 1e-9);
        NEAR(remainder(pad.angle_deg - truth.angle_deg, 360.0), 0.0, 0.3);
        CHECK(pad.angle_deg >= -180.0 && pad.angle_deg <= 180.0);
        NEAR(pad.x_px, x_px, 1.0);
        NEAR(pad.y_px, y_px, 1.0);
        CHECK(pad.kinds == 0U); // nothing was seen
    }
    CHECK(frame(false) == TRACK_NONE);
    CHECK(frame(false) == TRACK_NONE);
    test_case("a new track has to be confirmed again");
    pad = moving(seconds());
    CHECK(frame(true) == TRACK_MEASURED);
    CHECK(frame(false) == TRACK_NONE);
    test_case("a detection between gives two frames again");
    follow(CONFIRMED);
    CHECK(frame(false) == TRACK_BRIDGED);
    CHECK(frame(false) == TRACK_BRIDGED);
    CHECK(jump(0.0) == TRACK_MEASURED);
    CHECK(frame(false) == TRACK_BRIDGED);
}

static void test_unconfirmed(void)
{
    for (int count = 0; count < CONFIRMED; count++) {
        test_case("%d detections are not bridged", count);
        follow(count);
        CHECK(frame(false) == TRACK_NONE);
        test_case("%d detections do not outweigh one elsewhere", count);
        follow(count);
        CHECK(jump(0.5) == TRACK_MEASURED);
        NEAR(pad.right_m, moving(seconds() - 1e-6 * FRAME_US).right_m + 0.5, 1e-9);
    }
}

static void test_refuse(void)
{
    test_case("a jump is refused twice and wins the third time");
    follow(CONFIRMED);
    CHECK(jump(0.5) == TRACK_BRIDGED);
    NEAR(pad.right_m, moving(seconds()).right_m, 0.05);
    CHECK(jump(0.5) == TRACK_BRIDGED);
    CHECK(jump(0.5) == TRACK_MEASURED);
    NEAR(pad.right_m, moving(seconds() - 1e-6 * FRAME_US).right_m + 0.5, 1e-9);
    test_case("what won is a new track, not a confirmed one");
    CHECK(frame(false) == TRACK_NONE);
    test_case("each quantity alone is enough to be refused");
    for (int i = 0; i < TRACK_QUANTITIES; i++) {
        follow(20);
        pad = moving(seconds());
        double *quantities[TRACK_QUANTITIES] = {&pad.right_m, &pad.forward_m, &pad.depth_m, &pad.angle_deg};
        *quantities[i] += i == TRACK_ANGLE_DEG ? 90.0 : 0.3;
        CHECK(frame(true) == TRACK_BRIDGED);
    }
    test_case("a detection that is no number is refused");
    follow(20);
    CHECK(jump((double)NAN) == TRACK_BRIDGED);
    test_case("refusals that are not in a row do not add up");
    follow(20);
    for (int i = 0; i < 10; i++) {
        CHECK(jump(0.5) == TRACK_BRIDGED);
        CHECK(jump(0.0) == TRACK_MEASURED);
    }
}

static void test_time(void)
{
    test_case("after more than a tenth of a second the track is over");
    follow(20);
    now_us += 100000U - FRAME_US;
    CHECK(frame(false) == TRACK_BRIDGED);
    follow(20);
    now_us += 100001U - FRAME_US;
    CHECK(frame(false) == TRACK_NONE);
    test_case("so it is when the clock goes back or stands still");
    follow(20);
    now_us -= FRAME_US;
    CHECK(frame(false) == TRACK_NONE);
    follow(20);
    now_us -= 3U * FRAME_US;
    CHECK(jump(0.5) == TRACK_MEASURED);
}

// A pad that comes nearer so fast that it would be behind the camera.
static void test_past_the_camera(void)
{
    test_case("no place behind the camera");
    tracker_init(&tracker);
    now_us = 0U;
    for (int i = 0; i < 20; i++) {
        pad = moving(0.0);
        pad.depth_m = pad.height_m = 0.405 - 0.02 * i;
        CHECK(frame(true) == TRACK_MEASURED);
    }
    CHECK(frame(false) == TRACK_BRIDGED);
    CHECK(pad.depth_m > 0.0);
    CHECK(frame(false) == TRACK_NONE);
}

void test_tracker(void)
{
    test_measured();
    test_bridge();
    test_unconfirmed();
    test_refuse();
    test_time();
    test_past_the_camera();
}

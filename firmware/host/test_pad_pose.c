// SPDX-License-Identifier: Apache-2.0
// The whole way from painted pixels to a pose, against the geometry painted.
#include <math.h>

#include "classify.h"
#include "pad_pose.h"
#include "test.h"
#include "test_scene.h"

#define RADIANS_PER_DEGREE 0.017453292519943295

static struct landing_record record;
static struct classify_scratch scratch;

static bool find(const struct scene *scene, struct pad_pose *pose)
{
    struct pad_shapes pad;

    scene_clear(&record);
    scene_paint_pad(&record, scene);
    return classify_pad(&record, &scratch, &pad) == 0 && pad_pose_estimate(&pad, &camera_default, pose) == 0;
}

static double turn(double degrees)
{
    return remainder(degrees, 360.0);
}

static void check_level(const struct scene *scene)
{
    struct pad_pose pose = {0};
    double x_px;
    double y_px;

    CHECK(find(scene, &pose));
    scene_project_centre(scene, &x_px, &y_px);
    NEAR(pose.x_px, x_px, 0.35);
    NEAR(pose.y_px, y_px, 0.35);
    NEAR(pose.height_m, scene->height_m, 0.02 * scene->height_m);
    NEAR(pose.ray.right * scene->height_m, scene->right_m, 0.0008 * scene->height_m);
    NEAR(pose.ray.forward * scene->height_m, scene->forward_m, 0.0008 * scene->height_m);
}

static void test_all_headings(void)
{
    for (int heading = 0; heading < 360; heading += 15) {
        const struct scene scene = {.height_m = 1.0, .heading_deg = heading};
        struct pad_pose pose = {0};
        test_case("heading %d", heading);
        check_level(&scene);
        CHECK(find(&scene, &pose));
        NEAR(turn(pose.angle_deg - heading), 0.0, 0.4);
        CHECK(pose.angle_deg > -180.0 && pose.angle_deg <= 180.0);
    }
}

static void test_heights_and_places(void)
{
    static const double heights_m[] = {0.25, 0.4, 0.8, 1.3, 1.9};
    static const double places[][2] = {{0.0, 0.0}, {0.35, 0.0}, {0.0, -0.2}, {-0.4, 0.15}};

    for (unsigned i = 0; i < sizeof heights_m / sizeof heights_m[0]; i++) {
        for (unsigned j = 0; j < sizeof places / sizeof places[0]; j++) {
            const struct scene scene = {
                .height_m = heights_m[i],
                .right_m = places[j][0] * heights_m[i],
                .forward_m = places[j][1] * heights_m[i],
                .heading_deg = 33.0,
            };
            test_case("height %.2f m, %.2f right, %.2f ahead", scene.height_m, scene.right_m, scene.forward_m);
            check_level(&scene);
        }
    }
}

// Tilt as in real flights: 90 % below 12 degrees.
static void test_tilt(void)
{
    static const double tilts[][2] = {{8.0, 0.0}, {0.0, -8.0}, {-8.0, 8.0}, {12.0, 0.0}, {0.0, 15.0}};

    for (unsigned i = 0; i < sizeof tilts / sizeof tilts[0]; i++) {
        for (int heading = 0; heading < 360; heading += 60) {
            const struct scene scene = {
                .height_m = i % 2U == 0U ? 1.0 : 0.5,
                .heading_deg = heading,
                .roll_deg = tilts[i][0],
                .pitch_deg = tilts[i][1],
            };
            struct pad_pose pose = {0};
            double x_px;
            double y_px;
            test_case("roll %.0f, pitch %.0f, heading %d", scene.roll_deg, scene.pitch_deg, heading);
            CHECK(find(&scene, &pose));
            scene_project_centre(&scene, &x_px, &y_px);
            NEAR(pose.x_px, x_px, 0.5);
            NEAR(pose.y_px, y_px, 0.5);
            NEAR(turn(pose.angle_deg - heading), 0.0, 3.0);
            const double tilt = cos(scene.roll_deg * RADIANS_PER_DEGREE) * cos(scene.pitch_deg * RADIANS_PER_DEGREE);
            NEAR(pose.height_m, scene.height_m * tilt, 0.015 * scene.height_m); // along the axis, not the plumb line
        }
    }
}

void test_pad_pose(void)
{
    test_all_headings();
    test_heights_and_places();
    test_tilt();
}

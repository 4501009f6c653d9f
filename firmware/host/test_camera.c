// SPDX-License-Identifier: Apache-2.0
#include <math.h>

#include "camera.h"
#include "test.h"

static void test_known_directions(void)
{
    struct camera_ray ray;

    test_case("known directions");
    CHECK(camera_unproject(&camera_default, 640.0, 360.0, &ray) == 0);
    NEAR(ray.right, 0.0, 0.0);
    NEAR(ray.forward, 0.0, 0.0);
    for (int degrees = 5; degrees < 80; degrees += 5) {
        const double theta = degrees * acos(-1.0) / 180.0;
        const double r = 2.0 * 552.0 * tan(theta / 2.0);
        test_case("%d degrees off axis", degrees);
        CHECK(camera_unproject(&camera_default, 640.0 + r, 360.0, &ray) == 0);
        NEAR(ray.right, tan(theta), 1e-9);
        NEAR(ray.forward, 0.0, 1e-12);
        CHECK(camera_unproject(&camera_default, 640.0, 360.0 - r, &ray) == 0); // up in the image is forward
        NEAR(ray.right, 0.0, 1e-12);
        NEAR(ray.forward, tan(theta), 1e-9);
    }
}

static void test_round_trip(void)
{
    for (int y = 0; y < 720; y += 71) {
        for (int x = 0; x < 1280; x += 79) {
            struct camera_ray ray;
            double back_x;
            double back_y;
            test_case("pixel %d, %d and back", x, y);
            CHECK(camera_unproject(&camera_default, x, y, &ray) == 0);
            camera_project(&camera_default, &ray, &back_x, &back_y);
            NEAR(back_x, x, 1e-9);
            NEAR(back_y, y, 1e-9);
        }
    }
}

static void test_limits(void)
{
    struct camera_ray ray;
    const struct camera half = camera_scaled(&camera_default, 640.0);
    struct camera_ray of_half;

    test_case("outside the model");
    CHECK(camera_unproject(&camera_default, 640.0 + 930.0, 360.0, &ray) == CAMERA_E_OUTSIDE);
    CHECK(camera_unproject(&camera_default, (double)NAN, 360.0, &ray) == CAMERA_E_OUTSIDE);
    test_case("half the frame, the same directions");
    CHECK(camera_unproject(&camera_default, 900.0, 200.0, &ray) == 0);
    CHECK(camera_unproject(&half, 450.0, 100.0, &of_half) == 0);
    NEAR(of_half.right, ray.right, 1e-12);
    NEAR(of_half.forward, ray.forward, 1e-12);
}

// What a lens that is not ideal does: r times 1 + radial_2 q + radial_4 q^2, q = (r / f)^2.
static void test_lens(void)
{
    struct camera bent = camera_default;
    double x_px;
    double y_px;

    bent.radial_2 = -0.06;
    bent.radial_4 = 0.01;
    for (int degrees = 0; degrees <= 60; degrees += 5) {
        const double theta = degrees * acos(-1.0) / 180.0;
        const double r = 2.0 * tan(theta / 2.0);
        const double bent_r = r * (1.0 - 0.06 * r * r + 0.01 * r * r * r * r);
        const double point[3] = {-300.0 * sin(theta) * 0.8, 300.0 * sin(theta) * 0.6, 300.0 * cos(theta)};
        double direction[3];
        test_case("lens, %d degrees off axis", degrees);
        camera_image(&bent, point, &x_px, &y_px);
        NEAR(x_px, 640.0 - 552.0 * bent_r * 0.8, 1e-9);
        NEAR(y_px, 360.0 + 552.0 * bent_r * 0.6, 1e-9);
        CHECK(camera_direction(&bent, x_px, y_px, direction) == 0);
        for (int i = 0; i < 3; i++) {
            NEAR(direction[i], point[i] / 300.0, 1e-8);
        }
    }
    test_case("a lens that folds back has no direction there");
    bent.radial_2 = -0.3;
    bent.radial_4 = 0.0;
    double direction[3];
    CHECK(camera_direction(&bent, 640.0 + 200.0, 360.0, direction) == 0);
    CHECK(camera_direction(&bent, 640.0 + 700.0, 360.0, direction) == CAMERA_E_OUTSIDE);
}

// Square pixels for each unit of area across the ray, by differences.
static void test_scale(void)
{
    struct camera cameras[2] = {camera_default, camera_default};

    cameras[1].radial_2 = -0.06;
    cameras[1].radial_4 = 0.01;
    for (int i = 0; i < 2; i++) {
        for (int degrees = 0; degrees <= 60; degrees += 20) {
            const double theta = degrees * acos(-1.0) / 180.0;
            const double step = 1e-4;
            // Across the ray: outwards, and about the axis.
            const double point[3] = {2.0 * sin(theta), 0.0, 2.0 * cos(theta)};
            const double outwards[3] = {point[0] + step * cos(theta), 0.0, point[2] - step * sin(theta)};
            const double about[3] = {point[0], step, point[2]};
            double x_px[3];
            double y_px[3];
            test_case("scale, camera %d, %d degrees off axis", i, degrees);
            const double scale = camera_image(&cameras[i], point, &x_px[0], &y_px[0]);
            camera_image(&cameras[i], outwards, &x_px[1], &y_px[1]);
            camera_image(&cameras[i], about, &x_px[2], &y_px[2]);
            const double area = (x_px[1] - x_px[0]) * (y_px[2] - y_px[0]) - (x_px[2] - x_px[0]) * (y_px[1] - y_px[0]);
            NEAR(scale / (area / (step * step)), 1.0, 1e-3);
        }
    }
}

void test_camera(void)
{
    test_known_directions();
    test_round_trip();
    test_limits();
    test_lens();
    test_scale();
}

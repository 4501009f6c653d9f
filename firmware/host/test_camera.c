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

void test_camera(void)
{
    test_known_directions();
    test_round_trip();
    test_limits();
}

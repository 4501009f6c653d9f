// SPDX-License-Identifier: Apache-2.0
#include <math.h>

#include "attitude.h"
#include "test.h"
#include "test_scene.h"

#define RADIANS_PER_DEGREE 0.017453292519943295
#define SET_US 5000000U
#define STALE_US (SET_US + 250001U)

static struct tilt_hint tilt;

static bool known_after(double roll_rad, double pitch_rad)
{
    struct attitude attitude = {.known = true, .received_us = SET_US};

    attitude_set(&attitude, roll_rad, pitch_rad, SET_US);
    return attitude_tilt(&attitude, SET_US, &tilt);
}

// What the scene's own rotation, that of the autopilots, makes of level ground.
static void test_level_ground(void)
{
    for (int roll = -40; roll <= 40; roll += 20) {
        for (int pitch = -40; pitch <= 40; pitch += 20) {
            const struct scene scene = {.height_m = 1.0, .heading_deg = 30.0, .roll_deg = roll, .pitch_deg = pitch};
            const struct pad_view truth = scene_view(&scene);
            test_case("level ground at roll %d, pitch %d", roll, pitch);
            CHECK(known_after(roll * RADIANS_PER_DEGREE, pitch * RADIANS_PER_DEGREE));
            NEAR(tilt.x, truth.value[PAD_TILT_X], 1e-12);
            NEAR(tilt.y, truth.value[PAD_TILT_Y], 1e-12);
            CHECK(tilt.sigma > 0.0 && tilt.sigma < 0.1);
        }
    }
}

static void test_age(void)
{
    struct attitude attitude = {.known = false};

    test_case("without an attitude the hint stays as it is");
    tilt = (struct tilt_hint){.x = 3.0, .y = 4.0, .sigma = 5.0};
    CHECK(!attitude_tilt(&attitude, 0U, &tilt));
    attitude_set(&attitude, 0.1, 0.2, SET_US);
    CHECK(!attitude_tilt(&attitude, STALE_US, &tilt));
    NEAR(tilt.x, 3.0, 0.0);
    NEAR(tilt.y, 4.0, 0.0);
    NEAR(tilt.sigma, 5.0, 0.0);
    test_case("an attitude counts for a quarter of a second");
    CHECK(attitude_tilt(&attitude, STALE_US - 1U, &tilt));
    NEAR(tilt.x, tan(0.1), 1e-12);
    attitude_set(&attitude, 0.0, 0.0, STALE_US);
    CHECK(attitude_tilt(&attitude, STALE_US, &tilt));
    NEAR(tilt.x, 0.0, 0.0);
}

static void test_no_attitude(void)
{
    const double senseless[] = {(double)NAN, (double)INFINITY, -(double)INFINITY, 1.01, -1.01};

    CHECK(known_after(1.0, -1.0));
    for (unsigned i = 0; i < sizeof senseless / sizeof senseless[0]; i++) {
        test_case("%g rad is no attitude, and the one before no longer counts", senseless[i]);
        CHECK(!known_after(senseless[i], 0.0));
        CHECK(!known_after(0.0, senseless[i]));
    }
}

void test_attitude(void)
{
    test_level_ground();
    test_age();
    test_no_attitude();
}

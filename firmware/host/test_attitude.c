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

    attitude_set(&attitude, roll_rad, pitch_rad, SET_US, SET_US);
    return attitude_tilt(&attitude, SET_US, SET_US, &tilt);
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
    CHECK(!attitude_tilt(&attitude, 0U, 0U, &tilt));
    attitude_set(&attitude, 0.1, 0.2, SET_US, SET_US);
    CHECK(!attitude_tilt(&attitude, STALE_US, STALE_US, &tilt));
    NEAR(tilt.x, 3.0, 0.0);
    NEAR(tilt.y, 4.0, 0.0);
    NEAR(tilt.sigma, 5.0, 0.0);
    test_case("an attitude counts for a quarter of a second");
    CHECK(attitude_tilt(&attitude, STALE_US - 1U, STALE_US - 1U, &tilt));
    NEAR(tilt.x, tan(0.1), 1e-12);
    attitude_set(&attitude, 0.0, 0.0, STALE_US, STALE_US);
    CHECK(attitude_tilt(&attitude, STALE_US, STALE_US, &tilt));
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

static struct attitude turning;

static double roll_at(uint64_t time_us, uint64_t now_us)
{
    double roll_rad = 9.0;
    double pitch_rad = 9.0;

    CHECK(attitude_at(&turning, time_us, now_us, &roll_rad, &pitch_rad));
    NEAR(pitch_rad, -roll_rad, 1e-12);
    return roll_rad;
}

// A roll of 1 rad/s that is 0 at SET_US, told every `period_us`, `late_us` after it was so.
static uint64_t turn(uint64_t period_us, uint64_t late_us, unsigned count)
{
    uint64_t now_us = SET_US;

    turning = (struct attitude){.known = false};
    for (unsigned i = 0; i < count; i++) {
        const double angle_rad = 1e-6 * (double)(i * period_us);
        now_us = SET_US + i * period_us + late_us;
        attitude_set(&turning, angle_rad, -angle_rad, SET_US + i * period_us, now_us);
    }
    return now_us;
}

static void test_turning(void)
{
    test_case("at 1 rad/s, an attitude every 20 ms: at the time of the exposure it is known to the microradian");
    uint64_t now_us = turn(20000U, 5000U, 30U);
    for (uint64_t age_us = 0U; age_us <= 280000U; age_us += 777U) {
        NEAR(roll_at(now_us - age_us, now_us), 1e-6 * (double)(now_us - age_us - SET_US), 1e-6);
    }
    test_case("where the newest as it is would be off by as much as the exposure is old");
    CHECK(fabs(turning.roll_rad - roll_at(now_us - 15000U, now_us)) > 0.009);
    test_case("before the oldest that is kept, the oldest");
    NEAR(roll_at(now_us - 400000U, now_us), 0.28, 1e-9);
    NEAR(roll_at(0U, now_us), 0.28, 1e-9);
    test_case("after the newest on for as long as two are apart, then no further");
    NEAR(roll_at(now_us + 200000U, now_us), 0.585, 1e-9); // not beyond now
    NEAR(roll_at(now_us + 100000U, now_us + 100000U), 0.60, 1e-9);
    test_case("by 50 ms at most, and not at all from two that are more than 100 ms apart");
    now_us = turn(80000U, 0U, 5U);
    NEAR(roll_at(now_us + 80000U, now_us + 80000U), 0.37, 1e-9);
    now_us = turn(110000U, 0U, 5U);
    NEAR(roll_at(now_us + 50000U, now_us + 50000U), 0.44, 1e-9);
    NEAR(roll_at(now_us - 55000U, now_us), 0.385, 1e-9);
    test_case("one alone is taken as it is");
    now_us = turn(20000U, 0U, 1U);
    NEAR(roll_at(now_us - 10000U, now_us), 0.0, 0.0);
    NEAR(roll_at(now_us + 10000U, now_us + 10000U), 0.0, 0.0);
    test_case("so is the first after a gap, and the first of a clock that went back");
    now_us = turn(250001U, 0U, 3U);
    NEAR(roll_at(now_us - 100000U, now_us), 0.500002, 0.0);
    attitude_set(&turning, 0.2, -0.2, now_us - 1U, now_us);
    NEAR(roll_at(now_us - 100000U, now_us), 0.2, 0.0);
    test_case("two of one time: the second");
    attitude_set(&turning, 0.3, -0.3, now_us - 1U, now_us);
    NEAR(roll_at(now_us, now_us), 0.3, 0.0);
    test_case("a line never leaves what is an attitude");
    turning = (struct attitude){.known = false};
    attitude_set(&turning, 0.0, 0.0, SET_US, SET_US);
    attitude_set(&turning, 1.0, -1.0, SET_US + 20000U, SET_US + 20000U);
    NEAR(roll_at(SET_US + 40000U, SET_US + 40000U), 1.0, 0.0);
}

void test_attitude(void)
{
    test_turning();
    test_level_ground();
    test_age();
    test_no_attitude();
}

// SPDX-License-Identifier: Apache-2.0
#include <stddef.h>

#include "fusion.h"
#include "test.h"

static struct lidar_reading reading(uint32_t distance_mm, uint32_t age_us)
{
    const struct lidar_reading lidar = {.valid = true, .distance_mm = distance_mm, .age_us = age_us};

    return lidar;
}

void test_fusion(void)
{
    const struct pad_estimate pad = {.height_m = 1.0};
    struct lidar_reading lidar = reading(1050, 1000);
    struct altitude altitude = fusion_altitude(&lidar, &pad);

    test_case("both agree: between them, nearer the surer one");
    CHECK(altitude.from_lidar && altitude.from_pad && !altitude.lidar_implausible);
    CHECK(altitude.height_m > 1.025 && altitude.height_m < 1.05);
    NEAR(altitude.pad_scale, altitude.height_m, 1e-12);

    test_case("a pad far to the side: the beam says less of its place, and its size less of the height");
    const struct pad_estimate aside = {.height_m = 1.0, .right_m = 0.6, .forward_m = -0.8};
    const struct altitude far = fusion_altitude(&lidar, &aside);
    CHECK(far.height_m > altitude.height_m && far.height_m < 1.05);
    CHECK(far.pad_scale > 1.0 && far.pad_scale < 1.025);

    test_case("LiDAR wrong by 2");
    lidar = reading(2000, 1000);
    altitude = fusion_altitude(&lidar, &pad);
    CHECK(!altitude.from_lidar && altitude.from_pad && altitude.lidar_implausible);
    NEAR(altitude.height_m, 1.0, 0.0);
    NEAR(altitude.pad_scale, 1.0, 0.0);
    lidar = reading(500, 1000);
    CHECK(fusion_altitude(&lidar, &pad).lidar_implausible);

    test_case("no pad");
    lidar = reading(12345, 1000);
    altitude = fusion_altitude(&lidar, NULL);
    CHECK(altitude.from_lidar && !altitude.from_pad);
    NEAR(altitude.height_m, 12.345, 1e-9);

    test_case("unusable LiDAR");
    CHECK(fusion_lidar_usable(&lidar));
    lidar = reading(1000, FUSION_LIDAR_MAX_AGE_US + 1U);
    CHECK(!fusion_lidar_usable(&lidar));
    altitude = fusion_altitude(&lidar, NULL);
    NEAR(altitude.height_m, 0.0, 0.0);
    CHECK(!altitude.from_lidar);
    CHECK(fusion_altitude(&lidar, &pad).from_pad && !fusion_altitude(&lidar, &pad).lidar_implausible);
    lidar = reading(FUSION_LIDAR_MAX_MM + 1U, 0);
    CHECK(!fusion_lidar_usable(&lidar));
    lidar = reading(FUSION_LIDAR_MIN_MM - 1U, 0);
    CHECK(!fusion_lidar_usable(&lidar));
    lidar = reading(1000, 0);
    lidar.valid = false;
    CHECK(!fusion_lidar_usable(&lidar));
}

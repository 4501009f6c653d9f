// SPDX-License-Identifier: Apache-2.0
// One altitude from two: the LiDAR's and the one that the pad's known size implies.
#ifndef TOUCHDOWN_FUSION_H
#define TOUCHDOWN_FUSION_H

#include <stdbool.h>
#include <stdint.h>

#include "detect.h"

// MAX_AGE_US of rtl/lidar_pwm. VALID and the age are two registers: between the reads a reading can grow too old.
#define FUSION_LIDAR_MAX_AGE_US 60000U
#define FUSION_LIDAR_MIN_MM 50U
#define FUSION_LIDAR_MAX_MM 40000U

struct lidar_reading {
    bool valid; // the hardware calls it valid and fresh
    uint32_t distance_mm;
    uint32_t age_us;
};

struct altitude {
    double height_m; // camera above the pad (or ground) along body down; 0 = not known
    double pad_scale; // what the pad's place is to be multiplied by; 1 = its size alone counts
    bool from_lidar;
    bool from_pad;
    bool lidar_implausible; // a fresh reading contradicts the pad's size and was left out
};

// True when the reading may be used at all: valid, fresh, within the sensor's range.
bool fusion_lidar_usable(const struct lidar_reading *lidar);

// `pad` is NULL when no pad is in sight.
struct altitude fusion_altitude(const struct lidar_reading *lidar, const struct pad_estimate *pad);

#endif

// SPDX-License-Identifier: Apache-2.0
#include "fusion.h"

#include <math.h>
#include <stddef.h>

#define METRES_PER_MM 0.001

// Standard deviations. LIDAR-Lite v3: 2.5 cm at any distance. Pad: the focal
// length is known to 1 or 2 %, tilt and lens add as much.
#define LIDAR_SIGMA_M 0.025
#define PAD_SIGMA_RATIO 0.03

// A beam that meets grass, a leg or the edge of a step is wrong by more than noise.
#define PLAUSIBLE_DIFFERENCE_RATIO 0.25
#define PLAUSIBLE_DIFFERENCE_M 0.10

bool fusion_lidar_usable(const struct lidar_reading *lidar)
{
    return lidar->valid && lidar->age_us <= FUSION_LIDAR_MAX_AGE_US && lidar->distance_mm >= FUSION_LIDAR_MIN_MM &&
           lidar->distance_mm <= FUSION_LIDAR_MAX_MM;
}

struct altitude fusion_altitude(const struct lidar_reading *lidar, const struct pad_estimate *pad)
{
    struct altitude altitude = {.height_m = 0.0, .from_lidar = false, .from_pad = false, .lidar_implausible = false};
    const bool usable = fusion_lidar_usable(lidar);
    const double lidar_m = (double)lidar->distance_mm * METRES_PER_MM;

    if (pad == NULL) {
        altitude.from_lidar = usable;
        altitude.height_m = usable ? lidar_m : 0.0;
        return altitude;
    }
    altitude.from_pad = true;
    altitude.height_m = pad->height_m;
    if (!usable) {
        return altitude;
    }
    const double tolerance_m = PLAUSIBLE_DIFFERENCE_M + PLAUSIBLE_DIFFERENCE_RATIO * pad->height_m;
    if (fabs(lidar_m - pad->height_m) > tolerance_m) {
        // The pad's size is known and was just seen; what the beam hit is not.
        altitude.lidar_implausible = true;
        return altitude;
    }
    const double pad_sigma_m = PAD_SIGMA_RATIO * pad->height_m;
    const double lidar_weight = 1.0 / (LIDAR_SIGMA_M * LIDAR_SIGMA_M);
    const double pad_weight = 1.0 / (pad_sigma_m * pad_sigma_m);
    altitude.from_lidar = true;
    altitude.height_m = (lidar_m * lidar_weight + pad->height_m * pad_weight) / (lidar_weight + pad_weight);
    return altitude;
}

// SPDX-License-Identifier: Apache-2.0
#include "fusion.h"

#include <math.h>
#include <stddef.h>

#define METRES_PER_MM 0.001

// Standard deviations. LIDAR-Lite v3: 2.5 cm at any distance. Pad: the focal
// length is known to 1 or 2 %, tilt and lens add as much.
#define LIDAR_SIGMA_M 0.025
#define PAD_SIGMA_RATIO 0.03
// Where the ground below the camera and the pad beside it are the same plane, its tilt is known to this much.
#define LEAN_SIGMA 0.025

// A beam that meets grass, a leg or the edge of a step is wrong by more than noise.
#define PLAUSIBLE_DIFFERENCE_RATIO 0.25
#define PLAUSIBLE_DIFFERENCE_M 0.10

bool fusion_lidar_usable(const struct lidar_reading *lidar)
{
    return lidar->valid && lidar->age_us <= FUSION_LIDAR_MAX_AGE_US && lidar->distance_mm >= FUSION_LIDAR_MIN_MM &&
           lidar->distance_mm <= FUSION_LIDAR_MAX_MM;
}

static double weighted(double a, double sigma_a, double b, double sigma_b)
{
    const double weight_a = 1.0 / (sigma_a * sigma_a);
    const double weight_b = 1.0 / (sigma_b * sigma_b);

    return (a * weight_a + b * weight_b) / (weight_a + weight_b);
}

struct altitude fusion_altitude(const struct lidar_reading *lidar, const struct pad_estimate *pad)
{
    struct altitude altitude = {.height_m = 0.0, .pad_scale = 1.0};
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
    // From the pad to the point that the beam meets, or back, the plane's tilt adds its part.
    const double lean_m = LEAN_SIGMA * hypot(pad->right_m, pad->forward_m);
    const double size_m = PAD_SIGMA_RATIO * pad->height_m;
    altitude.from_lidar = true;
    altitude.height_m = weighted(lidar_m, LIDAR_SIGMA_M, pad->height_m, hypot(size_m, lean_m));
    altitude.pad_scale = weighted(lidar_m, hypot(LIDAR_SIGMA_M, lean_m), pad->height_m, size_m) / pad->height_m;
    return altitude;
}

// SPDX-License-Identifier: Apache-2.0
#include "tracker.h"

#include <math.h>
#include <string.h>

#define US_PER_S 1e6
// A track may bridge and refuse only once so many detections have agreed.
#define HITS_TO_CONFIRM 6U
#define BRIDGED_MAX 2U
// So many detections elsewhere, one after the other, are the pad after all.
#define REFUSED_MAX 3U
#define GAP_MAX_US 100000U

// How far a multicopter can pull away from constant velocity; tilting counts too, as the axes are the camera's.
static const double acceleration[TRACK_QUANTITIES] = {6.0, 6.0, 6.0, 300.0};
#define START_RATE_M_S 2.0
#define START_RATE_DEG_S 90.0
// What a single detection is good for.
#define PLACE_SIGMA 0.004 // of the depth
#define PLACE_SIGMA_M 0.002
#define ANGLE_SIGMA_DEG 0.7
#define GATE_SIGMA 6.0

void tracker_init(struct tracker *tracker)
{
    memset(tracker, 0, sizeof *tracker);
}

bool tracker_has_begun(const struct tracker *tracker)
{
    return tracker->hits == 1U;
}

static double turned(double degrees)
{
    return degrees - 360.0 * floor((degrees + 180.0) / 360.0);
}

static double sigma_of(int quantity, const struct pad_estimate *pad)
{
    return quantity == TRACK_ANGLE_DEG ? ANGLE_SIGMA_DEG : PLACE_SIGMA * pad->depth_m + PLACE_SIGMA_M;
}

static double measured(int quantity, const struct pad_estimate *pad)
{
    const double values[TRACK_QUANTITIES] = {pad->right_m, pad->forward_m, pad->depth_m, pad->angle_deg};

    return values[quantity];
}

static void begin(struct tracker *tracker, const struct pad_estimate *pad)
{
    for (int i = 0; i < TRACK_QUANTITIES; i++) {
        const double sigma = sigma_of(i, pad);
        const double rate = i == TRACK_ANGLE_DEG ? START_RATE_DEG_S : START_RATE_M_S;
        tracker->axes[i] = (struct track_axis){
            .value = measured(i, pad), .variance = sigma * sigma, .rate_variance = rate * rate};
    }
    tracker->hits = 1U;
    tracker->bridged = 0U;
    tracker->refused = 0U;
    tracker->height_less_depth_m = pad->height_m - pad->depth_m;
}

static void predict(struct track_axis *axis, double seconds, double pull)
{
    // White acceleration that is constant for the step.
    const double noise = pull * pull * seconds * seconds;

    axis->value += axis->rate * seconds;
    axis->variance += seconds * (2.0 * axis->covariance + seconds * axis->rate_variance);
    axis->variance += noise * seconds * seconds / 4.0;
    axis->covariance += seconds * axis->rate_variance + noise * seconds / 2.0;
    axis->rate_variance += noise;
}

static double innovation(const struct tracker *tracker, int quantity, const struct pad_estimate *pad)
{
    const double difference = measured(quantity, pad) - tracker->axes[quantity].value;

    return quantity == TRACK_ANGLE_DEG ? turned(difference) : difference;
}

static bool fits(const struct tracker *tracker, const struct pad_estimate *pad)
{
    for (int i = 0; i < TRACK_QUANTITIES; i++) {
        const double sigma = sigma_of(i, pad);
        const double allowed = tracker->axes[i].variance + sigma * sigma;
        const double difference = innovation(tracker, i, pad);
        if (!(difference * difference <= GATE_SIGMA * GATE_SIGMA * allowed)) {
            return false;
        }
    }
    return true;
}

static void correct(struct tracker *tracker, const struct pad_estimate *pad)
{
    for (int i = 0; i < TRACK_QUANTITIES; i++) {
        struct track_axis *axis = &tracker->axes[i];
        const double sigma = sigma_of(i, pad);
        const double difference = innovation(tracker, i, pad);
        const double gain = axis->variance / (axis->variance + sigma * sigma);
        const double rate_gain = axis->covariance / (axis->variance + sigma * sigma);
        axis->value += gain * difference;
        axis->rate += rate_gain * difference;
        axis->rate_variance -= rate_gain * axis->covariance;
        axis->covariance *= 1.0 - gain;
        axis->variance *= 1.0 - gain;
    }
    tracker->axes[TRACK_ANGLE_DEG].value = turned(tracker->axes[TRACK_ANGLE_DEG].value);
    tracker->hits += tracker->hits < HITS_TO_CONFIRM ? 1U : 0U;
    tracker->bridged = 0U;
    tracker->refused = 0U;
    tracker->height_less_depth_m = pad->height_m - pad->depth_m;
}

static enum track_result bridge(struct tracker *tracker, const struct camera *camera, struct pad_estimate *pad)
{
    const double depth_m = tracker->axes[TRACK_DEPTH_M].value;

    if (tracker->hits < HITS_TO_CONFIRM || tracker->bridged >= BRIDGED_MAX || !(depth_m > 0.0) ||
        !(depth_m + tracker->height_less_depth_m > 0.0)) {
        tracker->hits = 0U;
        return TRACK_NONE;
    }
    tracker->bridged++;
    memset(pad, 0, sizeof *pad);
    pad->right_m = tracker->axes[TRACK_RIGHT_M].value;
    pad->forward_m = tracker->axes[TRACK_FORWARD_M].value;
    pad->depth_m = depth_m;
    pad->height_m = depth_m + tracker->height_less_depth_m;
    pad->angle_deg = turned(tracker->axes[TRACK_ANGLE_DEG].value);
    const struct camera_ray ray = {.right = pad->right_m / depth_m, .forward = pad->forward_m / depth_m};
    camera_project(camera, &ray, &pad->x_px, &pad->y_px);
    return TRACK_BRIDGED;
}

enum track_result tracker_update(struct tracker *tracker, const struct camera *camera, uint64_t frame_us, bool found,
                                 struct pad_estimate *pad)
{
    const uint64_t gap_us = frame_us - tracker->last_us;

    if (tracker->hits == 0U || frame_us <= tracker->last_us || gap_us > GAP_MAX_US) {
        tracker->hits = 0U;
    } else {
        for (int i = 0; i < TRACK_QUANTITIES; i++) {
            predict(&tracker->axes[i], (double)gap_us / US_PER_S, acceleration[i]);
        }
    }
    tracker->last_us = frame_us;
    if (!found) {
        return tracker->hits > 0U ? bridge(tracker, camera, pad) : TRACK_NONE;
    }
    if (tracker->hits == 0U) {
        begin(tracker, pad);
        return TRACK_MEASURED;
    }
    if (fits(tracker, pad)) {
        correct(tracker, pad);
        return TRACK_MEASURED;
    }
    tracker->refused++;
    if (tracker->hits < HITS_TO_CONFIRM || tracker->refused >= REFUSED_MAX) {
        begin(tracker, pad);
        return TRACK_MEASURED;
    }
    return bridge(tracker, camera, pad);
}

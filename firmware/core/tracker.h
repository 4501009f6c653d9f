// SPDX-License-Identifier: Apache-2.0
// Follows the pad from frame to frame: drops a detection that cannot be the same
// pad, and bridges a frame or two without one. It never starts a target itself,
// and what was measured goes out as it was measured, without a filter's delay.
#ifndef TOUCHDOWN_TRACKER_H
#define TOUCHDOWN_TRACKER_H

#include <stdbool.h>
#include <stdint.h>

#include "detect.h"

// A place and its rate, each axis for itself (Kalman filter, constant velocity).
struct track_axis {
    double value;
    double rate;
    double variance;
    double covariance;
    double rate_variance;
};

enum track_quantity { TRACK_RIGHT_M, TRACK_FORWARD_M, TRACK_DEPTH_M, TRACK_ANGLE_DEG, TRACK_QUANTITIES };

struct tracker {
    struct track_axis axes[TRACK_QUANTITIES];
    uint64_t last_us;
    uint32_t hits;    // detections since the track began
    uint32_t bridged; // frames since the last of them
    uint32_t refused; // detections in a row that did not fit
    double height_less_depth_m;
};

enum track_result {
    TRACK_NONE,     // nothing to report
    TRACK_MEASURED, // the detection, as it is
    TRACK_BRIDGED   // what the track predicts; written into the estimate
};

void tracker_init(struct tracker *tracker);

// True when the newest frame's detection began a track: it need not be the pad that was followed before.
bool tracker_has_begun(const struct tracker *tracker);

// One frame: `found` says whether `pad` holds a detection.
enum track_result tracker_update(struct tracker *tracker, const struct camera *camera, uint64_t frame_us, bool found,
                                 struct pad_estimate *pad);

#endif

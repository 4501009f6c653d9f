// SPDX-License-Identifier: Apache-2.0
// What Touchdown listens to: TIMESYNC, by which an autopilot turns the time_usec
// of LANDING_TARGET into its own time (PX4 does), and ATTITUDE, which says how
// the ground lies before the camera.
#ifndef TOUCHDOWN_MAVLINK_IN_H
#define TOUCHDOWN_MAVLINK_IN_H

#include <stdint.h>

#include <common/mavlink.h>

struct mavlink_in {
    mavlink_message_t assembling;
    mavlink_status_t status;
};

enum mavlink_in_kind { MAVLINK_IN_NOTHING, MAVLINK_IN_TIMESYNC_REQUEST, MAVLINK_IN_ATTITUDE };

struct mavlink_in_message {
    int64_t request_ns; // of a TIMESYNC request
    float roll_rad;     // of an ATTITUDE; right side down is positive
    float pitch_rad;    // nose up is positive
};

void mavlink_in_init(struct mavlink_in *in);

// Takes one byte. Says what it completes; the fields of that kind are then set.
enum mavlink_in_kind mavlink_in_byte(struct mavlink_in *in, uint8_t byte, struct mavlink_in_message *message);

#endif

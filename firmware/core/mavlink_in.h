// SPDX-License-Identifier: Apache-2.0
// The one thing that Touchdown listens to: TIMESYNC. An autopilot that asks can
// turn the time_usec of LANDING_TARGET into its own time (PX4 does).
#ifndef TOUCHDOWN_MAVLINK_IN_H
#define TOUCHDOWN_MAVLINK_IN_H

#include <stdbool.h>
#include <stdint.h>

#include <common/mavlink.h>

struct mavlink_in {
    mavlink_message_t assembling;
    mavlink_status_t status;
};

void mavlink_in_init(struct mavlink_in *in);

// Takes one byte. True when it completes a TIMESYNC request, whose
// timestamp is then in `request_ns`.
bool mavlink_in_timesync_request(struct mavlink_in *in, uint8_t byte, int64_t *request_ns);

#endif

// SPDX-License-Identifier: Apache-2.0
// Flies the landing: joins phases, autopilot, steering and what the ground wants.
#ifndef TOUCHDOWN_FLIGHT_H
#define TOUCHDOWN_FLIGHT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "attitude.h"
#include "autopilot.h"
#include "detect.h"
#include "fusion.h"
#include "landing.h"
#include "links.h"
#include "mavlink_in.h"
#include "parameters.h"

#define FLIGHT_LOG_ROWS 32U

// A step from phase to phase, as the log holds it.
struct flight_log_row {
    uint64_t time_us;
    enum landing_phase from;
    enum landing_phase to;
    const char *reason;
};

struct flight {
    struct autopilot autopilot;
    struct landing landing;
    struct parameters parameters;
    struct landing_known known;
    uint32_t switch_channel; // of which switch_known and switch_on are; 0 = none
    bool switch_known;
    bool switch_on;
    uint64_t next_velocity_us;
    uint64_t next_disarm_us;
    struct flight_log_row log[FLIGHT_LOG_ROWS];
    uint32_t logged;       // since start; the newest FLIGHT_LOG_ROWS are kept
    uint32_t log_said;     // next row of a report of the log; beyond `logged`, none is under way
    uint32_t params_said;  // the same for the list of parameters
    uint64_t next_said_us;
};

// `rates` are those of the autopilot's wire.
void flight_init(struct flight *flight, const struct rates *rates, uint64_t now_us);

// What arrived on a link; messages that are not of the flight are left alone.
void flight_on_message(struct flight *flight, struct links *links, enum app_link link,
                       const struct mavlink_in_message *message, uint64_t now_us);

// The pad in the next frame need not be the one before: it has to be seen in a row of frames of its own.
void flight_on_new_track(struct flight *flight);

// Each good record: `pad` is what was measured in it, NULL when none was; `exposed_us` is when.
void flight_on_frame(struct flight *flight, const struct attitude *attitude, const struct pad_estimate *pad,
                     const struct altitude *altitude, uint64_t exposed_us, uint64_t now_us);

// To be called with each tick. `lidar` is NULL without one.
void flight_tick(struct flight *flight, struct links *links, const struct attitude *attitude,
                 const struct lidar_reading *lidar, uint64_t now_us);

#endif

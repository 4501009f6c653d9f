// SPDX-License-Identifier: Apache-2.0
// A landing joined together, and all around it: autopilot, ground, frames, LiDAR and time.
#ifndef TOUCHDOWN_TEST_FLIGHT_RIG_H
#define TOUCHDOWN_TEST_FLIGHT_RIG_H

#include "flight.h"
#include "test_wire.h"

#define SECOND 1000000U
#define TICK_US 10000U
#define GUIDED 4U
#define LOITER 5U
#define LAND 9U
#define BRAKE 17U

struct rig {
    struct flight flight;
    struct links links;
    struct attitude attitude;
    struct lidar_reading lidar;
    uint64_t now_us;
};

extern struct rig rig;

void rig_give(enum app_link link, struct mavlink_in_message message, uint8_t component);
void rig_of_autopilot(struct mavlink_in_message message);
void rig_heartbeat(uint32_t mode, bool armed);
void rig_start(void);
void rig_frame(double forward_m, double down_m, double angle_deg, bool lidar_agrees);

// Time with an autopilot in `mode`, frames with the pad ahead and below, and ticks.
void rig_fly(uint64_t for_us, uint32_t mode, double forward_m, double down_m);

void rig_ask(uint16_t number);
const mavlink_message_t *rig_newest_velocity(void);
int rig_velocities(void);
bool rig_stands(const mavlink_message_t *velocity);

// Commands of a kind to the autopilot; the first parameter but one is that of the newest.
int rig_commands(uint16_t number, float *second);

// From the start until it steers, with all telemetry there.
void rig_engage(void);

#endif

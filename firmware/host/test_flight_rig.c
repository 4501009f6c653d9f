// SPDX-License-Identifier: Apache-2.0
#include "test_flight_rig.h"

#include "test.h"

struct rig rig;

void rig_give(enum app_link link, struct mavlink_in_message message, uint8_t component)
{
    message.system = 1U;
    message.component = component;
    flight_on_message(&rig.flight, &rig.links, link, &message, rig.now_us);
}

void rig_of_autopilot(struct mavlink_in_message message)
{
    rig_give(APP_LINK_AUTOPILOT, message, (uint8_t)MAV_COMP_ID_AUTOPILOT1);
}

void rig_heartbeat(uint32_t mode, bool armed)
{
    struct mavlink_in_message message = {.kind = MAVLINK_IN_HEARTBEAT};

    message.as.heartbeat = (struct mavlink_in_heartbeat){.custom_mode = mode,
                                                         .type = (uint8_t)MAV_TYPE_QUADROTOR,
                                                         .autopilot = (uint8_t)MAV_AUTOPILOT_ARDUPILOTMEGA,
                                                         .base_mode = armed ? (uint8_t)MAV_MODE_FLAG_SAFETY_ARMED : 0U};
    rig_of_autopilot(message);
}

void rig_start(void)
{
    wire_open(&rig.links);
    rig.now_us = 10U * (uint64_t)SECOND;
    flight_init(&rig.flight, rates_of(RATES_AUTOPILOT, 0U), rig.now_us);
    rig.attitude = (struct attitude){.known = false};
    rig.lidar = (struct lidar_reading){.valid = true, .distance_mm = 1500U};
}

void rig_frame(double forward_m, double down_m, double angle_deg, bool lidar_agrees)
{
    const struct pad_estimate pad = {
        .forward_m = forward_m / 2.0, .depth_m = down_m / 2.0, .height_m = down_m / 2.0, .angle_deg = angle_deg};
    const struct altitude altitude = {
        .height_m = down_m, .pad_scale = down_m / pad.height_m, .lidar_implausible = !lidar_agrees};

    flight_on_frame(&rig.flight, &rig.attitude, &pad, &altitude, rig.now_us, rig.now_us);
}

void rig_fly(uint64_t for_us, uint32_t mode, double forward_m, double down_m)
{
    const uint64_t end_us = rig.now_us + for_us;

    while (rig.now_us < end_us) {
        rig.now_us += TICK_US;
        rig_heartbeat(mode, true);
        attitude_set(&rig.attitude, 0.0, 0.0, rig.now_us, rig.now_us);
        rig.lidar.distance_mm = (uint32_t)(1000.0 * down_m);
        rig_frame(forward_m, down_m, 0.0, true);
        flight_tick(&rig.flight, &rig.links, &rig.attitude, &rig.lidar, rig.now_us);
    }
}

void rig_ask(uint16_t number)
{
    struct mavlink_in_message message = {.kind = MAVLINK_IN_COMMAND};

    message.as.command.command = number;
    rig_give(APP_LINK_GROUND, message, WIRE_GROUND_COMPONENT);
}

const mavlink_message_t *rig_newest_velocity(void)
{
    return wire_last(APP_LINK_AUTOPILOT, MAVLINK_MSG_ID_SET_POSITION_TARGET_LOCAL_NED);
}

int rig_velocities(void)
{
    return wire_count(APP_LINK_AUTOPILOT, MAVLINK_MSG_ID_SET_POSITION_TARGET_LOCAL_NED);
}

bool rig_stands(const mavlink_message_t *velocity)
{
    return mavlink_msg_set_position_target_local_ned_get_vx(velocity) == 0.0F &&
           mavlink_msg_set_position_target_local_ned_get_vy(velocity) == 0.0F &&
           mavlink_msg_set_position_target_local_ned_get_vz(velocity) == 0.0F &&
           mavlink_msg_set_position_target_local_ned_get_yaw_rate(velocity) == 0.0F;
}

int rig_commands(uint16_t number, float *second)
{
    const mavlink_message_t *newest = wire_last(APP_LINK_AUTOPILOT, MAVLINK_MSG_ID_COMMAND_LONG);

    *second = mavlink_msg_command_long_get_param2(newest);
    return mavlink_msg_command_long_get_command(newest) == number
               ? wire_count(APP_LINK_AUTOPILOT, MAVLINK_MSG_ID_COMMAND_LONG)
               : 0;
}

void rig_engage(void)
{
    rig_start();
    for (size_t i = 0; i < AUTOPILOT_STREAMS; i++) {
        rig.flight.autopilot.next_stream_us[i] = UINT64_MAX;
    }
    rig_fly(SECOND, LOITER, 0.3, 1.8);
    CHECK(rig_velocities() == 0 && rig.flight.logged == 0U);
    rig_ask((uint16_t)MAV_CMD_NAV_LAND);
    wire_clear();
}

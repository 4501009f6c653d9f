// SPDX-License-Identifier: Apache-2.0
#include <math.h>
#include <string.h>

#include "mavlink_out.h"
#include "test.h"
#include "test_wire.h"

static struct mavlink_out out;
static uint8_t bytes[MAVLINK_OUT_MAX_BYTES];

static void test_heartbeat(void)
{
    test_case("a heartbeat says whether all is well");
    mavlink_message_t message = wire_decode(bytes, mavlink_out_heartbeat(&out, true, bytes));
    CHECK(mavlink_msg_heartbeat_get_system_status(&message) == (uint8_t)MAV_STATE_ACTIVE);
    CHECK(message.sysid == MAVLINK_OUT_SYSTEM_ID && message.compid == MAVLINK_OUT_COMPONENT_ID);
    const uint8_t sequence = message.seq;
    message = wire_decode(bytes, mavlink_out_heartbeat(&out, false, bytes));
    CHECK(mavlink_msg_heartbeat_get_system_status(&message) == (uint8_t)MAV_STATE_CRITICAL);
    CHECK(message.seq == (uint8_t)(sequence + 1U));
}

static uint16_t distance_cm(bool usable, uint32_t distance_mm, uint8_t quality)
{
    const mavlink_message_t message =
        wire_decode(bytes, mavlink_out_distance_sensor(&out, 5U, usable, distance_mm, bytes));

    CHECK(mavlink_msg_distance_sensor_get_signal_quality(&message) == quality);
    return mavlink_msg_distance_sensor_get_current_distance(&message);
}

static void test_distance(void)
{
    test_case("a distance is rounded; without one it is out of range");
    CHECK(distance_cm(true, 1234U, 100U) == 123U);
    CHECK(distance_cm(true, 1235U, 100U) == 124U);
    CHECK(distance_cm(true, 40000U, 100U) == 4000U);
    CHECK(distance_cm(true, 40005U, 100U) == 4001U);
    CHECK(distance_cm(true, UINT32_MAX, 100U) == 4001U);
    CHECK(distance_cm(false, 1234U, 1U) == 4001U);
}

static void test_target(void)
{
    struct mavlink_out_target target = {
        .time_us = 77U, .right = 0.5, .forward = 0.25, .height_m = 2.0, .pad_width_m = 0.25};

    test_case("a target as two angles, slant and size");
    mavlink_message_t message = wire_decode(bytes, mavlink_out_landing_target(&out, &target, bytes));
    const double slant_m = 2.0 * sqrt(1.0 + 0.25 + 0.0625);
    CHECK(mavlink_msg_landing_target_get_time_usec(&message) == 77U);
    NEAR((double)mavlink_msg_landing_target_get_angle_x(&message), atan(0.5), 1e-6);
    NEAR((double)mavlink_msg_landing_target_get_angle_y(&message), -atan(0.25), 1e-6);
    NEAR((double)mavlink_msg_landing_target_get_distance(&message), slant_m, 1e-6);
    NEAR((double)mavlink_msg_landing_target_get_size_x(&message), 2.0 * atan(0.125 / slant_m), 1e-6);
    test_case("no height: no size, and no division by it");
    target.height_m = 0.0;
    message = wire_decode(bytes, mavlink_out_landing_target(&out, &target, bytes));
    CHECK(mavlink_msg_landing_target_get_size_x(&message) == 0.0F);
}

static void test_array(void)
{
    float values[60];
    float got[58];
    char name[10];

    test_case("an array takes nine letters and 58 values");
    for (int i = 0; i < 60; i++) {
        values[i] = (float)i;
    }
    mavlink_message_t message =
        wire_decode(bytes, mavlink_out_float_array(&out, 9U, 3U, "NINE_LETTERS", values, 60U, bytes));
    CHECK(mavlink_msg_debug_float_array_get_name(&message, name) == 10U);
    CHECK(memcmp(name, "NINE_LETT", 10U) == 0);
    (void)mavlink_msg_debug_float_array_get_data(&message, got);
    CHECK(got[0] == 0.0F && got[57] == 57.0F);
    message = wire_decode(bytes, mavlink_out_float_array(&out, 9U, 3U, "PAD", values, 2U, bytes));
    (void)mavlink_msg_debug_float_array_get_data(&message, got);
    CHECK(got[1] == 1.0F && got[2] == 0.0F);
}

static void test_text(void)
{
    static const char long_text[] = "what is longer than the fifty letters of a message is cut off";
    char got[51] = {0};

    test_case("words, and words that are too many");
    mavlink_message_t message =
        wire_decode(bytes, mavlink_out_status_text(&out, MAVLINK_OUT_WARNING, "short", bytes));
    (void)mavlink_msg_statustext_get_text(&message, got);
    CHECK(strcmp(got, "short") == 0 && mavlink_msg_statustext_get_severity(&message) == (uint8_t)MAV_SEVERITY_WARNING);
    message = wire_decode(bytes, mavlink_out_status_text(&out, MAVLINK_OUT_INFO, long_text, bytes));
    (void)mavlink_msg_statustext_get_text(&message, got);
    CHECK(strncmp(got, long_text, 50U) == 0 && got[50] == '\0');
}

static void test_command(void)
{
    const struct mavlink_out_command command = {
        .command = (uint16_t)MAV_CMD_DO_SET_MODE, .confirmation = 3U, .parameters = {1.0F, 2.0F, 3.0F}};
    mavlink_message_t message = wire_decode(bytes, mavlink_out_command(&out, &command, bytes));

    test_case("a command is for the autopilot, an answer for whoever asked");
    CHECK(mavlink_msg_command_long_get_target_system(&message) == 1U);
    CHECK(mavlink_msg_command_long_get_target_component(&message) == (uint8_t)MAV_COMP_ID_AUTOPILOT1);
    CHECK(mavlink_msg_command_long_get_command(&message) == (uint16_t)MAV_CMD_DO_SET_MODE);
    CHECK(mavlink_msg_command_long_get_confirmation(&message) == 3U);
    CHECK(mavlink_msg_command_long_get_param3(&message) == 3.0F);
    CHECK(mavlink_msg_command_long_get_param4(&message) == 0.0F);
    message = wire_decode(bytes, mavlink_out_command_ack(&out, (uint16_t)MAV_CMD_NAV_LAND, (uint8_t)MAV_RESULT_DENIED,
                                                         WIRE_GROUND_SYSTEM, WIRE_GROUND_COMPONENT, bytes));
    CHECK(mavlink_msg_command_ack_get_command(&message) == (uint16_t)MAV_CMD_NAV_LAND);
    CHECK(mavlink_msg_command_ack_get_result(&message) == (uint8_t)MAV_RESULT_DENIED);
    CHECK(mavlink_msg_command_ack_get_target_system(&message) == WIRE_GROUND_SYSTEM);
    CHECK(mavlink_msg_command_ack_get_target_component(&message) == WIRE_GROUND_COMPONENT);
}

static void test_velocity(void)
{
    const struct mavlink_out_velocity velocity = {
        .forward_m_s = 0.5, .right_m_s = -0.25, .down_m_s = 0.125, .yaw_rate_rad_s = 0.75};
    const mavlink_message_t message = wire_decode(bytes, mavlink_out_velocity(&out, 99U, &velocity, bytes));

    test_case("a velocity, and nothing else that counts");
    CHECK(mavlink_msg_set_position_target_local_ned_get_time_boot_ms(&message) == 99U);
    CHECK(mavlink_msg_set_position_target_local_ned_get_coordinate_frame(&message) == (uint8_t)MAV_FRAME_BODY_NED);
    CHECK(mavlink_msg_set_position_target_local_ned_get_type_mask(&message) == 0x05C7U);
    CHECK(mavlink_msg_set_position_target_local_ned_get_vx(&message) == 0.5F);
    CHECK(mavlink_msg_set_position_target_local_ned_get_vy(&message) == -0.25F);
    CHECK(mavlink_msg_set_position_target_local_ned_get_vz(&message) == 0.125F);
    CHECK(mavlink_msg_set_position_target_local_ned_get_yaw_rate(&message) == 0.75F);
}

static void test_answers(void)
{
    char name[17] = {0};

    test_case("a parameter with the longest name, and the time");
    mavlink_message_t message =
        wire_decode(bytes, mavlink_out_parameter(&out, "SIXTEEN_LETTERS_", 0.25F, 2U, 11U, bytes));
    (void)mavlink_msg_param_value_get_param_id(&message, name);
    CHECK(strcmp(name, "SIXTEEN_LETTERS_") == 0 && mavlink_msg_param_value_get_param_value(&message) == 0.25F);
    CHECK(mavlink_msg_param_value_get_param_index(&message) == 2U);
    CHECK(mavlink_msg_param_value_get_param_count(&message) == 11U);
    CHECK(mavlink_msg_param_value_get_param_type(&message) == (uint8_t)MAV_PARAM_TYPE_REAL32);
    message = wire_decode(bytes, mavlink_out_timesync_reply(&out, 3000U, -7, bytes));
    CHECK(mavlink_msg_timesync_get_tc1(&message) == 3000000 && mavlink_msg_timesync_get_ts1(&message) == -7);
}

void test_mavlink_out(void)
{
    memset(&out, 0, sizeof out);
    test_heartbeat();
    test_distance();
    test_target();
    test_array();
    test_text();
    test_command();
    test_velocity();
    test_answers();
}

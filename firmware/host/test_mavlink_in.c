// SPDX-License-Identifier: Apache-2.0
#include <string.h>

#include "mavlink_out.h"
#include "test.h"
#include "test_wire.h"

#define US MAVLINK_OUT_SYSTEM_ID, MAVLINK_OUT_COMPONENT_ID
#define FROM_AUTOPILOT 1, MAV_COMP_ID_AUTOPILOT1

static mavlink_message_t sent;
// As long as the fields that they are copied to.
static const char speed[MAVLINK_IN_PARAM_NAME_CHARS] = "TD_SPEED";
static const char nameless[MAVLINK_IN_PARAM_NAME_CHARS] = "";
static const char longest[MAVLINK_IN_PARAM_NAME_CHARS] = "SIXTEEN_LETTERS_";
static const char words[MAVLINK_MSG_STATUSTEXT_FIELD_TEXT_LEN] = "PreArm: nothing for us";

static enum mavlink_in_kind kind_of_sent(void)
{
    return wire_receive(&sent).kind;
}

static void test_of_the_autopilot(void)
{
    struct mavlink_in_message got;

    test_case("what an autopilot says");
    mavlink_msg_heartbeat_pack(FROM_AUTOPILOT, &sent, MAV_TYPE_QUADROTOR, MAV_AUTOPILOT_PX4,
                               MAV_MODE_FLAG_SAFETY_ARMED, 0x12345678U, MAV_STATE_ACTIVE);
    got = wire_receive(&sent);
    CHECK(got.kind == MAVLINK_IN_HEARTBEAT && got.system == 1U && got.component == (uint8_t)MAV_COMP_ID_AUTOPILOT1);
    CHECK(got.as.heartbeat.type == (uint8_t)MAV_TYPE_QUADROTOR && got.as.heartbeat.custom_mode == 0x12345678U);
    CHECK(got.as.heartbeat.autopilot == (uint8_t)MAV_AUTOPILOT_PX4);
    CHECK(got.as.heartbeat.base_mode == (uint8_t)MAV_MODE_FLAG_SAFETY_ARMED);
    mavlink_msg_attitude_pack(FROM_AUTOPILOT, &sent, 7U, 0.25F, -0.5F, 3.0F, 1.0F, 2.0F, 3.0F);
    got = wire_receive(&sent);
    CHECK(got.kind == MAVLINK_IN_ATTITUDE && got.as.attitude.roll_rad == 0.25F && got.as.attitude.pitch_rad == -0.5F);
    mavlink_msg_sys_status_pack(FROM_AUTOPILOT, &sent, 0U, 0U, 0U, 0U, 12000U, -1, 37, 0U, 0U, 0U, 0U, 0U, 0U, 0U, 0U,
                                0U);
    got = wire_receive(&sent);
    CHECK(got.kind == MAVLINK_IN_BATTERY && got.as.battery_percent == 37);
    mavlink_msg_extended_sys_state_pack(FROM_AUTOPILOT, &sent, MAV_VTOL_STATE_UNDEFINED, MAV_LANDED_STATE_ON_GROUND);
    got = wire_receive(&sent);
    CHECK(got.kind == MAVLINK_IN_LANDED_STATE && got.as.landed_state == (uint8_t)MAV_LANDED_STATE_ON_GROUND);
    mavlink_msg_rc_channels_pack(FROM_AUTOPILOT, &sent, 0U, 18U, 1001U, 1002U, 1003U, 1004U, 1005U, 1006U, 1007U,
                                 1008U, 1009U, 1010U, 1011U, 1012U, 1013U, 1014U, 1015U, 1016U, 1017U, 1018U, 255U);
    got = wire_receive(&sent);
    CHECK(got.kind == MAVLINK_IN_RC);
    for (uint16_t i = 0; i < MAVLINK_IN_RC_CHANNELS; i++) {
        CHECK(got.as.rc_us[i] == 1001U + i);
    }
    mavlink_msg_statustext_pack(FROM_AUTOPILOT, &sent, MAV_SEVERITY_INFO, words, 0U, 0U);
    CHECK(kind_of_sent() == MAVLINK_IN_NOTHING);
}

static void test_timesync_request(void)
{
    test_case("a request for the time, and an answer");
    mavlink_msg_timesync_pack(FROM_AUTOPILOT, &sent, 0, -5000000000);
    const struct mavlink_in_message got = wire_receive(&sent);
    CHECK(got.kind == MAVLINK_IN_TIMESYNC_REQUEST && got.as.timesync.request_ns == -5000000000);
    mavlink_msg_timesync_pack(FROM_AUTOPILOT, &sent, 1, 2);
    CHECK(kind_of_sent() == MAVLINK_IN_TIMESYNC_ANSWER);
}

static void test_ack(void)
{
    test_case("an acknowledgement for us, for no one in particular, for others");
    mavlink_msg_command_ack_pack(FROM_AUTOPILOT, &sent, MAV_CMD_DO_SET_MODE, MAV_RESULT_DENIED, 0U, 0, US);
    const struct mavlink_in_message got = wire_receive(&sent);
    CHECK(got.kind == MAVLINK_IN_ACK && got.as.ack.command == (uint16_t)MAV_CMD_DO_SET_MODE);
    CHECK(got.as.ack.result == (uint8_t)MAV_RESULT_DENIED);
    mavlink_msg_command_ack_pack(FROM_AUTOPILOT, &sent, MAV_CMD_DO_SET_MODE, MAV_RESULT_DENIED, 0U, 0, 0U, 0U);
    CHECK(kind_of_sent() == MAVLINK_IN_ACK);
    mavlink_msg_command_ack_pack(FROM_AUTOPILOT, &sent, MAV_CMD_DO_SET_MODE, MAV_RESULT_DENIED, 0U, 0, 0U, 7U);
    CHECK(kind_of_sent() == MAVLINK_IN_NOTHING);
    mavlink_msg_command_ack_pack(FROM_AUTOPILOT, &sent, MAV_CMD_DO_SET_MODE, MAV_RESULT_DENIED, 0U, 0, 255U, 190U);
    CHECK(kind_of_sent() == MAVLINK_IN_NOTHING);
}

static void test_command(void)
{
    test_case("a command for us, and one for the autopilot");
    mavlink_msg_command_long_pack(WIRE_GROUND_SYSTEM, WIRE_GROUND_COMPONENT, &sent, US, MAV_CMD_NAV_LAND, 0U, 1.0F,
                                  2.0F, 3.0F, 4.0F, 5.0F, 6.0F, 7.0F);
    const struct mavlink_in_message got = wire_receive(&sent);
    CHECK(got.kind == MAVLINK_IN_COMMAND && got.as.command.command == (uint16_t)MAV_CMD_NAV_LAND);
    CHECK(got.system == WIRE_GROUND_SYSTEM && got.component == WIRE_GROUND_COMPONENT);
    for (int i = 0; i < 7; i++) {
        CHECK(got.as.command.parameters[i] == (float)(i + 1));
    }
    mavlink_msg_command_long_pack(WIRE_GROUND_SYSTEM, WIRE_GROUND_COMPONENT, &sent, FROM_AUTOPILOT, MAV_CMD_NAV_LAND,
                                  0U, 0.0F, 0.0F, 0.0F, 0.0F, 0.0F, 0.0F, 0.0F);
    CHECK(kind_of_sent() == MAVLINK_IN_NOTHING);
    mavlink_msg_command_long_pack(WIRE_GROUND_SYSTEM, WIRE_GROUND_COMPONENT, &sent, 2, MAVLINK_OUT_COMPONENT_ID,
                                  MAV_CMD_NAV_LAND, 0U, 0.0F, 0.0F, 0.0F, 0.0F, 0.0F, 0.0F, 0.0F);
    CHECK(kind_of_sent() == MAVLINK_IN_NOTHING);
}

static void test_parameters_of_the_protocol(void)
{
    struct mavlink_in_message got;

    test_case("parameters by name, by index, all of them, of others");
    mavlink_msg_param_request_read_pack(WIRE_GROUND_SYSTEM, WIRE_GROUND_COMPONENT, &sent, US, speed, -1);
    got = wire_receive(&sent);
    CHECK(got.kind == MAVLINK_IN_PARAM_READ && got.as.param.index == -1 && strcmp(got.as.param.name, "TD_SPEED") == 0);
    mavlink_msg_param_request_read_pack(WIRE_GROUND_SYSTEM, WIRE_GROUND_COMPONENT, &sent, US, nameless, 3);
    got = wire_receive(&sent);
    CHECK(got.kind == MAVLINK_IN_PARAM_READ && got.as.param.index == 3 && got.as.param.name[0] == '\0');
    mavlink_msg_param_request_read_pack(WIRE_GROUND_SYSTEM, WIRE_GROUND_COMPONENT, &sent, FROM_AUTOPILOT, speed,
                                        -1);
    CHECK(kind_of_sent() == MAVLINK_IN_NOTHING);
    mavlink_msg_param_request_list_pack(WIRE_GROUND_SYSTEM, WIRE_GROUND_COMPONENT, &sent, US);
    CHECK(kind_of_sent() == MAVLINK_IN_PARAM_LIST);
    mavlink_msg_param_request_list_pack(WIRE_GROUND_SYSTEM, WIRE_GROUND_COMPONENT, &sent, 1, MAV_COMP_ID_ALL);
    CHECK(kind_of_sent() == MAVLINK_IN_PARAM_LIST);
    mavlink_msg_param_request_list_pack(WIRE_GROUND_SYSTEM, WIRE_GROUND_COMPONENT, &sent, FROM_AUTOPILOT);
    CHECK(kind_of_sent() == MAVLINK_IN_NOTHING);
    mavlink_msg_param_request_list_pack(WIRE_GROUND_SYSTEM, WIRE_GROUND_COMPONENT, &sent, 2, MAV_COMP_ID_ALL);
    CHECK(kind_of_sent() == MAVLINK_IN_NOTHING);
    mavlink_msg_param_set_pack(WIRE_GROUND_SYSTEM, WIRE_GROUND_COMPONENT, &sent, US, longest, 0.25F,
                               MAV_PARAM_TYPE_REAL32);
    got = wire_receive(&sent);
    CHECK(got.kind == MAVLINK_IN_PARAM_SET && got.as.param.value == 0.25F && got.as.param.index == -1);
    CHECK(got.as.param.type == (uint8_t)MAV_PARAM_TYPE_REAL32 && strcmp(got.as.param.name, "SIXTEEN_LETTERS_") == 0);
    mavlink_msg_param_set_pack(WIRE_GROUND_SYSTEM, WIRE_GROUND_COMPONENT, &sent, FROM_AUTOPILOT, speed, 0.25F,
                               MAV_PARAM_TYPE_REAL32);
    CHECK(kind_of_sent() == MAVLINK_IN_NOTHING);
}

static void test_damage(void)
{
    struct mavlink_in in;
    struct mavlink_in_message got;
    uint8_t bytes[MAVLINK_MAX_PACKET_LEN];

    test_case("a flipped bit anywhere: nothing is received, and the next message is, at the latest the second");
    mavlink_msg_attitude_pack(FROM_AUTOPILOT, &sent, 7U, 0.25F, -0.5F, 3.0F, 1.0F, 2.0F, 3.0F);
    const uint16_t size = mavlink_msg_to_send_buffer(bytes, &sent);
    for (uint16_t bit = 0; bit < 8U * size; bit++) {
        int received = 0;

        mavlink_in_init(&in);
        bytes[bit / 8U] ^= (uint8_t)(1U << bit % 8U);
        for (uint16_t i = 0; i < size; i++) {
            CHECK(mavlink_in_byte(&in, bytes[i], &got) == MAVLINK_IN_NOTHING);
        }
        bytes[bit / 8U] ^= (uint8_t)(1U << bit % 8U);
        // A length that was flipped to more swallows what follows.
        for (int again = 0; again < 10; again++) {
            for (uint16_t i = 0; i < size; i++) {
                received += mavlink_in_byte(&in, bytes[i], &got) == MAVLINK_IN_ATTITUDE ? 1 : 0;
            }
        }
        CHECK(received >= (bit / 8U == 1U ? 2 : 9));
    }
}

void test_mavlink_in(void)
{
    test_of_the_autopilot();
    test_timesync_request();
    test_ack();
    test_command();
    test_parameters_of_the_protocol();
    test_damage();
}

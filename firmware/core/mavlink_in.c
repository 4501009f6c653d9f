// SPDX-License-Identifier: Apache-2.0
#include "mavlink_in.h"

#include <string.h>

#include "mavlink_out.h"

_Static_assert(MAVLINK_IN_PARAM_NAME_CHARS == MAVLINK_MSG_PARAM_SET_FIELD_PARAM_ID_LEN, "length of a name");

void mavlink_in_init(struct mavlink_in *in)
{
    memset(in, 0, sizeof *in);
}

static bool is_for_us(uint8_t system, uint8_t component)
{
    return system == MAVLINK_OUT_SYSTEM_ID && component == MAVLINK_OUT_COMPONENT_ID;
}

static enum mavlink_in_kind read_timesync(const mavlink_message_t *received, struct mavlink_in_message *message)
{
    mavlink_timesync_t timesync;

    // MAVLink's single getters read 64 bits from where they lie, aligned or not.
    mavlink_msg_timesync_decode(received, &timesync);
    // tc1 is 0 in a request and the answerer's time in a reply.
    message->as.timesync = (struct mavlink_in_timesync){.request_ns = timesync.ts1, .answer_ns = timesync.tc1};
    return message->as.timesync.answer_ns != 0 ? MAVLINK_IN_TIMESYNC_ANSWER : MAVLINK_IN_TIMESYNC_REQUEST;
}

static enum mavlink_in_kind read_heartbeat(const mavlink_message_t *received, struct mavlink_in_message *message)
{
    message->as.heartbeat = (struct mavlink_in_heartbeat){
        .custom_mode = mavlink_msg_heartbeat_get_custom_mode(received),
        .type = mavlink_msg_heartbeat_get_type(received),
        .autopilot = mavlink_msg_heartbeat_get_autopilot(received),
        .base_mode = mavlink_msg_heartbeat_get_base_mode(received),
    };
    return MAVLINK_IN_HEARTBEAT;
}

static enum mavlink_in_kind read_attitude(const mavlink_message_t *received, struct mavlink_in_message *message)
{
    message->as.attitude = (struct mavlink_in_attitude){
        .time_ms = mavlink_msg_attitude_get_time_boot_ms(received),
        .roll_rad = mavlink_msg_attitude_get_roll(received),
        .pitch_rad = mavlink_msg_attitude_get_pitch(received),
    };
    return MAVLINK_IN_ATTITUDE;
}

static enum mavlink_in_kind read_rc(const mavlink_message_t *received, struct mavlink_in_message *message)
{
    mavlink_rc_channels_t rc;

    mavlink_msg_rc_channels_decode(received, &rc);
    const uint16_t channels[MAVLINK_IN_RC_CHANNELS] = {
        rc.chan1_raw,  rc.chan2_raw,  rc.chan3_raw,  rc.chan4_raw,  rc.chan5_raw,  rc.chan6_raw,
        rc.chan7_raw,  rc.chan8_raw,  rc.chan9_raw,  rc.chan10_raw, rc.chan11_raw, rc.chan12_raw,
        rc.chan13_raw, rc.chan14_raw, rc.chan15_raw, rc.chan16_raw, rc.chan17_raw, rc.chan18_raw};
    memcpy(message->as.rc_us, channels, sizeof channels);
    return MAVLINK_IN_RC;
}

static enum mavlink_in_kind read_ack(const mavlink_message_t *received, struct mavlink_in_message *message)
{
    const uint8_t system = mavlink_msg_command_ack_get_target_system(received);
    const uint8_t component = mavlink_msg_command_ack_get_target_component(received);

    // Older autopilots leave both out.
    if ((system != 0U || component != 0U) && !is_for_us(system, component)) {
        return MAVLINK_IN_NOTHING;
    }
    message->as.ack = (struct mavlink_in_ack){
        .command = mavlink_msg_command_ack_get_command(received),
        .result = mavlink_msg_command_ack_get_result(received),
    };
    return MAVLINK_IN_ACK;
}

static enum mavlink_in_kind read_command(const mavlink_message_t *received, struct mavlink_in_message *message)
{
    mavlink_command_long_t command;

    mavlink_msg_command_long_decode(received, &command);
    if (!is_for_us(command.target_system, command.target_component)) {
        return MAVLINK_IN_NOTHING;
    }
    message->as.command = (struct mavlink_in_command){
        .command = command.command,
        .parameters = {command.param1, command.param2, command.param3, command.param4, command.param5, command.param6,
                       command.param7},
    };
    return MAVLINK_IN_COMMAND;
}

static enum mavlink_in_kind read_param_read(const mavlink_message_t *received, struct mavlink_in_message *message)
{
    if (!is_for_us(mavlink_msg_param_request_read_get_target_system(received),
                   mavlink_msg_param_request_read_get_target_component(received))) {
        return MAVLINK_IN_NOTHING;
    }
    memset(&message->as.param, 0, sizeof message->as.param);
    message->as.param.index = mavlink_msg_param_request_read_get_param_index(received);
    (void)mavlink_msg_param_request_read_get_param_id(received, message->as.param.name);
    return MAVLINK_IN_PARAM_READ;
}

static enum mavlink_in_kind read_param_list(const mavlink_message_t *received)
{
    const uint8_t component = mavlink_msg_param_request_list_get_target_component(received);

    // Ground stations ask all components at once.
    return mavlink_msg_param_request_list_get_target_system(received) == MAVLINK_OUT_SYSTEM_ID &&
                   (component == MAVLINK_OUT_COMPONENT_ID || component == (uint8_t)MAV_COMP_ID_ALL)
               ? MAVLINK_IN_PARAM_LIST
               : MAVLINK_IN_NOTHING;
}

static enum mavlink_in_kind read_param_set(const mavlink_message_t *received, struct mavlink_in_message *message)
{
    if (!is_for_us(mavlink_msg_param_set_get_target_system(received),
                   mavlink_msg_param_set_get_target_component(received))) {
        return MAVLINK_IN_NOTHING;
    }
    memset(&message->as.param, 0, sizeof message->as.param);
    message->as.param.index = -1;
    (void)mavlink_msg_param_set_get_param_id(received, message->as.param.name);
    message->as.param.type = mavlink_msg_param_set_get_param_type(received);
    message->as.param.value = mavlink_msg_param_set_get_param_value(received);
    return MAVLINK_IN_PARAM_SET;
}

static enum mavlink_in_kind read(const mavlink_message_t *received, struct mavlink_in_message *message)
{
    switch (received->msgid) {
    case MAVLINK_MSG_ID_TIMESYNC:
        return read_timesync(received, message);
    case MAVLINK_MSG_ID_HEARTBEAT:
        return read_heartbeat(received, message);
    case MAVLINK_MSG_ID_ATTITUDE:
        return read_attitude(received, message);
    case MAVLINK_MSG_ID_SYS_STATUS:
        message->as.battery_percent = mavlink_msg_sys_status_get_battery_remaining(received);
        return MAVLINK_IN_BATTERY;
    case MAVLINK_MSG_ID_EXTENDED_SYS_STATE:
        message->as.landed_state = mavlink_msg_extended_sys_state_get_landed_state(received);
        return MAVLINK_IN_LANDED_STATE;
    case MAVLINK_MSG_ID_RC_CHANNELS:
        return read_rc(received, message);
    case MAVLINK_MSG_ID_COMMAND_ACK:
        return read_ack(received, message);
    case MAVLINK_MSG_ID_COMMAND_LONG:
        return read_command(received, message);
    case MAVLINK_MSG_ID_PARAM_REQUEST_READ:
        return read_param_read(received, message);
    case MAVLINK_MSG_ID_PARAM_REQUEST_LIST:
        return read_param_list(received);
    case MAVLINK_MSG_ID_PARAM_SET:
        return read_param_set(received, message);
    default:
        return MAVLINK_IN_NOTHING;
    }
}

bool mavlink_in_is_autopilot(const struct mavlink_in_message *message)
{
    return message->system == MAVLINK_OUT_SYSTEM_ID && message->component == (uint8_t)MAV_COMP_ID_AUTOPILOT1;
}

enum mavlink_in_kind mavlink_in_byte(struct mavlink_in *in, uint8_t byte, struct mavlink_in_message *message)
{
    mavlink_message_t received;
    mavlink_status_t status;

    message->kind = MAVLINK_IN_NOTHING;
    if (mavlink_frame_char_buffer(&in->assembling, &in->status, byte, &received, &status) != MAVLINK_FRAMING_OK) {
        return MAVLINK_IN_NOTHING;
    }
    message->system = received.sysid;
    message->component = received.compid;
    message->kind = read(&received, message);
    return message->kind;
}

// SPDX-License-Identifier: Apache-2.0
// What Touchdown listens to. Messages of the autopilot count when they come from
// component 1 of the vehicle; commands and parameters when they are meant for us.
#ifndef TOUCHDOWN_MAVLINK_IN_H
#define TOUCHDOWN_MAVLINK_IN_H

#include <stdbool.h>
#include <stdint.h>

#include <common/mavlink.h>

#define MAVLINK_IN_RC_CHANNELS 18U
#define MAVLINK_IN_PARAM_NAME_CHARS 16U

struct mavlink_in {
    mavlink_message_t assembling;
    mavlink_status_t status;
};

enum mavlink_in_kind {
    MAVLINK_IN_NOTHING,
    MAVLINK_IN_TIMESYNC_REQUEST,
    MAVLINK_IN_TIMESYNC_ANSWER,
    MAVLINK_IN_HEARTBEAT,
    MAVLINK_IN_ATTITUDE,
    MAVLINK_IN_BATTERY,
    MAVLINK_IN_LANDED_STATE,
    MAVLINK_IN_RC,
    MAVLINK_IN_ACK,
    MAVLINK_IN_COMMAND,
    MAVLINK_IN_PARAM_READ,
    MAVLINK_IN_PARAM_LIST,
    MAVLINK_IN_PARAM_SET
};

struct mavlink_in_heartbeat {
    uint32_t custom_mode;
    uint8_t type;
    uint8_t autopilot;
    uint8_t base_mode;
};

struct mavlink_in_timesync {
    int64_t request_ns; // the asker's time
    int64_t answer_ns;  // the answerer's, of an answer
};

struct mavlink_in_attitude {
    uint32_t time_ms; // since the autopilot's start
    float roll_rad;  // right side down is positive
    float pitch_rad; // nose up is positive
};

struct mavlink_in_ack {
    uint16_t command;
    uint8_t result;
};

struct mavlink_in_command {
    uint16_t command;
    float parameters[7];
};

struct mavlink_in_param {
    char name[MAVLINK_IN_PARAM_NAME_CHARS + 1U]; // empty when asked for by index
    int16_t index;                               // -1 = by name
    uint8_t type;                                // MAV_PARAM_TYPE, of PARAM_SET
    float value;                                 // of PARAM_SET
};

struct mavlink_in_message {
    enum mavlink_in_kind kind;
    uint8_t system; // of the sender
    uint8_t component;
    union {
        struct mavlink_in_timesync timesync;
        struct mavlink_in_heartbeat heartbeat;
        struct mavlink_in_attitude attitude;
        int8_t battery_percent; // -1 = not known
        uint8_t landed_state;
        uint16_t rc_us[MAVLINK_IN_RC_CHANNELS]; // 65535 = no such channel
        struct mavlink_in_ack ack;
        struct mavlink_in_command command;
        struct mavlink_in_param param;
    } as;
};

void mavlink_in_init(struct mavlink_in *in);

// True when the autopilot of our vehicle sent it.
bool mavlink_in_is_autopilot(const struct mavlink_in_message *message);

// Takes one byte. Says what it completes, the same as `message->kind`; the fields of that kind are then set.
enum mavlink_in_kind mavlink_in_byte(struct mavlink_in *in, uint8_t byte, struct mavlink_in_message *message);

#endif

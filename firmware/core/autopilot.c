// SPDX-License-Identifier: Apache-2.0
#include "autopilot.h"

#include <stddef.h>
#include <string.h>

#include <common/mavlink.h>

#define PX4_MAIN_SHIFT 16U
#define PX4_SUB_SHIFT 24U
#define PX4_OFFBOARD 6U
#define PX4_AUTO 4U
#define PX4_AUTO_LOITER 3U
#define PX4_AUTO_PRECLAND 9U
#define ARDUCOPTER_GUIDED 4U
#define ARDUCOPTER_LAND 9U
#define ARDUCOPTER_BRAKE 17U
#define STREAM_REQUEST_PERIOD_US 1000000U
#define HEARTBEAT_OFTEN_US 500000U // apart at most where more than one a second comes
// A setpoint must be there before PX4 takes OFFBOARD; ArduPilot does not mind.
#define FIRST_REQUEST_AFTER_US 300000U

struct stream_row {
    uint32_t message;
    uint32_t interval_us; // 0 = the wire's rates say
    uint32_t missing_after_us;
    uint32_t requests_max; // 0 = until it comes
};

static const struct stream_row streams[AUTOPILOT_STREAMS] = {
    [AUTOPILOT_STREAM_ATTITUDE] = {MAVLINK_MSG_ID_ATTITUDE, 0U, 200000U, 0U},
    [AUTOPILOT_STREAM_EXTENDED_SYS_STATE] = {MAVLINK_MSG_ID_EXTENDED_SYS_STATE, 200000U, 1000000U, 0U},
    [AUTOPILOT_STREAM_SYS_STATUS] = {MAVLINK_MSG_ID_SYS_STATUS, 1000000U, 3000000U, 0U},
    [AUTOPILOT_STREAM_RC_CHANNELS] = {MAVLINK_MSG_ID_RC_CHANNELS, 0U, 1000000U, 0U},
    [AUTOPILOT_STREAM_HEARTBEAT] = {MAVLINK_MSG_ID_HEARTBEAT, 200000U, 1000000U, 5U}, // one that cannot goes on at 1 Hz
};

// The code of a mode in HEARTBEAT.custom_mode, of a profile that is known.
static uint32_t code_of(enum autopilot_profile profile, enum landing_mode mode)
{
    static const uint32_t ardupilot[LANDING_MODES] = {
        [LANDING_MODE_STEER] = ARDUCOPTER_GUIDED,
        [LANDING_MODE_LAND] = ARDUCOPTER_LAND,
        [LANDING_MODE_HOLD] = ARDUCOPTER_BRAKE, // LOITER would obey a throttle stick that lies low
    };
    static const uint32_t px4[LANDING_MODES] = {
        [LANDING_MODE_STEER] = PX4_OFFBOARD << PX4_MAIN_SHIFT,
        [LANDING_MODE_LAND] = PX4_AUTO << PX4_MAIN_SHIFT | PX4_AUTO_PRECLAND << PX4_SUB_SHIFT,
        [LANDING_MODE_HOLD] = PX4_AUTO << PX4_MAIN_SHIFT | PX4_AUTO_LOITER << PX4_SUB_SHIFT,
    };

    return profile == AUTOPILOT_PX4 ? px4[mode] : ardupilot[mode];
}

static uint32_t interval_of(const struct autopilot *autopilot, size_t stream)
{
    return stream == (size_t)AUTOPILOT_STREAM_ATTITUDE      ? autopilot->rates->attitude_interval_us
           : stream == (size_t)AUTOPILOT_STREAM_RC_CHANNELS ? autopilot->rates->rc_interval_us
                                                            : streams[stream].interval_us;
}

void autopilot_init(struct autopilot *autopilot, const struct rates *rates)
{
    memset(autopilot, 0, sizeof *autopilot);
    autopilot->rates = rates;
}

// True when the newest HEARTBEAT shows that mode.
static bool shows(const struct autopilot *autopilot, enum landing_mode mode)
{
    return mode != LANDING_MODE_NONE && autopilot->heard && autopilot->profile != AUTOPILOT_UNKNOWN &&
           autopilot->custom_mode == code_of(autopilot->profile, mode);
}

static void on_stream(struct autopilot *autopilot, enum autopilot_stream stream, uint64_t now_us)
{
    autopilot->stream_us[stream] = now_us;
    autopilot->stream_requests[stream] = 0U;
}

// Whose doing the mode is that the newest HEARTBEAT shows.
static void judge_mode(struct autopilot *autopilot)
{
    // The wanted mode may be one that it is about to leave, for another that was asked for before.
    const bool settled = autopilot->wanted_before == LANDING_MODE_NONE || autopilot->requests != 0U;

    if (shows(autopilot, autopilot->wanted_before) || (shows(autopilot, autopilot->wanted) && settled)) {
        autopilot->mode_before = autopilot->custom_mode;
        autopilot->wanted_before = LANDING_MODE_NONE;
    } else if (autopilot->custom_mode != autopilot->mode_before && !shows(autopilot, autopilot->wanted)) {
        autopilot->mode_taken = true;
    }
}

static void on_heartbeat(struct autopilot *autopilot, const struct mavlink_in_heartbeat *heartbeat, uint64_t now_us)
{
    autopilot->profile = heartbeat->autopilot == (uint8_t)MAV_AUTOPILOT_ARDUPILOTMEGA ? AUTOPILOT_ARDUPILOT
                         : heartbeat->autopilot == (uint8_t)MAV_AUTOPILOT_PX4         ? AUTOPILOT_PX4
                                                                                      : AUTOPILOT_UNKNOWN;
    if (autopilot->heard && now_us <= autopilot->heartbeat_us + HEARTBEAT_OFTEN_US) {
        on_stream(autopilot, AUTOPILOT_STREAM_HEARTBEAT, now_us);
    } else if (!autopilot_is_heard(autopilot, now_us)) {
        autopilot->stream_requests[AUTOPILOT_STREAM_HEARTBEAT] = 0U; // it may have been restarted
    }
    autopilot->heard = true;
    autopilot->heartbeat_us = now_us;
    autopilot->armed = (heartbeat->base_mode & (uint8_t)MAV_MODE_FLAG_SAFETY_ARMED) != 0U;
    autopilot->custom_mode = heartbeat->custom_mode;
    if (autopilot->wanted != LANDING_MODE_NONE) {
        judge_mode(autopilot);
    }
}

static void on_ack(struct autopilot *autopilot, const struct mavlink_in_ack *ack, uint64_t now_us)
{
    // What it says of message intervals does not matter: they are asked for until they come.
    if (ack->command == (uint16_t)MAV_CMD_DO_SET_MODE && autopilot->wanted != LANDING_MODE_NONE &&
        autopilot->requests != 0U) {
        autopilot->rejected = ack->result == (uint8_t)MAV_RESULT_DENIED ||
                              ack->result == (uint8_t)MAV_RESULT_UNSUPPORTED;
        // Said again it is as old as it was.
        const uint64_t since_us = autopilot->accepted_us != 0U ? autopilot->accepted_us : now_us;
        autopilot->accepted_us = ack->result == (uint8_t)MAV_RESULT_ACCEPTED ? since_us : 0U;
    }
}

void autopilot_on_message(struct autopilot *autopilot, const struct mavlink_in_message *message, uint64_t now_us)
{
    switch (message->kind) {
    case MAVLINK_IN_HEARTBEAT:
        on_heartbeat(autopilot, &message->as.heartbeat, now_us);
        break;
    case MAVLINK_IN_ACK:
        on_ack(autopilot, &message->as.ack, now_us);
        break;
    case MAVLINK_IN_ATTITUDE:
        on_stream(autopilot, AUTOPILOT_STREAM_ATTITUDE, now_us);
        break;
    case MAVLINK_IN_LANDED_STATE:
        on_stream(autopilot, AUTOPILOT_STREAM_EXTENDED_SYS_STATE, now_us);
        autopilot->on_ground = message->as.landed_state == (uint8_t)MAV_LANDED_STATE_ON_GROUND;
        break;
    case MAVLINK_IN_BATTERY:
        on_stream(autopilot, AUTOPILOT_STREAM_SYS_STATUS, now_us);
        autopilot->battery_known = message->as.battery_percent >= 0;
        autopilot->battery_percent = (uint8_t)(autopilot->battery_known ? message->as.battery_percent : 0);
        break;
    case MAVLINK_IN_RC:
        on_stream(autopilot, AUTOPILOT_STREAM_RC_CHANNELS, now_us);
        break;
    case MAVLINK_IN_NOTHING:
    case MAVLINK_IN_TIMESYNC_REQUEST:
    case MAVLINK_IN_TIMESYNC_ANSWER:
    case MAVLINK_IN_COMMAND:
    case MAVLINK_IN_PARAM_READ:
    case MAVLINK_IN_PARAM_LIST:
    case MAVLINK_IN_PARAM_SET:
        break;
    }
}

bool autopilot_is_heard(const struct autopilot *autopilot, uint64_t now_us)
{
    return autopilot->heard && now_us <= autopilot->heartbeat_us + AUTOPILOT_SILENT_US;
}

bool autopilot_is_in(const struct autopilot *autopilot, enum landing_mode mode)
{
    return shows(autopilot, mode) && (mode != autopilot->wanted || autopilot->wanted_before == LANDING_MODE_NONE);
}

void autopilot_want(struct autopilot *autopilot, enum landing_mode mode, uint64_t now_us)
{
    if (mode == autopilot->wanted) {
        return;
    }
    // On the way from one mode to the next, the one it is in and the one asked for before are no one else's doing.
    if (mode == LANDING_MODE_NONE || autopilot->wanted == LANDING_MODE_NONE) {
        autopilot->wanted_before = LANDING_MODE_NONE;
    } else if (autopilot->requests != 0U && !autopilot_is_in(autopilot, autopilot->wanted)) {
        autopilot->wanted_before = autopilot->wanted;
    }
    autopilot->mode_before = autopilot->custom_mode;
    autopilot->mode_taken = false;
    autopilot->rejected = false;
    autopilot->accepted_us = 0U;
    autopilot->requests = 0U;
    autopilot->next_request_us = autopilot->wanted == LANDING_MODE_NONE ? now_us + FIRST_REQUEST_AFTER_US : now_us;
    autopilot->wanted = mode;
}

bool autopilot_refuses(const struct autopilot *autopilot, uint64_t now_us)
{
    // Of an autopilot that is neither of the two no mode is known.
    return autopilot->wanted != LANDING_MODE_NONE && !autopilot_is_in(autopilot, autopilot->wanted) &&
           (autopilot->profile == AUTOPILOT_UNKNOWN || autopilot->rejected ||
            (autopilot->accepted_us != 0U && now_us >= autopilot->accepted_us + AUTOPILOT_SHOWN_AFTER_US) ||
            (autopilot->accepted_us == 0U && autopilot->requests >= AUTOPILOT_REQUESTS_MAX &&
             now_us >= autopilot->next_request_us));
}

// A request would override a pilot who has just taken over, so it goes out on the word of a HEARTBEAT that no one has,
// and after AUTOPILOT_MODE_WAIT_US without one.
static bool may_ask(const struct autopilot *autopilot, uint64_t now_us)
{
    return now_us >= autopilot->next_request_us &&
           (now_us <= autopilot->heartbeat_us + AUTOPILOT_MODE_FRESH_US ||
            now_us >= autopilot->next_request_us + AUTOPILOT_MODE_WAIT_US);
}

bool autopilot_mode_request(struct autopilot *autopilot, uint64_t now_us, struct autopilot_command *command)
{
    if (autopilot->wanted == LANDING_MODE_NONE || autopilot->profile == AUTOPILOT_UNKNOWN || autopilot->mode_taken ||
        autopilot->accepted_us != 0U || autopilot_is_in(autopilot, autopilot->wanted) ||
        autopilot->requests >= AUTOPILOT_REQUESTS_MAX || !may_ask(autopilot, now_us)) {
        return false;
    }
    const uint32_t code = code_of(autopilot->profile, autopilot->wanted);

    memset(command, 0, sizeof *command);
    command->command = (uint16_t)MAV_CMD_DO_SET_MODE;
    command->parameters[0] = (float)MAV_MODE_FLAG_CUSTOM_MODE_ENABLED;
    if (autopilot->profile == AUTOPILOT_PX4) {
        command->parameters[1] = (float)(code >> PX4_MAIN_SHIFT & 0xFFU);
        command->parameters[2] = (float)(code >> PX4_SUB_SHIFT);
    } else {
        command->parameters[1] = (float)code;
    }
    autopilot->requests++;
    autopilot->next_request_us = now_us + AUTOPILOT_REQUEST_PERIOD_US;
    return true;
}

bool autopilot_stream_request(struct autopilot *autopilot, uint64_t now_us, struct autopilot_command *command)
{
    if (!autopilot_is_heard(autopilot, now_us)) {
        return false;
    }
    for (size_t i = 0; i < AUTOPILOT_STREAMS; i++) {
        const uint64_t arrived_us = autopilot->stream_us[i];
        const bool comes = arrived_us != 0U && now_us <= arrived_us + streams[i].missing_after_us;

        const uint32_t requests_max = streams[i].requests_max;
        const bool in_vain = requests_max != 0U && autopilot->stream_requests[i] >= requests_max;

        if (comes || in_vain || now_us < autopilot->next_stream_us[i]) {
            continue;
        }
        autopilot->stream_requests[i]++;
        autopilot->next_stream_us[i] = now_us + STREAM_REQUEST_PERIOD_US;
        memset(command, 0, sizeof *command);
        command->command = (uint16_t)MAV_CMD_SET_MESSAGE_INTERVAL;
        command->parameters[0] = (float)streams[i].message;
        command->parameters[1] = (float)interval_of(autopilot, i);
        return true;
    }
    return false;
}

// SPDX-License-Identifier: Apache-2.0
// Bytes into the MAVLink receiver: noise, and frames whose checksum is right. What it
// says it has received must have been sent, and what is whole must be received.
#include "mavlink_in.h"

#include <string.h>

#include "frame.h"
#include "mavlink_out.h"
#include "target.h"

#define SENT_BYTES 1280U

static struct mavlink_in in;
static uint8_t sent[SENT_BYTES];
static size_t sent_size;

static bool is_for_us(const struct frame *frame, size_t at)
{
    return frame->payload[at] == MAVLINK_OUT_SYSTEM_ID && frame->payload[at + 1U] == MAVLINK_OUT_COMPONENT_ID;
}

// Bit for bit, so that a NaN equals itself.
static bool same_float(const struct frame *frame, size_t at, float value)
{
    return memcmp(frame->payload + at, &value, sizeof value) == 0;
}

static bool same_name(const struct frame *frame, size_t at, const char *name)
{
    return strlen(name) <= MAVLINK_IN_PARAM_NAME_CHARS &&
           strncmp((const char *)frame->payload + at, name, MAVLINK_IN_PARAM_NAME_CHARS) == 0;
}

static bool same_rc(const struct frame *frame, const uint16_t *channels_us)
{
    for (size_t i = 0; i < MAVLINK_IN_RC_CHANNELS; i++) {
        if (channels_us[i] != frame_u16(frame, 4U + 2U * i)) {
            return false;
        }
    }
    return true;
}

static bool same_command(const struct frame *frame, const struct mavlink_in_command *command)
{
    for (size_t i = 0; i < 7U; i++) {
        if (!same_float(frame, 4U * i, command->parameters[i])) {
            return false;
        }
    }
    return command->command == frame_u16(frame, 28U) && is_for_us(frame, 30U);
}

// True when the message says what the frame says.
static bool same(const struct frame *frame, const struct mavlink_in_message *message)
{
    const uint8_t *payload = frame->payload;

    if (message->system != frame->system || message->component != frame->component) {
        return false;
    }
    switch (message->kind) {
    case MAVLINK_IN_NOTHING:
        return false;
    case MAVLINK_IN_TIMESYNC_REQUEST:
    case MAVLINK_IN_TIMESYNC_ANSWER:
        return frame->message == MAVLINK_MSG_ID_TIMESYNC &&
               (message->kind == MAVLINK_IN_TIMESYNC_ANSWER) == (message->as.timesync.answer_ns != 0) &&
               memcmp(&message->as.timesync.answer_ns, payload, sizeof message->as.timesync.answer_ns) == 0 &&
               memcmp(&message->as.timesync.request_ns, payload + 8, sizeof message->as.timesync.request_ns) == 0;
    case MAVLINK_IN_HEARTBEAT:
        return frame->message == MAVLINK_MSG_ID_HEARTBEAT &&
               message->as.heartbeat.custom_mode == frame_u32(frame, 0U) && message->as.heartbeat.type == payload[4] &&
               message->as.heartbeat.autopilot == payload[5] && message->as.heartbeat.base_mode == payload[6];
    case MAVLINK_IN_ATTITUDE:
        return frame->message == MAVLINK_MSG_ID_ATTITUDE && same_float(frame, 4U, message->as.attitude.roll_rad) &&
               same_float(frame, 8U, message->as.attitude.pitch_rad);
    case MAVLINK_IN_BATTERY:
        return frame->message == MAVLINK_MSG_ID_SYS_STATUS && message->as.battery_percent == (int8_t)payload[30];
    case MAVLINK_IN_LANDED_STATE:
        return frame->message == MAVLINK_MSG_ID_EXTENDED_SYS_STATE && message->as.landed_state == payload[1];
    case MAVLINK_IN_RC:
        return frame->message == MAVLINK_MSG_ID_RC_CHANNELS && same_rc(frame, message->as.rc_us);
    case MAVLINK_IN_ACK:
        return frame->message == MAVLINK_MSG_ID_COMMAND_ACK && message->as.ack.command == frame_u16(frame, 0U) &&
               message->as.ack.result == payload[2] && (is_for_us(frame, 8U) || frame_u16(frame, 8U) == 0U);
    case MAVLINK_IN_COMMAND:
        return frame->message == MAVLINK_MSG_ID_COMMAND_LONG && same_command(frame, &message->as.command);
    case MAVLINK_IN_PARAM_READ:
        return frame->message == MAVLINK_MSG_ID_PARAM_REQUEST_READ && is_for_us(frame, 2U) &&
               message->as.param.index == (int16_t)frame_u16(frame, 0U) && same_name(frame, 4U, message->as.param.name);
    case MAVLINK_IN_PARAM_LIST:
        return frame->message == MAVLINK_MSG_ID_PARAM_REQUEST_LIST && payload[0] == MAVLINK_OUT_SYSTEM_ID &&
               (payload[1] == MAVLINK_OUT_COMPONENT_ID || payload[1] == (uint8_t)MAV_COMP_ID_ALL);
    case MAVLINK_IN_PARAM_SET:
        return frame->message == MAVLINK_MSG_ID_PARAM_SET && is_for_us(frame, 4U) && message->as.param.index == -1 &&
               same_float(frame, 0U, message->as.param.value) && same_name(frame, 6U, message->as.param.name) &&
               message->as.param.type == payload[22];
    }
    return false;
}

// True when the bytes that were sent end with a frame that says this.
static bool was_sent(const struct mavlink_in_message *message)
{
    struct frame frame;

    for (size_t size = 1U; size <= sent_size && size <= FRAME_MAX_BYTES; size++) {
        if (frame_read(sent + sent_size - size, size, &frame) && same(&frame, message)) {
            return true;
        }
    }
    return false;
}

// Returns whether the last of the bytes completed a message.
static bool give(const uint8_t *bytes, size_t size)
{
    bool received = false;

    for (size_t i = 0; i < size; i++) {
        struct mavlink_in_message message;
        const enum mavlink_in_kind kind = mavlink_in_byte(&in, bytes[i], &message);

        sent[sent_size++] = bytes[i];
        DEMAND(kind == message.kind);
        DEMAND(kind == MAVLINK_IN_NOTHING || was_sent(&message));
        received = kind != MAVLINK_IN_NOTHING;
    }
    return received;
}

static bool is_idle(void)
{
    return in.status.parse_state == MAVLINK_PARSE_STATE_IDLE || in.status.parse_state == MAVLINK_PARSE_STATE_UNINIT;
}

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size)
{
    struct input input = {.bytes = bytes, .left = size};

    mavlink_in_init(&in);
    sent_size = 0U;
    while (input.left != 0U && sent_size + FRAME_MAX_BYTES <= SENT_BYTES) {
        uint8_t piece[FRAME_MAX_BYTES];
        const uint8_t what = input_u8(&input);

        if (what % 4U == 0U) {
            (void)give(piece, input_take(&input, piece, what / 4U));
            continue;
        }
        bool intact;
        const size_t piece_size = frame_from_input(&input, piece, &intact);
        const bool idle = is_idle();
        DEMAND(give(piece, piece_size) || !(intact && idle));
    }
    return 0;
}

// SPDX-License-Identifier: Apache-2.0
#include "mavlink_in.h"

#include <string.h>

#include "mavlink_out.h"

void mavlink_in_init(struct mavlink_in *in)
{
    memset(in, 0, sizeof *in);
}

static enum mavlink_in_kind read_timesync(const mavlink_message_t *received, struct mavlink_in_message *message)
{
    mavlink_timesync_t timesync;

    mavlink_msg_timesync_decode(received, &timesync);
    // tc1 is 0 in a request and the answerer's time in a reply.
    if (timesync.tc1 != 0) {
        return MAVLINK_IN_NOTHING;
    }
    message->request_ns = timesync.ts1;
    return MAVLINK_IN_TIMESYNC_REQUEST;
}

enum mavlink_in_kind mavlink_in_byte(struct mavlink_in *in, uint8_t byte, struct mavlink_in_message *message)
{
    mavlink_message_t received;
    mavlink_status_t status;

    if (mavlink_frame_char_buffer(&in->assembling, &in->status, byte, &received, &status) != MAVLINK_FRAMING_OK) {
        return MAVLINK_IN_NOTHING;
    }
    switch (received.msgid) {
    case MAVLINK_MSG_ID_TIMESYNC:
        return read_timesync(&received, message);
    case MAVLINK_MSG_ID_ATTITUDE:
        message->roll_rad = mavlink_msg_attitude_get_roll(&received);
        message->pitch_rad = mavlink_msg_attitude_get_pitch(&received);
        return MAVLINK_IN_ATTITUDE;
    default:
        return MAVLINK_IN_NOTHING;
    }
}

// SPDX-License-Identifier: Apache-2.0
#include "mavlink_in.h"

#include <string.h>

#include "mavlink_out.h"

void mavlink_in_init(struct mavlink_in *in)
{
    memset(in, 0, sizeof *in);
}

bool mavlink_in_timesync_request(struct mavlink_in *in, uint8_t byte, int64_t *request_ns)
{
    mavlink_message_t message;
    mavlink_status_t status;
    mavlink_timesync_t timesync;

    if (mavlink_frame_char_buffer(&in->assembling, &in->status, byte, &message, &status) != MAVLINK_FRAMING_OK ||
        message.msgid != MAVLINK_MSG_ID_TIMESYNC) {
        return false;
    }
    mavlink_msg_timesync_decode(&message, &timesync);
    // tc1 is 0 in a request and the answerer's time in a reply.
    if (timesync.tc1 != 0) {
        return false;
    }
    *request_ns = timesync.ts1;
    return true;
}

// SPDX-License-Identifier: Apache-2.0
// What is known of the autopilot, what it is asked for, and whether it does it.
#ifndef TOUCHDOWN_AUTOPILOT_H
#define TOUCHDOWN_AUTOPILOT_H

#include <stdbool.h>
#include <stdint.h>

#include "landing_table.h"
#include "mavlink_in.h"
#include "rates.h"

enum autopilot_profile { AUTOPILOT_UNKNOWN, AUTOPILOT_ARDUPILOT, AUTOPILOT_PX4 };

// Telemetry that is asked for, again and again until it comes.
enum autopilot_stream {
    AUTOPILOT_STREAM_ATTITUDE,
    AUTOPILOT_STREAM_EXTENDED_SYS_STATE,
    AUTOPILOT_STREAM_SYS_STATUS,
    AUTOPILOT_STREAM_RC_CHANNELS,
    AUTOPILOT_STREAM_HEARTBEAT,
    AUTOPILOT_STREAMS
};

#define AUTOPILOT_SILENT_US 3000000U
#define AUTOPILOT_REQUEST_PERIOD_US 500000U
#define AUTOPILOT_REQUESTS_MAX 5U
// So old at most is a HEARTBEAT that says which mode it is in now; so long such a one is waited for.
#define AUTOPILOT_MODE_FRESH_US 100000U
#define AUTOPILOT_MODE_WAIT_US 1200000U
// In which it is to show a mode that it accepted: two HEARTBEATs at 1 Hz, one of which may be lost.
#define AUTOPILOT_SHOWN_AFTER_US 2500000U

struct autopilot {
    const struct rates *rates; // of its wire
    enum autopilot_profile profile;
    bool heard;
    uint64_t heartbeat_us;
    uint32_t custom_mode;
    bool armed;
    bool on_ground;
    bool battery_known;
    uint8_t battery_percent;

    enum landing_mode wanted;
    enum landing_mode wanted_before; // was asked for and not yet seen, so may come late; else NONE
    uint32_t mode_before;            // the mode that it was last known to be in by its own or our doing
    bool mode_taken;                 // by someone else
    bool rejected;
    uint64_t accepted_us; // when it accepted the wanted mode; 0 = it did not
    uint32_t requests;
    uint64_t next_request_us;

    uint64_t stream_us[AUTOPILOT_STREAMS]; // newest arrival; 0 = none
    uint64_t next_stream_us[AUTOPILOT_STREAMS];
    uint32_t stream_requests[AUTOPILOT_STREAMS]; // since it last came
};

// A COMMAND_LONG for the autopilot.
struct autopilot_command {
    uint16_t command; // MAV_CMD
    float parameters[7];
};

void autopilot_init(struct autopilot *autopilot, const struct rates *rates);

// Takes what the autopilot said.
void autopilot_on_message(struct autopilot *autopilot, const struct mavlink_in_message *message, uint64_t now_us);

// True when it was heard of lately.
bool autopilot_is_heard(const struct autopilot *autopilot, uint64_t now_us);

// True when it is in that mode, and nothing else that was asked for is under way. None at all for LANDING_MODE_NONE.
bool autopilot_is_in(const struct autopilot *autopilot, enum landing_mode mode);

// From now on this mode is wanted; LANDING_MODE_NONE asks for nothing.
void autopilot_want(struct autopilot *autopilot, enum landing_mode mode, uint64_t now_us);

// It rejected the wanted mode, or did not take it after AUTOPILOT_REQUESTS_MAX requests, or accepted it and does not
// show it.
bool autopilot_refuses(const struct autopilot *autopilot, uint64_t now_us);

// The mode that is to be asked for now, if any. To be sent at once.
bool autopilot_mode_request(struct autopilot *autopilot, uint64_t now_us, struct autopilot_command *command);

// The message interval that is to be asked for now, if any. To be sent at once.
bool autopilot_stream_request(struct autopilot *autopilot, uint64_t now_us, struct autopilot_command *command);

#endif

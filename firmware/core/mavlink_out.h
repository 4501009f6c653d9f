// SPDX-License-Identifier: Apache-2.0
// The MAVLink 2 messages that Touchdown sends, as bytes. Each function packs one
// whole frame into `bytes` and returns its length.
#ifndef TOUCHDOWN_MAVLINK_OUT_H
#define TOUCHDOWN_MAVLINK_OUT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#define MAVLINK_OUT_MAX_BYTES 280U
#define MAVLINK_OUT_SYSTEM_ID 1U      // that of the vehicle
#define MAVLINK_OUT_COMPONENT_ID 191U // MAV_COMP_ID_ONBOARD_COMPUTER
#define MAVLINK_OUT_STATUS_TEXT_CHARS 50U

// One direction of one wire: receivers find lost messages by the sequence.
struct mavlink_out {
    uint8_t sequence;
};

enum mavlink_out_severity { MAVLINK_OUT_CRITICAL = 2, MAVLINK_OUT_WARNING = 4, MAVLINK_OUT_INFO = 6 };

struct mavlink_out_target {
    uint64_t time_us; // of the first pixel of the frame
    double right;     // tangents of the angles from body down
    double forward;
    double height_m;    // along body down
    double pad_width_m; // outer diameter of the ring
};

size_t mavlink_out_heartbeat(struct mavlink_out *out, bool healthy, uint8_t *bytes);

// `usable` false: out of range, with the quality that means "no valid signal".
size_t mavlink_out_distance_sensor(struct mavlink_out *out, uint32_t time_ms, bool usable, uint32_t distance_mm,
                                   uint8_t *bytes);

size_t mavlink_out_landing_target(struct mavlink_out *out, const struct mavlink_out_target *target, uint8_t *bytes);

// At most 9 characters of name and 58 values.
size_t mavlink_out_float_array(struct mavlink_out *out, uint64_t time_us, uint16_t array_id, const char *name,
                               const float *values, size_t count, uint8_t *bytes);

// Text beyond MAVLINK_OUT_STATUS_TEXT_CHARS is cut off.
size_t mavlink_out_status_text(struct mavlink_out *out, enum mavlink_out_severity severity, const char *text,
                               uint8_t *bytes);

// Of a vehicle's autopilot: component 1 of our system.
struct mavlink_out_command {
    uint16_t command;     // MAV_CMD
    uint8_t confirmation; // how often it was sent before
    float parameters[7];
};

size_t mavlink_out_command(struct mavlink_out *out, const struct mavlink_out_command *command, uint8_t *bytes);

// Answers a command of `system` and `component`; `result` is a MAV_RESULT.
size_t mavlink_out_command_ack(struct mavlink_out *out, uint16_t command, uint8_t result, uint8_t system,
                               uint8_t component, uint8_t *bytes);

// In the level frame that turns with the heading.
struct mavlink_out_velocity {
    double forward_m_s;
    double right_m_s;
    double down_m_s;
    double yaw_rate_rad_s; // clockwise as seen from above
};

// SET_POSITION_TARGET_LOCAL_NED for the autopilot: velocity and yaw rate.
size_t mavlink_out_velocity(struct mavlink_out *out, uint32_t time_ms, const struct mavlink_out_velocity *velocity,
                            uint8_t *bytes);

// PARAM_VALUE of a float; `name` has at most 16 characters.
size_t mavlink_out_parameter(struct mavlink_out *out, const char *name, float value, uint16_t index, uint16_t count,
                             uint8_t *bytes);

size_t mavlink_out_timesync_request(struct mavlink_out *out, int64_t request_ns, uint8_t *bytes);

size_t mavlink_out_timesync_reply(struct mavlink_out *out, uint64_t now_us, int64_t request_ns, uint8_t *bytes);

#endif

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

size_t mavlink_out_timesync_reply(struct mavlink_out *out, uint64_t now_us, int64_t request_ns, uint8_t *bytes);

#endif

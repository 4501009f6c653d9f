// SPDX-License-Identifier: Apache-2.0
#include "mavlink_out.h"

#include <math.h>
#include <string.h>

#include <common/mavlink.h>

#define MM_PER_CM 10U
#define LIDAR_MIN_CM 5U
#define LIDAR_MAX_CM 4000U
#define LIDAR_VARIANCE_CM2 6U // (2.5 cm)^2
#define LIDAR_BEAM_RAD 0.008F
// Of SET_POSITION_TARGET_LOCAL_NED: position, acceleration and yaw do not count.
#define VELOCITY_AND_YAW_RATE                                                                                          \
    (POSITION_TARGET_TYPEMASK_X_IGNORE | POSITION_TARGET_TYPEMASK_Y_IGNORE | POSITION_TARGET_TYPEMASK_Z_IGNORE |       \
     POSITION_TARGET_TYPEMASK_AX_IGNORE | POSITION_TARGET_TYPEMASK_AY_IGNORE | POSITION_TARGET_TYPEMASK_AZ_IGNORE |    \
     POSITION_TARGET_TYPEMASK_YAW_IGNORE)
#define QUALITY_INVALID 1U
#define QUALITY_PERFECT 100U

_Static_assert(MAVLINK_OUT_MAX_BYTES >= MAVLINK_MAX_PACKET_LEN, "room for the longest frame");
_Static_assert(MAVLINK_OUT_COMPONENT_ID == MAV_COMP_ID_ONBOARD_COMPUTER, "component id");
_Static_assert(VELOCITY_AND_YAW_RATE == 0x05C7, "what ArduPilot and PX4 take as velocity and yaw rate");
_Static_assert((int)MAVLINK_OUT_CRITICAL == (int)MAV_SEVERITY_CRITICAL, "severity");
_Static_assert((int)MAVLINK_OUT_WARNING == (int)MAV_SEVERITY_WARNING, "severity");
_Static_assert((int)MAVLINK_OUT_INFO == (int)MAV_SEVERITY_INFO, "severity");

// MAVLink's own helpers keep the sequence in global state; it belongs to a wire.
static mavlink_status_t begin(const struct mavlink_out *out)
{
    mavlink_status_t status;

    memset(&status, 0, sizeof status);
    status.current_tx_seq = out->sequence;
    return status;
}

static size_t finish(struct mavlink_out *out, const mavlink_status_t *status, const mavlink_message_t *message,
                     uint8_t *bytes)
{
    out->sequence = status->current_tx_seq;
    return mavlink_msg_to_send_buffer(bytes, message);
}

size_t mavlink_out_heartbeat(struct mavlink_out *out, bool healthy, uint8_t *bytes)
{
    mavlink_status_t status = begin(out);
    mavlink_message_t message;

    mavlink_msg_heartbeat_pack_status(MAVLINK_OUT_SYSTEM_ID, MAVLINK_OUT_COMPONENT_ID, &status, &message,
                                      MAV_TYPE_ONBOARD_CONTROLLER, MAV_AUTOPILOT_INVALID, 0, 0,
                                      healthy ? MAV_STATE_ACTIVE : MAV_STATE_CRITICAL);
    return finish(out, &status, &message, bytes);
}

size_t mavlink_out_distance_sensor(struct mavlink_out *out, uint32_t time_ms, bool usable, uint32_t distance_mm,
                                   uint8_t *bytes)
{
    static const float no_quaternion[4] = {0.0F, 0.0F, 0.0F, 0.0F};
    mavlink_status_t status = begin(out);
    mavlink_message_t message;
    const uint32_t rounded_cm = distance_mm / MM_PER_CM + (distance_mm % MM_PER_CM >= MM_PER_CM / 2U ? 1U : 0U);
    const uint32_t distance_cm = usable && rounded_cm <= LIDAR_MAX_CM ? rounded_cm : LIDAR_MAX_CM + 1U;

    mavlink_msg_distance_sensor_pack_status(
        MAVLINK_OUT_SYSTEM_ID, MAVLINK_OUT_COMPONENT_ID, &status, &message, time_ms, LIDAR_MIN_CM, LIDAR_MAX_CM,
        (uint16_t)distance_cm, MAV_DISTANCE_SENSOR_LASER, 0, MAV_SENSOR_ROTATION_PITCH_270, LIDAR_VARIANCE_CM2,
        LIDAR_BEAM_RAD, LIDAR_BEAM_RAD, no_quaternion, usable ? QUALITY_PERFECT : QUALITY_INVALID);
    return finish(out, &status, &message, bytes);
}

size_t mavlink_out_landing_target(struct mavlink_out *out, const struct mavlink_out_target *target, uint8_t *bytes)
{
    static const float no_rotation[4] = {1.0F, 0.0F, 0.0F, 0.0F};
    mavlink_status_t status = begin(out);
    mavlink_message_t message;
    // Raw body angles: the autopilot takes roll and pitch out itself. Its frame is
    // forward, right, down; a target ahead has a negative angle_y.
    const double angle_x = atan(target->right);
    const double angle_y = -atan(target->forward);
    const double stretch = sqrt(1.0 + target->right * target->right + target->forward * target->forward);
    const double slant_m = target->height_m * stretch;
    const double size = slant_m > 0.0 ? 2.0 * atan(target->pad_width_m / 2.0 / slant_m) : 0.0;

    mavlink_msg_landing_target_pack_status(MAVLINK_OUT_SYSTEM_ID, MAVLINK_OUT_COMPONENT_ID, &status, &message,
                                           target->time_us, 0, MAV_FRAME_BODY_FRD, (float)angle_x, (float)angle_y,
                                           (float)slant_m, (float)size, (float)size, 0.0F, 0.0F, 0.0F, no_rotation,
                                           LANDING_TARGET_TYPE_VISION_FIDUCIAL, 0);
    return finish(out, &status, &message, bytes);
}

size_t mavlink_out_float_array(struct mavlink_out *out, uint64_t time_us, uint16_t array_id, const char *name,
                               const float *values, size_t count, uint8_t *bytes)
{
    mavlink_status_t status = begin(out);
    mavlink_message_t message;
    char padded_name[MAVLINK_MSG_DEBUG_FLOAT_ARRAY_FIELD_NAME_LEN] = {0};
    float padded_values[MAVLINK_MSG_DEBUG_FLOAT_ARRAY_FIELD_DATA_LEN] = {0.0F};

    for (size_t i = 0; i + 1U < sizeof padded_name && name[i] != '\0'; i++) {
        padded_name[i] = name[i];
    }
    for (size_t i = 0; i < count && i < MAVLINK_MSG_DEBUG_FLOAT_ARRAY_FIELD_DATA_LEN; i++) {
        padded_values[i] = values[i];
    }
    mavlink_msg_debug_float_array_pack_status(MAVLINK_OUT_SYSTEM_ID, MAVLINK_OUT_COMPONENT_ID, &status, &message,
                                              time_us, padded_name, array_id, padded_values);
    return finish(out, &status, &message, bytes);
}

size_t mavlink_out_status_text(struct mavlink_out *out, enum mavlink_out_severity severity, const char *text,
                               uint8_t *bytes)
{
    mavlink_status_t status = begin(out);
    mavlink_message_t message;
    char padded[MAVLINK_OUT_STATUS_TEXT_CHARS] = {0};

    for (size_t i = 0; i < sizeof padded && text[i] != '\0'; i++) {
        padded[i] = text[i];
    }
    mavlink_msg_statustext_pack_status(MAVLINK_OUT_SYSTEM_ID, MAVLINK_OUT_COMPONENT_ID, &status, &message,
                                       (uint8_t)severity, padded, 0, 0);
    return finish(out, &status, &message, bytes);
}

size_t mavlink_out_command(struct mavlink_out *out, const struct mavlink_out_command *command, uint8_t *bytes)
{
    mavlink_status_t status = begin(out);
    mavlink_message_t message;
    const float *p = command->parameters;

    mavlink_msg_command_long_pack_status(MAVLINK_OUT_SYSTEM_ID, MAVLINK_OUT_COMPONENT_ID, &status, &message,
                                         MAVLINK_OUT_SYSTEM_ID, MAV_COMP_ID_AUTOPILOT1, command->command,
                                         command->confirmation, p[0], p[1], p[2], p[3], p[4], p[5], p[6]);
    return finish(out, &status, &message, bytes);
}

size_t mavlink_out_command_ack(struct mavlink_out *out, uint16_t command, uint8_t result, uint8_t system,
                               uint8_t component, uint8_t *bytes)
{
    mavlink_status_t status = begin(out);
    mavlink_message_t message;

    mavlink_msg_command_ack_pack_status(MAVLINK_OUT_SYSTEM_ID, MAVLINK_OUT_COMPONENT_ID, &status, &message, command,
                                        result, 0, 0, system, component);
    return finish(out, &status, &message, bytes);
}

size_t mavlink_out_velocity(struct mavlink_out *out, uint32_t time_ms, const struct mavlink_out_velocity *velocity,
                            uint8_t *bytes)
{
    mavlink_status_t status = begin(out);
    mavlink_message_t message;

    mavlink_msg_set_position_target_local_ned_pack_status(
        MAVLINK_OUT_SYSTEM_ID, MAVLINK_OUT_COMPONENT_ID, &status, &message, time_ms, MAVLINK_OUT_SYSTEM_ID,
        MAV_COMP_ID_AUTOPILOT1, MAV_FRAME_BODY_NED, VELOCITY_AND_YAW_RATE, 0.0F, 0.0F, 0.0F,
        (float)velocity->forward_m_s, (float)velocity->right_m_s, (float)velocity->down_m_s, 0.0F, 0.0F, 0.0F, 0.0F,
        (float)velocity->yaw_rate_rad_s);
    return finish(out, &status, &message, bytes);
}

size_t mavlink_out_parameter(struct mavlink_out *out, const char *name, float value, uint16_t index, uint16_t count,
                             uint8_t *bytes)
{
    mavlink_status_t status = begin(out);
    mavlink_message_t message;
    char padded[MAVLINK_MSG_PARAM_VALUE_FIELD_PARAM_ID_LEN] = {0};

    for (size_t i = 0; i < sizeof padded && name[i] != '\0'; i++) {
        padded[i] = name[i];
    }
    mavlink_msg_param_value_pack_status(MAVLINK_OUT_SYSTEM_ID, MAVLINK_OUT_COMPONENT_ID, &status, &message, padded,
                                        value, MAV_PARAM_TYPE_REAL32, count, index);
    return finish(out, &status, &message, bytes);
}

static size_t timesync(struct mavlink_out *out, int64_t answer_ns, int64_t request_ns, uint8_t *bytes)
{
    mavlink_status_t status = begin(out);
    mavlink_message_t message;

    mavlink_msg_timesync_pack_status(MAVLINK_OUT_SYSTEM_ID, MAVLINK_OUT_COMPONENT_ID, &status, &message, answer_ns,
                                     request_ns);
    return finish(out, &status, &message, bytes);
}

size_t mavlink_out_timesync_request(struct mavlink_out *out, int64_t request_ns, uint8_t *bytes)
{
    return timesync(out, 0, request_ns, bytes);
}

size_t mavlink_out_timesync_reply(struct mavlink_out *out, uint64_t now_us, int64_t request_ns, uint8_t *bytes)
{
    return timesync(out, (int64_t)(now_us * 1000U), request_ns, bytes);
}

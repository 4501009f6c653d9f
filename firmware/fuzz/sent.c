// SPDX-License-Identifier: Apache-2.0
#include "sent.h"

#include <math.h>
#include <string.h>

#include <common/mavlink.h>

#include "app.h"
#include "frame.h"
#include "target.h"

#define HALF_TURN 3.14159274F
#define RAD_PER_DEG 0.0174532925F
#define SEARCH_M_S 0.3F
#define CLIMB_M_S 0.4F
#define ROUNDING 1e-5F
#define VELOCITY_AND_YAW_RATE 0x5C7U // bits of what is to be ignored
#define DISTANCE_MOST_CM 4001U       // one more than the sensor's range: none

struct limits {
    const char *name;
    float least;
    float most;
};

static const struct limits limits[PARAMETERS_COUNT] = {
#define SENT_LIMITS(member, name, least, most, usual) {name, least, most},
    LANDING_PARAMETERS(SENT_LIMITS)
#undef SENT_LIMITS
};

void sent_init(struct sent *sent, const struct flight *flight)
{
    memset(sent, 0, sizeof *sent);
    sent->flight = flight;
}

void sent_parameters_are_sane(const struct parameters *parameters)
{
    for (size_t i = 0; i < PARAMETERS_COUNT; i++) {
        const float value = parameters_get(parameters, i);

        DEMAND(value >= limits[i].least && value <= limits[i].most);
    }
}

static void check_target(const struct frame *frame)
{
    const float distance_m = frame_float(frame, 16U);

    DEMAND(fabsf(frame_float(frame, 8U)) < HALF_TURN / 2.0F && fabsf(frame_float(frame, 12U)) < HALF_TURN / 2.0F);
    DEMAND(distance_m > 0.0F && isfinite(distance_m));
    DEMAND(isfinite(frame_float(frame, 20U)) && isfinite(frame_float(frame, 24U)));
}

static void check_array(const struct frame *frame)
{
    const uint16_t fields = frame_u16(frame, 8U) == 1U ? APP_PAD_FIELDS : APP_HEALTH_FIELDS;

    for (size_t i = 0; i < fields; i++) {
        DEMAND(isfinite(frame_float(frame, 20U + 4U * i)));
    }
}

static void check_text(const struct frame *frame)
{
    DEMAND(frame->payload[1] != 0U);
    for (size_t i = 1U; i <= MAVLINK_OUT_STATUS_TEXT_CHARS; i++) {
        DEMAND(frame->payload[i] == 0U || (frame->payload[i] >= 0x20U && frame->payload[i] < 0x7FU));
    }
}

static void check_parameter(const struct frame *frame)
{
    const uint16_t index = frame_u16(frame, 6U);

    DEMAND(index < PARAMETERS_COUNT && frame_u16(frame, 4U) == PARAMETERS_COUNT);
    DEMAND(strncmp((const char *)frame->payload + 8, limits[index].name, 16U) == 0);
    DEMAND(frame_float(frame, 0U) >= limits[index].least && frame_float(frame, 0U) <= limits[index].most);
}

// Velocities go out in phases that steer, and zero until the autopilot is asked to leave the steering mode; while it is
// heard, armed and no one else's.
static void check_velocity(const struct sent *sent, const struct frame *frame)
{
    const struct flight *flight = sent->flight;
    const struct parameters *parameters = &flight->parameters;
    const enum landing_steer steer = landing_phase_table[flight->landing.phase].steer;
    const float forward = frame_float(frame, 16U);
    const float right = frame_float(frame, 20U);
    const float down = frame_float(frame, 24U);
    const float yaw = frame_float(frame, 44U);
    const float most = steer == LANDING_STEER_SEARCH ? SEARCH_M_S : parameters->speed_m_s;

    DEMAND(steer != LANDING_STEER_NONE);
    // On the way to another mode they only stop it, and only where they are obeyed.
    DEMAND(landing_phase_table[flight->landing.phase].mode == LANDING_MODE_STEER ||
           (steer == LANDING_STEER_STOP && autopilot_is_in(&flight->autopilot, LANDING_MODE_STEER)));
    DEMAND(autopilot_is_heard(&flight->autopilot, sent->now_us) && flight->autopilot.armed);
    DEMAND(!flight->autopilot.mode_taken);
    DEMAND(frame_u16(frame, 48U) == VELOCITY_AND_YAW_RATE && frame->payload[52] == (uint8_t)MAV_FRAME_BODY_NED);
    DEMAND(hypotf(forward, right) <= most + ROUNDING);
    DEMAND(down >= -CLIMB_M_S - ROUNDING && down <= parameters->descent_m_s + ROUNDING);
    DEMAND(fabsf(yaw) <= RAD_PER_DEG * parameters->yaw_rate_deg_s + ROUNDING);
    DEMAND(yaw == 0.0F || steer == LANDING_STEER_ALIGN);
    DEMAND(down <= 0.0F || steer == LANDING_STEER_DESCEND || steer == LANDING_STEER_CENTRE);
    DEMAND(steer != LANDING_STEER_STOP || (forward == 0.0F && right == 0.0F && down == 0.0F));
    DEMAND(steer != LANDING_STEER_CLIMB || (forward == 0.0F && right == 0.0F));
    DEMAND(steer == LANDING_STEER_SEARCH || (forward == 0.0F && right == 0.0F && yaw == 0.0F) ||
           landing_sees_pad(&flight->known, sent->now_us));
}

static void check_mode(const struct flight *flight, const struct frame *frame)
{
    const enum landing_mode mode = landing_phase_table[flight->landing.phase].mode;
    const uint32_t main_mode = (uint32_t)frame_float(frame, 4U);
    const uint32_t sub_mode = (uint32_t)frame_float(frame, 8U);
    static const uint32_t ardupilot[LANDING_MODES] = {0U, 4U, 9U, 17U};
    static const uint32_t px4[LANDING_MODES][2] = {{0U, 0U}, {6U, 0U}, {4U, 9U}, {4U, 3U}};

    DEMAND(mode != LANDING_MODE_NONE && flight->autopilot.wanted == mode);
    DEMAND(flight->autopilot.requests >= 1U && flight->autopilot.requests <= AUTOPILOT_REQUESTS_MAX);
    DEMAND(frame->payload[32] == flight->autopilot.requests - 1U);
    DEMAND(frame_float(frame, 0U) == 1.0F);
    if (flight->autopilot.profile == AUTOPILOT_PX4) {
        DEMAND(main_mode == px4[mode][0] && sub_mode == px4[mode][1]);
    } else {
        DEMAND(flight->autopilot.profile == AUTOPILOT_ARDUPILOT && main_mode == ardupilot[mode] && sub_mode == 0U);
    }
}

static void check_command(const struct sent *sent, const struct frame *frame)
{
    const uint16_t command = frame_u16(frame, 28U);

    DEMAND(frame->payload[30] == MAVLINK_OUT_SYSTEM_ID && frame->payload[31] == (uint8_t)MAV_COMP_ID_AUTOPILOT1);
    for (size_t i = 0; i < 7U; i++) {
        DEMAND(isfinite(frame_float(frame, 4U * i)));
    }
    if (command == (uint16_t)MAV_CMD_DO_SET_MODE) {
        check_mode(sent->flight, frame);
    } else if (command == (uint16_t)MAV_CMD_COMPONENT_ARM_DISARM) {
        // Off alone, never by force, and only when it should be down.
        DEMAND(sent->flight->landing.phase == LANDING_PHASE_TOUCHDOWN);
        DEMAND(frame_float(frame, 0U) == 0.0F && frame_float(frame, 4U) == 0.0F);
    } else {
        DEMAND(command == (uint16_t)MAV_CMD_SET_MESSAGE_INTERVAL);
        DEMAND(frame_float(frame, 4U) >= 20000.0F);
    }
}

static void check_to_autopilot(const struct sent *sent, const struct frame *frame)
{
    switch (frame->message) {
    case MAVLINK_MSG_ID_LANDING_TARGET:
        check_target(frame);
        break;
    case MAVLINK_MSG_ID_DISTANCE_SENSOR:
        DEMAND(frame_u16(frame, 8U) <= DISTANCE_MOST_CM);
        break;
    case MAVLINK_MSG_ID_COMMAND_LONG:
        check_command(sent, frame);
        break;
    case MAVLINK_MSG_ID_SET_POSITION_TARGET_LOCAL_NED:
        check_velocity(sent, frame);
        break;
    default:
        DEMAND(frame->message == MAVLINK_MSG_ID_HEARTBEAT);
        break;
    }
}

static void check_to_ground(const struct frame *frame)
{
    switch (frame->message) {
    case MAVLINK_MSG_ID_DEBUG_FLOAT_ARRAY:
        check_array(frame);
        break;
    case MAVLINK_MSG_ID_STATUSTEXT:
        check_text(frame);
        break;
    default:
        DEMAND(frame->message == MAVLINK_MSG_ID_HEARTBEAT);
        break;
    }
}

bool sent_write(void *context, enum app_link link, const uint8_t *bytes, size_t size)
{
    struct sent *sent = context;
    struct frame frame;

    DEMAND(link == APP_LINK_AUTOPILOT || link == APP_LINK_GROUND);
    DEMAND(frame_read(bytes, size, &frame) && frame.version == 2);
    DEMAND(frame.system == MAVLINK_OUT_SYSTEM_ID && frame.component == MAVLINK_OUT_COMPONENT_ID);
    DEMAND(!sent->numbered[link] || frame.sequence == (uint8_t)(sent->sequence[link] + 1U));
    sent->numbered[link] = true;
    sent->sequence[link] = frame.sequence;
    sent->count[link]++;
    // Answers go back to whoever asked.
    if (frame.message == MAVLINK_MSG_ID_PARAM_VALUE) {
        check_parameter(&frame);
    } else if (frame.message != MAVLINK_MSG_ID_COMMAND_ACK && frame.message != MAVLINK_MSG_ID_TIMESYNC) {
        if (link == APP_LINK_AUTOPILOT) {
            check_to_autopilot(sent, &frame);
        } else {
            check_to_ground(&frame);
        }
    }
    return !sent->full;
}

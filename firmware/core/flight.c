// SPDX-License-Identifier: Apache-2.0
#include "flight.h"

#include <math.h>
#include <string.h>

#include <common/mavlink.h>

#include "ground.h"
#include "text.h"

#define RAD_PER_DEG 0.017453292519943295
#define US_PER_MS 1000U
#define MM_PER_M 1000.0
#define DISARM_AFTER_US 5000000U
#define DISARM_PERIOD_US 1000000U
// What a switch gives in its two places, with room for trims; between them nothing changes.
#define SWITCH_ON_US 1700U
#define SWITCH_OFF_US 1300U
#define NO_CHANNEL_US 65535U
#define CHANNEL_LEAST_US 800U // less is a receiver without a transmitter

void flight_init(struct flight *flight, const struct rates *rates, uint64_t now_us)
{
    memset(flight, 0, sizeof *flight);
    autopilot_init(&flight->autopilot, rates);
    landing_init(&flight->landing, now_us);
    parameters_init(&flight->parameters);
    ground_init(flight);
    flight->known.autopilot = &flight->autopilot;
    flight->known.parameters = &flight->parameters;
}

static void on_rc(struct flight *flight, const uint16_t *channels_us)
{
    const uint32_t channel = (uint32_t)flight->parameters.rc_channel;

    if (channel != flight->switch_channel) {
        flight->switch_channel = channel;
        flight->switch_known = false;
    }
    if (channel == 0U || channel > MAVLINK_IN_RC_CHANNELS) {
        return;
    }
    const uint16_t value_us = channels_us[channel - 1U];

    if (value_us == NO_CHANNEL_US || value_us < CHANNEL_LEAST_US) {
        return;
    }
    if (value_us >= SWITCH_ON_US) {
        // A switch that is on when it is first seen was not turned on by anyone.
        flight->known.asked |= flight->switch_known && !flight->switch_on ? LANDING_FACT_START : 0U;
        flight->switch_on = true;
        flight->switch_known = true;
    } else if (value_us <= SWITCH_OFF_US) {
        flight->known.asked |= flight->switch_known && flight->switch_on ? LANDING_FACT_ABORT : 0U;
        flight->switch_on = false;
        flight->switch_known = true;
    }
}

void flight_on_message(struct flight *flight, struct links *links, enum app_link link,
                       const struct mavlink_in_message *message, uint64_t now_us)
{
    switch (message->kind) {
    case MAVLINK_IN_COMMAND:
        ground_on_command(flight, links, link, message);
        break;
    case MAVLINK_IN_PARAM_READ:
    case MAVLINK_IN_PARAM_LIST:
    case MAVLINK_IN_PARAM_SET:
        ground_on_parameter(flight, links, link, message);
        break;
    case MAVLINK_IN_HEARTBEAT:
        if (message->as.heartbeat.type == (uint8_t)MAV_TYPE_GCS) {
            flight->known.ground_us = now_us;
        }
        break;
    case MAVLINK_IN_RC:
        if (link == APP_LINK_AUTOPILOT && mavlink_in_is_autopilot(message)) {
            on_rc(flight, message->as.rc_us);
        }
        break;
    case MAVLINK_IN_NOTHING:
    case MAVLINK_IN_TIMESYNC_REQUEST:
    case MAVLINK_IN_TIMESYNC_ANSWER:
    case MAVLINK_IN_ATTITUDE:
    case MAVLINK_IN_BATTERY:
    case MAVLINK_IN_LANDED_STATE:
    case MAVLINK_IN_ACK:
        break;
    }
    if (link == APP_LINK_AUTOPILOT && mavlink_in_is_autopilot(message)) {
        autopilot_on_message(&flight->autopilot, message, now_us);
    }
}

void flight_on_new_track(struct flight *flight)
{
    flight->known.pad_row = 0U;
}

void flight_on_frame(struct flight *flight, const struct attitude *attitude, const struct pad_estimate *pad,
                     const struct altitude *altitude, uint64_t exposed_us, uint64_t now_us)
{
    struct landing_known *known = &flight->known;
    double roll_rad = 0.0;
    double pitch_rad = 0.0;

    known->record_us = now_us;
    if (pad == NULL) {
        known->pad_row = 0U;
        return;
    }
    const double scale = altitude->pad_scale;

    // A frame without a reading says neither: it leaves that as it was.
    const bool agreed = altitude->from_lidar || (!altitude->lidar_implausible && known->agreed_us == known->pad_us);

    known->pad_us = now_us;
    if (agreed) {
        known->agreed_us = now_us;
    }
    // Seen it is; but turned level by an old attitude it would be steered by as soon as ATTITUDE is back.
    if (!attitude_at(attitude, exposed_us, now_us, &roll_rad, &pitch_rad)) {
        known->pad_row = 0U;
        return;
    }
    if (now_us > known->level_us + LANDING_PAD_FRESH_US) {
        known->pad_row = 0U;
    }
    known->level_us = now_us;
    known->pad_row += known->pad_row < UINT32_MAX ? 1U : 0U;
    known->pad = steering_level(roll_rad, pitch_rad, pad->right_m * scale, pad->forward_m * scale,
                                pad->depth_m * scale, RAD_PER_DEG * pad->angle_deg);
}

static void send_command(struct links *links, const struct autopilot_command *command, uint8_t confirmation)
{
    uint8_t bytes[MAVLINK_OUT_MAX_BYTES];
    struct mavlink_out_command out = {.command = command->command, .confirmation = confirmation};

    memcpy(out.parameters, command->parameters, sizeof out.parameters);
    links_send(links, APP_LINK_AUTOPILOT, bytes,
               mavlink_out_command(&links->out[APP_LINK_AUTOPILOT], &out, bytes));
}

// A phase that wants another mode stops the vehicle until the autopilot leaves the one in which it obeys velocities.
static bool takes_velocity(const struct flight *flight)
{
    const struct landing_phase_row *phase = &landing_phase_table[flight->landing.phase];

    return phase->steer != LANDING_STEER_NONE &&
           (phase->mode == LANDING_MODE_STEER || autopilot_is_in(&flight->autopilot, LANDING_MODE_STEER));
}

static void send_velocity(struct flight *flight, struct links *links, uint64_t now_us)
{
    const enum landing_steer steer = landing_phase_table[flight->landing.phase].steer;
    uint8_t bytes[MAVLINK_OUT_MAX_BYTES];

    if (!takes_velocity(flight) || now_us < flight->next_velocity_us) {
        return;
    }
    struct steering_view view = {
        .pad_known = landing_sees_pad(&flight->known, now_us),
        .pad = flight->known.pad,
        .phase_us = now_us - flight->landing.entered_us,
    };
    view.height_known = landing_height_m(&flight->known, now_us, &view.height_m);
    const struct mavlink_out_velocity velocity = steering_velocity(steer, &view, &flight->parameters);

    links_send(links, APP_LINK_AUTOPILOT, bytes,
               mavlink_out_velocity(&links->out[APP_LINK_AUTOPILOT], (uint32_t)(now_us / US_PER_MS), &velocity, bytes));
    flight->next_velocity_us = now_us + links->rates[APP_LINK_AUTOPILOT]->velocity_period_us;
}

static void ask_to_disarm(struct flight *flight, struct links *links, uint64_t now_us)
{
    const struct autopilot_command command = {.command = (uint16_t)MAV_CMD_COMPONENT_ARM_DISARM};

    // LAND disarms by itself; this is for one that does not notice the ground. Without force: in the air it is refused.
    if (flight->landing.phase != LANDING_PHASE_TOUCHDOWN || now_us < flight->landing.entered_us + DISARM_AFTER_US ||
        now_us < flight->next_disarm_us) {
        return;
    }
    send_command(links, &command, 0U);
    flight->next_disarm_us = now_us + DISARM_PERIOD_US;
}

static void say(struct links *links, const struct landing_rule *rule)
{
    struct text text = {.length = 0U};

    text_append(&text, "Touchdown: ");
    text_append(&text, rule->reason);
    links_say(links, (enum mavlink_out_severity)rule->severity, text.chars);
}

static void step(struct flight *flight, struct links *links, uint64_t now_us)
{
    const enum landing_phase before = flight->landing.phase;
    const uint32_t facts = landing_facts(&flight->landing, &flight->known, now_us);
    const struct landing_rule *rule = landing_step(&flight->landing, facts, now_us);

    flight->known.asked = 0U;
    if (rule == NULL) {
        return;
    }
    say(links, rule);
    flight->log[flight->logged % FLIGHT_LOG_ROWS] = (struct flight_log_row){
        .time_us = now_us, .from = before, .to = rule->to, .reason = rule->reason};
    flight->logged++;
    flight->next_velocity_us = now_us;
}

void flight_tick(struct flight *flight, struct links *links, const struct attitude *attitude,
                 const struct lidar_reading *lidar, uint64_t now_us)
{
    struct autopilot_command command;

    flight->known.attitude_us = attitude->known ? attitude->received_us : 0U;
    if (lidar != NULL && fusion_lidar_usable(lidar)) {
        flight->known.lidar_us = now_us;
        flight->known.lidar_m =
            (double)lidar->distance_mm / MM_PER_M * cos(attitude->roll_rad) * cos(attitude->pitch_rad);
    }
    step(flight, links, now_us);
    autopilot_want(&flight->autopilot, landing_phase_table[flight->landing.phase].mode, now_us);
    send_velocity(flight, links, now_us);
    if (autopilot_mode_request(&flight->autopilot, now_us, &command)) {
        send_command(links, &command, (uint8_t)(flight->autopilot.requests - 1U));
    }
    if (autopilot_stream_request(&flight->autopilot, now_us, &command)) {
        send_command(links, &command, 0U);
    }
    ask_to_disarm(flight, links, now_us);
    ground_tick(flight, links, now_us);
}

// SPDX-License-Identifier: Apache-2.0
// The landing joined together: messages and frames in, modes and velocities out.
#include "flight.h"

#include <math.h>
#include <string.h>

#include "test.h"
#include "test_wire.h"

#define SECOND 1000000U
#define TICK_US 10000U
#define SWITCH 7U // the channel of TD_RC_CHAN, from 0
#define GUIDED 4U
#define LOITER 5U
#define LAND 9U
#define BRAKE 17U

static struct flight flight;
static struct links links;
static struct attitude attitude;
static struct lidar_reading lidar;
static uint64_t now_us;

static void give(enum app_link link, struct mavlink_in_message message, uint8_t component)
{
    message.system = 1U;
    message.component = component;
    flight_on_message(&flight, &links, link, &message, now_us);
}

static void of_autopilot(struct mavlink_in_message message)
{
    give(APP_LINK_AUTOPILOT, message, (uint8_t)MAV_COMP_ID_AUTOPILOT1);
}

static void heartbeat(uint32_t mode, bool armed)
{
    struct mavlink_in_message message = {.kind = MAVLINK_IN_HEARTBEAT};

    message.as.heartbeat = (struct mavlink_in_heartbeat){.custom_mode = mode,
                                                         .type = (uint8_t)MAV_TYPE_QUADROTOR,
                                                         .autopilot = (uint8_t)MAV_AUTOPILOT_ARDUPILOTMEGA,
                                                         .base_mode = armed ? (uint8_t)MAV_MODE_FLAG_SAFETY_ARMED : 0U};
    of_autopilot(message);
}

static struct mavlink_in_message rc_message(size_t channel, uint16_t value_us)
{
    struct mavlink_in_message message = {.kind = MAVLINK_IN_RC};

    for (size_t i = 0; i < MAVLINK_IN_RC_CHANNELS; i++) {
        message.as.rc_us[i] = i == channel ? value_us : 1500U;
    }
    return message;
}

// What a switch on this channel, in this place, asks for.
static uint32_t asked_on(size_t channel, uint16_t value_us)
{
    flight.known.asked = 0U;
    of_autopilot(rc_message(channel, value_us));
    return flight.known.asked;
}

// The same of the usual channel.
static uint32_t asked_by(uint16_t value_us)
{
    return asked_on(SWITCH, value_us);
}

static void start(void)
{
    wire_open(&links);
    now_us = 10U * (uint64_t)SECOND;
    flight_init(&flight, rates_of(RATES_AUTOPILOT, 0U), now_us);
    attitude = (struct attitude){.known = false};
    lidar = (struct lidar_reading){.valid = true, .distance_mm = 1500U};
}

static void test_switch(void)
{
    test_case("a switch that is on from the beginning starts nothing");
    start();
    CHECK(asked_by(1900U) == 0U);
    test_case("turned off it aborts, turned on it starts, once");
    CHECK(asked_by(1100U) == LANDING_FACT_ABORT);
    CHECK(asked_by(1100U) == 0U);
    CHECK(asked_by(1700U) == LANDING_FACT_START);
    CHECK(asked_by(1700U) == 0U);
    CHECK(asked_by(1300U) == LANDING_FACT_ABORT);
    test_case("between its places, without a transmitter or a channel nothing changes");
    CHECK(asked_by(1699U) == 0U && asked_by(1301U) == 0U);
    CHECK(asked_by(65535U) == 0U && asked_by(799U) == 0U);
    CHECK(asked_by(1900U) == LANDING_FACT_START);
    test_case("a switch that is off from the beginning aborts nothing");
    start();
    CHECK(asked_by(1000U) == 0U);
    CHECK(asked_by(2000U) == LANDING_FACT_START);
    test_case("no channel is watched with TD_RC_CHAN 0, or one that there is not");
    start();
    CHECK(asked_by(1000U) == 0U);
    flight.parameters.rc_channel = 0.0F;
    CHECK(asked_by(2000U) == 0U);
    flight.parameters.rc_channel = 19.0F;
    CHECK(asked_by(2000U) == 0U);
    test_case("channels count only as the autopilot says them");
    flight.parameters.rc_channel = 8.0F;
    give(APP_LINK_GROUND, rc_message(SWITCH, 2000U), (uint8_t)MAV_COMP_ID_AUTOPILOT1);
    give(APP_LINK_AUTOPILOT, rc_message(SWITCH, 2000U), (uint8_t)MAV_COMP_ID_CAMERA);
    CHECK(flight.known.asked == 0U);
    CHECK(asked_by(1000U) == 0U && asked_by(2000U) == LANDING_FACT_START);
    test_case("what is known of a switch is not known of another channel");
    CHECK(asked_by(1000U) == LANDING_FACT_ABORT);
    flight.parameters.rc_channel = 9.0F;
    CHECK(asked_on(SWITCH + 1U, 2000U) == 0U);
    CHECK(asked_on(SWITCH + 1U, 1000U) == LANDING_FACT_ABORT && asked_on(SWITCH + 1U, 2000U) == LANDING_FACT_START);
    flight.parameters.rc_channel = 8.0F;
    CHECK(asked_by(1000U) == 0U);
}

static void test_who_is_heard(void)
{
    struct mavlink_in_message message = {.kind = MAVLINK_IN_HEARTBEAT};

    test_case("a ground station is one on either link; the autopilot only on its own");
    start();
    message.as.heartbeat.type = (uint8_t)MAV_TYPE_GCS;
    give(APP_LINK_GROUND, message, WIRE_GROUND_COMPONENT);
    CHECK(flight.known.ground_us == now_us && !flight.autopilot.heard);
    message.as.heartbeat.type = (uint8_t)MAV_TYPE_QUADROTOR;
    now_us += SECOND;
    give(APP_LINK_GROUND, message, (uint8_t)MAV_COMP_ID_AUTOPILOT1);
    CHECK(flight.known.ground_us == now_us - SECOND && !flight.autopilot.heard);
    message.system = 2U;
    flight_on_message(&flight, &links, APP_LINK_AUTOPILOT, &message, now_us);
    CHECK(!flight.autopilot.heard);
    of_autopilot(message);
    CHECK(flight.autopilot.heard);
    test_case("commands and parameters are answered on the link they came from");
    message = (struct mavlink_in_message){.kind = MAVLINK_IN_COMMAND};
    message.as.command.command = (uint16_t)MAV_CMD_DO_GO_AROUND;
    of_autopilot(message);
    CHECK(wire_count(APP_LINK_AUTOPILOT, MAVLINK_MSG_ID_COMMAND_ACK) == 1);
    CHECK(flight.known.asked == LANDING_FACT_ABORT);
    message = (struct mavlink_in_message){.kind = MAVLINK_IN_PARAM_READ};
    give(APP_LINK_GROUND, message, WIRE_GROUND_COMPONENT);
    CHECK(wire_count(APP_LINK_GROUND, MAVLINK_MSG_ID_PARAM_VALUE) == 1);
}

static void frame(double forward_m, double down_m, double angle_deg, bool lidar_agrees)
{
    const struct pad_estimate pad = {
        .forward_m = forward_m / 2.0, .depth_m = down_m / 2.0, .height_m = down_m / 2.0, .angle_deg = angle_deg};
    const struct altitude altitude = {
        .height_m = down_m, .pad_scale = down_m / pad.height_m, .lidar_implausible = !lidar_agrees};

    flight_on_frame(&flight, &attitude, &pad, &altitude, now_us, now_us);
}

static void test_frames(void)
{
    test_case("a frame with the pad: as large as the altitude says, counted, and whether the LiDAR agrees");
    start();
    attitude_set(&attitude, 0.0, 0.0, now_us, now_us);
    frame(0.4, 2.0, 90.0, true);
    NEAR(flight.known.pad.forward_m, 0.4, 1e-9);
    NEAR(flight.known.pad.down_m, 2.0, 1e-9);
    NEAR(flight.known.pad.angle_rad, 1.5707963, 1e-6);
    CHECK(flight.known.pad_row == 1U && flight.known.pad_us == now_us && flight.known.agreed_us == now_us);
    now_us += TICK_US;
    frame(0.4, 2.0, 90.0, false);
    CHECK(flight.known.pad_row == 2U && flight.known.agreed_us == now_us - TICK_US);
    test_case("a frame without a reading of the LiDAR does not make it agree");
    now_us += TICK_US;
    frame(0.4, 2.0, 90.0, true);
    CHECK(flight.known.pad_us == now_us && flight.known.agreed_us == now_us - 2U * TICK_US);
    test_case("a count that is at its end stays there");
    flight.known.pad_row = UINT32_MAX;
    frame(0.4, 2.0, 90.0, true);
    CHECK(flight.known.pad_row == UINT32_MAX);
    test_case("a tenth of a second without frames begins the count anew, as does a pad that need not be the same");
    flight.known.pad_row = 4U;
    now_us += 100000U;
    frame(0.4, 2.0, 90.0, true);
    CHECK(flight.known.pad_row == 5U);
    now_us += 100001U;
    frame(0.4, 2.0, 90.0, true);
    CHECK(flight.known.pad_row == 1U);
    flight_on_new_track(&flight);
    frame(0.4, 2.0, 90.0, true);
    CHECK(flight.known.pad_row == 1U);
    test_case("a frame without the pad begins the count anew");
    now_us += TICK_US;
    flight_on_frame(&flight, &attitude, NULL, &(struct altitude){.height_m = 2.0}, now_us, now_us);
    CHECK(flight.known.pad_row == 0U && flight.known.record_us == now_us && flight.known.pad_us == now_us - TICK_US);
}

// Time with an autopilot in `mode`, frames with the pad ahead and below, and ticks.
static void fly(uint64_t for_us, uint32_t mode, double forward_m, double down_m)
{
    const uint64_t end_us = now_us + for_us;

    while (now_us < end_us) {
        now_us += TICK_US;
        heartbeat(mode, true);
        attitude_set(&attitude, 0.0, 0.0, now_us, now_us);
        lidar.distance_mm = (uint32_t)(1000.0 * down_m);
        frame(forward_m, down_m, 0.0, true);
        flight_tick(&flight, &links, &attitude, &lidar, now_us);
    }
}

static void ask(uint16_t number)
{
    struct mavlink_in_message message = {.kind = MAVLINK_IN_COMMAND};

    message.as.command.command = number;
    give(APP_LINK_GROUND, message, WIRE_GROUND_COMPONENT);
}

static const mavlink_message_t *newest_velocity(void)
{
    return wire_last(APP_LINK_AUTOPILOT, MAVLINK_MSG_ID_SET_POSITION_TARGET_LOCAL_NED);
}

static int velocities(void)
{
    return wire_count(APP_LINK_AUTOPILOT, MAVLINK_MSG_ID_SET_POSITION_TARGET_LOCAL_NED);
}

static bool stands(const mavlink_message_t *velocity)
{
    return mavlink_msg_set_position_target_local_ned_get_vx(velocity) == 0.0F &&
           mavlink_msg_set_position_target_local_ned_get_vy(velocity) == 0.0F &&
           mavlink_msg_set_position_target_local_ned_get_vz(velocity) == 0.0F &&
           mavlink_msg_set_position_target_local_ned_get_yaw_rate(velocity) == 0.0F;
}

// Commands of a kind to the autopilot; the first parameter but one is that of the newest.
static int commands(uint16_t number, float *second)
{
    const mavlink_message_t *newest = wire_last(APP_LINK_AUTOPILOT, MAVLINK_MSG_ID_COMMAND_LONG);

    *second = mavlink_msg_command_long_get_param2(newest);
    return mavlink_msg_command_long_get_command(newest) == number
               ? wire_count(APP_LINK_AUTOPILOT, MAVLINK_MSG_ID_COMMAND_LONG)
               : 0;
}

static void test_streams(void)
{
    float interval_us;

    test_case("before a landing telemetry is asked for, and nothing else");
    start();
    fly(5000U, LOITER, 0.0, 1.5);
    CHECK(commands((uint16_t)MAV_CMD_SET_MESSAGE_INTERVAL, &interval_us) == 1 && interval_us == 20000.0F);
    CHECK(velocities() == 0);
    test_case("with no attitude none is known, with no LiDAR no height");
    start();
    flight_tick(&flight, &links, &attitude, NULL, now_us);
    CHECK(flight.known.attitude_us == 0U && flight.known.lidar_us == 0U);
    lidar.valid = false;
    flight_tick(&flight, &links, &attitude, &lidar, now_us);
    CHECK(flight.known.lidar_us == 0U);
    test_case("the LiDAR's height is along the plumb line");
    lidar = (struct lidar_reading){.valid = true, .distance_mm = 2000U};
    attitude_set(&attitude, 0.3, 0.4, now_us, now_us);
    flight_tick(&flight, &links, &attitude, &lidar, now_us);
    NEAR(flight.known.lidar_m, 2.0 * cos(0.3) * cos(0.4), 1e-9);
}

// From the start until it steers, with all telemetry there.
static void engage(void)
{
    start();
    for (size_t i = 0; i < AUTOPILOT_STREAMS; i++) {
        flight.autopilot.next_stream_us[i] = UINT64_MAX;
    }
    fly(SECOND, LOITER, 0.3, 1.8);
    CHECK(velocities() == 0 && flight.logged == 0U);
    ask((uint16_t)MAV_CMD_NAV_LAND);
    wire_clear();
}

static void test_engage(void)
{
    float mode;

    test_case("a start: it stands still and asks for the mode, after setpoints that PX4 wants to see first");
    engage();
    fly(290000U, LOITER, 0.3, 1.8);
    CHECK(flight.landing.phase == LANDING_PHASE_ENGAGE && flight.logged == 1U);
    CHECK(strcmp(wire_text(), "Touchdown: start") == 0);
    CHECK(velocities() >= 7 && velocities() <= 9); // 30 Hz
    CHECK(mavlink_msg_set_position_target_local_ned_get_vx(newest_velocity()) == 0.0F);
    CHECK(commands((uint16_t)MAV_CMD_DO_SET_MODE, &mode) == 0);
    fly(30000U, LOITER, 0.3, 1.8);
    CHECK(commands((uint16_t)MAV_CMD_DO_SET_MODE, &mode) == 1 && mode == (float)GUIDED);
    fly(500000U, LOITER, 0.3, 1.8);
    CHECK(commands((uint16_t)MAV_CMD_DO_SET_MODE, &mode) == 2);
    CHECK(mavlink_msg_command_long_get_confirmation(wire_last(APP_LINK_AUTOPILOT, MAVLINK_MSG_ID_COMMAND_LONG)) == 1U);
    test_case("in the mode it flies towards the pad, by the gain and no faster than allowed");
    fly(3U * TICK_US, GUIDED, 0.3, 1.8);
    CHECK(flight.landing.phase == LANDING_PHASE_CENTRE);
    NEAR((double)mavlink_msg_set_position_target_local_ned_get_vx(newest_velocity()), 0.21, 1e-6);
    fly(100000U, GUIDED, 3.0, 1.8);
    NEAR((double)mavlink_msg_set_position_target_local_ned_get_vx(newest_velocity()), 0.5, 1e-6);
    CHECK(mavlink_msg_set_position_target_local_ned_get_vz(newest_velocity()) == 0.0F);
    test_case("the log holds each step with its time and reason");
    const struct flight_log_row *row = &flight.log[(flight.logged - 1U) % FLIGHT_LOG_ROWS];
    CHECK(row->from == LANDING_PHASE_SEARCH && row->to == LANDING_PHASE_CENTRE && strcmp(row->reason, "pad seen") == 0);
}

static void test_abort(void)
{
    float mode;

    test_case("an abort stops it at once and for as long as the autopilot stays in the steering mode");
    engage();
    fly(500000U, GUIDED, 0.3, 1.8);
    CHECK(velocities() > 10 && !stands(newest_velocity()));
    ask((uint16_t)MAV_CMD_DO_GO_AROUND);
    wire_clear();
    fly(TICK_US, GUIDED, 0.3, 1.8);
    CHECK(velocities() == 1 && stands(newest_velocity()) && flight.landing.phase == LANDING_PHASE_GIVE_UP);
    fly(600000U, GUIDED, 0.3, 1.8);
    CHECK(velocities() >= 15 && stands(newest_velocity()));
    CHECK(commands((uint16_t)MAV_CMD_DO_SET_MODE, &mode) == 2 && mode == (float)BRAKE);
    test_case("handed back, it commands nothing any more");
    wire_clear();
    fly(TICK_US, BRAKE, 0.3, 1.8);
    CHECK(flight.landing.phase == LANDING_PHASE_STANDBY);
    fly(SECOND, GUIDED, 0.3, 1.8);
    CHECK(velocities() == 0);
    test_case("an abort before the autopilot can be steered sends no velocity");
    engage();
    fly(100000U, LOITER, 0.3, 1.8);
    ask((uint16_t)MAV_CMD_DO_GO_AROUND);
    wire_clear();
    fly(600000U, LOITER, 0.3, 1.8);
    CHECK(velocities() == 0 && flight.landing.phase == LANDING_PHASE_GIVE_UP);
}

static void answer_mode_requests(uint8_t result)
{
    struct mavlink_in_message message = {.kind = MAVLINK_IN_ACK};

    message.as.ack = (struct mavlink_in_ack){.command = (uint16_t)MAV_CMD_DO_SET_MODE, .result = result};
    of_autopilot(message);
}

// How long it waits for a mode that does not come, in a phase that has no limit.
static uint64_t wait_us(enum landing_phase phase, uint32_t mode, int result)
{
    const uint64_t since_us = now_us;

    while (flight.landing.phase == phase && now_us < since_us + 60U * (uint64_t)SECOND) {
        fly(TICK_US, mode, 0.3, 1.8);
        if (result >= 0) {
            answer_mode_requests((uint8_t)result);
        }
    }
    return now_us - since_us;
}

static void test_waits_for_a_mode(void)
{
    static const int results[] = {-1, MAV_RESULT_ACCEPTED, MAV_RESULT_TEMPORARILY_REJECTED, MAV_RESULT_FAILED,
                                  MAV_RESULT_IN_PROGRESS};

    for (size_t i = 0; i < sizeof results / sizeof results[0]; i++) {
        test_case("a mode that does not come is refused within 3 s, answer %d", results[i]);
        engage();
        fly(TICK_US, LOITER, 0.3, 1.8);
        CHECK(flight.landing.phase == LANDING_PHASE_ENGAGE);
        CHECK(wait_us(LANDING_PHASE_ENGAGE, LOITER, results[i]) <= 3U * SECOND);
        CHECK(flight.landing.phase == LANDING_PHASE_STANDBY);
        engage();
        fly(500000U, GUIDED, 0.3, 1.8);
        ask((uint16_t)MAV_CMD_DO_GO_AROUND);
        fly(TICK_US, GUIDED, 0.3, 1.8);
        CHECK(flight.landing.phase == LANDING_PHASE_GIVE_UP);
        CHECK(wait_us(LANDING_PHASE_GIVE_UP, GUIDED, results[i]) <= 3U * SECOND);
        CHECK(flight.landing.phase == LANDING_PHASE_STANDBY);
    }
}

static void test_gap(void)
{
    test_case("after a while without frames the pad is not steered by before it was seen in five");
    engage();
    fly(500000U, GUIDED, 0.3, 1.8);
    const uint64_t until_us = now_us + 2U * SECOND;
    while (now_us < until_us) {
        now_us += TICK_US;
        heartbeat(GUIDED, true);
        attitude_set(&attitude, 0.0, 0.0, now_us, now_us);
        flight_tick(&flight, &links, &attitude, &lidar, now_us);
    }
    CHECK(flight.landing.phase == LANDING_PHASE_WAIT);
    fly(4U * TICK_US, GUIDED, 0.3, 1.8);
    CHECK(flight.landing.phase == LANDING_PHASE_WAIT);
    fly(TICK_US, GUIDED, 0.3, 1.8);
    CHECK(flight.landing.phase == LANDING_PHASE_CENTRE);
    test_case("nor is another one");
    fly(100000U, GUIDED, 0.3, 1.8);
    CHECK(!stands(newest_velocity()));
    flight_on_new_track(&flight);
    fly(4U * TICK_US, GUIDED, -0.5, 1.8);
    CHECK(stands(newest_velocity()) && flight.landing.phase == LANDING_PHASE_CENTRE);
    fly(100000U, GUIDED, -0.5, 1.8);
    CHECK(mavlink_msg_set_position_target_local_ned_get_vx(newest_velocity()) < 0.0F);
}

static void test_no_attitude(void)
{
    test_case("a pad of a frame without an attitude is seen, and not steered by, before or after ATTITUDE is back");
    engage();
    fly(500000U, GUIDED, 0.3, 1.8);
    const uint64_t until_us = now_us + SECOND;
    while (now_us < until_us) {
        now_us += TICK_US;
        heartbeat(GUIDED, true);
        frame(-0.9, 1.8, 0.0, true);
        flight_tick(&flight, &links, &attitude, &lidar, now_us);
    }
    const uint32_t facts = landing_facts(&flight.landing, &flight.known, now_us);
    CHECK(flight.landing.phase == LANDING_PHASE_WAIT && flight.known.pad_row == 0U);
    CHECK((facts & LANDING_FACT_ATTITUDE_STALE) != 0U && (facts & LANDING_FACT_PAD) == 0U);
    CHECK((facts & (LANDING_FACT_PAD_LOST | LANDING_FACT_CAMERA_LOST | LANDING_FACT_LIDAR_CONTRADICTS)) == 0U);
    // The frame before was turned level without it.
    attitude_set(&attitude, 0.0, 0.0, now_us, now_us);
    flight_tick(&flight, &links, &attitude, &lidar, now_us);
    CHECK(!landing_sees_pad(&flight.known, now_us));
    fly(4U * TICK_US, GUIDED, 0.3, 1.8);
    CHECK(flight.landing.phase == LANDING_PHASE_WAIT && stands(newest_velocity()));
    fly(TICK_US, GUIDED, 0.3, 1.8);
    CHECK(flight.landing.phase == LANDING_PHASE_CENTRE);
    test_case("while the autopilot lands by itself the pad is not lost for want of an attitude");
    fly(2U * SECOND, GUIDED, 0.0, 1.8);
    fly(3U * SECOND, GUIDED, 0.0, 0.9);
    CHECK(flight.landing.phase == LANDING_PHASE_LAND);
    for (int i = 0; i < 100; i++) {
        now_us += TICK_US;
        heartbeat(LAND, true);
        frame(0.0, 0.8, 0.0, true);
        flight_tick(&flight, &links, &attitude, &lidar, now_us);
    }
    CHECK(flight.landing.phase == LANDING_PHASE_LAND);
}

static void test_down_and_another_mode(void)
{
    struct mavlink_in_message landed = {.kind = MAVLINK_IN_LANDED_STATE};

    test_case("down with motors off is landed, also where the mode changes with it");
    engage();
    fly(2U * SECOND, GUIDED, 0.0, 1.8);
    fly(3U * SECOND, GUIDED, 0.0, 0.9);
    fly(SECOND, LAND, 0.0, 0.3);
    landed.as.landed_state = (uint8_t)MAV_LANDED_STATE_ON_GROUND;
    of_autopilot(landed);
    fly(SECOND, LAND, 0.0, 0.1);
    CHECK(flight.landing.phase == LANDING_PHASE_TOUCHDOWN);
    heartbeat(LOITER, false);
    flight_tick(&flight, &links, &attitude, &lidar, now_us);
    CHECK(flight.landing.phase == LANDING_PHASE_LANDED);
}

static void test_abort_without_word_of_the_mode(void)
{
    const uint64_t least_us = 400000U;
    float mode;

    test_case("until a HEARTBEAT says that no one took over it stands still, and goes on to until it holds");
    engage();
    fly(500000U, GUIDED, 3.0, 1.8);
    now_us += 200000U;
    ask((uint16_t)MAV_CMD_DO_GO_AROUND);
    wire_clear();
    for (const uint64_t end_us = now_us + least_us; now_us < end_us; now_us += TICK_US) {
        flight_tick(&flight, &links, &attitude, &lidar, now_us);
        CHECK(mavlink_msg_set_position_target_local_ned_get_vx(newest_velocity()) == 0.0F);
    }
    CHECK(flight.landing.phase == LANDING_PHASE_GIVE_UP && velocities() >= 10);
    CHECK(commands((uint16_t)MAV_CMD_DO_SET_MODE, &mode) == 0);
    wire_clear();
    fly(TICK_US, GUIDED, 3.0, 1.8);
    CHECK(commands((uint16_t)MAV_CMD_DO_SET_MODE, &mode) == 1 && mode == (float)BRAKE);
    fly(SECOND, BRAKE, 3.0, 1.8);
    wire_clear();
    fly(SECOND, BRAKE, 3.0, 1.8);
    CHECK(velocities() == 0);
}

static void test_down(void)
{
    struct mavlink_in_message landed = {.kind = MAVLINK_IN_LANDED_STATE};
    float force;

    test_case("centred it goes down, aligned it lands");
    engage();
    fly(2U * SECOND, GUIDED, 0.0, 1.8);
    CHECK(flight.landing.phase == LANDING_PHASE_DESCEND);
    NEAR((double)mavlink_msg_set_position_target_local_ned_get_vz(newest_velocity()), 0.25, 1e-6);
    fly(3U * SECOND, GUIDED, 0.0, 0.9);
    CHECK(flight.landing.phase == LANDING_PHASE_LAND);
    test_case("it stands still until the autopilot lands");
    CHECK(stands(newest_velocity()));
    wire_clear();
    fly(100000U, GUIDED, 0.1, 0.9);
    CHECK(velocities() >= 2 && stands(newest_velocity()));
    wire_clear();
    fly(SECOND, LAND, 0.0, 0.3);
    CHECK(velocities() == 0 && flight.landing.committed);
    test_case("on the ground it asks for the motors off, without force");
    landed.as.landed_state = (uint8_t)MAV_LANDED_STATE_ON_GROUND;
    of_autopilot(landed);
    wire_clear();
    fly(5U * SECOND, LAND, 0.0, 0.1);
    CHECK(flight.landing.phase == LANDING_PHASE_TOUCHDOWN);
    CHECK(commands((uint16_t)MAV_CMD_COMPONENT_ARM_DISARM, &force) == 0);
    fly(2U * TICK_US, LAND, 0.0, 0.1);
    CHECK(commands((uint16_t)MAV_CMD_COMPONENT_ARM_DISARM, &force) == 1 && force == 0.0F);
    CHECK(mavlink_msg_command_long_get_param1(wire_last(APP_LINK_AUTOPILOT, MAVLINK_MSG_ID_COMMAND_LONG)) == 0.0F);
    fly(SECOND, LAND, 0.0, 0.1);
    CHECK(commands((uint16_t)MAV_CMD_COMPONENT_ARM_DISARM, &force) == 2);
    heartbeat(LAND, false);
    flight_tick(&flight, &links, &attitude, &lidar, now_us);
    CHECK(flight.landing.phase == LANDING_PHASE_LANDED);
}

void test_flight(void)
{
    test_switch();
    test_who_is_heard();
    test_frames();
    test_streams();
    test_engage();
    test_abort();
    test_waits_for_a_mode();
    test_gap();
    test_no_attitude();
    test_down_and_another_mode();
    test_abort_without_word_of_the_mode();
    test_down();
}

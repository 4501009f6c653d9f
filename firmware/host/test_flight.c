// SPDX-License-Identifier: Apache-2.0
// The landing joined together: what it takes from messages, and from frames.
#include <math.h>

#include "test.h"
#include "test_flight_rig.h"

#define SWITCH 7U // the channel of TD_RC_CHAN, from 0

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
    rig.flight.known.asked = 0U;
    rig_of_autopilot(rc_message(channel, value_us));
    return rig.flight.known.asked;
}

// The same of the usual channel.
static uint32_t asked_by(uint16_t value_us)
{
    return asked_on(SWITCH, value_us);
}

static void test_switch(void)
{
    test_case("a switch that is on from the beginning starts nothing");
    rig_start();
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
    rig_start();
    CHECK(asked_by(1000U) == 0U);
    CHECK(asked_by(2000U) == LANDING_FACT_START);
    test_case("no channel is watched with TD_RC_CHAN 0, or one that there is not");
    rig_start();
    CHECK(asked_by(1000U) == 0U);
    rig.flight.parameters.rc_channel = 0.0F;
    CHECK(asked_by(2000U) == 0U);
    rig.flight.parameters.rc_channel = 19.0F;
    CHECK(asked_by(2000U) == 0U);
    test_case("channels count only as the autopilot says them");
    rig.flight.parameters.rc_channel = 8.0F;
    rig_give(APP_LINK_GROUND, rc_message(SWITCH, 2000U), (uint8_t)MAV_COMP_ID_AUTOPILOT1);
    rig_give(APP_LINK_AUTOPILOT, rc_message(SWITCH, 2000U), (uint8_t)MAV_COMP_ID_CAMERA);
    CHECK(rig.flight.known.asked == 0U);
    CHECK(asked_by(1000U) == 0U && asked_by(2000U) == LANDING_FACT_START);
    test_case("what is known of a switch is not known of another channel");
    CHECK(asked_by(1000U) == LANDING_FACT_ABORT);
    rig.flight.parameters.rc_channel = 9.0F;
    CHECK(asked_on(SWITCH + 1U, 2000U) == 0U);
    CHECK(asked_on(SWITCH + 1U, 1000U) == LANDING_FACT_ABORT && asked_on(SWITCH + 1U, 2000U) == LANDING_FACT_START);
    rig.flight.parameters.rc_channel = 8.0F;
    CHECK(asked_by(1000U) == 0U);
}

static void test_who_is_heard(void)
{
    struct mavlink_in_message message = {.kind = MAVLINK_IN_HEARTBEAT};

    test_case("a ground station is one on either link; the autopilot only on its own");
    rig_start();
    message.as.heartbeat.type = (uint8_t)MAV_TYPE_GCS;
    rig_give(APP_LINK_GROUND, message, WIRE_GROUND_COMPONENT);
    CHECK(rig.flight.known.ground_us == rig.now_us && !rig.flight.autopilot.heard);
    message.as.heartbeat.type = (uint8_t)MAV_TYPE_QUADROTOR;
    rig.now_us += SECOND;
    rig_give(APP_LINK_GROUND, message, (uint8_t)MAV_COMP_ID_AUTOPILOT1);
    CHECK(rig.flight.known.ground_us == rig.now_us - SECOND && !rig.flight.autopilot.heard);
    message.system = 2U;
    flight_on_message(&rig.flight, &rig.links, APP_LINK_AUTOPILOT, &message, rig.now_us);
    CHECK(!rig.flight.autopilot.heard);
    rig_of_autopilot(message);
    CHECK(rig.flight.autopilot.heard);
    test_case("commands and parameters are answered on the link they came from");
    message = (struct mavlink_in_message){.kind = MAVLINK_IN_COMMAND};
    message.as.command.command = (uint16_t)MAV_CMD_DO_GO_AROUND;
    rig_of_autopilot(message);
    CHECK(wire_count(APP_LINK_AUTOPILOT, MAVLINK_MSG_ID_COMMAND_ACK) == 1);
    CHECK(rig.flight.known.asked == LANDING_FACT_ABORT);
    message = (struct mavlink_in_message){.kind = MAVLINK_IN_PARAM_READ};
    rig_give(APP_LINK_GROUND, message, WIRE_GROUND_COMPONENT);
    CHECK(wire_count(APP_LINK_GROUND, MAVLINK_MSG_ID_PARAM_VALUE) == 1);
}

static void test_frames(void)
{
    test_case("a frame with the pad: as large as the altitude says, counted, and whether the LiDAR agrees");
    rig_start();
    attitude_set(&rig.attitude, 0.0, 0.0, rig.now_us, rig.now_us);
    rig_frame(0.4, 2.0, 90.0, true);
    NEAR(rig.flight.known.pad.forward_m, 0.4, 1e-9);
    NEAR(rig.flight.known.pad.down_m, 2.0, 1e-9);
    NEAR(rig.flight.known.pad.angle_rad, 1.5707963, 1e-6);
    CHECK(rig.flight.known.pad_row == 1U && rig.flight.known.pad_us == rig.now_us);
    CHECK(rig.flight.known.agreed_us == rig.now_us);
    rig.now_us += TICK_US;
    rig_frame(0.4, 2.0, 90.0, false);
    CHECK(rig.flight.known.pad_row == 2U && rig.flight.known.agreed_us == rig.now_us - TICK_US);
    test_case("a frame without a reading of the LiDAR does not make it agree");
    rig.now_us += TICK_US;
    rig_frame(0.4, 2.0, 90.0, true);
    CHECK(rig.flight.known.pad_us == rig.now_us && rig.flight.known.agreed_us == rig.now_us - 2U * TICK_US);
    test_case("a count that is at its end stays there");
    rig.flight.known.pad_row = UINT32_MAX;
    rig_frame(0.4, 2.0, 90.0, true);
    CHECK(rig.flight.known.pad_row == UINT32_MAX);
    test_case("a tenth of a second without frames begins the count anew, as does a pad that need not be the same");
    rig.flight.known.pad_row = 4U;
    rig.now_us += 100000U;
    rig_frame(0.4, 2.0, 90.0, true);
    CHECK(rig.flight.known.pad_row == 5U);
    rig.now_us += 100001U;
    rig_frame(0.4, 2.0, 90.0, true);
    CHECK(rig.flight.known.pad_row == 1U);
    flight_on_new_track(&rig.flight);
    rig_frame(0.4, 2.0, 90.0, true);
    CHECK(rig.flight.known.pad_row == 1U);
    test_case("a frame without the pad begins the count anew");
    rig.now_us += TICK_US;
    flight_on_frame(&rig.flight, &rig.attitude, NULL, &(struct altitude){.height_m = 2.0}, rig.now_us, rig.now_us);
    CHECK(rig.flight.known.pad_row == 0U && rig.flight.known.record_us == rig.now_us);
    CHECK(rig.flight.known.pad_us == rig.now_us - TICK_US);
}

static void test_streams(void)
{
    float interval_us;

    test_case("before a landing telemetry is asked for, and nothing else");
    rig_start();
    rig_fly(5000U, LOITER, 0.0, 1.5);
    CHECK(rig_commands((uint16_t)MAV_CMD_SET_MESSAGE_INTERVAL, &interval_us) == 1 && interval_us == 20000.0F);
    CHECK(rig_velocities() == 0);
    test_case("with no attitude none is known, with no LiDAR no height");
    rig_start();
    flight_tick(&rig.flight, &rig.links, &rig.attitude, NULL, rig.now_us);
    CHECK(rig.flight.known.attitude_us == 0U && rig.flight.known.lidar_us == 0U);
    rig.lidar.valid = false;
    flight_tick(&rig.flight, &rig.links, &rig.attitude, &rig.lidar, rig.now_us);
    CHECK(rig.flight.known.lidar_us == 0U);
    test_case("the LiDAR's height is along the plumb line");
    rig.lidar = (struct lidar_reading){.valid = true, .distance_mm = 2000U};
    attitude_set(&rig.attitude, 0.3, 0.4, rig.now_us, rig.now_us);
    flight_tick(&rig.flight, &rig.links, &rig.attitude, &rig.lidar, rig.now_us);
    NEAR(rig.flight.known.lidar_m, 2.0 * cos(0.3) * cos(0.4), 1e-9);
}

void test_flight(void)
{
    test_switch();
    test_who_is_heard();
    test_frames();
    test_streams();
}

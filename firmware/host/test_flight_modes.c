// SPDX-License-Identifier: Apache-2.0
// The landing joined together: each phase with the autopilot's mode, as it comes, does not come, and is lost.
#include <string.h>

#include "test.h"
#include "test_flight_rig.h"

static void test_engage(void)
{
    float mode;

    test_case("a start: it stands still and asks for the mode, after setpoints that PX4 wants to see first");
    rig_engage();
    rig_fly(290000U, LOITER, 0.3, 1.8);
    CHECK(rig.flight.landing.phase == LANDING_PHASE_ENGAGE && rig.flight.logged == 1U);
    CHECK(strcmp(wire_text(), "Touchdown: start") == 0);
    CHECK(rig_velocities() >= 7 && rig_velocities() <= 9); // 30 Hz
    CHECK(mavlink_msg_set_position_target_local_ned_get_vx(rig_newest_velocity()) == 0.0F);
    CHECK(rig_commands((uint16_t)MAV_CMD_DO_SET_MODE, &mode) == 0);
    rig_fly(30000U, LOITER, 0.3, 1.8);
    CHECK(rig_commands((uint16_t)MAV_CMD_DO_SET_MODE, &mode) == 1 && mode == (float)GUIDED);
    rig_fly(500000U, LOITER, 0.3, 1.8);
    CHECK(rig_commands((uint16_t)MAV_CMD_DO_SET_MODE, &mode) == 2);
    CHECK(mavlink_msg_command_long_get_confirmation(wire_last(APP_LINK_AUTOPILOT, MAVLINK_MSG_ID_COMMAND_LONG)) == 1U);
    test_case("in the mode it flies towards the pad, by the gain and no faster than allowed");
    rig_fly(3U * TICK_US, GUIDED, 0.3, 1.8);
    CHECK(rig.flight.landing.phase == LANDING_PHASE_CENTRE);
    NEAR((double)mavlink_msg_set_position_target_local_ned_get_vx(rig_newest_velocity()), 0.21, 1e-6);
    rig_fly(100000U, GUIDED, 3.0, 1.8);
    NEAR((double)mavlink_msg_set_position_target_local_ned_get_vx(rig_newest_velocity()), 0.5, 1e-6);
    CHECK(mavlink_msg_set_position_target_local_ned_get_vz(rig_newest_velocity()) == 0.0F);
    test_case("the log holds each step with its time and reason");
    const struct flight_log_row *row = &rig.flight.log[(rig.flight.logged - 1U) % FLIGHT_LOG_ROWS];
    CHECK(row->from == LANDING_PHASE_SEARCH && row->to == LANDING_PHASE_CENTRE && strcmp(row->reason, "pad seen") == 0);
}

static void test_abort(void)
{
    float mode;

    test_case("an abort stops it at once and for as long as the autopilot stays in the steering mode");
    rig_engage();
    rig_fly(500000U, GUIDED, 0.3, 1.8);
    CHECK(rig_velocities() > 10 && !rig_stands(rig_newest_velocity()));
    rig_ask((uint16_t)MAV_CMD_DO_GO_AROUND);
    wire_clear();
    rig_fly(TICK_US, GUIDED, 0.3, 1.8);
    CHECK(rig_velocities() == 1 && rig_stands(rig_newest_velocity()));
    CHECK(rig.flight.landing.phase == LANDING_PHASE_GIVE_UP);
    rig_fly(600000U, GUIDED, 0.3, 1.8);
    CHECK(rig_velocities() >= 15 && rig_stands(rig_newest_velocity()));
    CHECK(rig_commands((uint16_t)MAV_CMD_DO_SET_MODE, &mode) == 2 && mode == (float)BRAKE);
    test_case("handed back, it commands nothing any more");
    wire_clear();
    rig_fly(TICK_US, BRAKE, 0.3, 1.8);
    CHECK(rig.flight.landing.phase == LANDING_PHASE_STANDBY);
    rig_fly(SECOND, GUIDED, 0.3, 1.8);
    CHECK(rig_velocities() == 0);
    test_case("an abort before the autopilot can be steered sends no velocity");
    rig_engage();
    rig_fly(100000U, LOITER, 0.3, 1.8);
    rig_ask((uint16_t)MAV_CMD_DO_GO_AROUND);
    wire_clear();
    rig_fly(600000U, LOITER, 0.3, 1.8);
    CHECK(rig_velocities() == 0 && rig.flight.landing.phase == LANDING_PHASE_GIVE_UP);
}

static void answer_mode_requests(uint8_t result)
{
    struct mavlink_in_message message = {.kind = MAVLINK_IN_ACK};

    message.as.ack = (struct mavlink_in_ack){.command = (uint16_t)MAV_CMD_DO_SET_MODE, .result = result};
    rig_of_autopilot(message);
}

// How long it waits for a mode that does not come, in a phase that has no limit.
static uint64_t wait_us(enum landing_phase phase, uint32_t mode, int result)
{
    const uint64_t since_us = rig.now_us;

    while (rig.flight.landing.phase == phase && rig.now_us < since_us + 60U * (uint64_t)SECOND) {
        rig_fly(TICK_US, mode, 0.3, 1.8);
        if (result >= 0) {
            answer_mode_requests((uint8_t)result);
        }
    }
    return rig.now_us - since_us;
}

static void test_waits_for_a_mode(void)
{
    static const int results[] = {-1, MAV_RESULT_ACCEPTED, MAV_RESULT_TEMPORARILY_REJECTED, MAV_RESULT_FAILED,
                                  MAV_RESULT_IN_PROGRESS};

    for (size_t i = 0; i < sizeof results / sizeof results[0]; i++) {
        test_case("a mode that does not come is refused within 3 s, answer %d", results[i]);
        rig_engage();
        rig_fly(TICK_US, LOITER, 0.3, 1.8);
        CHECK(rig.flight.landing.phase == LANDING_PHASE_ENGAGE);
        CHECK(wait_us(LANDING_PHASE_ENGAGE, LOITER, results[i]) <= 3U * SECOND);
        CHECK(rig.flight.landing.phase == LANDING_PHASE_STANDBY);
        rig_engage();
        rig_fly(500000U, GUIDED, 0.3, 1.8);
        rig_ask((uint16_t)MAV_CMD_DO_GO_AROUND);
        rig_fly(TICK_US, GUIDED, 0.3, 1.8);
        CHECK(rig.flight.landing.phase == LANDING_PHASE_GIVE_UP);
        CHECK(wait_us(LANDING_PHASE_GIVE_UP, GUIDED, results[i]) <= 3U * SECOND);
        CHECK(rig.flight.landing.phase == LANDING_PHASE_STANDBY);
    }
}

static void test_gap(void)
{
    test_case("after a while without frames the pad is not steered by before it was seen in five");
    rig_engage();
    rig_fly(500000U, GUIDED, 0.3, 1.8);
    const uint64_t until_us = rig.now_us + 2U * SECOND;
    while (rig.now_us < until_us) {
        rig.now_us += TICK_US;
        rig_heartbeat(GUIDED, true);
        attitude_set(&rig.attitude, 0.0, 0.0, rig.now_us, rig.now_us);
        flight_tick(&rig.flight, &rig.links, &rig.attitude, &rig.lidar, rig.now_us);
    }
    CHECK(rig.flight.landing.phase == LANDING_PHASE_WAIT);
    rig_fly(4U * TICK_US, GUIDED, 0.3, 1.8);
    CHECK(rig.flight.landing.phase == LANDING_PHASE_WAIT);
    rig_fly(TICK_US, GUIDED, 0.3, 1.8);
    CHECK(rig.flight.landing.phase == LANDING_PHASE_CENTRE);
    test_case("nor is another one");
    rig_fly(100000U, GUIDED, 0.3, 1.8);
    CHECK(!rig_stands(rig_newest_velocity()));
    flight_on_new_track(&rig.flight);
    rig_fly(4U * TICK_US, GUIDED, -0.5, 1.8);
    CHECK(rig_stands(rig_newest_velocity()) && rig.flight.landing.phase == LANDING_PHASE_CENTRE);
    rig_fly(100000U, GUIDED, -0.5, 1.8);
    CHECK(mavlink_msg_set_position_target_local_ned_get_vx(rig_newest_velocity()) < 0.0F);
}

static void test_no_attitude(void)
{
    test_case("a pad of a frame without an attitude is seen, and not steered by, before or after ATTITUDE is back");
    rig_engage();
    rig_fly(500000U, GUIDED, 0.3, 1.8);
    const uint64_t until_us = rig.now_us + SECOND;
    while (rig.now_us < until_us) {
        rig.now_us += TICK_US;
        rig_heartbeat(GUIDED, true);
        rig_frame(-0.9, 1.8, 0.0, true);
        flight_tick(&rig.flight, &rig.links, &rig.attitude, &rig.lidar, rig.now_us);
    }
    const uint32_t facts = landing_facts(&rig.flight.landing, &rig.flight.known, rig.now_us);
    CHECK(rig.flight.landing.phase == LANDING_PHASE_WAIT && rig.flight.known.pad_row == 0U);
    CHECK((facts & LANDING_FACT_ATTITUDE_STALE) != 0U && (facts & LANDING_FACT_PAD) == 0U);
    CHECK((facts & (LANDING_FACT_PAD_LOST | LANDING_FACT_CAMERA_LOST | LANDING_FACT_LIDAR_CONTRADICTS)) == 0U);
    // The frame before was turned level without it.
    attitude_set(&rig.attitude, 0.0, 0.0, rig.now_us, rig.now_us);
    flight_tick(&rig.flight, &rig.links, &rig.attitude, &rig.lidar, rig.now_us);
    CHECK(!landing_sees_pad(&rig.flight.known, rig.now_us));
    rig_fly(4U * TICK_US, GUIDED, 0.3, 1.8);
    CHECK(rig.flight.landing.phase == LANDING_PHASE_WAIT && rig_stands(rig_newest_velocity()));
    rig_fly(TICK_US, GUIDED, 0.3, 1.8);
    CHECK(rig.flight.landing.phase == LANDING_PHASE_CENTRE);
    test_case("while the autopilot lands by itself the pad is not lost for want of an attitude");
    rig_fly(2U * SECOND, GUIDED, 0.0, 1.8);
    rig_fly(3U * SECOND, GUIDED, 0.0, 0.9);
    CHECK(rig.flight.landing.phase == LANDING_PHASE_LAND);
    for (int i = 0; i < 100; i++) {
        rig.now_us += TICK_US;
        rig_heartbeat(LAND, true);
        rig_frame(0.0, 0.8, 0.0, true);
        flight_tick(&rig.flight, &rig.links, &rig.attitude, &rig.lidar, rig.now_us);
    }
    CHECK(rig.flight.landing.phase == LANDING_PHASE_LAND);
}

static void test_down_and_another_mode(void)
{
    struct mavlink_in_message landed = {.kind = MAVLINK_IN_LANDED_STATE};

    test_case("down with motors off is landed, also where the mode changes with it");
    rig_engage();
    rig_fly(2U * SECOND, GUIDED, 0.0, 1.8);
    rig_fly(3U * SECOND, GUIDED, 0.0, 0.9);
    rig_fly(SECOND, LAND, 0.0, 0.3);
    landed.as.landed_state = (uint8_t)MAV_LANDED_STATE_ON_GROUND;
    rig_of_autopilot(landed);
    rig_fly(SECOND, LAND, 0.0, 0.1);
    CHECK(rig.flight.landing.phase == LANDING_PHASE_TOUCHDOWN);
    rig_heartbeat(LOITER, false);
    flight_tick(&rig.flight, &rig.links, &rig.attitude, &rig.lidar, rig.now_us);
    CHECK(rig.flight.landing.phase == LANDING_PHASE_LANDED);
}

static void test_abort_without_word_of_the_mode(void)
{
    const uint64_t least_us = 400000U;
    float mode;

    test_case("until a HEARTBEAT says that no one took over it stands still, and goes on to until it holds");
    rig_engage();
    rig_fly(500000U, GUIDED, 3.0, 1.8);
    rig.now_us += 200000U;
    rig_ask((uint16_t)MAV_CMD_DO_GO_AROUND);
    wire_clear();
    for (const uint64_t end_us = rig.now_us + least_us; rig.now_us < end_us; rig.now_us += TICK_US) {
        flight_tick(&rig.flight, &rig.links, &rig.attitude, &rig.lidar, rig.now_us);
        CHECK(mavlink_msg_set_position_target_local_ned_get_vx(rig_newest_velocity()) == 0.0F);
    }
    CHECK(rig.flight.landing.phase == LANDING_PHASE_GIVE_UP && rig_velocities() >= 10);
    CHECK(rig_commands((uint16_t)MAV_CMD_DO_SET_MODE, &mode) == 0);
    wire_clear();
    rig_fly(TICK_US, GUIDED, 3.0, 1.8);
    CHECK(rig_commands((uint16_t)MAV_CMD_DO_SET_MODE, &mode) == 1 && mode == (float)BRAKE);
    rig_fly(SECOND, BRAKE, 3.0, 1.8);
    wire_clear();
    rig_fly(SECOND, BRAKE, 3.0, 1.8);
    CHECK(rig_velocities() == 0);
}

static void test_down(void)
{
    struct mavlink_in_message landed = {.kind = MAVLINK_IN_LANDED_STATE};
    float force;

    test_case("centred it goes down, aligned it lands");
    rig_engage();
    rig_fly(2U * SECOND, GUIDED, 0.0, 1.8);
    CHECK(rig.flight.landing.phase == LANDING_PHASE_DESCEND);
    NEAR((double)mavlink_msg_set_position_target_local_ned_get_vz(rig_newest_velocity()), 0.25, 1e-6);
    rig_fly(3U * SECOND, GUIDED, 0.0, 0.9);
    CHECK(rig.flight.landing.phase == LANDING_PHASE_LAND);
    test_case("it stands still until the autopilot lands");
    CHECK(rig_stands(rig_newest_velocity()));
    wire_clear();
    rig_fly(100000U, GUIDED, 0.1, 0.9);
    CHECK(rig_velocities() >= 2 && rig_stands(rig_newest_velocity()));
    wire_clear();
    rig_fly(SECOND, LAND, 0.0, 0.3);
    CHECK(rig_velocities() == 0 && rig.flight.landing.committed);
    test_case("on the ground it asks for the motors off, without force");
    landed.as.landed_state = (uint8_t)MAV_LANDED_STATE_ON_GROUND;
    rig_of_autopilot(landed);
    wire_clear();
    rig_fly(5U * SECOND, LAND, 0.0, 0.1);
    CHECK(rig.flight.landing.phase == LANDING_PHASE_TOUCHDOWN);
    CHECK(rig_commands((uint16_t)MAV_CMD_COMPONENT_ARM_DISARM, &force) == 0);
    rig_fly(2U * TICK_US, LAND, 0.0, 0.1);
    CHECK(rig_commands((uint16_t)MAV_CMD_COMPONENT_ARM_DISARM, &force) == 1 && force == 0.0F);
    CHECK(mavlink_msg_command_long_get_param1(wire_last(APP_LINK_AUTOPILOT, MAVLINK_MSG_ID_COMMAND_LONG)) == 0.0F);
    rig_fly(SECOND, LAND, 0.0, 0.1);
    CHECK(rig_commands((uint16_t)MAV_CMD_COMPONENT_ARM_DISARM, &force) == 2);
    rig_heartbeat(LAND, false);
    flight_tick(&rig.flight, &rig.links, &rig.attitude, &rig.lidar, rig.now_us);
    CHECK(rig.flight.landing.phase == LANDING_PHASE_LANDED);
}

void test_flight_modes(void)
{
    test_engage();
    test_abort();
    test_waits_for_a_mode();
    test_gap();
    test_no_attitude();
    test_down_and_another_mode();
    test_abort_without_word_of_the_mode();
    test_down();
}

// SPDX-License-Identifier: Apache-2.0
#include <string.h>

#include <common/mavlink.h>

#include "autopilot.h"
#include "test.h"

#define SECOND 1000000U

static struct autopilot autopilot;
static struct autopilot_command command;

static void heartbeat(uint8_t kind, uint32_t custom_mode, uint8_t base_mode, uint64_t now_us)
{
    const struct mavlink_in_message message = {
        .kind = MAVLINK_IN_HEARTBEAT,
        .as.heartbeat = {.custom_mode = custom_mode, .autopilot = kind, .base_mode = base_mode},
    };

    autopilot_on_message(&autopilot, &message, now_us);
}

static void acknowledge(uint16_t of, uint8_t result, uint64_t now_us)
{
    const struct mavlink_in_message message = {.kind = MAVLINK_IN_ACK, .as.ack = {.command = of, .result = result}};

    autopilot_on_message(&autopilot, &message, now_us);
}

static void start(uint8_t kind, uint32_t custom_mode)
{
    autopilot_init(&autopilot, rates_of(RATES_AUTOPILOT, 0U));
    heartbeat(kind, custom_mode, MAV_MODE_FLAG_SAFETY_ARMED, SECOND);
}

static void test_heard(void)
{
    test_case("silence");
    autopilot_init(&autopilot, rates_of(RATES_AUTOPILOT, 0U));
    CHECK(!autopilot_is_heard(&autopilot, 0U));
    start(MAV_AUTOPILOT_ARDUPILOTMEGA, 5U);
    CHECK(autopilot_is_heard(&autopilot, SECOND + AUTOPILOT_SILENT_US));
    CHECK(!autopilot_is_heard(&autopilot, SECOND + AUTOPILOT_SILENT_US + 1U));
    CHECK(autopilot.armed);
    heartbeat(MAV_AUTOPILOT_ARDUPILOTMEGA, 5U, 0U, 2U * SECOND);
    CHECK(!autopilot.armed);
}

static void test_modes(void)
{
    static const struct {
        uint8_t kind;
        enum landing_mode mode;
        uint32_t custom_mode;
        float main;
        float sub;
    } rows[] = {
        {MAV_AUTOPILOT_ARDUPILOTMEGA, LANDING_MODE_STEER, 4U, 4.0F, 0.0F},
        {MAV_AUTOPILOT_ARDUPILOTMEGA, LANDING_MODE_LAND, 9U, 9.0F, 0.0F},
        {MAV_AUTOPILOT_ARDUPILOTMEGA, LANDING_MODE_HOLD, 17U, 17.0F, 0.0F},
        {MAV_AUTOPILOT_PX4, LANDING_MODE_STEER, 0x00060000U, 6.0F, 0.0F},
        {MAV_AUTOPILOT_PX4, LANDING_MODE_LAND, 0x09040000U, 4.0F, 9.0F},
        {MAV_AUTOPILOT_PX4, LANDING_MODE_HOLD, 0x03040000U, 4.0F, 3.0F},
    };

    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        test_case("mode %u of autopilot %u", (unsigned)rows[i].mode, (unsigned)rows[i].kind);
        start(rows[i].kind, 1U);
        autopilot_want(&autopilot, rows[i].mode, 2U * SECOND);
        CHECK(!autopilot_is_in(&autopilot, rows[i].mode));
        // Setpoints come first.
        heartbeat(rows[i].kind, 1U, 0U, 2U * SECOND);
        CHECK(!autopilot_mode_request(&autopilot, 2U * SECOND, &command));
        heartbeat(rows[i].kind, 1U, 0U, 3U * SECOND);
        CHECK(autopilot_mode_request(&autopilot, 3U * SECOND, &command));
        CHECK(command.command == MAV_CMD_DO_SET_MODE && command.parameters[0] == 1.0F);
        CHECK(command.parameters[1] == rows[i].main && command.parameters[2] == rows[i].sub);
        CHECK(!autopilot_mode_request(&autopilot, 3U * SECOND + 1U, &command));
        heartbeat(rows[i].kind, rows[i].custom_mode, 0U, 4U * SECOND);
        CHECK(autopilot_is_in(&autopilot, rows[i].mode));
        CHECK(!autopilot_mode_request(&autopilot, 5U * SECOND, &command));
        CHECK(!autopilot.mode_taken && !autopilot_refuses(&autopilot, 5U * SECOND));
    }
    CHECK(!autopilot_is_in(&autopilot, LANDING_MODE_NONE));
}

static void test_pilot(void)
{
    test_case("the mode that it was in when another was asked for is no one's doing");
    start(MAV_AUTOPILOT_ARDUPILOTMEGA, 5U);
    autopilot_want(&autopilot, LANDING_MODE_STEER, SECOND);
    heartbeat(MAV_AUTOPILOT_ARDUPILOTMEGA, 5U, 0U, 2U * SECOND);
    CHECK(!autopilot.mode_taken);
    test_case("once taken, that very mode is someone's");
    heartbeat(MAV_AUTOPILOT_ARDUPILOTMEGA, 4U, 0U, 3U * SECOND);
    CHECK(!autopilot.mode_taken);
    heartbeat(MAV_AUTOPILOT_ARDUPILOTMEGA, 5U, 0U, 4U * SECOND);
    CHECK(autopilot.mode_taken);
    test_case("a third mode is someone's at any time");
    start(MAV_AUTOPILOT_ARDUPILOTMEGA, 5U);
    autopilot_want(&autopilot, LANDING_MODE_STEER, SECOND);
    heartbeat(MAV_AUTOPILOT_ARDUPILOTMEGA, 6U, 0U, 2U * SECOND);
    CHECK(autopilot.mode_taken);
    test_case("a mode that was asked for before may come late");
    start(MAV_AUTOPILOT_ARDUPILOTMEGA, 5U);
    autopilot_want(&autopilot, LANDING_MODE_STEER, SECOND);
    CHECK(autopilot_mode_request(&autopilot, 3U * SECOND, &command));
    autopilot_want(&autopilot, LANDING_MODE_HOLD, 3U * SECOND);
    heartbeat(MAV_AUTOPILOT_ARDUPILOTMEGA, 4U, 0U, 4U * SECOND);
    CHECK(!autopilot.mode_taken);
    heartbeat(MAV_AUTOPILOT_ARDUPILOTMEGA, 17U, 0U, 5U * SECOND);
    CHECK(!autopilot.mode_taken);
    heartbeat(MAV_AUTOPILOT_ARDUPILOTMEGA, 4U, 0U, 6U * SECOND);
    CHECK(autopilot.mode_taken);
    test_case("once it has come, the mode before it is someone's");
    start(MAV_AUTOPILOT_ARDUPILOTMEGA, 5U);
    autopilot_want(&autopilot, LANDING_MODE_STEER, SECOND);
    CHECK(autopilot_mode_request(&autopilot, 3U * SECOND, &command));
    autopilot_want(&autopilot, LANDING_MODE_HOLD, 3U * SECOND);
    heartbeat(MAV_AUTOPILOT_ARDUPILOTMEGA, 4U, 0U, 4U * SECOND);
    heartbeat(MAV_AUTOPILOT_ARDUPILOTMEGA, 5U, 0U, 5U * SECOND);
    CHECK(autopilot.mode_taken);
    test_case("a mode that was wanted and never asked for is someone's");
    start(MAV_AUTOPILOT_ARDUPILOTMEGA, 5U);
    autopilot_want(&autopilot, LANDING_MODE_STEER, SECOND);
    autopilot_want(&autopilot, LANDING_MODE_HOLD, SECOND);
    heartbeat(MAV_AUTOPILOT_ARDUPILOTMEGA, 4U, 0U, 2U * SECOND);
    CHECK(autopilot.mode_taken);
    test_case("nothing wanted, nothing taken");
    autopilot_want(&autopilot, LANDING_MODE_NONE, 5U * SECOND);
    heartbeat(MAV_AUTOPILOT_ARDUPILOTMEGA, 6U, 0U, 6U * SECOND);
    CHECK(!autopilot.mode_taken);
}

static void test_silent_takeover(void)
{
    test_case("a pilot who took over after the newest HEARTBEAT is not overridden");
    start(MAV_AUTOPILOT_PX4, 0x09040000U);
    autopilot_want(&autopilot, LANDING_MODE_LAND, SECOND);
    autopilot_want(&autopilot, LANDING_MODE_STEER, SECOND + 500000U);
    CHECK(!autopilot_mode_request(&autopilot, SECOND + 500000U, &command));
    CHECK(!autopilot_mode_request(&autopilot, 2U * SECOND - 1U, &command));
    heartbeat(MAV_AUTOPILOT_PX4, 0x03040000U, 0U, 2U * SECOND);
    CHECK(autopilot.mode_taken);
    CHECK(!autopilot_mode_request(&autopilot, 2U * SECOND, &command));
    test_case("the word of a HEARTBEAT that no one did is waited for, for so long");
    start(MAV_AUTOPILOT_PX4, 0x09040000U);
    autopilot_want(&autopilot, LANDING_MODE_LAND, SECOND);
    autopilot_want(&autopilot, LANDING_MODE_STEER, SECOND + 500000U);
    heartbeat(MAV_AUTOPILOT_PX4, 0x09040000U, 0U, 2U * SECOND);
    CHECK(!autopilot.mode_taken && autopilot_mode_request(&autopilot, 2U * SECOND + 100000U, &command));
    test_case("the next request waits as the first did");
    CHECK(!autopilot_mode_request(&autopilot, 2U * SECOND + 600000U, &command));
    heartbeat(MAV_AUTOPILOT_PX4, 0x09040000U, 0U, 3U * SECOND);
    CHECK(autopilot_mode_request(&autopilot, 3U * SECOND, &command));
    test_case("no longer than is safe");
    start(MAV_AUTOPILOT_PX4, 0x09040000U);
    autopilot_want(&autopilot, LANDING_MODE_LAND, SECOND);
    autopilot_want(&autopilot, LANDING_MODE_HOLD, SECOND + 500000U);
    CHECK(!autopilot_mode_request(&autopilot, SECOND + 500000U + AUTOPILOT_MODE_WAIT_US - 1U, &command));
    CHECK(autopilot_mode_request(&autopilot, SECOND + 500000U + AUTOPILOT_MODE_WAIT_US, &command));
    test_case("it waits for velocities from when it is to leave the steering mode until it is asked to");
    start(MAV_AUTOPILOT_PX4, 0x00060000U);
    autopilot_want(&autopilot, LANDING_MODE_STEER, SECOND);
    autopilot_want(&autopilot, LANDING_MODE_LAND, SECOND + 500000U);
    heartbeat(MAV_AUTOPILOT_PX4, 0x00060000U, 0U, 2U * SECOND);
    CHECK(autopilot_mode_request(&autopilot, 2U * SECOND, &command));
}

static void test_accepted(void)
{
    test_case("what is accepted is not asked for again, and is refused when it does not show");
    start(MAV_AUTOPILOT_ARDUPILOTMEGA, 5U);
    autopilot_want(&autopilot, LANDING_MODE_STEER, SECOND);
    CHECK(autopilot_mode_request(&autopilot, 3U * SECOND, &command));
    acknowledge(MAV_CMD_DO_SET_MODE, MAV_RESULT_ACCEPTED, 3U * SECOND);
    heartbeat(MAV_AUTOPILOT_ARDUPILOTMEGA, 5U, 0U, 5U * SECOND);
    CHECK(!autopilot_mode_request(&autopilot, 5U * SECOND, &command));
    CHECK(!autopilot_refuses(&autopilot, 3U * SECOND + AUTOPILOT_SHOWN_AFTER_US - 1U));
    CHECK(autopilot_refuses(&autopilot, 3U * SECOND + AUTOPILOT_SHOWN_AFTER_US));
    test_case("the newest answer counts");
    acknowledge(MAV_CMD_DO_SET_MODE, MAV_RESULT_TEMPORARILY_REJECTED, 5U * SECOND);
    CHECK(!autopilot_refuses(&autopilot, 9U * SECOND));
    CHECK(autopilot_mode_request(&autopilot, 5U * SECOND, &command));
    test_case("a mode that still shows is not the one it is in when another was accepted");
    start(MAV_AUTOPILOT_PX4, 0x03040000U);
    autopilot_want(&autopilot, LANDING_MODE_STEER, SECOND);
    CHECK(autopilot_mode_request(&autopilot, 3U * SECOND, &command));
    autopilot_want(&autopilot, LANDING_MODE_HOLD, 3U * SECOND);
    CHECK(!autopilot_is_in(&autopilot, LANDING_MODE_HOLD));
    heartbeat(MAV_AUTOPILOT_PX4, 0x03040000U, 0U, 4U * SECOND);
    CHECK(!autopilot_is_in(&autopilot, LANDING_MODE_HOLD) && !autopilot.mode_taken);
    CHECK(autopilot_mode_request(&autopilot, 4U * SECOND, &command));
    heartbeat(MAV_AUTOPILOT_PX4, 0x03040000U, 0U, 5U * SECOND);
    CHECK(autopilot_is_in(&autopilot, LANDING_MODE_HOLD) && !autopilot.mode_taken);
    test_case("a new landing knows nothing of what the last one asked for");
    autopilot_want(&autopilot, LANDING_MODE_STEER, 5U * SECOND);
    CHECK(autopilot_mode_request(&autopilot, 5U * SECOND, &command));
    autopilot_want(&autopilot, LANDING_MODE_NONE, 5U * SECOND);
    autopilot_want(&autopilot, LANDING_MODE_HOLD, 5U * SECOND);
    CHECK(autopilot_is_in(&autopilot, LANDING_MODE_HOLD));
}

static void test_refusal(void)
{
    uint64_t now_us = SECOND;

    test_case("five requests without effect");
    start(MAV_AUTOPILOT_ARDUPILOTMEGA, 5U);
    autopilot_want(&autopilot, LANDING_MODE_LAND, now_us);
    for (unsigned i = 0; i < AUTOPILOT_REQUESTS_MAX; i++) {
        now_us += SECOND;
        heartbeat(MAV_AUTOPILOT_ARDUPILOTMEGA, 5U, 0U, now_us);
        CHECK(!autopilot_refuses(&autopilot, now_us));
        CHECK(autopilot_mode_request(&autopilot, now_us, &command));
    }
    CHECK(!autopilot_refuses(&autopilot, now_us));
    now_us += SECOND;
    CHECK(!autopilot_mode_request(&autopilot, now_us, &command));
    CHECK(autopilot_refuses(&autopilot, now_us));
    test_case("a refusal counts at once, one for the time being does not");
    start(MAV_AUTOPILOT_ARDUPILOTMEGA, 5U);
    autopilot_want(&autopilot, LANDING_MODE_LAND, SECOND);
    acknowledge(MAV_CMD_DO_SET_MODE, MAV_RESULT_DENIED, SECOND); // of someone else's request
    CHECK(!autopilot_refuses(&autopilot, 2U * SECOND));
    heartbeat(MAV_AUTOPILOT_ARDUPILOTMEGA, 5U, 0U, 2U * SECOND);
    CHECK(autopilot_mode_request(&autopilot, 2U * SECOND, &command));
    acknowledge(MAV_CMD_DO_SET_MODE, MAV_RESULT_TEMPORARILY_REJECTED, 2U * SECOND);
    CHECK(!autopilot_refuses(&autopilot, 2U * SECOND));
    acknowledge(MAV_CMD_SET_MESSAGE_INTERVAL, MAV_RESULT_DENIED, 2U * SECOND);
    CHECK(!autopilot_refuses(&autopilot, 2U * SECOND));
    acknowledge(MAV_CMD_DO_SET_MODE, MAV_RESULT_DENIED, 2U * SECOND);
    CHECK(autopilot_refuses(&autopilot, 2U * SECOND));
    test_case("of an autopilot that is not known nothing is asked");
    start(MAV_AUTOPILOT_GENERIC, 4U);
    autopilot_want(&autopilot, LANDING_MODE_STEER, SECOND);
    CHECK(!autopilot_is_in(&autopilot, LANDING_MODE_STEER));
    CHECK(!autopilot_mode_request(&autopilot, 3U * SECOND, &command));
    CHECK(autopilot_refuses(&autopilot, 3U * SECOND));
}

static void test_streams(void)
{
    const struct mavlink_in_message attitude = {.kind = MAVLINK_IN_ATTITUDE};
    const struct mavlink_in_message landed = {.kind = MAVLINK_IN_LANDED_STATE,
                                              .as.landed_state = MAV_LANDED_STATE_ON_GROUND};
    const struct mavlink_in_message battery = {.kind = MAVLINK_IN_BATTERY, .as.battery_percent = 77};
    const struct mavlink_in_message no_battery = {.kind = MAVLINK_IN_BATTERY, .as.battery_percent = -1};
    const struct mavlink_in_message rc = {.kind = MAVLINK_IN_RC};
    const struct mavlink_in_message other = {.kind = MAVLINK_IN_COMMAND};
    unsigned asked = 0U;

    test_case("nothing is asked of one that is not there");
    autopilot_init(&autopilot, rates_of(RATES_AUTOPILOT, 0U));
    CHECK(!autopilot_stream_request(&autopilot, SECOND, &command));
    test_case("all five are asked for, once a second each, until they come");
    start(MAV_AUTOPILOT_PX4, 0U);
    while (asked < 10U && autopilot_stream_request(&autopilot, SECOND, &command)) {
        CHECK(command.command == MAV_CMD_SET_MESSAGE_INTERVAL && command.parameters[1] >= 20000.0F);
        asked++;
    }
    CHECK(asked == AUTOPILOT_STREAMS);
    CHECK(!autopilot_stream_request(&autopilot, 2U * SECOND - 1U, &command));
    autopilot_on_message(&autopilot, &landed, 2U * SECOND);
    autopilot_on_message(&autopilot, &battery, 2U * SECOND);
    autopilot_on_message(&autopilot, &rc, 2U * SECOND);
    autopilot_on_message(&autopilot, &other, 2U * SECOND);
    heartbeat(MAV_AUTOPILOT_PX4, 0U, 0U, 2U * SECOND - 200000U);
    heartbeat(MAV_AUTOPILOT_PX4, 0U, 0U, 2U * SECOND);
    CHECK(autopilot_stream_request(&autopilot, 2U * SECOND, &command));
    CHECK(command.parameters[0] == (float)MAVLINK_MSG_ID_ATTITUDE);
    CHECK(!autopilot_stream_request(&autopilot, 2U * SECOND, &command));
    autopilot_on_message(&autopilot, &attitude, 2U * SECOND);
    CHECK(!autopilot_stream_request(&autopilot, 2U * SECOND + 200000U, &command));
    CHECK(autopilot.on_ground && autopilot.battery_known && autopilot.battery_percent == 77U);
    autopilot_on_message(&autopilot, &no_battery, 2U * SECOND);
    CHECK(!autopilot.battery_known);
    test_case("what stops coming is asked for again");
    CHECK(autopilot_stream_request(&autopilot, 3U * SECOND, &command));
    CHECK(command.parameters[0] == (float)MAVLINK_MSG_ID_ATTITUDE);
}

// How often HEARTBEAT is asked for in ten seconds in which one comes so often.
static unsigned heartbeat_requests(uint64_t since_us, uint64_t period_us)
{
    unsigned asked = 0U;

    for (uint64_t now_us = since_us; now_us < since_us + 10U * SECOND; now_us += 50000U) {
        if ((now_us - since_us) % period_us == 0U) {
            heartbeat(MAV_AUTOPILOT_PX4, 0U, 0U, now_us);
        }
        while (autopilot_stream_request(&autopilot, now_us, &command)) {
            asked += command.parameters[0] == (float)MAVLINK_MSG_ID_HEARTBEAT ? 1U : 0U;
            CHECK(command.parameters[0] != (float)MAVLINK_MSG_ID_HEARTBEAT || command.parameters[1] == 200000.0F);
        }
    }
    return asked;
}

static void test_heartbeats_asked_for(void)
{
    test_case("more HEARTBEATs are asked for a few times, of one that is started again anew, and no more once they come");
    start(MAV_AUTOPILOT_PX4, 0U);
    CHECK(heartbeat_requests(SECOND, SECOND) == 5U);
    CHECK(heartbeat_requests(11U * SECOND, SECOND) == 0U);
    CHECK(heartbeat_requests(30U * SECOND, SECOND) == 5U);
    CHECK(heartbeat_requests(40U * SECOND, 200000U) == 0U);
    CHECK(heartbeat_requests(50U * SECOND, SECOND) == 5U);
    CHECK(heartbeat_requests(70U * SECOND, 200000U) <= 1U);
}

void test_autopilot(void)
{
    test_heard();
    test_modes();
    test_pilot();
    test_silent_takeover();
    test_accepted();
    test_refusal();
    test_streams();
    test_heartbeats_asked_for();
}

// SPDX-License-Identifier: Apache-2.0
#include <string.h>

#include "flight.h"
#include "ground.h"
#include "test.h"
#include "test_wire.h"

#define PERIOD_US 50000U

static struct flight flight;
static struct links links;

static void start(void)
{
    wire_open(&links);
    flight_init(&flight, rates_of(RATES_AUTOPILOT, 0U), 0U);
}

// Returns the MAV_RESULT of the answer, -1 without one, and what was asked for in `asked`.
static int command(uint16_t number, float first, uint32_t *asked)
{
    struct mavlink_in_message message = {
        .kind = MAVLINK_IN_COMMAND, .system = WIRE_GROUND_SYSTEM, .component = WIRE_GROUND_COMPONENT};

    message.as.command = (struct mavlink_in_command){.command = number, .parameters = {first}};
    flight.known.asked = 0U;
    wire_clear();
    ground_on_command(&flight, &links, APP_LINK_GROUND, &message);
    *asked = flight.known.asked;
    const mavlink_message_t *answer = wire_last(APP_LINK_GROUND, MAVLINK_MSG_ID_COMMAND_ACK);
    CHECK(wire_count(APP_LINK_GROUND, MAVLINK_MSG_ID_COMMAND_ACK) == 1);
    CHECK(mavlink_msg_command_ack_get_command(answer) == number);
    CHECK(mavlink_msg_command_ack_get_target_system(answer) == WIRE_GROUND_SYSTEM);
    CHECK(mavlink_msg_command_ack_get_target_component(answer) == WIRE_GROUND_COMPONENT);
    return mavlink_msg_command_ack_get_result(answer);
}

static void test_commands(void)
{
    uint32_t asked;

    test_case("each command is answered, and asks for what it says");
    start();
    CHECK(command((uint16_t)MAV_CMD_NAV_LAND, 0.0F, &asked) == (int)MAV_RESULT_ACCEPTED);
    CHECK(asked == LANDING_FACT_START);
    CHECK(command((uint16_t)MAV_CMD_DO_GO_AROUND, 0.0F, &asked) == (int)MAV_RESULT_ACCEPTED);
    CHECK(asked == LANDING_FACT_ABORT);
    CHECK(command((uint16_t)MAV_CMD_DO_PAUSE_CONTINUE, 0.5F, &asked) == (int)MAV_RESULT_DENIED);
    CHECK(asked == 0U);
    CHECK(command((uint16_t)MAV_CMD_COMPONENT_ARM_DISARM, 1.0F, &asked) == (int)MAV_RESULT_UNSUPPORTED);
    CHECK(asked == 0U);
}

static void test_start_again(void)
{
    uint32_t asked;

    start();
    for (unsigned phase = 0U; phase < (unsigned)LANDING_PHASES; phase++) {
        const bool ends = phase == (unsigned)LANDING_PHASE_HOLD || phase == (unsigned)LANDING_PHASE_GIVE_UP;
        const bool waits = phase == (unsigned)LANDING_PHASE_STANDBY || phase == (unsigned)LANDING_PHASE_LANDED;

        test_case("a start in %s: during a landing it is the same once more, and starts nothing",
                  landing_phase_table[phase].name);
        flight.landing.phase = (enum landing_phase)phase;
        CHECK(command((uint16_t)MAV_CMD_NAV_LAND, 0.0F, &asked) ==
              (int)(ends ? MAV_RESULT_TEMPORARILY_REJECTED : MAV_RESULT_ACCEPTED));
        CHECK(asked == (waits ? LANDING_FACT_START : 0U));
    }
}

static void check_hold(bool can)
{
    const int result = (int)(can ? MAV_RESULT_ACCEPTED : MAV_RESULT_TEMPORARILY_REJECTED);
    uint32_t asked;

    CHECK(command((uint16_t)MAV_CMD_DO_PAUSE_CONTINUE, 0.0F, &asked) == result);
    CHECK(asked == (can ? LANDING_FACT_PAUSE : 0U));
    CHECK(command((uint16_t)MAV_CMD_DO_PAUSE_CONTINUE, 1.0F, &asked) == result);
    CHECK(asked == (can ? LANDING_FACT_GO_ON : 0U));
}

static void test_hold(void)
{
    start();
    for (unsigned phase = 0U; phase < (unsigned)LANDING_PHASES; phase++) {
        const bool can = phase != (unsigned)LANDING_PHASE_STANDBY && phase != (unsigned)LANDING_PHASE_TOUCHDOWN &&
                         phase != (unsigned)LANDING_PHASE_LANDED && phase != (unsigned)LANDING_PHASE_GIVE_UP;

        test_case("to hold and to go on in %s, and the same once more", landing_phase_table[phase].name);
        flight.landing.phase = (enum landing_phase)phase;
        check_hold(can);
    }
    test_case("too low it is not promised");
    flight.landing.phase = LANDING_PHASE_LAND;
    flight.landing.committed = true;
    check_hold(false);
}

static void parameter(enum mavlink_in_kind kind, const char *name, int16_t index, uint8_t type, float value)
{
    struct mavlink_in_message message = {.kind = kind};

    (void)strncpy(message.as.param.name, name, MAVLINK_IN_PARAM_NAME_CHARS);
    message.as.param.index = index;
    message.as.param.type = type;
    message.as.param.value = value;
    wire_clear();
    ground_on_parameter(&flight, &links, APP_LINK_GROUND, &message);
}

static float answered(void)
{
    CHECK(wire_count(APP_LINK_GROUND, MAVLINK_MSG_ID_PARAM_VALUE) == 1);
    return mavlink_msg_param_value_get_param_value(wire_last(APP_LINK_GROUND, MAVLINK_MSG_ID_PARAM_VALUE));
}

static void test_parameters_asked_for(void)
{
    test_case("a parameter is read by name or index; one that is not there has no answer");
    start();
    parameter(MAVLINK_IN_PARAM_READ, "TD_SPEED", -1, 0U, 0.0F);
    CHECK(answered() == flight.parameters.speed_m_s);
    parameter(MAVLINK_IN_PARAM_READ, "", 0, 0U, 0.0F);
    CHECK(answered() == flight.parameters.search_height_m);
    parameter(MAVLINK_IN_PARAM_READ, "", (int16_t)PARAMETERS_COUNT, 0U, 0.0F);
    CHECK(wire_count(APP_LINK_GROUND, MAVLINK_MSG_ID_PARAM_VALUE) == 0);
    parameter(MAVLINK_IN_PARAM_READ, "TD_NOTHING", -1, 0U, 0.0F);
    CHECK(wire_count(APP_LINK_GROUND, MAVLINK_MSG_ID_PARAM_VALUE) == 0);
}

// Whether a value was put away before anybody was told of it.
static bool kept_first(float speed_m_s)
{
    struct parameters loaded;
    int sent_before;
    const uint8_t *bytes = wire_kept(&sent_before);

    parameters_init(&loaded);
    return bytes != NULL && sent_before == 0 && parameters_load(&loaded, bytes, PARAMETERS_STORED_BYTES) == 0 &&
           loaded.speed_m_s == speed_m_s;
}

static bool nothing_kept(void)
{
    int sent_before;

    return wire_kept(&sent_before) == NULL;
}

static void test_parameters_set(void)
{
    test_case("a parameter that is set is kept, then answered");
    start();
    parameter(MAVLINK_IN_PARAM_SET, "TD_SPEED", -1, (uint8_t)MAV_PARAM_TYPE_REAL32, 0.25F);
    CHECK(answered() == 0.25F && flight.parameters.speed_m_s == 0.25F && kept_first(0.25F));
    test_case("beyond its limits or of another type it stays, and that is said");
    parameter(MAVLINK_IN_PARAM_SET, "TD_SPEED", -1, (uint8_t)MAV_PARAM_TYPE_REAL32, 25.0F);
    CHECK(answered() == 0.25F && nothing_kept());
    CHECK(strcmp(wire_text(), "Touchdown: parameter beyond its limits") == 0);
    parameter(MAVLINK_IN_PARAM_SET, "TD_SPEED", -1, (uint8_t)MAV_PARAM_TYPE_INT32, 0.5F);
    CHECK(answered() == 0.25F && nothing_kept());
}

static void test_list(void)
{
    test_case("the list of parameters goes out one at a time, a period apart");
    start();
    ground_tick(&flight, &links, 0U);
    CHECK(wire_count(APP_LINK_GROUND, MAVLINK_MSG_ID_PARAM_VALUE) == 0);
    parameter(MAVLINK_IN_PARAM_LIST, "", -1, 0U, 0.0F);
    for (uint64_t now_us = 0U; now_us < 2U * PERIOD_US * (uint64_t)PARAMETERS_COUNT; now_us += 10000U) {
        const int before = wire_count(APP_LINK_GROUND, MAVLINK_MSG_ID_PARAM_VALUE);
        ground_tick(&flight, &links, now_us);
        CHECK(wire_count(APP_LINK_GROUND, MAVLINK_MSG_ID_PARAM_VALUE) - before <= (now_us % PERIOD_US == 0U ? 1 : 0));
    }
    CHECK(wire_count(APP_LINK_GROUND, MAVLINK_MSG_ID_PARAM_VALUE) == (int)PARAMETERS_COUNT);
    const mavlink_message_t *last = wire_last(APP_LINK_GROUND, MAVLINK_MSG_ID_PARAM_VALUE);
    CHECK(mavlink_msg_param_value_get_param_index(last) == PARAMETERS_COUNT - 1U);
    CHECK(mavlink_msg_param_value_get_param_value(last) == flight.parameters.ground_needed);
}

static void log_rows(uint32_t count)
{
    for (uint32_t i = 0; i < count; i++) {
        flight.log[flight.logged % FLIGHT_LOG_ROWS] =
            (struct flight_log_row){.time_us = 123456789U + 1000000U * (uint64_t)flight.logged,
                                    .from = LANDING_PHASE_SEARCH,
                                    .to = LANDING_PHASE_CENTRE,
                                    .reason = "pad seen"};
        flight.logged++;
    }
}

// Returns how many rows are said.
static int report(void)
{
    uint32_t asked;

    CHECK(command((uint16_t)MAV_CMD_USER_1, 0.0F, &asked) == (int)MAV_RESULT_ACCEPTED && asked == 0U);
    for (int i = 0; i < 100; i++) {
        ground_tick(&flight, &links, flight.next_said_us);
    }
    return wire_count(APP_LINK_GROUND, MAVLINK_MSG_ID_STATUSTEXT);
}

static void test_log(void)
{
    test_case("an empty log says nothing");
    start();
    CHECK(report() == 0);
    test_case("a row of the log as words");
    log_rows(1U);
    CHECK(report() == 1);
    CHECK(strcmp(wire_text(), "123.4 SEARCH>CENTRE: pad seen") == 0);
    test_case("the newest rows of a log that is full, each once");
    log_rows(FLIGHT_LOG_ROWS + 4U);
    CHECK(report() == (int)FLIGHT_LOG_ROWS);
    CHECK(strcmp(wire_text(), "159.4 SEARCH>CENTRE: pad seen") == 0);
    CHECK(report() == (int)FLIGHT_LOG_ROWS);
}

void test_ground(void)
{
    test_commands();
    test_start_again();
    test_hold();
    test_parameters_asked_for();
    test_parameters_set();
    test_list();
    test_log();
}

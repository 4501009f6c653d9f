// SPDX-License-Identifier: Apache-2.0
#include "ground.h"

#include <common/mavlink.h>

#include "text.h"

#define NOTHING_TO_SAY UINT32_MAX
// A message of 60 bytes takes 10 ms at 57600 baud, beside what goes out anyway.
#define SAY_PERIOD_US 50000U
#define MS_PER_S 1000U
#define US_PER_MS 1000U

static enum landing_phase phase_of(const struct flight *flight)
{
    return flight->landing.phase;
}

static bool commands(const struct flight *flight)
{
    return landing_phase_table[phase_of(flight)].mode != LANDING_MODE_NONE;
}

// True while it can be told to stand still, or does.
static bool can_hold(const struct flight *flight)
{
    const uint32_t present = flight->landing.committed ? LANDING_FACT_COMMITTED : 0U;

    for (size_t i = 0; i < LANDING_RULES; i++) {
        const struct landing_rule *rule = &landing_rules[i];

        if ((rule->from >> (uint32_t)phase_of(flight) & 1U) != 0U && (rule->unless & present) == 0U &&
            (rule->when & (LANDING_FACT_PAUSE | LANDING_FACT_GO_ON)) != 0U) {
            return true;
        }
    }
    return false;
}

// True when a landing goes on that need not be started: told to start, it was told so twice.
static bool lands(const struct flight *flight)
{
    return commands(flight) && phase_of(flight) != LANDING_PHASE_HOLD && phase_of(flight) != LANDING_PHASE_GIVE_UP;
}

static uint8_t taken_if(bool taken)
{
    return (uint8_t)(taken ? MAV_RESULT_ACCEPTED : MAV_RESULT_TEMPORARILY_REJECTED);
}

// What a command asks for, or 0; `result` says why.
static uint32_t fact_of(const struct flight *flight, const struct mavlink_in_command *command, uint8_t *result)
{
    *result = (uint8_t)MAV_RESULT_ACCEPTED;
    switch (command->command) {
    case MAV_CMD_NAV_LAND:
        // A refusal for other reasons is said in words, by the rule that refuses.
        *result = taken_if(!commands(flight) || lands(flight));
        return commands(flight) ? 0U : LANDING_FACT_START;
    case MAV_CMD_DO_GO_AROUND:
        return LANDING_FACT_ABORT;
    case MAV_CMD_DO_PAUSE_CONTINUE:
        if (command->parameters[0] != 0.0F && command->parameters[0] != 1.0F) {
            *result = (uint8_t)MAV_RESULT_DENIED;
            return 0U;
        }
        *result = taken_if(can_hold(flight));
        if (!can_hold(flight)) {
            return 0U;
        }
        return command->parameters[0] == 0.0F ? LANDING_FACT_PAUSE : LANDING_FACT_GO_ON;
    case MAV_CMD_USER_1:
        return 0U;
    default:
        *result = (uint8_t)MAV_RESULT_UNSUPPORTED;
        return 0U;
    }
}

void ground_init(struct flight *flight)
{
    flight->params_said = NOTHING_TO_SAY;
    flight->log_said = NOTHING_TO_SAY;
}

void ground_on_command(struct flight *flight, struct links *links, enum app_link link,
                       const struct mavlink_in_message *message)
{
    const struct mavlink_in_command *command = &message->as.command;
    uint8_t bytes[MAVLINK_OUT_MAX_BYTES];
    uint8_t result;

    flight->known.asked |= fact_of(flight, command, &result);
    if (command->command == (uint16_t)MAV_CMD_USER_1) {
        flight->log_said = flight->logged < FLIGHT_LOG_ROWS ? 0U : flight->logged - FLIGHT_LOG_ROWS;
    }
    links_send(links, link, bytes,
               mavlink_out_command_ack(&links->out[link], command->command, result, message->system,
                                       message->component, bytes));
}

static void say_parameter(const struct flight *flight, struct links *links, enum app_link link, size_t index)
{
    uint8_t bytes[MAVLINK_OUT_MAX_BYTES];

    links_send(links, link, bytes,
               mavlink_out_parameter(&links->out[link], parameters_name(index),
                                     parameters_get(&flight->parameters, index), (uint16_t)index,
                                     (uint16_t)PARAMETERS_COUNT, bytes));
}

static void keep_parameters(const struct flight *flight, const struct links *links)
{
    uint8_t bytes[PARAMETERS_STORED_BYTES];

    parameters_store(&flight->parameters, bytes);
    links_keep(links, bytes, sizeof bytes);
}

void ground_on_parameter(struct flight *flight, struct links *links, enum app_link link,
                         const struct mavlink_in_message *message)
{
    const struct mavlink_in_param *param = &message->as.param;

    if (message->kind == MAVLINK_IN_PARAM_LIST) {
        flight->params_said = 0U;
        return;
    }
    const int index = param->index >= 0 ? param->index : parameters_find(param->name);

    if (index < 0 || (size_t)index >= PARAMETERS_COUNT) {
        return; // as the protocol has it: no answer to a name that is not known
    }
    if (message->kind == MAVLINK_IN_PARAM_SET) {
        const int error = param->type == (uint8_t)MAV_PARAM_TYPE_REAL32
                              ? parameters_set(&flight->parameters, (size_t)index, param->value)
                              : PARAMETERS_E_RANGE;

        if (error == 0) {
            keep_parameters(flight, links);
        } else {
            links_say(links, MAVLINK_OUT_WARNING, "Touchdown: parameter beyond its limits");
        }
    }
    // The answer to PARAM_SET is the value that holds from now on, changed or not, over a restart too.
    say_parameter(flight, links, link, (size_t)index);
}

// "123.4 SEARCH>CENTRE: pad seen"
static void say_row(struct links *links, const struct flight_log_row *row)
{
    struct text text = {.length = 0U};
    const uint32_t time_ms = (uint32_t)(row->time_us / US_PER_MS);

    text_append_number(&text, time_ms / MS_PER_S);
    text_append(&text, ".");
    text_append_number(&text, time_ms % MS_PER_S / 100U);
    text_append(&text, " ");
    text_append(&text, landing_phase_table[row->from].name);
    text_append(&text, ">");
    text_append(&text, landing_phase_table[row->to].name);
    text_append(&text, ": ");
    text_append(&text, row->reason);
    links_say(links, MAVLINK_OUT_INFO, text.chars);
}

void ground_tick(struct flight *flight, struct links *links, uint64_t now_us)
{
    if (now_us < flight->next_said_us) {
        return;
    }
    if (flight->params_said < PARAMETERS_COUNT) {
        say_parameter(flight, links, APP_LINK_GROUND, flight->params_said);
        flight->params_said++;
    } else if (flight->log_said < flight->logged) {
        say_row(links, &flight->log[flight->log_said % FLIGHT_LOG_ROWS]);
        flight->log_said++;
        // What is logged later is not part of this report.
        if (flight->log_said == flight->logged) {
            flight->log_said = NOTHING_TO_SAY;
        }
    } else {
        return;
    }
    flight->next_said_us = now_us + SAY_PERIOD_US;
}

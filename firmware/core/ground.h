// SPDX-License-Identifier: Apache-2.0
// What the ground asks for: commands and parameters. Each gets an answer.
#ifndef TOUCHDOWN_GROUND_H
#define TOUCHDOWN_GROUND_H

#include "flight.h"

// To a COMMAND_LONG for us: NAV_LAND starts, DO_GO_AROUND aborts, DO_PAUSE_CONTINUE stands still and goes on,
// USER_1 says the log of phases.
void ground_on_command(struct flight *flight, struct links *links, enum app_link link,
                       const struct mavlink_in_message *message);

void ground_on_parameter(struct flight *flight, struct links *links, enum app_link link,
                         const struct mavlink_in_message *message);

void ground_init(struct flight *flight);

// Says what is left of the list of parameters and of the log, a message at a time.
void ground_tick(struct flight *flight, struct links *links, uint64_t now_us);

#endif

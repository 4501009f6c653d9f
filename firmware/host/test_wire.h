// SPDX-License-Identifier: Apache-2.0
// Both links as the other end sees them: what was sent, decoded by MAVLink's own headers,
// and messages from the autopilot or the ground.
#ifndef TOUCHDOWN_TEST_WIRE_H
#define TOUCHDOWN_TEST_WIRE_H

#include <common/mavlink.h>

#include "links.h"
#include "mavlink_in.h"

#define WIRE_GROUND_SYSTEM 255U
#define WIRE_GROUND_COMPONENT 190U

// Links that keep what is sent, until the next call.
void wire_open(struct links *links);

// Forgets what was sent.
void wire_clear(void);

// How many messages of a kind were sent on a link.
int wire_count(enum app_link link, uint32_t message);

// The block of parameters that was put away to be kept, and how many messages were sent before; NULL when none was.
const uint8_t *wire_kept(int *sent_before);

// The newest of a kind; all zeros when there is none.
const mavlink_message_t *wire_last(enum app_link link, uint32_t message);

// The words of the newest STATUSTEXT.
const char *wire_text(void);

// Decodes one whole frame; a failed check when it is none.
mavlink_message_t wire_decode(const uint8_t *bytes, size_t size);

// What the receiver makes of a message, sent as bytes; the kind is NOTHING when it does not want it.
struct mavlink_in_message wire_receive(const mavlink_message_t *message);

#endif

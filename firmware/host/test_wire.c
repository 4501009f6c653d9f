// SPDX-License-Identifier: Apache-2.0
#include "test_wire.h"

#include <string.h>

#include "parameters.h"
#include "test.h"

#define MESSAGES_MAX 1024

static mavlink_message_t messages[MESSAGES_MAX];
static enum app_link sent_on[MESSAGES_MAX];
static int count;
static uint8_t kept[PARAMETERS_STORED_BYTES];
static int kept_after; // so many messages; -1 = nothing was
static const mavlink_message_t none;

mavlink_message_t wire_decode(const uint8_t *bytes, size_t size)
{
    mavlink_message_t assembling = {0};
    mavlink_message_t message = {0};
    mavlink_status_t status = {0};
    mavlink_status_t ignored;
    bool whole = false;

    for (size_t i = 0; i < size; i++) {
        CHECK(!whole);
        whole = mavlink_frame_char_buffer(&assembling, &status, bytes[i], &message, &ignored) == MAVLINK_FRAMING_OK;
    }
    CHECK(whole);
    return message;
}

static bool send(void *context, enum app_link link, const uint8_t *bytes, size_t size)
{
    (void)context;
    CHECK(count < MESSAGES_MAX);
    if (count < MESSAGES_MAX) {
        messages[count] = wire_decode(bytes, size);
        sent_on[count] = link;
        count++;
    }
    return true;
}

static void keep(void *context, const uint8_t *bytes, size_t size)
{
    (void)context;
    CHECK(size == sizeof kept);
    memcpy(kept, bytes, size <= sizeof kept ? size : 0U);
    kept_after = count;
}

void wire_open(struct links *links)
{
    const struct app_port port = {.write = send, .keep = keep, .context = NULL};

    wire_clear();
    links_init(links, &port);
}

void wire_clear(void)
{
    count = 0;
    kept_after = -1;
}

int wire_count(enum app_link link, uint32_t message)
{
    int found = 0;

    for (int i = 0; i < count; i++) {
        found += sent_on[i] == link && messages[i].msgid == message ? 1 : 0;
    }
    return found;
}

const uint8_t *wire_kept(int *sent_before)
{
    *sent_before = kept_after;
    return kept_after >= 0 ? kept : NULL;
}

const mavlink_message_t *wire_last(enum app_link link, uint32_t message)
{
    for (int i = count - 1; i >= 0; i--) {
        if (sent_on[i] == link && messages[i].msgid == message) {
            return &messages[i];
        }
    }
    return &none;
}

const char *wire_text(void)
{
    static char text[MAVLINK_MSG_STATUSTEXT_FIELD_TEXT_LEN + 1];

    memset(text, 0, sizeof text);
    (void)mavlink_msg_statustext_get_text(wire_last(APP_LINK_GROUND, MAVLINK_MSG_ID_STATUSTEXT), text);
    return text;
}

struct mavlink_in_message wire_receive(const mavlink_message_t *message)
{
    struct mavlink_in in;
    struct mavlink_in_message received = {.kind = MAVLINK_IN_NOTHING};
    uint8_t bytes[MAVLINK_MAX_PACKET_LEN];
    const uint16_t size = mavlink_msg_to_send_buffer(bytes, message);

    mavlink_in_init(&in);
    for (uint16_t i = 0; i < size; i++) {
        CHECK(received.kind == MAVLINK_IN_NOTHING);
        CHECK(mavlink_in_byte(&in, bytes[i], &received) == received.kind);
    }
    return received;
}

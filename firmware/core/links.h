// SPDX-License-Identifier: Apache-2.0
// The two wires: whole messages or none, numbered per wire, losses counted.
#ifndef TOUCHDOWN_LINKS_H
#define TOUCHDOWN_LINKS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "mavlink_out.h"
#include "rates.h"

enum app_link { APP_LINK_AUTOPILOT, APP_LINK_GROUND, APP_LINKS };

struct app_port {
    // Takes a whole message, or drops it and returns false; never blocks, never
    // sends a part.
    bool (*write)(void *context, enum app_link link, const uint8_t *bytes, size_t size);
    // Returns at `time_us`, or at once where that is past or too far ahead. NULL: always at once.
    void (*wait_until)(void *context, uint64_t time_us);
    // Keeps a block of parameters over a restart; it is kept on return. NULL: nowhere to keep it.
    void (*keep)(void *context, const uint8_t *bytes, size_t size);
    void *context;
    uint32_t baud[APP_LINKS]; // 0 = no wire that would set a limit
};

struct links {
    struct app_port port;
    struct mavlink_out out[APP_LINKS];
    const struct rates *rates[APP_LINKS];
    uint32_t dropped[APP_LINKS]; // messages that found no room on the wire
};

void links_init(struct links *links, const struct app_port *port);

void links_send(struct links *links, enum app_link link, const uint8_t *bytes, size_t size);

// Lets time pass, where there is somebody who can wait.
void links_wait_until(const struct links *links, uint64_t time_us);

// Keeps a block of parameters, where there is a place for it.
void links_keep(const struct links *links, const uint8_t *bytes, size_t size);

// A STATUSTEXT for the ground.
void links_say(struct links *links, enum mavlink_out_severity severity, const char *text);

#endif

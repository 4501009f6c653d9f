// SPDX-License-Identifier: Apache-2.0
#include "links.h"

#include <string.h>

void links_init(struct links *links, const struct app_port *port)
{
    memset(links, 0, sizeof *links);
    links->port = *port;
    links->rates[APP_LINK_AUTOPILOT] = rates_of(RATES_AUTOPILOT, port->baud[APP_LINK_AUTOPILOT]);
    links->rates[APP_LINK_GROUND] = rates_of(RATES_GROUND, port->baud[APP_LINK_GROUND]);
}

void links_send(struct links *links, enum app_link link, const uint8_t *bytes, size_t size)
{
    if (!links->port.write(links->port.context, link, bytes, size)) {
        links->dropped[link]++;
    }
}

void links_wait_until(const struct links *links, uint64_t time_us)
{
    if (links->port.wait_until != NULL) {
        links->port.wait_until(links->port.context, time_us);
    }
}

void links_keep(const struct links *links, const uint8_t *bytes, size_t size)
{
    if (links->port.keep != NULL) {
        links->port.keep(links->port.context, bytes, size);
    }
}

void links_say(struct links *links, enum mavlink_out_severity severity, const char *text)
{
    uint8_t bytes[MAVLINK_OUT_MAX_BYTES];

    links_send(links, APP_LINK_GROUND, bytes,
               mavlink_out_status_text(&links->out[APP_LINK_GROUND], severity, text, bytes));
}

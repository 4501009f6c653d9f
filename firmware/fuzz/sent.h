// SPDX-License-Identifier: Apache-2.0
// Reads all that the firmware sends, and demands that it is whole, finite and allowed.
#ifndef TOUCHDOWN_FUZZ_SENT_H
#define TOUCHDOWN_FUZZ_SENT_H

#include "flight.h"
#include "links.h"

struct sent {
    const struct flight *flight;
    bool numbered[APP_LINKS]; // one was sent before
    uint8_t sequence[APP_LINKS];
    bool full; // the wires take nothing
    uint64_t now_us;
    uint32_t count[APP_LINKS];
};

// `flight` is looked at whenever something is sent.
void sent_init(struct sent *sent, const struct flight *flight);

// For struct app_port; its context is a struct sent.
bool sent_write(void *context, enum app_link link, const uint8_t *bytes, size_t size);

// Each within its limits, so never NaN.
void sent_parameters_are_sane(const struct parameters *parameters);

#endif

// SPDX-License-Identifier: Apache-2.0
// MAVLink frames put together and taken apart without the library that the
// firmware uses; of that, only the table of each message's CRC_EXTRA.
#ifndef TOUCHDOWN_FUZZ_FRAME_H
#define TOUCHDOWN_FUZZ_FRAME_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "input.h"

#define FRAME_MAX_BYTES 280U
#define FRAME_PAYLOAD_BYTES 255U

struct frame {
    int version; // 1 or 2
    uint8_t sequence;
    uint8_t system;
    uint8_t component;
    uint32_t message;
    uint8_t payload[FRAME_PAYLOAD_BYTES]; // zeros beyond what was sent
};

// A MAVLink 2 frame as the autopilot sends it; returns its length.
size_t frame_pack(uint32_t message, const uint8_t *payload, size_t size, uint8_t *bytes);

// A frame that the input describes: version, sender, message, payload, flags. Its
// checksum is right unless the input wants it damaged or cut off. `intact` says whether a
// receiver has to take it.
size_t frame_from_input(struct input *input, uint8_t *bytes, bool *intact);

// True when these bytes are exactly one frame with the right checksum of a message that is known.
bool frame_read(const uint8_t *bytes, size_t size, struct frame *frame);

uint16_t frame_u16(const struct frame *frame, size_t at);
uint32_t frame_u32(const struct frame *frame, size_t at);
float frame_float(const struct frame *frame, size_t at);

#endif

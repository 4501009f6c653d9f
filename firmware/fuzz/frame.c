// SPDX-License-Identifier: Apache-2.0
#include "frame.h"

#include <string.h>

#include <common/mavlink.h>

#include "mavlink_out.h"

#define START_1 0xFEU
#define START_2 0xFDU
#define HEADER_1 6U
#define HEADER_2 10U
#define CHECKSUM 2U
#define SIGNATURE 13U
#define SIGNED 0x01U

// What a frame of the input may be like.
enum {
    OF_AUTOPILOT = 0x01, // or of whom the input says
    FOR_US = 0x02,
    OLD_VERSION = 0x04,
    WITH_SIGNATURE = 0x08,
    DAMAGED = 0x10,
    CUT_OFF = 0x20,
    ODD_FLAGS = 0x40,
    ANY_MESSAGE = 0x80
};

struct known {
    uint32_t message;
    size_t target_at; // of the system it is for, then the component; 0 = for all
    bool kept;        // read by the firmware when it is for us
};

static const struct known known[] = {
    {MAVLINK_MSG_ID_HEARTBEAT, 0U, true},          {MAVLINK_MSG_ID_TIMESYNC, 0U, false},
    {MAVLINK_MSG_ID_ATTITUDE, 0U, true},           {MAVLINK_MSG_ID_SYS_STATUS, 0U, true},
    {MAVLINK_MSG_ID_EXTENDED_SYS_STATE, 0U, true}, {MAVLINK_MSG_ID_RC_CHANNELS, 0U, true},
    {MAVLINK_MSG_ID_COMMAND_ACK, 8U, true},        {MAVLINK_MSG_ID_COMMAND_LONG, 30U, true},
    {MAVLINK_MSG_ID_PARAM_REQUEST_READ, 2U, true}, {MAVLINK_MSG_ID_PARAM_REQUEST_LIST, 0U, false},
    {MAVLINK_MSG_ID_PARAM_SET, 4U, true},          {MAVLINK_MSG_ID_SET_MODE, 0U, false},
    {MAVLINK_MSG_ID_STATUSTEXT, 0U, false},
};

// X.25, half a byte at a time.
static uint16_t crc_of(uint16_t crc, const uint8_t *bytes, size_t size)
{
    static const uint16_t halves[16] = {0x0000U, 0x1081U, 0x2102U, 0x3183U, 0x4204U, 0x5285U, 0x6306U, 0x7387U,
                                        0x8408U, 0x9489U, 0xA50AU, 0xB58BU, 0xC60CU, 0xD68DU, 0xE70EU, 0xF78FU};

    for (size_t i = 0; i < size; i++) {
        crc = (uint16_t)(crc >> 4U ^ halves[(crc ^ bytes[i]) & 0xFU]);
        crc = (uint16_t)(crc >> 4U ^ halves[(crc ^ bytes[i] >> 4U) & 0xFU]);
    }
    return crc;
}

static bool checksum_of(uint32_t message, const uint8_t *bytes, size_t size, uint16_t *checksum)
{
    const mavlink_msg_entry_t *entry = mavlink_get_msg_entry(message);

    if (entry == NULL) {
        return false;
    }
    *checksum = crc_of(crc_of(0xFFFFU, bytes + 1, size - 1U), &entry->crc_extra, 1U);
    return true;
}

// Header and payload are there; returns the length with the checksum.
static size_t finish(uint32_t message, uint8_t *bytes, size_t size)
{
    uint16_t checksum = 0U;

    (void)checksum_of(message, bytes, size, &checksum);
    bytes[size] = (uint8_t)checksum;
    bytes[size + 1U] = (uint8_t)(checksum >> 8U);
    return size + CHECKSUM;
}

size_t frame_pack(uint32_t message, const uint8_t *payload, size_t size, uint8_t *bytes)
{
    const uint8_t header[HEADER_2] = {START_2,
                                      (uint8_t)size,
                                      0U,
                                      0U,
                                      0U,
                                      MAVLINK_OUT_SYSTEM_ID,
                                      (uint8_t)MAV_COMP_ID_AUTOPILOT1,
                                      (uint8_t)message,
                                      (uint8_t)(message >> 8U),
                                      (uint8_t)(message >> 16U)};

    memcpy(bytes, header, sizeof header);
    memcpy(bytes + HEADER_2, payload, size);
    return finish(message, bytes, HEADER_2 + size);
}

size_t frame_from_input(struct input *input, uint8_t *bytes, bool *intact)
{
    const unsigned like = input_u8(input);
    const uint8_t choice = input_u8(input);
    const struct known *row = &known[choice % (sizeof known / sizeof known[0])];
    const bool old = (like & OLD_VERSION) != 0U;
    const size_t header = old ? HEADER_1 : HEADER_2;
    const uint32_t any = (like & ANY_MESSAGE) != 0U ? input_u16(input) : row->message;
    const uint32_t message = old ? any & 0xFFU : any;
    const size_t payload = input_u8(input);
    uint8_t *at = bytes;

    *at++ = old ? START_1 : START_2;
    *at++ = (uint8_t)payload;
    if (!old) {
        *at++ = (uint8_t)(((like & WITH_SIGNATURE) != 0U ? SIGNED : 0U) | ((like & ODD_FLAGS) != 0U ? 0x02U : 0U));
        *at++ = 0U;
    }
    *at++ = 0U;
    *at++ = (like & OF_AUTOPILOT) != 0U ? MAVLINK_OUT_SYSTEM_ID : input_u8(input);
    *at++ = (like & OF_AUTOPILOT) != 0U ? (uint8_t)MAV_COMP_ID_AUTOPILOT1 : input_u8(input);
    *at++ = (uint8_t)message;
    if (!old) {
        *at++ = (uint8_t)(message >> 8U);
        *at++ = (uint8_t)(message >> 16U);
    }
    (void)input_take(input, at, payload);
    const bool for_us = (like & FOR_US) != 0U && row->target_at != 0U && row->target_at + 1U < payload;
    if (for_us) {
        at[row->target_at] = MAVLINK_OUT_SYSTEM_ID;
        at[row->target_at + 1U] = MAVLINK_OUT_COMPONENT_ID;
    }
    size_t size = finish(message, bytes, header + payload);
    if (!old && (like & WITH_SIGNATURE) != 0U) {
        (void)input_take(input, bytes + size, SIGNATURE);
        size += SIGNATURE;
    }
    if ((like & DAMAGED) != 0U) {
        bytes[1U + input_u8(input) % (header + payload)] ^= 0x40U;
    }
    if ((like & CUT_OFF) != 0U) {
        size -= input_u8(input) % size;
    }
    *intact = (like & (DAMAGED | CUT_OFF | ANY_MESSAGE)) == 0U && (old || (like & ODD_FLAGS) == 0U) && row->kept &&
              message == row->message && (row->target_at == 0U || for_us);
    return size;
}

bool frame_read(const uint8_t *bytes, size_t size, struct frame *frame)
{
    if (size < HEADER_1 + CHECKSUM || (bytes[0] != START_1 && bytes[0] != START_2)) {
        return false;
    }
    const bool old = bytes[0] == START_1;
    const size_t header = old ? HEADER_1 : HEADER_2;
    const size_t payload = bytes[1];
    const size_t signature = !old && (bytes[2] & SIGNED) != 0U ? SIGNATURE : 0U;

    if (size != header + payload + CHECKSUM + signature || (!old && (bytes[2] & ~SIGNED) != 0U)) {
        return false;
    }
    const uint8_t *at = bytes + (old ? 2 : 4);
    memset(frame, 0, sizeof *frame);
    frame->version = old ? 1 : 2;
    frame->sequence = at[0];
    frame->system = at[1];
    frame->component = at[2];
    frame->message = old ? at[3] : at[3] | (uint32_t)at[4] << 8U | (uint32_t)at[5] << 16U;
    memcpy(frame->payload, bytes + header, payload);
    uint16_t checksum;
    return checksum_of(frame->message, bytes, header + payload, &checksum) &&
           bytes[header + payload] == (uint8_t)checksum && bytes[header + payload + 1U] == (uint8_t)(checksum >> 8U);
}

uint16_t frame_u16(const struct frame *frame, size_t at)
{
    return (uint16_t)(frame->payload[at] | frame->payload[at + 1U] << 8U);
}

uint32_t frame_u32(const struct frame *frame, size_t at)
{
    return frame_u16(frame, at) | (uint32_t)frame_u16(frame, at + 2U) << 16U;
}

float frame_float(const struct frame *frame, size_t at)
{
    float value;

    memcpy(&value, frame->payload + at, sizeof value);
    return value;
}

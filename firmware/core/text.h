// SPDX-License-Identifier: Apache-2.0
// The one line of a STATUSTEXT, put together piece by piece.
#ifndef TOUCHDOWN_TEXT_H
#define TOUCHDOWN_TEXT_H

#include <stddef.h>
#include <stdint.h>

#include "mavlink_out.h"

struct text {
    char chars[MAVLINK_OUT_STATUS_TEXT_CHARS + 1U]; // ends with 0; what does not fit is cut off
    size_t length;
};

// Empty to begin with: struct text text = {.length = 0U};
void text_append(struct text *text, const char *more);
void text_append_number(struct text *text, uint32_t number);
void text_append_hexadecimal(struct text *text, uint32_t number);

#endif

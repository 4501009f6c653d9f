// SPDX-License-Identifier: Apache-2.0
#include "text.h"

#define DECIMAL_DIGITS_MAX 10U
#define HEX_DIGITS 8U

void text_append(struct text *text, const char *more)
{
    // Bounded: each turn makes the text one character longer.
    for (size_t i = 0; more[i] != '\0' && text->length + 1U < sizeof text->chars; i++) {
        text->chars[text->length++] = more[i];
    }
    text->chars[text->length] = '\0';
}

void text_append_number(struct text *text, uint32_t number)
{
    char digits[DECIMAL_DIGITS_MAX + 1U] = {0};
    size_t first = DECIMAL_DIGITS_MAX;

    // Bounded: `first` counts down to 0.
    do {
        digits[--first] = "0123456789"[number % 10U];
        number /= 10U;
    } while (number != 0U && first > 0U);
    text_append(text, &digits[first]);
}

void text_append_hexadecimal(struct text *text, uint32_t number)
{
    char digits[HEX_DIGITS + 1U] = {0};

    for (uint32_t i = 0; i < HEX_DIGITS; i++) {
        digits[i] = "0123456789abcdef"[(number >> (28U - 4U * i)) & 0xFU];
    }
    text_append(text, digits);
}

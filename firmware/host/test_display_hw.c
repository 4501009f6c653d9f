// SPDX-License-Identifier: Apache-2.0
// The display's driver against registers that are made up here.
#include <stdint.h>
#include <string.h>

// In place of board/zynq.h, which needs the processor.
#define TOUCHDOWN_ZYNQ_H
#define ZYNQ_LANDING_CORE_BASE 0x1000U
#define ZYNQ_DISPLAY_BASE 0U

static uint32_t register_read(uintptr_t address);
static void register_write(uintptr_t address, uint32_t value);

#include "../board/display_hw.c"

#include "test.h"

static uint32_t registers[32];
static uint32_t features;
static char shown[PICTURE_LINES][PICTURE_COLUMNS];
static unsigned chars_written;
static unsigned written_unheld;
static bool touched;

static uint32_t register_read(uintptr_t address)
{
    if (address == ZYNQ_LANDING_CORE_BASE + LANDING_REG_FEATURES_OFFSET) {
        return features;
    }
    touched = true;
    return registers[address / 4U];
}

static void register_write(uintptr_t address, uint32_t value)
{
    touched = true;
    if (address != DISPLAY_REG_CTRL_OFFSET &&
        (registers[DISPLAY_REG_CTRL_OFFSET / 4U] & DISPLAY_REG_CTRL_HOLD_MASK) == 0U) {
        written_unheld++;
    }
    registers[address / 4U] = value;
    if (address == DISPLAY_REG_TEXT_OFFSET) {
        const uint32_t line = (value & DISPLAY_REG_TEXT_LINE_MASK) >> DISPLAY_REG_TEXT_LINE_SHIFT;
        const uint32_t column = (value & DISPLAY_REG_TEXT_COLUMN_MASK) >> DISPLAY_REG_TEXT_COLUMN_SHIFT;
        shown[line][column] = (char)(value & DISPLAY_REG_TEXT_CHAR_MASK);
        chars_written++;
    }
}

static uint32_t reg(uint32_t offset)
{
    return registers[offset / 4U];
}

static void power_up(void)
{
    (void)memset(registers, 0, sizeof registers);
    (void)memset(shown, 0, sizeof shown);
    registers[DISPLAY_REG_ID_OFFSET / 4U] = DISPLAY_REG_ID_VALUE_RESET;
    registers[DISPLAY_REG_VERSION_OFFSET / 4U] = DISPLAY_REG_VERSION_MAJOR_RESET << DISPLAY_REG_VERSION_MAJOR_SHIFT;
    features = LANDING_REG_FEATURES_DISPLAY_MASK;
}

static void test_is_there(void)
{
    power_up();
    test_case("a display that is known");
    CHECK(display_hw_is_there());
    test_case("another version");
    registers[DISPLAY_REG_VERSION_OFFSET / 4U] += 1U << DISPLAY_REG_VERSION_MAJOR_SHIFT;
    CHECK(!display_hw_is_there());
    test_case("another core");
    power_up();
    registers[DISPLAY_REG_ID_OFFSET / 4U]++;
    CHECK(!display_hw_is_there());
    test_case("none: nothing of it is touched, for that would be a data abort");
    power_up();
    features = 0U;
    touched = false;
    CHECK(!display_hw_is_there());
    CHECK(!touched);
}

static void test_show(void)
{
    struct picture picture;

    power_up();
    display_hw_start();
    test_case("start");
    CHECK(reg(DISPLAY_REG_SHOW_OFFSET) == DISPLAY_REG_SHOW_CROSSHAIR_MASK);
    CHECK(reg(DISPLAY_REG_CTRL_OFFSET) == 0U);
    CHECK(reg(DISPLAY_REG_STORED_BASE_OFFSET) == BOARD_STORED_PICTURE_ADDRESS);
    CHECK(shown[0][0] == ' ' && shown[PICTURE_LINES - 1U][PICTURE_COLUMNS - 1U] == ' ');

    test_case("a pad");
    (void)memset(&picture, 0, sizeof picture);
    (void)memset(picture.text, ' ', sizeof picture.text);
    (void)memcpy(picture.text[1], "ABC", 3U);
    picture.has_pad = true;
    picture.centre = (struct picture_place){-3, 700};
    picture.tip = (struct picture_place){PICTURE_PLACE_MAX_PX, PICTURE_PLACE_MIN_PX};
    picture.boxes[PICTURE_RECTANGLE] = (struct picture_box){true, {-1, 2}, {30, 40}};
    picture.boxes[PICTURE_SMALL_RING] = (struct picture_box){true, {5, 6}, {7, 8}};
    written_unheld = 0U;
    chars_written = 0U;
    display_hw_show(&picture);
    CHECK(written_unheld == 0U);
    CHECK(chars_written == 3U);
    CHECK(memcmp(shown, picture.text, sizeof shown) == 0);
    CHECK(reg(DISPLAY_REG_CTRL_OFFSET) == 0U);
    CHECK(reg(DISPLAY_REG_SHOW_OFFSET) ==
          (DISPLAY_REG_SHOW_TEXT_MASK | DISPLAY_REG_SHOW_CROSSHAIR_MASK | DISPLAY_REG_SHOW_PAD_MASK |
           (0xCU << DISPLAY_REG_SHOW_BOXES_SHIFT)));
    CHECK(reg(DISPLAY_REG_CENTRE_OFFSET) == (700U << 16 | 0x3FFDU));
    CHECK(reg(DISPLAY_REG_TIP_OFFSET) == (0x2000U << 16 | 0x1FFFU));
    CHECK(reg(DISPLAY_REG_RECTANGLE_FROM_OFFSET) == (2U << 16 | 0x3FFFU));
    CHECK(reg(DISPLAY_REG_RECTANGLE_TO_OFFSET) == (40U << 16 | 30U));
    CHECK(reg(DISPLAY_REG_SMALL_RING_FROM_OFFSET) == (6U << 16 | 5U));
    CHECK(reg(DISPLAY_REG_SMALL_RING_TO_OFFSET) == (8U << 16 | 7U));

    test_case("the same again, without the pad: no character is written");
    chars_written = 0U;
    picture.has_pad = false;
    picture.boxes[PICTURE_RECTANGLE].shown = false;
    picture.boxes[PICTURE_SMALL_RING].shown = false;
    display_hw_show(&picture);
    CHECK(chars_written == 0U);
    CHECK(reg(DISPLAY_REG_SHOW_OFFSET) == (DISPLAY_REG_SHOW_TEXT_MASK | DISPLAY_REG_SHOW_CROSSHAIR_MASK));
}

static void test_poll(void)
{
    static const uint32_t sources[] = {0U, 1U, 1U | DISPLAY_REG_CTRL_PATTERN_MOVE_MASK, 2U};
    static const struct display_lights dark = {false, false, false};
    static const struct display_lights bright = {true, true, true};

    power_up();
    display_hw_start();
    for (uint32_t i = 0; i < 4U; i++) {
        test_case("switches %u", i);
        registers[DISPLAY_REG_STATUS_OFFSET / 4U] = i << DISPLAY_REG_STATUS_SWITCHES_SHIFT;
        display_hw_poll(&dark);
        CHECK(reg(DISPLAY_REG_CTRL_OFFSET) == sources[i]);
        CHECK(display_hw_shows_camera() == (i == 0U));
        CHECK(reg(DISPLAY_REG_LEDS_OFFSET) == 0U);
    }
    registers[DISPLAY_REG_STATUS_OFFSET / 4U] = DISPLAY_REG_STATUS_CLOCK_RUNS_MASK;
    display_hw_poll(&bright);
    CHECK(reg(DISPLAY_REG_LEDS_OFFSET) == 0xFU);
    for (uint32_t i = 1; i <= 5U; i++) {
        test_case("button, press %u: each counts once, however long it is held", i);
        for (int polls = 0; polls < 3; polls++) {
            registers[DISPLAY_REG_STATUS_OFFSET / 4U] = 1U << DISPLAY_REG_STATUS_BUTTONS_SHIFT;
            display_hw_poll(&dark);
            CHECK(reg(DISPLAY_REG_CTRL_OFFSET) == (i % 4U) << DISPLAY_REG_CTRL_VIEW_SHIFT);
        }
        registers[DISPLAY_REG_STATUS_OFFSET / 4U] = 2U << DISPLAY_REG_STATUS_BUTTONS_SHIFT;
        display_hw_poll(&dark);
        CHECK(reg(DISPLAY_REG_CTRL_OFFSET) == (i % 4U) << DISPLAY_REG_CTRL_VIEW_SHIFT);
    }
}

void test_display_hw(void)
{
    test_is_there();
    test_show();
    test_poll();
}

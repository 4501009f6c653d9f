// SPDX-License-Identifier: Apache-2.0
#include "display_hw.h"

#include <stdint.h>

#include "board.h"
#include "display_regs.h"
#include "landing_regs.h"
#include "zynq.h"

#define VIEWS 4U
#define SOURCE_CAMERA 0U
#define SOURCE_PATTERN 1U
#define SOURCE_STORED 2U
#define LED_CLOCK 1U
#define LED_FRAMES 2U
#define LED_PAD 4U
#define LED_LIDAR 8U
#define BUTTON_VIEW 1U
#define PLACE_MASK 0x3FFFU
#define PLACE_Y_SHIFT 16U

// Where each shape's box is; its end follows in the next register.
static const uint32_t box_offsets[PICTURE_SHAPES] = {
    [PICTURE_RING] = DISPLAY_REG_RING_FROM_OFFSET,
    [PICTURE_SQUARE] = DISPLAY_REG_SQUARE_FROM_OFFSET,
    [PICTURE_RECTANGLE] = DISPLAY_REG_RECTANGLE_FROM_OFFSET,
    [PICTURE_SMALL_RING] = DISPLAY_REG_SMALL_RING_FROM_OFFSET,
};
#define BOX_END 4U
_Static_assert(DISPLAY_REG_RING_TO_OFFSET == DISPLAY_REG_RING_FROM_OFFSET + BOX_END, "an end follows its beginning");
_Static_assert(DISPLAY_REG_SQUARE_TO_OFFSET == DISPLAY_REG_SQUARE_FROM_OFFSET + BOX_END, "here too");
_Static_assert(DISPLAY_REG_RECTANGLE_TO_OFFSET == DISPLAY_REG_RECTANGLE_FROM_OFFSET + BOX_END, "here too");
_Static_assert(DISPLAY_REG_SMALL_RING_TO_OFFSET == DISPLAY_REG_SMALL_RING_FROM_OFFSET + BOX_END, "here too");

static struct {
    uint32_t view;
    uint32_t source; // field of CTRL, with the pattern's movement
    uint32_t buttons;
    char text[PICTURE_LINES][PICTURE_COLUMNS];
} now;

static uint32_t get(uint32_t offset)
{
    return register_read(ZYNQ_DISPLAY_BASE + offset);
}

static void set(uint32_t offset, uint32_t value)
{
    register_write(ZYNQ_DISPLAY_BASE + offset, value);
}

static void set_control(bool hold)
{
    set(DISPLAY_REG_CTRL_OFFSET, now.source | now.view << DISPLAY_REG_CTRL_VIEW_SHIFT |
                                     (hold ? DISPLAY_REG_CTRL_HOLD_MASK : 0U));
}

static void set_place(uint32_t offset, const struct picture_place *place)
{
    set(offset, ((uint32_t)place->y_px & PLACE_MASK) << PLACE_Y_SHIFT | ((uint32_t)place->x_px & PLACE_MASK));
}

static void set_char(uint32_t line, uint32_t column, char character)
{
    now.text[line][column] = character;
    set(DISPLAY_REG_TEXT_OFFSET, line << DISPLAY_REG_TEXT_LINE_SHIFT | column << DISPLAY_REG_TEXT_COLUMN_SHIFT |
                                     (uint32_t)(unsigned char)character);
}

bool display_hw_is_there(void)
{
    // Where nothing answers, a read would be a data abort: landing_core says what else is there.
    const uint32_t built_with = register_read(ZYNQ_LANDING_CORE_BASE + LANDING_REG_FEATURES_OFFSET);

    return (built_with & LANDING_REG_FEATURES_DISPLAY_MASK) != 0U &&
           get(DISPLAY_REG_ID_OFFSET) == DISPLAY_REG_ID_VALUE_RESET &&
           (get(DISPLAY_REG_VERSION_OFFSET) & DISPLAY_REG_VERSION_MAJOR_MASK) >> DISPLAY_REG_VERSION_MAJOR_SHIFT ==
               DISPLAY_REG_VERSION_MAJOR_RESET;
}

void display_hw_start(void)
{
    now.view = 0U;
    now.source = SOURCE_CAMERA;
    now.buttons = 0U;
    for (uint32_t line = 0; line < PICTURE_LINES; line++) {
        for (uint32_t column = 0; column < PICTURE_COLUMNS; column++) {
            set_char(line, column, ' ');
        }
    }
    set(DISPLAY_REG_STORED_BASE_OFFSET, BOARD_STORED_PICTURE_ADDRESS);
    set(DISPLAY_REG_SHOW_OFFSET, DISPLAY_REG_SHOW_CROSSHAIR_MASK);
    set_control(false);
}

void display_hw_show(const struct picture *picture)
{
    uint32_t show = DISPLAY_REG_SHOW_TEXT_MASK | DISPLAY_REG_SHOW_CROSSHAIR_MASK;

    // Held, the monitor goes on showing what it shows until all of this is written.
    set_control(true);
    for (uint32_t i = 0; i < PICTURE_SHAPES; i++) {
        if (picture->boxes[i].shown) {
            show |= 1U << (DISPLAY_REG_SHOW_BOXES_SHIFT + i);
            set_place(box_offsets[i], &picture->boxes[i].from);
            set_place(box_offsets[i] + BOX_END, &picture->boxes[i].to);
        }
    }
    if (picture->has_pad) {
        show |= DISPLAY_REG_SHOW_PAD_MASK;
        set_place(DISPLAY_REG_CENTRE_OFFSET, &picture->centre);
        set_place(DISPLAY_REG_TIP_OFFSET, &picture->tip);
    }
    for (uint32_t line = 0; line < PICTURE_LINES; line++) {
        for (uint32_t column = 0; column < PICTURE_COLUMNS; column++) {
            if (now.text[line][column] != picture->text[line][column]) {
                set_char(line, column, picture->text[line][column]);
            }
        }
    }
    set(DISPLAY_REG_SHOW_OFFSET, show);
    set_control(false);
}

bool display_hw_shows_camera(void)
{
    return now.source == SOURCE_CAMERA;
}

void display_hw_poll(const struct display_lights *lights)
{
    static const uint32_t sources[] = {
        SOURCE_CAMERA,
        SOURCE_PATTERN,
        SOURCE_PATTERN | DISPLAY_REG_CTRL_PATTERN_MOVE_MASK,
        SOURCE_STORED,
    };
    const uint32_t status = get(DISPLAY_REG_STATUS_OFFSET);
    const uint32_t buttons = (status & DISPLAY_REG_STATUS_BUTTONS_MASK) >> DISPLAY_REG_STATUS_BUTTONS_SHIFT;
    const uint32_t pressed = buttons & ~now.buttons;
    uint32_t leds = (status & DISPLAY_REG_STATUS_CLOCK_RUNS_MASK) != 0U ? LED_CLOCK : 0U;

    now.buttons = buttons;
    if ((pressed & BUTTON_VIEW) != 0U) {
        now.view = (now.view + 1U) % VIEWS;
    }
    now.source = sources[(status & DISPLAY_REG_STATUS_SWITCHES_MASK) >> DISPLAY_REG_STATUS_SWITCHES_SHIFT];
    set_control(false);
    leds |= lights->frames ? LED_FRAMES : 0U;
    leds |= lights->pad ? LED_PAD : 0U;
    leds |= lights->lidar ? LED_LIDAR : 0U;
    set(DISPLAY_REG_LEDS_OFFSET, leds);
}

# SPDX-License-Identifier: Apache-2.0
"""Generated from rtl/display/display.rdl by python -m scripts.regmap. Do not edit."""

from golden.registers import Field, Register

ID_OFFSET = 0x00
ID_VALUE_MASK = 0xFFFFFFFF
ID_VALUE_SHIFT = 0
VERSION_OFFSET = 0x04
VERSION_PATCH_MASK = 0x000000FF
VERSION_PATCH_SHIFT = 0
VERSION_MINOR_MASK = 0x0000FF00
VERSION_MINOR_SHIFT = 8
VERSION_MAJOR_MASK = 0x00FF0000
VERSION_MAJOR_SHIFT = 16
CTRL_OFFSET = 0x08
CTRL_SOURCE_MASK = 0x00000003
CTRL_SOURCE_SHIFT = 0
CTRL_VIEW_MASK = 0x00000030
CTRL_VIEW_SHIFT = 4
CTRL_PATTERN_MOVE_MASK = 0x00000100
CTRL_PATTERN_MOVE_SHIFT = 8
CTRL_HOLD_MASK = 0x00010000
CTRL_HOLD_SHIFT = 16
SHOW_OFFSET = 0x0C
SHOW_TEXT_MASK = 0x00000001
SHOW_TEXT_SHIFT = 0
SHOW_TEXT_BANK_MASK = 0x00000002
SHOW_TEXT_BANK_SHIFT = 1
SHOW_PAD_MASK = 0x00000004
SHOW_PAD_SHIFT = 2
SHOW_CROSSHAIR_MASK = 0x00000008
SHOW_CROSSHAIR_SHIFT = 3
SHOW_BOXES_MASK = 0x000000F0
SHOW_BOXES_SHIFT = 4
RING_FROM_OFFSET = 0x10
RING_FROM_LEFT_MASK = 0x00003FFF
RING_FROM_LEFT_SHIFT = 0
RING_FROM_TOP_MASK = 0x3FFF0000
RING_FROM_TOP_SHIFT = 16
RING_TO_OFFSET = 0x14
RING_TO_RIGHT_MASK = 0x00003FFF
RING_TO_RIGHT_SHIFT = 0
RING_TO_BOTTOM_MASK = 0x3FFF0000
RING_TO_BOTTOM_SHIFT = 16
SQUARE_FROM_OFFSET = 0x18
SQUARE_FROM_LEFT_MASK = 0x00003FFF
SQUARE_FROM_LEFT_SHIFT = 0
SQUARE_FROM_TOP_MASK = 0x3FFF0000
SQUARE_FROM_TOP_SHIFT = 16
SQUARE_TO_OFFSET = 0x1C
SQUARE_TO_RIGHT_MASK = 0x00003FFF
SQUARE_TO_RIGHT_SHIFT = 0
SQUARE_TO_BOTTOM_MASK = 0x3FFF0000
SQUARE_TO_BOTTOM_SHIFT = 16
RECTANGLE_FROM_OFFSET = 0x20
RECTANGLE_FROM_LEFT_MASK = 0x00003FFF
RECTANGLE_FROM_LEFT_SHIFT = 0
RECTANGLE_FROM_TOP_MASK = 0x3FFF0000
RECTANGLE_FROM_TOP_SHIFT = 16
RECTANGLE_TO_OFFSET = 0x24
RECTANGLE_TO_RIGHT_MASK = 0x00003FFF
RECTANGLE_TO_RIGHT_SHIFT = 0
RECTANGLE_TO_BOTTOM_MASK = 0x3FFF0000
RECTANGLE_TO_BOTTOM_SHIFT = 16
SMALL_RING_FROM_OFFSET = 0x28
SMALL_RING_FROM_LEFT_MASK = 0x00003FFF
SMALL_RING_FROM_LEFT_SHIFT = 0
SMALL_RING_FROM_TOP_MASK = 0x3FFF0000
SMALL_RING_FROM_TOP_SHIFT = 16
SMALL_RING_TO_OFFSET = 0x2C
SMALL_RING_TO_RIGHT_MASK = 0x00003FFF
SMALL_RING_TO_RIGHT_SHIFT = 0
SMALL_RING_TO_BOTTOM_MASK = 0x3FFF0000
SMALL_RING_TO_BOTTOM_SHIFT = 16
CENTRE_OFFSET = 0x30
CENTRE_X_MASK = 0x00003FFF
CENTRE_X_SHIFT = 0
CENTRE_Y_MASK = 0x3FFF0000
CENTRE_Y_SHIFT = 16
TIP_OFFSET = 0x34
TIP_X_MASK = 0x00003FFF
TIP_X_SHIFT = 0
TIP_Y_MASK = 0x3FFF0000
TIP_Y_SHIFT = 16
TEXT_OFFSET = 0x38
TEXT_CHAR_MASK = 0x0000007F
TEXT_CHAR_SHIFT = 0
TEXT_COLUMN_MASK = 0x003F0000
TEXT_COLUMN_SHIFT = 16
TEXT_LINE_MASK = 0x00400000
TEXT_LINE_SHIFT = 22
TEXT_BANK_MASK = 0x00800000
TEXT_BANK_SHIFT = 23
LEDS_OFFSET = 0x3C
LEDS_ON_MASK = 0x0000000F
LEDS_ON_SHIFT = 0
STATUS_OFFSET = 0x40
STATUS_CLOCK_RUNS_MASK = 0x00000001
STATUS_CLOCK_RUNS_SHIFT = 0
STATUS_CLOCK_LOCKED_MASK = 0x00000002
STATUS_CLOCK_LOCKED_SHIFT = 1
STATUS_MONITOR_MASK = 0x00000004
STATUS_MONITOR_SHIFT = 2
STATUS_BUTTONS_MASK = 0x000000F0
STATUS_BUTTONS_SHIFT = 4
STATUS_SWITCHES_MASK = 0x00000300
STATUS_SWITCHES_SHIFT = 8
EVENTS_OFFSET = 0x44
EVENTS_CLOCK_LOST_MASK = 0x00000001
EVENTS_CLOCK_LOST_SHIFT = 0
EVENTS_FRAME_BLANK_MASK = 0x00000002
EVENTS_FRAME_BLANK_SHIFT = 1
EVENTS_STORED_UNDERFLOW_MASK = 0x00000004
EVENTS_STORED_UNDERFLOW_SHIFT = 2
EVENTS_STORED_ERROR_MASK = 0x00000008
EVENTS_STORED_ERROR_SHIFT = 3
PIX_CLK_OFFSET = 0x48
PIX_CLK_KHZ_MASK = 0x000FFFFF
PIX_CLK_KHZ_SHIFT = 0
FRAMES_BLANK_OFFSET = 0x4C
FRAMES_BLANK_COUNT_MASK = 0xFFFFFFFF
FRAMES_BLANK_COUNT_SHIFT = 0
STORED_BASE_OFFSET = 0x50
STORED_BASE_ADDRESS_MASK = 0xFFFFFFFF
STORED_BASE_ADDRESS_SHIFT = 0

REGISTERS = (
    Register(
        "ID",
        0x00,
        (Field("value", 0, 32, "constant", 0x54444450),),
    ),
    Register(
        "VERSION",
        0x04,
        (
            Field("patch", 0, 8, "constant", 0x0),
            Field("minor", 8, 8, "constant", 0x1),
            Field("major", 16, 8, "constant", 0x0),
        ),
    ),
    Register(
        "CTRL",
        0x08,
        (
            Field("source", 0, 2, "rw", 0x0),
            Field("view", 4, 2, "rw", 0x0),
            Field("pattern_move", 8, 1, "rw", 0x0),
            Field("hold", 16, 1, "rw", 0x0),
        ),
    ),
    Register(
        "SHOW",
        0x0C,
        (
            Field("text", 0, 1, "rw", 0x0),
            Field("text_bank", 1, 1, "rw", 0x0),
            Field("pad", 2, 1, "rw", 0x0),
            Field("crosshair", 3, 1, "rw", 0x1),
            Field("boxes", 4, 4, "rw", 0x0),
        ),
    ),
    Register(
        "RING_FROM",
        0x10,
        (
            Field("left", 0, 14, "rw", 0x0),
            Field("top", 16, 14, "rw", 0x0),
        ),
    ),
    Register(
        "RING_TO",
        0x14,
        (
            Field("right", 0, 14, "rw", 0x0),
            Field("bottom", 16, 14, "rw", 0x0),
        ),
    ),
    Register(
        "SQUARE_FROM",
        0x18,
        (
            Field("left", 0, 14, "rw", 0x0),
            Field("top", 16, 14, "rw", 0x0),
        ),
    ),
    Register(
        "SQUARE_TO",
        0x1C,
        (
            Field("right", 0, 14, "rw", 0x0),
            Field("bottom", 16, 14, "rw", 0x0),
        ),
    ),
    Register(
        "RECTANGLE_FROM",
        0x20,
        (
            Field("left", 0, 14, "rw", 0x0),
            Field("top", 16, 14, "rw", 0x0),
        ),
    ),
    Register(
        "RECTANGLE_TO",
        0x24,
        (
            Field("right", 0, 14, "rw", 0x0),
            Field("bottom", 16, 14, "rw", 0x0),
        ),
    ),
    Register(
        "SMALL_RING_FROM",
        0x28,
        (
            Field("left", 0, 14, "rw", 0x0),
            Field("top", 16, 14, "rw", 0x0),
        ),
    ),
    Register(
        "SMALL_RING_TO",
        0x2C,
        (
            Field("right", 0, 14, "rw", 0x0),
            Field("bottom", 16, 14, "rw", 0x0),
        ),
    ),
    Register(
        "CENTRE",
        0x30,
        (
            Field("x", 0, 14, "rw", 0x0),
            Field("y", 16, 14, "rw", 0x0),
        ),
    ),
    Register(
        "TIP",
        0x34,
        (
            Field("x", 0, 14, "rw", 0x0),
            Field("y", 16, 14, "rw", 0x0),
        ),
    ),
    Register(
        "TEXT",
        0x38,
        (
            Field("char", 0, 7, "rw", 0x0),
            Field("column", 16, 6, "rw", 0x0),
            Field("line", 22, 1, "rw", 0x0),
            Field("bank", 23, 1, "rw", 0x0),
        ),
    ),
    Register(
        "LEDS",
        0x3C,
        (Field("on", 0, 4, "rw", 0x0),),
    ),
    Register(
        "STATUS",
        0x40,
        (
            Field("clock_runs", 0, 1, "ro", 0x0),
            Field("clock_locked", 1, 1, "ro", 0x0),
            Field("monitor", 2, 1, "ro", 0x0),
            Field("buttons", 4, 4, "ro", 0x0),
            Field("switches", 8, 2, "ro", 0x0),
        ),
    ),
    Register(
        "EVENTS",
        0x44,
        (
            Field("clock_lost", 0, 1, "w1c", 0x0),
            Field("frame_blank", 1, 1, "w1c", 0x0),
            Field("stored_underflow", 2, 1, "w1c", 0x0),
            Field("stored_error", 3, 1, "w1c", 0x0),
        ),
    ),
    Register(
        "PIX_CLK",
        0x48,
        (Field("khz", 0, 20, "ro", 0x0),),
    ),
    Register(
        "FRAMES_BLANK",
        0x4C,
        (Field("count", 0, 32, "ro", 0x0),),
    ),
    Register(
        "STORED_BASE",
        0x50,
        (Field("address", 0, 32, "rw", 0x0),),
    ),
)

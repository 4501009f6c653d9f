# SPDX-License-Identifier: Apache-2.0
"""Generated from rtl/landing_regs/landing_core.rdl by python -m scripts.regmap. Do not edit."""

import numpy as np

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
CTRL_ENABLE_MASK = 0x00000001
CTRL_ENABLE_SHIFT = 0
CTRL_DARK_IS_ONE_MASK = 0x00000002
CTRL_DARK_IS_ONE_SHIFT = 1
CTRL_LABEL_ZEROS_MASK = 0x00000004
CTRL_LABEL_ZEROS_SHIFT = 2
FRAME_SIZE_OFFSET = 0x0C
FRAME_SIZE_WIDTH_MASK = 0x0000FFFF
FRAME_SIZE_WIDTH_SHIFT = 0
FRAME_SIZE_HEIGHT_MASK = 0xFFFF0000
FRAME_SIZE_HEIGHT_SHIFT = 16
THRESHOLD_OFFSET = 0x10
THRESHOLD_FACTOR_MASK = 0x000001FF
THRESHOLD_FACTOR_SHIFT = 0
THRESHOLD_FLAT_LIMIT_MASK = 0x00FF0000
THRESHOLD_FLAT_LIMIT_SHIFT = 16
MIN_AREA_OFFSET = 0x14
MIN_AREA_PIXELS_MASK = 0xFFFFFFFF
MIN_AREA_PIXELS_SHIFT = 0
RING_BASE_OFFSET = 0x18
RING_BASE_ADDRESS_MASK = 0xFFFFFFFF
RING_BASE_ADDRESS_SHIFT = 0
RING_INFO_OFFSET = 0x1C
RING_INFO_BUFFERS_MASK = 0x000000FF
RING_INFO_BUFFERS_SHIFT = 0
RING_INFO_MAX_OBJECTS_MASK = 0xFFFF0000
RING_INFO_MAX_OBJECTS_SHIFT = 16
RING_HEAD_OFFSET = 0x20
RING_HEAD_INDEX_MASK = 0x000000FF
RING_HEAD_INDEX_SHIFT = 0
RING_HEAD_VALID_MASK = 0x80000000
RING_HEAD_VALID_SHIFT = 31
FRAME_NUMBER_OFFSET = 0x24
FRAME_NUMBER_NUMBER_MASK = 0xFFFFFFFF
FRAME_NUMBER_NUMBER_SHIFT = 0
IRQ_STATUS_OFFSET = 0x28
IRQ_STATUS_FRAME_DONE_MASK = 0x00000001
IRQ_STATUS_FRAME_DONE_SHIFT = 0
IRQ_STATUS_FRAME_MALFORMED_MASK = 0x00000002
IRQ_STATUS_FRAME_MALFORMED_SHIFT = 1
IRQ_STATUS_FRAME_OVERFLOW_MASK = 0x00000004
IRQ_STATUS_FRAME_OVERFLOW_SHIFT = 2
IRQ_STATUS_AXI_ERROR_MASK = 0x00000008
IRQ_STATUS_AXI_ERROR_SHIFT = 3
IRQ_STATUS_LIDAR_FAULT_MASK = 0x00000010
IRQ_STATUS_LIDAR_FAULT_SHIFT = 4
IRQ_ENABLE_OFFSET = 0x2C
IRQ_ENABLE_FRAME_DONE_MASK = 0x00000001
IRQ_ENABLE_FRAME_DONE_SHIFT = 0
IRQ_ENABLE_FRAME_MALFORMED_MASK = 0x00000002
IRQ_ENABLE_FRAME_MALFORMED_SHIFT = 1
IRQ_ENABLE_FRAME_OVERFLOW_MASK = 0x00000004
IRQ_ENABLE_FRAME_OVERFLOW_SHIFT = 2
IRQ_ENABLE_AXI_ERROR_MASK = 0x00000008
IRQ_ENABLE_AXI_ERROR_SHIFT = 3
IRQ_ENABLE_LIDAR_FAULT_MASK = 0x00000010
IRQ_ENABLE_LIDAR_FAULT_SHIFT = 4
FRAMES_SEEN_OFFSET = 0x30
FRAMES_SEEN_COUNT_MASK = 0xFFFFFFFF
FRAMES_SEEN_COUNT_SHIFT = 0
FRAMES_MALFORMED_OFFSET = 0x34
FRAMES_MALFORMED_COUNT_MASK = 0xFFFFFFFF
FRAMES_MALFORMED_COUNT_SHIFT = 0
FRAMES_OVERFLOW_OFFSET = 0x38
FRAMES_OVERFLOW_COUNT_MASK = 0xFFFFFFFF
FRAMES_OVERFLOW_COUNT_SHIFT = 0
FRAMES_UNWRITTEN_OFFSET = 0x3C
FRAMES_UNWRITTEN_COUNT_MASK = 0xFFFFFFFF
FRAMES_UNWRITTEN_COUNT_SHIFT = 0
MEASURED_SIZE_OFFSET = 0x40
MEASURED_SIZE_WIDTH_MASK = 0x0000FFFF
MEASURED_SIZE_WIDTH_SHIFT = 0
MEASURED_SIZE_HEIGHT_MASK = 0xFFFF0000
MEASURED_SIZE_HEIGHT_SHIFT = 16
LIDAR_CTRL_OFFSET = 0x44
LIDAR_CTRL_ENABLE_MASK = 0x00000001
LIDAR_CTRL_ENABLE_SHIFT = 0
LIDAR_DISTANCE_OFFSET = 0x48
LIDAR_DISTANCE_MM_MASK = 0xFFFFFFFF
LIDAR_DISTANCE_MM_SHIFT = 0
LIDAR_AGE_OFFSET = 0x4C
LIDAR_AGE_US_MASK = 0xFFFFFFFF
LIDAR_AGE_US_SHIFT = 0
LIDAR_STATUS_OFFSET = 0x50
LIDAR_STATUS_VALID_MASK = 0x00000001
LIDAR_STATUS_VALID_SHIFT = 0
LIDAR_STATUS_TIMEOUT_MASK = 0x00000002
LIDAR_STATUS_TIMEOUT_SHIFT = 1
LIDAR_STATUS_TOO_LONG_MASK = 0x00000004
LIDAR_STATUS_TOO_LONG_SHIFT = 2
LIDAR_STATUS_TOO_SHORT_MASK = 0x00000008
LIDAR_STATUS_TOO_SHORT_SHIFT = 3
TIME_LO_OFFSET = 0x54
TIME_LO_US_MASK = 0xFFFFFFFF
TIME_LO_US_SHIFT = 0
TIME_HI_OFFSET = 0x58
TIME_HI_US_MASK = 0xFFFFFFFF
TIME_HI_US_SHIFT = 0
SCRATCH_OFFSET = 0x5C
SCRATCH_VALUE_MASK = 0xFFFFFFFF
SCRATCH_VALUE_SHIFT = 0
FEATURES_OFFSET = 0x60
FEATURES_DISPLAY_MASK = 0x00000001
FEATURES_DISPLAY_SHIFT = 0

REGISTERS = (
    Register(
        "ID",
        0x00,
        (Field("value", 0, 32, "constant", 0x5444574E),),
    ),
    Register(
        "VERSION",
        0x04,
        (
            Field("patch", 0, 8, "constant", 0x0),
            Field("minor", 8, 8, "constant", 0x2),
            Field("major", 16, 8, "constant", 0x0),
        ),
    ),
    Register(
        "CTRL",
        0x08,
        (
            Field("enable", 0, 1, "rw", 0x0),
            Field("dark_is_one", 1, 1, "rw", 0x0),
            Field("label_zeros", 2, 1, "rw", 0x1),
        ),
    ),
    Register(
        "FRAME_SIZE",
        0x0C,
        (
            Field("width", 0, 16, "rw", 0x500),
            Field("height", 16, 16, "rw", 0x2D0),
        ),
    ),
    Register(
        "THRESHOLD",
        0x10,
        (
            Field("factor", 0, 9, "rw", 0x40),
            Field("flat_limit", 16, 8, "rw", 0x0),
        ),
    ),
    Register(
        "MIN_AREA",
        0x14,
        (Field("pixels", 0, 32, "rw", 0x1E),),
    ),
    Register(
        "RING_BASE",
        0x18,
        (Field("address", 0, 32, "rw", 0x0),),
    ),
    Register(
        "RING_INFO",
        0x1C,
        (
            Field("buffers", 0, 8, "ro", 0x0),
            Field("max_objects", 16, 16, "ro", 0x0),
        ),
    ),
    Register(
        "RING_HEAD",
        0x20,
        (
            Field("index", 0, 8, "ro", 0x0),
            Field("valid", 31, 1, "ro", 0x0),
        ),
    ),
    Register(
        "FRAME_NUMBER",
        0x24,
        (Field("number", 0, 32, "ro", 0x0),),
    ),
    Register(
        "IRQ_STATUS",
        0x28,
        (
            Field("frame_done", 0, 1, "w1c", 0x0),
            Field("frame_malformed", 1, 1, "w1c", 0x0),
            Field("frame_overflow", 2, 1, "w1c", 0x0),
            Field("axi_error", 3, 1, "w1c", 0x0),
            Field("lidar_fault", 4, 1, "w1c", 0x0),
        ),
    ),
    Register(
        "IRQ_ENABLE",
        0x2C,
        (
            Field("frame_done", 0, 1, "rw", 0x0),
            Field("frame_malformed", 1, 1, "rw", 0x0),
            Field("frame_overflow", 2, 1, "rw", 0x0),
            Field("axi_error", 3, 1, "rw", 0x0),
            Field("lidar_fault", 4, 1, "rw", 0x0),
        ),
    ),
    Register(
        "FRAMES_SEEN",
        0x30,
        (Field("count", 0, 32, "ro", 0x0),),
    ),
    Register(
        "FRAMES_MALFORMED",
        0x34,
        (Field("count", 0, 32, "ro", 0x0),),
    ),
    Register(
        "FRAMES_OVERFLOW",
        0x38,
        (Field("count", 0, 32, "ro", 0x0),),
    ),
    Register(
        "FRAMES_UNWRITTEN",
        0x3C,
        (Field("count", 0, 32, "ro", 0x0),),
    ),
    Register(
        "MEASURED_SIZE",
        0x40,
        (
            Field("width", 0, 16, "ro", 0x0),
            Field("height", 16, 16, "ro", 0x0),
        ),
    ),
    Register(
        "LIDAR_CTRL",
        0x44,
        (Field("enable", 0, 1, "rw", 0x0),),
    ),
    Register(
        "LIDAR_DISTANCE",
        0x48,
        (Field("mm", 0, 32, "ro", 0x0),),
    ),
    Register(
        "LIDAR_AGE",
        0x4C,
        (Field("us", 0, 32, "ro", 0x0),),
    ),
    Register(
        "LIDAR_STATUS",
        0x50,
        (
            Field("valid", 0, 1, "ro", 0x0),
            Field("timeout", 1, 1, "ro", 0x0),
            Field("too_long", 2, 1, "ro", 0x0),
            Field("too_short", 3, 1, "ro", 0x0),
        ),
    ),
    Register(
        "TIME_LO",
        0x54,
        (Field("us", 0, 32, "ro", 0x0),),
    ),
    Register(
        "TIME_HI",
        0x58,
        (Field("us", 0, 32, "ro", 0x0),),
    ),
    Register(
        "SCRATCH",
        0x5C,
        (Field("value", 0, 32, "rw", 0x0),),
    ),
    Register(
        "FEATURES",
        0x60,
        (Field("display", 0, 1, "ro", 0x0),),
    ),
)

RING_BUFFERS = 4
RING_STRIDE_BYTES = 32768
RECORD_MAX_OBJECTS = 256
HEADER_ID_VERSION = 0x1
HEADER_ID_MAGIC = 0x5444
HEADER_FLAGS_THRESHOLDS_MISSING_MASK = 0x00000001
HEADER_FLAGS_THRESHOLDS_STALE_MASK = 0x00000002
HEADER_FLAGS_OBJECTS_OVERFLOW_MASK = 0x00000004
HEADER_FLAGS_ALTITUDE_VALID_MASK = 0x00000008

HEADER_DTYPE = np.dtype(
    [
        ("id_version", "<u2"),
        ("id_magic", "<u2"),
        ("flags", "<u4"),
        ("start_time_us", "<u8"),
        ("scan_time_us", "<u4"),
        ("altitude_mm", "<u4"),
        ("altitude_age_us", "<u4"),
        ("object_count", "<u4"),
        ("objects_dropped", "<u4"),
        ("frame_size_width", "<u2"),
        ("frame_size_height", "<u2"),
        ("threshold_factor", "<u4"),
        ("min_area", "<u4"),
        ("frames_malformed", "<u4"),
        ("frames_overflow", "<u4"),
        ("reserved", "<u4"),
        ("frame_number", "<u4"),
    ]
)
OBJECT_DTYPE = np.dtype(
    [
        ("area", "<u4"),
        ("box_min_x", "<u2"),
        ("box_min_y", "<u2"),
        ("box_max_x", "<u2"),
        ("box_max_y", "<u2"),
        ("reserved_0", "<u4"),
        ("sum_x", "<u8"),
        ("sum_y", "<u8"),
        ("sum_xx", "<u8"),
        ("sum_yy", "<u8"),
        ("sum_xy", "<u8"),
        ("reserved_1", "<u4"),
        ("reserved_2", "<u4"),
    ]
)
RECORD_DTYPE = np.dtype([("header", HEADER_DTYPE), ("objects", OBJECT_DTYPE, RECORD_MAX_OBJECTS)])

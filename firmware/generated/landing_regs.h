// SPDX-License-Identifier: Apache-2.0
// Generated from rtl/landing_regs/landing_core.rdl by python -m scripts.regmap. Do not edit.
#ifndef LANDING_REGS_H
#define LANDING_REGS_H

#include <stddef.h>
#include <stdint.h>

// Registers: byte offsets from their base; fields as masks in place.
#define LANDING_REG_ID_OFFSET 0x00u
#define LANDING_REG_ID_VALUE_MASK 0xffffffffu
#define LANDING_REG_ID_VALUE_SHIFT 0u
#define LANDING_REG_ID_VALUE_RESET 0x5444574eu
#define LANDING_REG_VERSION_OFFSET 0x04u
#define LANDING_REG_VERSION_PATCH_MASK 0x000000ffu
#define LANDING_REG_VERSION_PATCH_SHIFT 0u
#define LANDING_REG_VERSION_PATCH_RESET 0x0u
#define LANDING_REG_VERSION_MINOR_MASK 0x0000ff00u
#define LANDING_REG_VERSION_MINOR_SHIFT 8u
#define LANDING_REG_VERSION_MINOR_RESET 0x2u
#define LANDING_REG_VERSION_MAJOR_MASK 0x00ff0000u
#define LANDING_REG_VERSION_MAJOR_SHIFT 16u
#define LANDING_REG_VERSION_MAJOR_RESET 0x0u
#define LANDING_REG_CTRL_OFFSET 0x08u
#define LANDING_REG_CTRL_ENABLE_MASK 0x00000001u
#define LANDING_REG_CTRL_ENABLE_SHIFT 0u
#define LANDING_REG_CTRL_ENABLE_RESET 0x0u
#define LANDING_REG_CTRL_DARK_IS_ONE_MASK 0x00000002u
#define LANDING_REG_CTRL_DARK_IS_ONE_SHIFT 1u
#define LANDING_REG_CTRL_DARK_IS_ONE_RESET 0x0u
#define LANDING_REG_CTRL_LABEL_ZEROS_MASK 0x00000004u
#define LANDING_REG_CTRL_LABEL_ZEROS_SHIFT 2u
#define LANDING_REG_CTRL_LABEL_ZEROS_RESET 0x1u
#define LANDING_REG_FRAME_SIZE_OFFSET 0x0cu
#define LANDING_REG_FRAME_SIZE_WIDTH_MASK 0x0000ffffu
#define LANDING_REG_FRAME_SIZE_WIDTH_SHIFT 0u
#define LANDING_REG_FRAME_SIZE_WIDTH_RESET 0x500u
#define LANDING_REG_FRAME_SIZE_HEIGHT_MASK 0xffff0000u
#define LANDING_REG_FRAME_SIZE_HEIGHT_SHIFT 16u
#define LANDING_REG_FRAME_SIZE_HEIGHT_RESET 0x2d0u
#define LANDING_REG_THRESHOLD_OFFSET 0x10u
#define LANDING_REG_THRESHOLD_FACTOR_MASK 0x000001ffu
#define LANDING_REG_THRESHOLD_FACTOR_SHIFT 0u
#define LANDING_REG_THRESHOLD_FACTOR_RESET 0x40u
#define LANDING_REG_THRESHOLD_FLAT_LIMIT_MASK 0x00ff0000u
#define LANDING_REG_THRESHOLD_FLAT_LIMIT_SHIFT 16u
#define LANDING_REG_THRESHOLD_FLAT_LIMIT_RESET 0x0u
#define LANDING_REG_MIN_AREA_OFFSET 0x14u
#define LANDING_REG_MIN_AREA_PIXELS_MASK 0xffffffffu
#define LANDING_REG_MIN_AREA_PIXELS_SHIFT 0u
#define LANDING_REG_MIN_AREA_PIXELS_RESET 0x1eu
#define LANDING_REG_RING_BASE_OFFSET 0x18u
#define LANDING_REG_RING_BASE_ADDRESS_MASK 0xffffffffu
#define LANDING_REG_RING_BASE_ADDRESS_SHIFT 0u
#define LANDING_REG_RING_BASE_ADDRESS_RESET 0x0u
#define LANDING_REG_RING_INFO_OFFSET 0x1cu
#define LANDING_REG_RING_INFO_BUFFERS_MASK 0x000000ffu
#define LANDING_REG_RING_INFO_BUFFERS_SHIFT 0u
#define LANDING_REG_RING_INFO_MAX_OBJECTS_MASK 0xffff0000u
#define LANDING_REG_RING_INFO_MAX_OBJECTS_SHIFT 16u
#define LANDING_REG_RING_HEAD_OFFSET 0x20u
#define LANDING_REG_RING_HEAD_INDEX_MASK 0x000000ffu
#define LANDING_REG_RING_HEAD_INDEX_SHIFT 0u
#define LANDING_REG_RING_HEAD_VALID_MASK 0x80000000u
#define LANDING_REG_RING_HEAD_VALID_SHIFT 31u
#define LANDING_REG_FRAME_NUMBER_OFFSET 0x24u
#define LANDING_REG_FRAME_NUMBER_NUMBER_MASK 0xffffffffu
#define LANDING_REG_FRAME_NUMBER_NUMBER_SHIFT 0u
#define LANDING_REG_IRQ_STATUS_OFFSET 0x28u
#define LANDING_REG_IRQ_STATUS_FRAME_DONE_MASK 0x00000001u
#define LANDING_REG_IRQ_STATUS_FRAME_DONE_SHIFT 0u
#define LANDING_REG_IRQ_STATUS_FRAME_DONE_RESET 0x0u
#define LANDING_REG_IRQ_STATUS_FRAME_MALFORMED_MASK 0x00000002u
#define LANDING_REG_IRQ_STATUS_FRAME_MALFORMED_SHIFT 1u
#define LANDING_REG_IRQ_STATUS_FRAME_MALFORMED_RESET 0x0u
#define LANDING_REG_IRQ_STATUS_FRAME_OVERFLOW_MASK 0x00000004u
#define LANDING_REG_IRQ_STATUS_FRAME_OVERFLOW_SHIFT 2u
#define LANDING_REG_IRQ_STATUS_FRAME_OVERFLOW_RESET 0x0u
#define LANDING_REG_IRQ_STATUS_AXI_ERROR_MASK 0x00000008u
#define LANDING_REG_IRQ_STATUS_AXI_ERROR_SHIFT 3u
#define LANDING_REG_IRQ_STATUS_AXI_ERROR_RESET 0x0u
#define LANDING_REG_IRQ_STATUS_LIDAR_FAULT_MASK 0x00000010u
#define LANDING_REG_IRQ_STATUS_LIDAR_FAULT_SHIFT 4u
#define LANDING_REG_IRQ_STATUS_LIDAR_FAULT_RESET 0x0u
#define LANDING_REG_IRQ_ENABLE_OFFSET 0x2cu
#define LANDING_REG_IRQ_ENABLE_FRAME_DONE_MASK 0x00000001u
#define LANDING_REG_IRQ_ENABLE_FRAME_DONE_SHIFT 0u
#define LANDING_REG_IRQ_ENABLE_FRAME_DONE_RESET 0x0u
#define LANDING_REG_IRQ_ENABLE_FRAME_MALFORMED_MASK 0x00000002u
#define LANDING_REG_IRQ_ENABLE_FRAME_MALFORMED_SHIFT 1u
#define LANDING_REG_IRQ_ENABLE_FRAME_MALFORMED_RESET 0x0u
#define LANDING_REG_IRQ_ENABLE_FRAME_OVERFLOW_MASK 0x00000004u
#define LANDING_REG_IRQ_ENABLE_FRAME_OVERFLOW_SHIFT 2u
#define LANDING_REG_IRQ_ENABLE_FRAME_OVERFLOW_RESET 0x0u
#define LANDING_REG_IRQ_ENABLE_AXI_ERROR_MASK 0x00000008u
#define LANDING_REG_IRQ_ENABLE_AXI_ERROR_SHIFT 3u
#define LANDING_REG_IRQ_ENABLE_AXI_ERROR_RESET 0x0u
#define LANDING_REG_IRQ_ENABLE_LIDAR_FAULT_MASK 0x00000010u
#define LANDING_REG_IRQ_ENABLE_LIDAR_FAULT_SHIFT 4u
#define LANDING_REG_IRQ_ENABLE_LIDAR_FAULT_RESET 0x0u
#define LANDING_REG_FRAMES_SEEN_OFFSET 0x30u
#define LANDING_REG_FRAMES_SEEN_COUNT_MASK 0xffffffffu
#define LANDING_REG_FRAMES_SEEN_COUNT_SHIFT 0u
#define LANDING_REG_FRAMES_MALFORMED_OFFSET 0x34u
#define LANDING_REG_FRAMES_MALFORMED_COUNT_MASK 0xffffffffu
#define LANDING_REG_FRAMES_MALFORMED_COUNT_SHIFT 0u
#define LANDING_REG_FRAMES_OVERFLOW_OFFSET 0x38u
#define LANDING_REG_FRAMES_OVERFLOW_COUNT_MASK 0xffffffffu
#define LANDING_REG_FRAMES_OVERFLOW_COUNT_SHIFT 0u
#define LANDING_REG_FRAMES_UNWRITTEN_OFFSET 0x3cu
#define LANDING_REG_FRAMES_UNWRITTEN_COUNT_MASK 0xffffffffu
#define LANDING_REG_FRAMES_UNWRITTEN_COUNT_SHIFT 0u
#define LANDING_REG_MEASURED_SIZE_OFFSET 0x40u
#define LANDING_REG_MEASURED_SIZE_WIDTH_MASK 0x0000ffffu
#define LANDING_REG_MEASURED_SIZE_WIDTH_SHIFT 0u
#define LANDING_REG_MEASURED_SIZE_HEIGHT_MASK 0xffff0000u
#define LANDING_REG_MEASURED_SIZE_HEIGHT_SHIFT 16u
#define LANDING_REG_LIDAR_CTRL_OFFSET 0x44u
#define LANDING_REG_LIDAR_CTRL_ENABLE_MASK 0x00000001u
#define LANDING_REG_LIDAR_CTRL_ENABLE_SHIFT 0u
#define LANDING_REG_LIDAR_CTRL_ENABLE_RESET 0x0u
#define LANDING_REG_LIDAR_DISTANCE_OFFSET 0x48u
#define LANDING_REG_LIDAR_DISTANCE_MM_MASK 0xffffffffu
#define LANDING_REG_LIDAR_DISTANCE_MM_SHIFT 0u
#define LANDING_REG_LIDAR_AGE_OFFSET 0x4cu
#define LANDING_REG_LIDAR_AGE_US_MASK 0xffffffffu
#define LANDING_REG_LIDAR_AGE_US_SHIFT 0u
#define LANDING_REG_LIDAR_STATUS_OFFSET 0x50u
#define LANDING_REG_LIDAR_STATUS_VALID_MASK 0x00000001u
#define LANDING_REG_LIDAR_STATUS_VALID_SHIFT 0u
#define LANDING_REG_LIDAR_STATUS_TIMEOUT_MASK 0x00000002u
#define LANDING_REG_LIDAR_STATUS_TIMEOUT_SHIFT 1u
#define LANDING_REG_LIDAR_STATUS_TOO_LONG_MASK 0x00000004u
#define LANDING_REG_LIDAR_STATUS_TOO_LONG_SHIFT 2u
#define LANDING_REG_LIDAR_STATUS_TOO_SHORT_MASK 0x00000008u
#define LANDING_REG_LIDAR_STATUS_TOO_SHORT_SHIFT 3u
#define LANDING_REG_TIME_LO_OFFSET 0x54u
#define LANDING_REG_TIME_LO_US_MASK 0xffffffffu
#define LANDING_REG_TIME_LO_US_SHIFT 0u
#define LANDING_REG_TIME_HI_OFFSET 0x58u
#define LANDING_REG_TIME_HI_US_MASK 0xffffffffu
#define LANDING_REG_TIME_HI_US_SHIFT 0u
#define LANDING_REG_SCRATCH_OFFSET 0x5cu
#define LANDING_REG_SCRATCH_VALUE_MASK 0xffffffffu
#define LANDING_REG_SCRATCH_VALUE_SHIFT 0u
#define LANDING_REG_SCRATCH_VALUE_RESET 0x0u
#define LANDING_REG_FEATURES_OFFSET 0x60u
#define LANDING_REG_FEATURES_DISPLAY_MASK 0x00000001u
#define LANDING_REG_FEATURES_DISPLAY_SHIFT 0u

// Result ring: buffers of LANDING_RING_STRIDE_BYTES, each begins with a struct landing_record.
#define LANDING_RING_BUFFERS 4u
#define LANDING_RING_STRIDE_BYTES 32768u
#define LANDING_RECORD_MAX_OBJECTS 256u
#define LANDING_HEADER_ID_VERSION_MASK 0x0000ffffu
#define LANDING_HEADER_ID_VERSION_SHIFT 0u
#define LANDING_HEADER_ID_VERSION_RESET 0x1u
#define LANDING_HEADER_ID_MAGIC_MASK 0xffff0000u
#define LANDING_HEADER_ID_MAGIC_SHIFT 16u
#define LANDING_HEADER_ID_MAGIC_RESET 0x5444u
#define LANDING_HEADER_FLAGS_THRESHOLDS_MISSING_MASK 0x00000001u
#define LANDING_HEADER_FLAGS_THRESHOLDS_MISSING_SHIFT 0u
#define LANDING_HEADER_FLAGS_THRESHOLDS_STALE_MASK 0x00000002u
#define LANDING_HEADER_FLAGS_THRESHOLDS_STALE_SHIFT 1u
#define LANDING_HEADER_FLAGS_OBJECTS_OVERFLOW_MASK 0x00000004u
#define LANDING_HEADER_FLAGS_OBJECTS_OVERFLOW_SHIFT 2u
#define LANDING_HEADER_FLAGS_ALTITUDE_VALID_MASK 0x00000008u
#define LANDING_HEADER_FLAGS_ALTITUDE_VALID_SHIFT 3u

struct landing_result_header {
    uint16_t id_version;
    uint16_t id_magic;
    uint32_t flags;
    uint64_t start_time_us;
    uint32_t scan_time_us;
    uint32_t altitude_mm;
    uint32_t altitude_age_us;
    uint32_t object_count;
    uint32_t objects_dropped;
    uint16_t frame_size_width;
    uint16_t frame_size_height;
    uint32_t threshold_factor;
    uint32_t min_area;
    uint32_t frames_malformed;
    uint32_t frames_overflow;
    uint32_t reserved;
    uint32_t frame_number;
};
_Static_assert(offsetof(struct landing_result_header, id_version) == 0, "layout of the result record");
_Static_assert(offsetof(struct landing_result_header, id_magic) == 2, "layout of the result record");
_Static_assert(offsetof(struct landing_result_header, flags) == 4, "layout of the result record");
_Static_assert(offsetof(struct landing_result_header, start_time_us) == 8, "layout of the result record");
_Static_assert(offsetof(struct landing_result_header, scan_time_us) == 16, "layout of the result record");
_Static_assert(offsetof(struct landing_result_header, altitude_mm) == 20, "layout of the result record");
_Static_assert(offsetof(struct landing_result_header, altitude_age_us) == 24, "layout of the result record");
_Static_assert(offsetof(struct landing_result_header, object_count) == 28, "layout of the result record");
_Static_assert(offsetof(struct landing_result_header, objects_dropped) == 32, "layout of the result record");
_Static_assert(offsetof(struct landing_result_header, frame_size_width) == 36, "layout of the result record");
_Static_assert(offsetof(struct landing_result_header, frame_size_height) == 38, "layout of the result record");
_Static_assert(offsetof(struct landing_result_header, threshold_factor) == 40, "layout of the result record");
_Static_assert(offsetof(struct landing_result_header, min_area) == 44, "layout of the result record");
_Static_assert(offsetof(struct landing_result_header, frames_malformed) == 48, "layout of the result record");
_Static_assert(offsetof(struct landing_result_header, frames_overflow) == 52, "layout of the result record");
_Static_assert(offsetof(struct landing_result_header, reserved) == 56, "layout of the result record");
_Static_assert(offsetof(struct landing_result_header, frame_number) == 60, "layout of the result record");
_Static_assert(sizeof(struct landing_result_header) == 64, "layout of the result record");

struct landing_object {
    uint32_t area;
    uint16_t box_min_x;
    uint16_t box_min_y;
    uint16_t box_max_x;
    uint16_t box_max_y;
    uint32_t reserved_0;
    uint64_t sum_x;
    uint64_t sum_y;
    uint64_t sum_xx;
    uint64_t sum_yy;
    uint64_t sum_xy;
    uint32_t reserved_1;
    uint32_t reserved_2;
};
_Static_assert(offsetof(struct landing_object, area) == 0, "layout of the result record");
_Static_assert(offsetof(struct landing_object, box_min_x) == 4, "layout of the result record");
_Static_assert(offsetof(struct landing_object, box_min_y) == 6, "layout of the result record");
_Static_assert(offsetof(struct landing_object, box_max_x) == 8, "layout of the result record");
_Static_assert(offsetof(struct landing_object, box_max_y) == 10, "layout of the result record");
_Static_assert(offsetof(struct landing_object, reserved_0) == 12, "layout of the result record");
_Static_assert(offsetof(struct landing_object, sum_x) == 16, "layout of the result record");
_Static_assert(offsetof(struct landing_object, sum_y) == 24, "layout of the result record");
_Static_assert(offsetof(struct landing_object, sum_xx) == 32, "layout of the result record");
_Static_assert(offsetof(struct landing_object, sum_yy) == 40, "layout of the result record");
_Static_assert(offsetof(struct landing_object, sum_xy) == 48, "layout of the result record");
_Static_assert(offsetof(struct landing_object, reserved_1) == 56, "layout of the result record");
_Static_assert(offsetof(struct landing_object, reserved_2) == 60, "layout of the result record");
_Static_assert(sizeof(struct landing_object) == 64, "layout of the result record");

struct landing_record {
    struct landing_result_header header;
    struct landing_object objects[LANDING_RECORD_MAX_OBJECTS];
};
_Static_assert(offsetof(struct landing_record, objects) == 64, "layout of the result record");
_Static_assert(sizeof(struct landing_record) == 16448, "layout of the result record");
_Static_assert(sizeof(struct landing_record) <= LANDING_RING_STRIDE_BYTES, "a record fits into a buffer");

#endif

// SPDX-License-Identifier: Apache-2.0
#include "records.h"

#include <math.h>
#include <string.h>

#include "camera.h"
#include "pad_view.h"

#define WIDTH_PX 1280U
#define HEIGHT_PX 720U
#define FRAME_US 16667U
#define PIXEL_VARIANCE (1.0 / 12.0)
#define BOX_SIGMAS 2.0 // half of the box of any shape of the pad, and some more
#define FEW 6U
#define AGAIN 0x80U

static const uint32_t usual_factors[] = {128U, 160U, 208U, 96U};

size_t records_size(const struct landing_record *record)
{
    const uint32_t count = record->header.object_count < LANDING_RECORD_MAX_OBJECTS ? record->header.object_count
                                                                                    : LANDING_RECORD_MAX_OBJECTS;

    return sizeof record->header + count * sizeof record->objects[0];
}

void records_clear(struct landing_record *record)
{
    memset(&record->header, 0, sizeof record->header);
    record->header.id_magic = LANDING_HEADER_ID_MAGIC_RESET;
    record->header.id_version = LANDING_HEADER_ID_VERSION_RESET;
    record->header.frame_size_width = WIDTH_PX;
    record->header.frame_size_height = HEIGHT_PX;
    record->header.threshold_factor = usual_factors[0];
}

static struct landing_object *append(struct landing_record *record)
{
    struct landing_object *object = &record->objects[record->header.object_count];

    record->header.object_count++;
    memset(object, 0, sizeof *object);
    return object;
}

static bool is_full(const struct landing_record *record)
{
    return record->header.object_count >= LANDING_RECORD_MAX_OBJECTS;
}

// Near the corner of the frame rounding may go below.
static uint64_t sum_of(double area, double mean)
{
    return (uint64_t)(area * fmax(mean, 0.0));
}

static uint16_t within(double value, double most)
{
    return (uint16_t)fmin(fmax(value, 0.0), most);
}

static double reach_px(double variance_px2)
{
    return BOX_SIGMAS * sqrt(variance_px2) + 1.0;
}

static void paint(struct landing_record *record, const struct shape *shape)
{
    struct landing_object *object = append(record);
    const double area = floor(shape->area_px);
    const double reach_x = reach_px(shape->cov_xx);
    const double reach_y = reach_px(shape->cov_yy);

    object->area = (uint32_t)area;
    object->box_min_x = within(shape->x_px - reach_x, WIDTH_PX - 1U);
    object->box_max_x = within(shape->x_px + reach_x, WIDTH_PX - 1U);
    object->box_min_y = within(shape->y_px - reach_y, HEIGHT_PX - 1U);
    object->box_max_y = within(shape->y_px + reach_y, HEIGHT_PX - 1U);
    object->sum_x = sum_of(area, shape->x_px);
    object->sum_y = sum_of(area, shape->y_px);
    object->sum_xx = sum_of(area, shape->x_px * shape->x_px + shape->cov_xx - PIXEL_VARIANCE);
    object->sum_yy = sum_of(area, shape->y_px * shape->y_px + shape->cov_yy - PIXEL_VARIANCE);
    object->sum_xy = sum_of(area, shape->x_px * shape->y_px + shape->cov_xy);
}

// Whether the image of a whole shape ends within the frame.
static bool is_inside(const struct shape *shape)
{
    const double reach_x = reach_px(shape->cov_xx);
    const double reach_y = reach_px(shape->cov_yy);

    return shape->x_px >= reach_x && shape->x_px <= WIDTH_PX - 1.0 - reach_x && shape->y_px >= reach_y &&
           shape->y_px <= HEIGHT_PX - 1.0 - reach_y;
}

// Less than a pixel of a shape, or more than all, is no object.
static bool is_seen(const struct pad_plane *plane, unsigned kind, bool cut, struct shape *shape)
{
    const bool seen = pad_plane_moments(plane, &camera_default, kind, cut, shape) > 0.0;

    return seen && shape->area_px >= 1.0 && shape->area_px <= (double)(WIDTH_PX * HEIGHT_PX) &&
           (cut || is_inside(shape));
}

void records_paint(struct landing_record *record, unsigned kinds, double x_px, double y_px, double height_m,
                   double yaw_rad, double tilt_x, double tilt_y)
{
    const struct pad_view view = {.value = {[PAD_X_PX] = camera_default.centre_x_px + x_px,
                                            [PAD_Y_PX] = camera_default.centre_y_px + y_px,
                                            [PAD_LOG_DISTANCE_MM] = log(1000.0 * height_m),
                                            [PAD_YAW_RAD] = yaw_rad,
                                            [PAD_TILT_X] = tilt_x,
                                            [PAD_TILT_Y] = tilt_y}};
    struct pad_plane plane;

    if (pad_plane_of(&view, &camera_default, &plane) != 0) {
        return;
    }
    for (unsigned kind = 1U; kind <= (unsigned)PAD_RING; kind *= 2U) {
        struct shape shape;

        if ((kinds & kind) != 0U && !is_full(record) &&
            (is_seen(&plane, kind, false, &shape) ||
             ((kinds & RECORDS_CUT) != 0U && is_seen(&plane, kind, true, &shape)))) {
            paint(record, &shape);
        }
    }
}

static double between(struct input *input, double least, double most)
{
    return least + (most - least) * input_share(input);
}

static void paint_pad(struct input *input, struct landing_record *record)
{
    const unsigned kinds = input_u8(input) ^ 0x0FU;
    const double x_px = between(input, -700.0, 700.0);
    const double y_px = between(input, -400.0, 400.0);
    const double height_m = between(input, 0.1, 4.0);
    const double yaw_rad = between(input, -3.2, 3.2);
    const double tilt_x = between(input, -0.8, 0.8);

    records_paint(record, kinds, x_px, y_px, height_m, yaw_rad, tilt_x, between(input, -0.8, 0.8));
}

// From the least to the most, and just beyond both.
static uint64_t sum_between(struct input *input, uint64_t least, uint64_t most)
{
    const uint8_t place = input_u8(input);

    if (place < 2U) {
        return least - place; // one too few
    }
    if (place >= 254U) {
        return most + (255U - place); // one too many
    }
    return place == 253U ? most : least + (most - least) / 251U * (place - 2U);
}

static void add_box(struct input *input, struct landing_record *record)
{
    const uint32_t width_px = record->header.frame_size_width;
    const uint32_t height_px = record->header.frame_size_height;
    struct landing_object *object = append(record);

    object->box_min_x = (uint16_t)(input_u16(input) % (width_px + 1U));
    object->box_min_y = (uint16_t)(input_u16(input) % (height_px + 1U));
    object->box_max_x = (uint16_t)(object->box_min_x + input_u8(input));
    object->box_max_y = (uint16_t)(object->box_min_y + input_u8(input));
    const uint64_t x_min = object->box_min_x;
    const uint64_t x_max = object->box_max_x;
    const uint64_t y_min = object->box_min_y;
    const uint64_t y_max = object->box_max_y;
    const uint64_t area = sum_between(input, 1U, (x_max - x_min + 1U) * (y_max - y_min + 1U));
    object->area = (uint32_t)area;
    object->sum_x = sum_between(input, area * x_min, area * x_max);
    object->sum_y = sum_between(input, area * y_min, area * y_max);
    object->sum_xx = sum_between(input, area * x_min * x_min, area * x_max * x_max);
    object->sum_yy = sum_between(input, area * y_min * y_min, area * y_max * y_max);
    object->sum_xy = sum_between(input, area * x_min * y_min, area * x_max * y_max);
}

static void add_raw(struct input *input, struct landing_record *record)
{
    (void)input_take(input, append(record), sizeof record->objects[0]);
}

// The last object again and again, each beside the one before: a crowd from few bytes of input.
static void add_row(struct input *input, struct landing_record *record)
{
    const uint32_t count = input_u8(input);
    const uint16_t step_px = input_u8(input);

    for (uint32_t i = 0; i < count && !is_full(record) && record->header.object_count != 0U; i++) {
        const struct landing_object last = record->objects[record->header.object_count - 1U];
        struct landing_object *object = append(record);
        const uint64_t area = last.area;

        *object = last;
        object->box_min_x = (uint16_t)(last.box_min_x + step_px);
        object->box_max_x = (uint16_t)(last.box_max_x + step_px);
        object->sum_x += area * step_px;
        object->sum_xx += 2U * step_px * last.sum_x + area * step_px * step_px;
        object->sum_xy += step_px * last.sum_y;
    }
}

static void add_objects(struct input *input, struct landing_record *record)
{
    const uint8_t how_many = input_u8(input);
    // Most records have a few objects, or a run would be slow; a row makes many of one.
    const uint32_t count = how_many < 240U ? how_many % FEW : how_many % 64U;

    for (uint32_t i = 0; i < count && !is_full(record); i++) {
        const uint8_t what = input_u8(input);

        if (what < 100U) {
            paint_pad(input, record);
        } else if (what < 200U) {
            add_box(input, record);
        } else if (what < 240U) {
            add_raw(input, record);
        } else {
            add_row(input, record);
        }
    }
}

static void damage(struct input *input, struct landing_record *record)
{
    const uint8_t hits = input_u8(input);
    // Few records are damaged, as most of those are refused at once.
    const uint32_t count = hits >= 200U ? hits % 4U : 0U;

    for (uint32_t i = 0; i < count; i++) {
        const size_t place = input_u16(input) % records_size(record);

        ((uint8_t *)record)[place] ^= input_u8(input);
    }
}

static void number(struct input *input, struct landing_record *record, uint32_t before, uint64_t before_us)
{
    const uint8_t step = input_u8(input);

    record->header.frame_number = step < 240U ? before + 1U + step % 3U : input_u32(input);
    record->header.start_time_us = step < 200U   ? before_us + FRAME_US
                                   : step < 240U ? before_us + (uint64_t)input_u8(input) * 1000U
                                                 : input_u64(input);
}

void records_next(struct input *input, struct landing_record *record)
{
    const uint32_t before = record->header.frame_number;
    const uint64_t before_us = record->header.start_time_us;
    const uint8_t like = input_u8(input);

    if ((like & AGAIN) == 0U) {
        records_clear(record);
        record->header.flags = like & 0x0FU;
        record->header.min_area = input_u8(input);
        record->header.altitude_mm = input_u16(input);
        record->header.altitude_age_us = 1000U * input_u8(input) / 3U;
        record->header.threshold_factor = usual_factors[like >> 4U & 3U];
        record->header.objects_dropped = input_u8(input) / 200U;
        if ((like & 0x40U) != 0U) {
            record->header.frame_size_width = input_u16(input);
            record->header.frame_size_height = input_u16(input);
        }
        add_objects(input, record);
        damage(input, record);
    }
    number(input, record, before, before_us);
}

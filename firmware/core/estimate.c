// SPDX-License-Identifier: Apache-2.0
#include "estimate.h"

#include <math.h>
#include <stddef.h>

#include "doubt.h"
#include "pad_geometry.h"

#define DEGREES_PER_RADIAN 57.29577951308232
#define METRES_PER_MM 0.001
#define BASELINE (RECTANGLE_CENTRE_Y_MM - SQUARE_CENTRE_Y_MM)
#define CENTRE_FRACTION (RECTANGLE_CENTRE_Y_MM / BASELINE)

// How well each way of telling the centre knows it.
#define SMALL_RING_SIGMA_PX 0.04
#define SMALL_RING_PRECISE_AREA_PX 150.0 // below it the hole closes
#define LINE_SIGMA_PX 0.03
#define LINE_SIGMA_RING 0.001 // of the ring's diameter

// What was seen of a shape less what the view expects of it, at its centroid.
static struct vector left_over(const struct detect_context *context, const struct pad_plane *plane,
                               const struct reading *reading, unsigned kind)
{
    const struct sighting *sighting = reading_of(reading, kind);
    const struct vector nothing = {.x = 0.0};
    struct shape expected;

    const enum pad_sampling sampling = sighting->clipped ? PAD_CLIPPED : PAD_WHOLE;

    context->work->done += pad_plane_work(kind, sampling);
    if (!(pad_plane_moments(plane, context->camera, kind, sampling, &expected) > 0.0)) {
        return nothing;
    }
    return shape_offset(&expected, &sighting->seen);
}

// The view explains all shapes together; near the centre the shapes that are
// there know better, as paper is curled and shutters roll. What they leave over
// moves the centre, each by its weight.
static void centre_of(const struct detect_context *context, const struct pad_plane *plane,
                      const struct reading *reading, struct pad_estimate *pad)
{
    double weight = 0.0;
    double x = 0.0;
    double y = 0.0;

    if (reading_has(reading, PAD_SMALL_RING) && !reading_of(reading, PAD_SMALL_RING)->clipped) {
        const double area = reading_of(reading, PAD_SMALL_RING)->seen.area_px;
        const double blur = SMALL_RING_PRECISE_AREA_PX / area;
        const double sigma = SMALL_RING_SIGMA_PX + blur * blur;
        const struct vector left = left_over(context, plane, reading, PAD_SMALL_RING);
        weight += 1.0 / (sigma * sigma);
        x += left.x / (sigma * sigma);
        y += left.y / (sigma * sigma);
    }
    if (reading_has_whole_pair(reading)) {
        const struct vector square = left_over(context, plane, reading, PAD_SQUARE);
        const struct vector rectangle = left_over(context, plane, reading, PAD_RECTANGLE);
        const struct shape *seen = &reading_of(reading, PAD_RECTANGLE)->seen;
        const double ring_px = 2.0 * RING_OUTER_RADIUS_MM * sqrt(seen->area_px / pad_area_mm2(PAD_RECTANGLE));
        const double sigma = LINE_SIGMA_PX + LINE_SIGMA_RING * ring_px;
        weight += 1.0 / (sigma * sigma);
        x += (CENTRE_FRACTION * square.x + (1.0 - CENTRE_FRACTION) * rectangle.x) / (sigma * sigma);
        y += (CENTRE_FRACTION * square.y + (1.0 - CENTRE_FRACTION) * rectangle.y) / (sigma * sigma);
    }
    pad->x_px = pad->view.value[PAD_X_PX] + (weight > 0.0 ? x / weight : 0.0);
    pad->y_px = pad->view.value[PAD_Y_PX] + (weight > 0.0 ? y / weight : 0.0);
}

// From the rectangle's centre to the square's. What is seen are centroids of
// their images, which perspective moves apart; what they leave over is right.
static struct vector direction_up(const struct detect_context *context, const struct pad_plane *plane,
                                  const struct reading *reading)
{
    struct vector square;
    struct vector rectangle;

    pad_plane_project(plane, context->camera, SQUARE_CENTRE_X_MM, SQUARE_CENTRE_Y_MM, &square.x, &square.y);
    pad_plane_project(plane, context->camera, RECTANGLE_CENTRE_X_MM, RECTANGLE_CENTRE_Y_MM, &rectangle.x,
                      &rectangle.y);
    struct vector up = {.x = square.x - rectangle.x, .y = square.y - rectangle.y};
    if (reading_has_whole_pair(reading)) {
        const struct vector square_left = left_over(context, plane, reading, PAD_SQUARE);
        const struct vector rectangle_left = left_over(context, plane, reading, PAD_RECTANGLE);
        up.x += square_left.x - rectangle_left.x;
        up.y += square_left.y - rectangle_left.y;
    }
    return up;
}

int estimate_of(const struct detect_context *context, const struct reading *reading, struct pad_estimate *pad)
{
    struct pad_plane plane;

    if (pad_plane_of(&pad->view, context->camera, &plane) != 0) {
        return DETECT_E_NO_PAD;
    }
    if ((context->options & DETECT_PERSPECTIVE) != 0U) {
        centre_of(context, &plane, reading, pad);
    } else if (reading_has(reading, PAD_SQUARE | PAD_RECTANGLE)) {
        const struct shape *square = &reading_of(reading, PAD_SQUARE)->seen;
        const struct shape *rectangle = &reading_of(reading, PAD_RECTANGLE)->seen;
        pad->x_px = rectangle->x_px + CENTRE_FRACTION * (square->x_px - rectangle->x_px);
        pad->y_px = rectangle->y_px + CENTRE_FRACTION * (square->y_px - rectangle->y_px);
    }
    const struct vector up = direction_up(context, &plane, reading);
    // Turned by 90 degrees: up in the image becomes 0.
    pad->angle_deg = atan2(up.x, -up.y) * DEGREES_PER_RADIAN;
    struct camera_ray ray;
    if (camera_unproject(context->camera, pad->x_px, pad->y_px, &ray) != 0) {
        return DETECT_E_NO_PAD;
    }
    pad->depth_m = plane.centre[2] * METRES_PER_MM;
    pad->right_m = ray.right * pad->depth_m;
    pad->forward_m = ray.forward * pad->depth_m;
    pad->height_m = pad_plane_height_m(&plane);
    pad->ring_share = reading->ring_share;
    pad->kinds = reading->kinds | (reading->ring_share >= RING_SHARE_MIN ? (unsigned)PAD_RING : 0U);
    return 0;
}

// SPDX-License-Identifier: Apache-2.0
#include "picture.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

#include "pad_geometry.h"
#include "text.h"

#define OUTLINE_POINTS 16
#define MM_PER_M 1000.0
#define TEXT_MM_MAX 999999.0
// Further out than a 14-bit place can say; the difference of two of them still fits into 32 bits.
#define FAR_PX 1e6

// Half the sides of a shape, or its radius twice, and where its middle is on the pad.
struct outline {
    unsigned kind;
    bool round;
    double x_mm;
    double y_mm;
    double half_width_mm;
    double half_height_mm;
};

static const struct outline outlines[PICTURE_SHAPES] = {
    [PICTURE_RING] = {PAD_RING, true, 0.0, 0.0, RING_OUTER_RADIUS_MM, RING_OUTER_RADIUS_MM},
    [PICTURE_SQUARE] = {PAD_SQUARE, false, SQUARE_CENTRE_X_MM, SQUARE_CENTRE_Y_MM, SQUARE_SIDE_MM / 2.0,
                        SQUARE_SIDE_MM / 2.0},
    [PICTURE_RECTANGLE] = {PAD_RECTANGLE, false, RECTANGLE_CENTRE_X_MM, RECTANGLE_CENTRE_Y_MM,
                           RECTANGLE_WIDTH_MM / 2.0, RECTANGLE_HEIGHT_MM / 2.0},
    [PICTURE_SMALL_RING] = {PAD_SMALL_RING, true, 0.0, 0.0, SMALL_RING_OUTER_RADIUS_MM, SMALL_RING_OUTER_RADIUS_MM},
};

static int32_t place_of(double px)
{
    if (!(px > (double)PICTURE_PLACE_MIN_PX)) {
        return PICTURE_PLACE_MIN_PX;
    }
    return px < (double)PICTURE_PLACE_MAX_PX ? (int32_t)px : PICTURE_PLACE_MAX_PX;
}

static struct picture_box box_of(const struct pad_plane *plane, const struct camera *camera,
                                 const struct outline *outline)
{
    double left = FAR_PX;
    double top = FAR_PX;
    double right = -FAR_PX;
    double bottom = -FAR_PX;

    for (int i = 0; i < OUTLINE_POINTS; i++) {
        const double turn_rad = 2.0 * 3.14159265358979 * (double)i / (double)OUTLINE_POINTS;
        double x = sin(turn_rad);
        double y = cos(turn_rad);
        if (!outline->round) {
            // Four corners, four times.
            x = x < 0.0 ? -1.0 : 1.0;
            y = y < 0.0 ? -1.0 : 1.0;
        }
        double x_px;
        double y_px;
        pad_plane_project(plane, camera, outline->x_mm + x * outline->half_width_mm,
                          outline->y_mm + y * outline->half_height_mm, &x_px, &y_px);
        left = fmin(left, x_px);
        right = fmax(right, x_px);
        top = fmin(top, y_px);
        bottom = fmax(bottom, y_px);
    }
    return (struct picture_box){
        .shown = true,
        .from = {place_of(floor(left)), place_of(floor(top))},
        .to = {place_of(ceil(right)), place_of(ceil(bottom))},
    };
}

static void append_mm(struct text *text, const char *name, double metres, const char *plus)
{
    const double mm = fmin(fmax(round(metres * MM_PER_M), -TEXT_MM_MAX), TEXT_MM_MAX);

    text_append(text, name);
    text_append(text, mm < 0.0 ? "-" : plus);
    text_append_number(text, (uint32_t)fabs(mm));
}

static void write_line(char line[PICTURE_COLUMNS], const struct text *text)
{
    (void)memset(line, ' ', PICTURE_COLUMNS);
    (void)memcpy(line, text->chars, text->length);
}

static void write_text(struct picture *picture, const struct pad_estimate *pad, const struct altitude *altitude,
                       const char *phase)
{
    struct text words = {.length = 0U};
    struct text numbers = {.length = 0U};

    _Static_assert(sizeof words.chars <= PICTURE_COLUMNS, "a text fits into a line");
    text_append(&words, phase);
    write_line(picture->text[0], &words);
    if (pad != NULL) {
        append_mm(&numbers, "RIGHT ", pad->right_m * altitude->pad_scale, "+");
        append_mm(&numbers, " AHEAD ", pad->forward_m * altitude->pad_scale, "+");
    } else {
        text_append(&numbers, "NO PAD");
    }
    if (altitude->height_m > 0.0) {
        append_mm(&numbers, " ALTITUDE ", altitude->height_m, "");
    }
    if (pad != NULL || altitude->height_m > 0.0) {
        text_append(&numbers, " MM");
    }
    write_line(picture->text[1], &numbers);
}

void picture_of(struct picture *picture, const struct camera *camera, const struct pad_estimate *pad,
                const struct altitude *altitude, const char *phase)
{
    struct pad_plane plane;

    (void)memset(picture, 0, sizeof *picture);
    write_text(picture, pad, altitude, phase);
    if (pad == NULL || pad_plane_of(&pad->view, camera, &plane) != 0) {
        return;
    }
    for (int i = 0; i < PICTURE_SHAPES; i++) {
        if ((pad->kinds & outlines[i].kind) != 0U) {
            picture->boxes[i] = box_of(&plane, camera, &outlines[i]);
        }
    }
    double x_px;
    double y_px;
    pad_plane_project(&plane, camera, SQUARE_CENTRE_X_MM, SQUARE_CENTRE_Y_MM, &x_px, &y_px);
    picture->has_pad = true;
    picture->centre = (struct picture_place){place_of(round(pad->x_px)), place_of(round(pad->y_px))};
    picture->tip = (struct picture_place){place_of(round(x_px)), place_of(round(y_px))};
}

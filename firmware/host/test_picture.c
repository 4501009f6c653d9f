// SPDX-License-Identifier: Apache-2.0
// What the monitor shows, against the boxes of painted shapes.
#include <math.h>
#include <string.h>

#include "picture.h"
#include "test.h"
#include "test_scene.h"

static const struct {
    unsigned kind;
    scene_shape shape;
} shapes[PICTURE_SHAPES] = {
    [PICTURE_RING] = {PAD_RING, scene_ring},
    [PICTURE_SQUARE] = {PAD_SQUARE, scene_square},
    [PICTURE_RECTANGLE] = {PAD_RECTANGLE, scene_rectangle},
    [PICTURE_SMALL_RING] = {PAD_SMALL_RING, scene_small_ring},
};

static const struct altitude high = {.height_m = 1.2344, .pad_scale = 0.5};

static struct pad_estimate pad_of(const struct scene *scene, unsigned kinds)
{
    struct pad_estimate pad = {.view = scene_view(scene), .kinds = kinds, .right_m = -0.02, .forward_m = 0.0309};

    scene_project_centre(scene, &pad.x_px, &pad.y_px);
    return pad;
}

static bool line_is(const struct picture *picture, unsigned line, const char *expected)
{
    char filled[PICTURE_COLUMNS];

    (void)memset(filled, ' ', sizeof filled);
    (void)memcpy(filled, expected, strlen(expected));
    return memcmp(filled, picture->text[line], sizeof filled) == 0;
}

static void test_boxes(void)
{
    static const struct scene scenes[] = {
        {.height_m = 1.0, .right_m = 0.05, .forward_m = -0.1, .heading_deg = 35.0},
        {.height_m = 1.5, .right_m = 0.3, .forward_m = 0.1, .heading_deg = -140.0, .roll_deg = 12.0, .pitch_deg = -15.0},
    };
    static struct landing_record record;
    struct picture picture;

    for (unsigned i = 0; i < sizeof scenes / sizeof scenes[0]; i++) {
        const struct pad_estimate pad = pad_of(&scenes[i], PAD_INNER | PAD_RING);
        picture_of(&picture, &camera_default, &pad, &high, "LAND");
        CHECK(picture.has_pad);
        NEAR(picture.centre.x_px, pad.x_px, 0.5);
        NEAR(picture.centre.y_px, pad.y_px, 0.5);
        for (unsigned shape = 0; shape < PICTURE_SHAPES; shape++) {
            test_case("scene %u, shape %u", i, shape);
            scene_clear(&record);
            scene_paint(&record, &scenes[i], shapes[shape].shape);
            const struct landing_object *object = &record.objects[0];
            const struct picture_box *box = &picture.boxes[shape];
            CHECK(record.header.object_count == 1U);
            CHECK(box->shown);
            // A circle's outermost pixel may lie between two of the points, and the painter leaves corners out.
            NEAR(box->from.x_px, object->box_min_x, 3.5);
            NEAR(box->from.y_px, object->box_min_y, 3.5);
            NEAR(box->to.x_px, object->box_max_x, 3.5);
            NEAR(box->to.y_px, object->box_max_y, 3.5);
            if (shapes[shape].kind == PAD_SQUARE) {
                NEAR(picture.tip.x_px, 0.5 * (object->box_min_x + object->box_max_x), 2.0);
                NEAR(picture.tip.y_px, 0.5 * (object->box_min_y + object->box_max_y), 2.0);
            }
        }
    }
}

static void test_what_was_not_seen(void)
{
    const struct scene scene = {.height_m = 1.0};
    struct pad_estimate pad = pad_of(&scene, PAD_SQUARE | PAD_RING);
    struct picture picture;

    test_case("only shapes that were seen have a box");
    picture_of(&picture, &camera_default, &pad, &high, "");
    CHECK(picture.boxes[PICTURE_RING].shown && picture.boxes[PICTURE_SQUARE].shown);
    CHECK(!picture.boxes[PICTURE_RECTANGLE].shown && !picture.boxes[PICTURE_SMALL_RING].shown);

    test_case("no pad, no box");
    picture_of(&picture, &camera_default, NULL, &high, "SEARCH");
    CHECK(!picture.has_pad && !picture.boxes[PICTURE_RING].shown);

    test_case("a view of nothing");
    pad.view.value[PAD_X_PX] = (double)NAN;
    picture_of(&picture, &camera_default, &pad, &high, "SEARCH");
    CHECK(!picture.has_pad && !picture.boxes[PICTURE_RING].shown);

    test_case("places have 14 bits, whatever is said");
    pad = pad_of(&scene, PAD_SQUARE);
    pad.x_px = 1e12;
    pad.y_px = (double)NAN;
    picture_of(&picture, &camera_default, &pad, &high, "SEARCH");
    CHECK(picture.centre.x_px == PICTURE_PLACE_MAX_PX && picture.centre.y_px == PICTURE_PLACE_MIN_PX);
}

static void test_words(void)
{
    const struct scene scene = {.height_m = 1.0};
    struct pad_estimate pad = pad_of(&scene, PAD_RING);
    const struct altitude none = {.height_m = 0.0, .pad_scale = 1.0};
    struct picture picture;

    test_case("phase, place and altitude");
    picture_of(&picture, &camera_default, &pad, &high, "DESCEND");
    CHECK(line_is(&picture, 0U, "DESCEND"));
    CHECK(line_is(&picture, 1U, "RIGHT -10 AHEAD +15 ALTITUDE 1234 MM"));
    picture_of(&picture, &camera_default, &pad, &none, "DESCEND");
    CHECK(line_is(&picture, 1U, "RIGHT -20 AHEAD +31 MM"));
    picture_of(&picture, &camera_default, NULL, &high, "SEARCH");
    CHECK(line_is(&picture, 1U, "NO PAD ALTITUDE 1234 MM"));
    picture_of(&picture, &camera_default, NULL, &none, "SEARCH");
    CHECK(line_is(&picture, 1U, "NO PAD"));

    test_case("numbers that no one could read");
    pad.right_m = (double)NAN;
    pad.forward_m = -1e30;
    picture_of(&picture, &camera_default, &pad, &none, "DESCEND");
    CHECK(line_is(&picture, 1U, "RIGHT -999999 AHEAD -999999 MM"));
}

void test_picture(void)
{
    test_boxes();
    test_what_was_not_seen();
    test_words();
}

// SPDX-License-Identifier: Apache-2.0
// What is not a pad, or not all of one, and records that make no sense.
#include <math.h>

#include "detect.h"
#include "pad_geometry.h"
#include "record.h"
#include "test.h"
#include "test_scene.h"

static struct landing_record record;
static struct detect_scratch scratch;
static struct pad_estimate pad;

static bool found(void)
{
    return scene_search(&record, &detect_no_hint, DETECT_ALL, &scratch, &pad);
}

static bool has(unsigned kinds)
{
    return (pad.kinds & kinds) == kinds;
}

static void paint_except(const struct scene *scene, scene_shape left_out)
{
    static const scene_shape shapes[] = {scene_rectangle, scene_small_ring, scene_square, scene_ring};

    scene_clear(&record);
    for (unsigned i = 0; i < sizeof shapes / sizeof shapes[0]; i++) {
        if (shapes[i] != left_out) {
            scene_paint(&record, scene, shapes[i]);
        }
    }
}

static void test_missing_shapes(void)
{
    const struct scene far = {.height_m = 1.0, .heading_deg = 20.0};
    const struct scene close = {.height_m = 0.3, .heading_deg = 200.0};

    test_case("no objects");
    scene_clear(&record);
    CHECK(!found());
    test_case("whole pad");
    paint_except(&far, NULL);
    CHECK(found() && has(PAD_INNER | PAD_RING));
    const double whole = pad.doubt;
    CHECK(whole < 0.3);
    test_case("without the small ring");
    paint_except(&far, scene_small_ring);
    CHECK(found() && has(PAD_SQUARE | PAD_RECTANGLE | PAD_RING) && !has(PAD_SMALL_RING));
    test_case("without the ring, close");
    paint_except(&close, scene_ring);
    CHECK(found() && has(PAD_INNER) && !has(PAD_RING));
    CHECK(pad.doubt > whole + 0.5);
    test_case("without square, far");
    paint_except(&far, scene_square);
    CHECK(!found());
    test_case("square and rectangle alone are not enough");
    scene_clear(&record);
    scene_paint(&record, &close, scene_square);
    scene_paint(&record, &close, scene_rectangle);
    CHECK(!found());
    test_case("nor the ring with one of them");
    scene_clear(&record);
    scene_paint(&record, &close, scene_ring);
    scene_paint(&record, &close, scene_rectangle);
    CHECK(!found());
}

static bool displaced_small_ring(double x_mm, double y_mm)
{
    return scene_small_ring(x_mm - 40.0, y_mm);
}

static bool displaced_ring(double x_mm, double y_mm)
{
    return scene_ring(x_mm - 30.0, y_mm);
}

static bool displaced_square(double x_mm, double y_mm)
{
    return scene_square(x_mm - 45.0, y_mm);
}

static bool long_rectangle(double x_mm, double y_mm)
{
    return fabs(x_mm) <= 90.0 && fabs(y_mm - RECTANGLE_CENTRE_Y_MM) <= 12.5;
}

static void paint_three(const struct scene *scene, scene_shape first, scene_shape second, scene_shape third)
{
    scene_clear(&record);
    scene_paint(&record, scene, first);
    scene_paint(&record, scene, second);
    scene_paint(&record, scene, third);
}

static void test_decoys(void)
{
    const struct scene close = {.height_m = 0.3, .heading_deg = 10.0};
    const struct scene far = {.height_m = 0.8, .heading_deg = 130.0};

    test_case("a small ring beside the line is no witness");
    paint_three(&close, scene_square, scene_rectangle, displaced_small_ring);
    CHECK(!found());
    test_case("nor is a ring around something else");
    paint_three(&close, scene_square, scene_rectangle, displaced_ring);
    CHECK(!found());
    test_case("a square in the wrong place within the ring");
    paint_three(&far, displaced_square, scene_rectangle, scene_ring);
    CHECK(!found());
    test_case("two squares within a ring");
    paint_three(&far, scene_square, displaced_square, scene_ring);
    CHECK(!found());
    test_case("a rectangle of the right area and the wrong sides");
    paint_three(&far, scene_square, long_rectangle, scene_ring);
    CHECK(!found());
    test_case("a ring alone");
    scene_clear(&record);
    scene_paint(&record, &far, scene_ring);
    CHECK(!found());
}

static bool blot(double x_mm, double y_mm)
{
    return fabs(x_mm - 55.0) <= 20.0 && fabs(y_mm + 10.0) <= 20.0;
}

static void test_clutter_within(void)
{
    const struct scene scene = {.height_m = 1.0};

    test_case("a dark thing inside the ring raises the doubt");
    paint_except(&scene, NULL);
    CHECK(found());
    const double clean = pad.doubt;
    scene_paint(&record, &scene, blot);
    CHECK(found());
    CHECK(pad.doubt > clean + 0.3);
}

static void test_two_pads(void)
{
    const struct scene whole = {.height_m = 1.2, .right_m = -0.5};
    const struct scene blotted = {.height_m = 1.2, .right_m = 0.5, .roll_deg = 14.0};

    test_case("two pads: the better one, whatever the order");
    for (int order = 0; order < 2; order++) {
        scene_clear(&record);
        scene_paint_pad(&record, order == 0 ? &whole : &blotted);
        scene_paint_pad(&record, order == 0 ? &blotted : &whole);
        scene_paint(&record, &blotted, blot);
        CHECK(found());
        CHECK(pad.x_px < 640.0);
    }
}

static bool all(int x, int y)
{
    (void)x;
    (void)y;
    return true;
}

// A full record of rectangles of all ratios: no pad, and no long search either.
static void test_clutter(void)
{
    test_case("clutter");
    scene_clear(&record);
    for (int i = 0; i < 256; i++) {
        const uint16_t width = (uint16_t)(6 + i % 7 * 3);
        const uint16_t height = (uint16_t)(6 + i % 5 * 4);
        scene_paint_pixels(&record, (uint16_t)(i % 32 * 40), (uint16_t)(i / 32 * 80), width, height, all);
    }
    CHECK(record.header.object_count == 256U);
    CHECK(!found());
}

static uint32_t random_state = 99U;

static uint32_t random_below(uint32_t limit)
{
    random_state = random_state * 1664525U + 1013904223U;
    return (random_state >> 8) % limit;
}

// Objects whose sums are anything that their boxes allow: record_check passes
// them, and no set of pixels has them.
static void make_up_object(struct landing_object *object)
{
    const uint32_t width = 1U + random_below(400U);
    const uint32_t height = 1U + random_below(400U);

    object->box_min_x = (uint16_t)random_below(1280U - width + 1U);
    object->box_min_y = (uint16_t)random_below(720U - height + 1U);
    object->box_max_x = (uint16_t)(object->box_min_x + width - 1U);
    object->box_max_y = (uint16_t)(object->box_min_y + height - 1U);
    object->area = 1U + random_below(width * height);
    const uint64_t area = object->area;
    const uint64_t x = object->box_min_x + random_below(width);
    const uint64_t y = object->box_min_y + random_below(height);
    const uint64_t other_x = object->box_min_x + random_below(width);
    const uint64_t other_y = object->box_min_y + random_below(height);
    object->sum_x = area * x;
    object->sum_y = area * y;
    object->sum_xx = area * x * other_x;
    object->sum_yy = area * y * other_y;
    object->sum_xy = area * x * other_y;
}

static void test_random_records(void)
{
    int seen = 0;

    test_case("random records");
    for (int round = 0; round < 200; round++) {
        scene_clear(&record);
        record.header.object_count = round % 10 == 0 ? 256U : 1U + random_below(64U);
        for (uint32_t i = 0; i < record.header.object_count; i++) {
            make_up_object(&record.objects[i]);
        }
        CHECK(record_check(&record, sizeof record) == 0);
        CHECK(!found());
        seen += scratch.count;
    }
    CHECK(seen > 1000); // or the objects were too odd to be looked at
}

// Sums that divide by zero or take the root of less: nothing of it comes out.
static void test_nan_makers(void)
{
    const struct scene scene = {.height_m = 0.5};

    test_case("objects at the same point");
    scene_clear(&record);
    for (uint32_t i = 0; i < 4U; i++) {
        scene_paint(&record, &scene, scene_small_ring);
    }
    for (uint32_t i = 0; i < 40U; i++) {
        scene_paint(&record, &scene, scene_rectangle);
        scene_paint(&record, &scene, scene_square);
    }
    scene_paint(&record, &scene, scene_ring);
    if (found()) {
        CHECK(isfinite(pad.x_px) && isfinite(pad.doubt) && isfinite(pad.height_m) && isfinite(pad.angle_deg));
    }
    test_case("all shapes in one place");
    scene_clear(&record);
    for (uint32_t i = 0; i < 6U; i++) {
        scene_paint_pixels(&record, 600, 300, (uint16_t)(20U + 5U * i), (uint16_t)(20U + 5U * i), all);
    }
    for (uint32_t i = 1; i < 6U; i++) {
        record.objects[i].sum_x = record.objects[0].sum_x * record.objects[i].area / record.objects[0].area;
        record.objects[i].sum_y = record.objects[0].sum_y * record.objects[i].area / record.objects[0].area;
    }
    CHECK(!found());
    test_case("a frame that is nothing but one object");
    scene_clear(&record);
    scene_paint_pixels(&record, 0, 0, 1280, 720, all);
    CHECK(!found());
    test_case("lines of one pixel");
    scene_clear(&record);
    for (uint16_t i = 0; i < 100U; i++) {
        scene_paint_pixels(&record, (uint16_t)(10U * i), 50, i % 2U == 0U ? 1U : 60U, i % 2U == 0U ? 60U : 1U, all);
    }
    CHECK(!found());
}

// A ring that is whole but of another size than the shapes inside it.
static void test_ring_of_another_size(void)
{
    for (int percent = 75; percent <= 135; percent += 5) {
        const struct scene inner = {.height_m = 2.0, .right_m = 0.3, .heading_deg = 40.0};
        const double scale = 100.0 / percent;
        const struct scene ring = {.height_m = scale * inner.height_m, .right_m = scale * inner.right_m};
        test_case("a ring of %d percent", percent);
        scene_clear(&record);
        scene_paint(&record, &inner, scene_rectangle);
        scene_paint(&record, &inner, scene_square);
        scene_paint(&record, &ring, scene_ring);
        if (percent <= 85 || percent >= 115) {
            CHECK(!found());
        } else if (percent == 100) {
            CHECK(found() && has(PAD_RING));
        }
    }
}

void test_detect_not(void)
{
    test_ring_of_another_size();
    test_missing_shapes();
    test_decoys();
    test_clutter_within();
    test_two_pads();
    test_clutter();
    test_random_records();
    test_nan_makers();
}

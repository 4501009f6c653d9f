// SPDX-License-Identifier: Apache-2.0
#include "classify.h"
#include "pad_geometry.h"
#include "test.h"
#include "test_scene.h"

static struct landing_record record;
static struct classify_scratch scratch;
static struct pad_shapes pad;

static bool found(void)
{
    return classify_pad(&record, &scratch, &pad) == 0;
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
    CHECK(found() && pad.has_ring && pad.has_small_ring);
    CHECK(pad.error < 0.01);
    test_case("without the small ring");
    paint_except(&far, scene_small_ring);
    CHECK(found() && pad.has_ring && !pad.has_small_ring);
    test_case("without the ring, close");
    paint_except(&close, scene_ring);
    CHECK(found() && !pad.has_ring && pad.has_small_ring);
    test_case("without square");
    paint_except(&far, scene_square);
    CHECK(!found());
    test_case("without rectangle");
    paint_except(&close, scene_rectangle);
    CHECK(!found());
    test_case("square and rectangle alone are not enough");
    scene_clear(&record);
    scene_paint(&record, &close, scene_square);
    scene_paint(&record, &close, scene_rectangle);
    CHECK(!found());
}

static bool displaced_small_ring(double x_mm, double y_mm)
{
    return scene_small_ring(x_mm - 40.0, y_mm);
}

static bool displaced_ring(double x_mm, double y_mm)
{
    return scene_ring(x_mm - 60.0, y_mm);
}

static bool filled_small_ring(double x_mm, double y_mm)
{
    return x_mm * x_mm + y_mm * y_mm <= SMALL_RING_OUTER_RADIUS_MM * SMALL_RING_OUTER_RADIUS_MM;
}

static void test_wrong_witness(void)
{
    const struct scene close = {.height_m = 0.3, .heading_deg = 10.0};

    test_case("a small ring beside the line is no witness");
    scene_clear(&record);
    scene_paint(&record, &close, scene_square);
    scene_paint(&record, &close, scene_rectangle);
    scene_paint(&record, &close, displaced_small_ring);
    CHECK(!found());
    test_case("nor is a blob in its place");
    scene_clear(&record);
    scene_paint(&record, &close, scene_square);
    scene_paint(&record, &close, scene_rectangle);
    scene_paint(&record, &close, filled_small_ring);
    CHECK(!found());
    test_case("nor is a ring around something else");
    scene_paint(&record, &close, displaced_ring);
    CHECK(!found());
}

static void test_two_pads(void)
{
    const struct scene whole = {.height_m = 1.2, .right_m = -0.5};
    const struct scene tilted = {.height_m = 1.2, .right_m = 0.5, .roll_deg = 14.0};

    test_case("two pads: the better one, whatever the order");
    for (int order = 0; order < 2; order++) {
        scene_clear(&record);
        scene_paint_pad(&record, order == 0 ? &whole : &tilted);
        scene_paint_pad(&record, order == 0 ? &tilted : &whole);
        CHECK(found());
        CHECK(pad.ring.x_px < 640.0);
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

void test_classify(void)
{
    test_missing_shapes();
    test_wrong_witness();
    test_two_pads();
    test_clutter();
}

// SPDX-License-Identifier: Apache-2.0
#include <math.h>

#include "shapes.h"
#include "test.h"
#include "test_scene.h"

static struct landing_record record;

static bool all(int x, int y)
{
    (void)x;
    (void)y;
    return true;
}

static double from_middle(int x, int y)
{
    return hypot(x - 150.0, y - 150.0);
}

static bool disc(int x, int y)
{
    return from_middle(x, y) <= 140.0;
}

static bool ring(int x, int y)
{
    return from_middle(x, y) <= 140.0 && from_middle(x, y) >= 112.0;
}

static bool tilted_rectangle(int x, int y)
{
    const double u = (x - 150.0) * 0.8 + (y - 150.0) * 0.6;
    const double v = (y - 150.0) * 0.8 - (x - 150.0) * 0.6;

    return fabs(u) <= 100.0 && fabs(v) <= 50.0;
}

static bool diagonal(int x, int y)
{
    return x == y;
}

static struct shape shape_of(uint16_t width, uint16_t height, bool (*inside)(int, int))
{
    struct shape shape = {0};

    scene_clear(&record);
    scene_paint_pixels(&record, 700, 300, width, height, inside);
    CHECK(shape_from_object(&record.objects[0], &shape) == 0);
    return shape;
}

static void test_invariants(void)
{
    struct shape shape;

    test_case("rectangles are exact, down to one pixel");
    for (uint16_t width = 1; width <= 64; width = (uint16_t)(width * 2)) {
        shape = shape_of(width, 5, all);
        NEAR(shape.invariant, SHAPE_INVARIANT_RECTANGLE, 1e-6);
        NEAR(shape.x_px, 700.0 + (width - 1) / 2.0, 1e-9);
        NEAR(shape.y_px, 302.0, 1e-9);
        NEAR(shape.cov_xx, width * width / 12.0, 1e-6);
        NEAR(shape.cov_xy, 0.0, 1e-6);
    }
    test_case("disc");
    shape = shape_of(301, 301, disc);
    NEAR(shape.invariant, 12.566, 0.01);
    test_case("ring of 0.8");
    shape = shape_of(301, 301, ring);
    NEAR(shape.invariant, SHAPE_INVARIANT_RING(0.8), 0.02);
    NEAR(shape.invariant, 2.76, 0.02);
    test_case("turned rectangle");
    shape = shape_of(301, 301, tilted_rectangle);
    NEAR(shape.invariant, 12.0, 0.02);
}

static void test_axes(void)
{
    const struct shape shape = shape_of(301, 301, tilted_rectangle);
    double long_px;
    double short_px;
    struct vector axis;

    test_case("axes of a turned rectangle");
    shape_axes(&shape, &long_px, &short_px, &axis);
    NEAR(long_px, 200.0 / sqrt(12.0), 0.3);
    NEAR(short_px, 100.0 / sqrt(12.0), 0.3);
    NEAR(fabs(axis.x), 0.8, 0.005);
    NEAR(axis.x * axis.y, 0.48, 0.005);

    test_case("the metric of the shape itself");
    const struct vector along = {.x = axis.x * long_px, .y = axis.y * long_px};
    const struct vector across = {.x = -axis.y * short_px, .y = axis.x * short_px};
    NEAR(shape_inner(&shape, along, along), 1.0, 1e-9);
    NEAR(shape_inner(&shape, across, across), 1.0, 1e-9);
    NEAR(shape_inner(&shape, along, across), 0.0, 1e-9);
    NEAR(shape_variance_along(&shape, &shape, along), 1.0, 1e-9);
}

static void test_degenerate(void)
{
    struct landing_object object = {0};
    struct shape shape;

    test_case("degenerate sums");
    CHECK(shape_from_object(&object, &shape) == SHAPE_E_DEGENERATE);
    object.area = 10U;
    object.sum_x = 1000U; // mean 100, but a mean square of less than 100^2
    object.sum_y = 1000U;
    object.sum_xx = 90000U;
    object.sum_yy = 100000U;
    object.sum_xy = 100000U;
    CHECK(shape_from_object(&object, &shape) == SHAPE_E_DEGENERATE);
    object.sum_xx = 100000U;
    object.sum_xy = 200000U; // correlation above one
    CHECK(shape_from_object(&object, &shape) == SHAPE_E_DEGENERATE);

    test_case("a diagonal line is thin but real");
    shape = shape_of(40, 40, diagonal);
    CHECK(isfinite(shape.invariant));
}

void test_shapes(void)
{
    test_invariants();
    test_axes();
    test_degenerate();
}

// SPDX-License-Identifier: Apache-2.0
// Each way of guessing comes near enough to the pad for the fit to take over.
#include <math.h>

#include "hypothesis.h"
#include "pad_geometry.h"
#include "test.h"
#include "test_scene.h"

static struct landing_record record;
static struct detect_scratch scratch;
static struct grid grid;
static struct hypotheses found;

// The candidates of the record, as the detection sorts them.
static void collect(void)
{
    struct pad_estimate pad;

    (void)detect_pad(&record, &camera_default, &detect_no_hint, DETECT_ALL, &scratch, &pad);
    found.count = 0;
}

static struct hypothesis_source source_of(double height_m, uint32_t options)
{
    grid_sort(&scratch, &camera_default, &grid);
    return (struct hypothesis_source){
        .grid = &grid, .camera = &camera_default, .height_m = height_m, .options = options};
}

static void from_pairs(double height_m, uint32_t options)
{
    const struct hypothesis_source source = source_of(height_m, options);
    struct work work = {.done = 0};

    found.count = 0;
    CHECK(hypotheses_from_pairs(&source, 0, &work, &found) == 0);
}

static void from_small_rings(void)
{
    const struct hypothesis_source source = source_of(0.0, DETECT_ALL);
    struct work work = {.done = 0};

    CHECK(hypotheses_from_small_rings(&source, 0, &work, &found) == 0);
}

static void from_rings(void)
{
    const struct hypothesis_source source = source_of(0.0, DETECT_ALL);
    struct work work = {.done = 0};

    CHECK(hypotheses_from_rings(&source, 0, &work, &found) == 0);
}

static bool is_near(const struct hypothesis *hypothesis, const struct scene *scene)
{
    const struct pad_view truth = scene_view(scene);
    const double *got = hypothesis->view.value;
    const double radius_px =
        RING_OUTER_RADIUS_MM / exp(truth.value[PAD_LOG_DISTANCE_MM]) * camera_default.focal_px;

    return hypot(got[PAD_X_PX] - truth.value[PAD_X_PX], got[PAD_Y_PX] - truth.value[PAD_Y_PX]) < 0.12 * radius_px &&
           fabs(got[PAD_LOG_DISTANCE_MM] - truth.value[PAD_LOG_DISTANCE_MM]) < 0.15 &&
           fabs(remainder(got[PAD_YAW_RAD] - truth.value[PAD_YAW_RAD], 2.0 * acos(-1.0))) < 0.25;
}

static bool any_near(const struct scene *scene)
{
    for (int i = 0; i < found.count; i++) {
        if (is_near(&found.list[i], scene)) {
            return true;
        }
    }
    return false;
}

static void check_sorted(void)
{
    CHECK(found.count <= HYPOTHESES);
    for (int i = 0; i < found.count; i++) {
        CHECK(isfinite(found.list[i].error));
        CHECK(i == 0 || found.list[i - 1].error <= found.list[i].error);
    }
}

static void test_pairs(void)
{
    for (int heading = 0; heading < 360; heading += 30) {
        const struct scene scene = {.height_m = 1.0,
                                    .right_m = 0.2,
                                    .forward_m = -0.1,
                                    .heading_deg = heading,
                                    .roll_deg = heading % 60 == 0 ? 12.0 : 0.0,
                                    .pitch_deg = heading % 90 == 0 ? -10.0 : 0.0};
        test_case("pair, heading %d", heading);
        scene_clear(&record);
        scene_paint_pad(&record, &scene);
        collect();
        from_pairs(0.0, DETECT_ALL);
        CHECK(found.count > 0 && is_near(&found.list[0], &scene));
        check_sorted();
    }
}

static bool piece_of_ring(double x_mm, double y_mm)
{
    return x_mm > fabs(y_mm) && scene_ring(x_mm, y_mm);
}

static bool opposite_piece(double x_mm, double y_mm)
{
    return piece_of_ring(-x_mm, y_mm);
}

static void test_witness_of_pairs(void)
{
    const struct scene scene = {.height_m = 1.0, .heading_deg = 40.0};

    test_case("a pair with nothing around it is none");
    scene_clear(&record);
    scene_paint(&record, &scene, scene_square);
    scene_paint(&record, &scene, scene_rectangle);
    collect();
    from_pairs(0.0, DETECT_ALL);
    CHECK(found.count == 0);
    test_case("pieces of a ring, if they are to count");
    scene_paint(&record, &scene, piece_of_ring);
    scene_paint(&record, &scene, opposite_piece);
    collect();
    from_pairs(0.0, DETECT_ALL);
    CHECK(any_near(&scene));
    from_pairs(0.0, DETECT_ALL & ~DETECT_RING_PIECES);
    CHECK(found.count == 0);
    test_case("or the small ring");
    scene_paint(&record, &scene, scene_small_ring);
    collect();
    from_pairs(0.0, DETECT_ALL & ~DETECT_RING_PIECES);
    CHECK(any_near(&scene));
}

static void test_far_pairs(void)
{
    const struct scene scene = {.height_m = 2.4, .heading_deg = 75.0};

    test_case("from afar the LiDAR is witness enough");
    scene_clear(&record);
    scene_paint(&record, &scene, scene_square);
    scene_paint(&record, &scene, scene_rectangle);
    collect();
    from_pairs(2.4, DETECT_ALL);
    CHECK(any_near(&scene));
    from_pairs(2.4, DETECT_ALL & ~DETECT_FAR);
    CHECK(found.count == 0);
    from_pairs(1.2, DETECT_ALL);
    CHECK(found.count == 0);
    from_pairs(0.0, DETECT_ALL);
    CHECK(found.count == 0);
}

static void test_height_orders_pairs(void)
{
    const struct scene scene = {.height_m = 1.0, .heading_deg = 20.0};

    test_case("a LiDAR that agrees costs nothing, one that contradicts 0.3 at most");
    scene_clear(&record);
    scene_paint_pad(&record, &scene);
    collect();
    from_pairs(0.0, DETECT_ALL);
    const double alone = found.list[0].error;
    from_pairs(1.0, DETECT_ALL);
    CHECK(is_near(&found.list[0], &scene));
    NEAR(found.list[0].error, alone, 0.05);
    from_pairs(1.2, DETECT_ALL);
    CHECK(found.list[0].error > alone + 0.02 && found.list[0].error < alone + 0.1);
    from_pairs(5.0, DETECT_ALL);
    CHECK(is_near(&found.list[0], &scene));
    NEAR(found.list[0].error, alone + 0.3, 1e-12);
}

static void test_only_the_best_stay(void)
{
    test_case("more pads than places in the list: the best stay");
    scene_clear(&record);
    for (int i = 0; i < HYPOTHESES + 3; i++) {
        const struct scene scene = {.height_m = 2.0,
                                    .right_m = 0.4 * (i % 5 - 2),
                                    .forward_m = i / 5 == 0 ? 0.3 : -0.3,
                                    .pitch_deg = 0.0,
                                    .heading_deg = 20.0 * i};
        scene_paint_pad(&record, &scene);
    }
    collect();
    from_pairs(0.0, DETECT_ALL);
    CHECK(found.count == HYPOTHESES);
    check_sorted();
}

// From so close that the border cuts the rectangle, or the square.
static void test_small_rings(void)
{
    for (int heading = 0; heading < 360; heading += 90) {
        const struct scene scene = {.height_m = 0.2, .right_m = 0.01, .heading_deg = heading};
        test_case("small ring, heading %d", heading);
        scene_clear(&record);
        scene_paint_pad(&record, &scene);
        collect();
        from_small_rings();
        CHECK(any_near(&scene));
        check_sorted();
    }
    const struct scene far = {.height_m = 1.5};
    test_case("a small ring of a few pixels says nothing");
    scene_clear(&record);
    scene_paint_pad(&record, &far);
    collect();
    from_small_rings();
    CHECK(found.count == 0);
}

static bool inner_as_one(double x_mm, double y_mm)
{
    return scene_square(x_mm, y_mm) || scene_rectangle(x_mm, y_mm) || scene_small_ring(x_mm, y_mm) ||
           (fabs(x_mm) < 4.0 && fabs(y_mm) < 50.0);
}

static void test_rings(void)
{
    for (int heading = 0; heading < 360; heading += 45) {
        const struct scene scene = {.height_m = 2.5, .right_m = 0.3, .heading_deg = heading};
        test_case("ring with all inner shapes run together, heading %d", heading);
        scene_clear(&record);
        scene_paint(&record, &scene, scene_ring);
        scene_paint(&record, &scene, inner_as_one);
        collect();
        from_rings();
        CHECK(found.count == 2); // either way up
        CHECK(is_near(&found.list[0], &scene));
        CHECK(found.count == 2 && found.list[0].fused && found.list[1].fused);
        check_sorted();
    }
    const struct scene scene = {.height_m = 2.5};
    test_case("an empty ring");
    scene_clear(&record);
    scene_paint(&record, &scene, scene_ring);
    collect();
    from_rings();
    CHECK(found.count == 0);
}

void test_hypothesis(void)
{
    test_pairs();
    test_witness_of_pairs();
    test_far_pairs();
    test_height_orders_pairs();
    test_only_the_best_stay();
    test_small_rings();
    test_rings();
}

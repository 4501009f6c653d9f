// SPDX-License-Identifier: Apache-2.0
// The whole way from painted pixels to the pad, against the geometry painted.
#include <math.h>

#include "detect.h"
#include "pad_geometry.h"
#include "test.h"
#include "test_scene.h"

#define RADIANS_PER_DEGREE 0.017453292519943295

static struct landing_record record;
static struct detect_scratch scratch;
static struct pad_estimate pad;

static bool find(uint32_t options)
{
    return scene_search(&record, &detect_no_hint, options, &scratch, &pad);
}

static bool find_pad(const struct scene *scene)
{
    scene_clear(&record);
    scene_paint_pad(&record, scene);
    return find(DETECT_ALL);
}

static double turn(double degrees)
{
    return remainder(degrees, 360.0);
}

static void check_centre(const struct scene *scene, double tolerance_px)
{
    double x_px;
    double y_px;

    scene_project_centre(scene, &x_px, &y_px);
    NEAR(pad.x_px, x_px, tolerance_px);
    NEAR(pad.y_px, y_px, tolerance_px);
}

static void check_level(const struct scene *scene)
{
    CHECK(find_pad(scene));
    check_centre(scene, 0.2);
    NEAR(pad.height_m, scene->height_m, 0.015 * scene->height_m);
    NEAR(pad.depth_m, scene->height_m, 0.01 * scene->height_m);
    NEAR(pad.right_m / pad.depth_m * scene->height_m, scene->right_m, 0.0005 * scene->height_m);
    NEAR(pad.forward_m / pad.depth_m * scene->height_m, scene->forward_m, 0.0005 * scene->height_m);
    CHECK(pad.doubt >= pad.misfit && pad.misfit >= 0.0 && pad.doubt < 0.3);
}

static void test_all_headings(void)
{
    for (int heading = 0; heading < 360; heading += 15) {
        const struct scene scene = {.height_m = 1.0, .heading_deg = heading};
        test_case("heading %d", heading);
        check_level(&scene);
        NEAR(turn(pad.angle_deg - heading), 0.0, 0.4);
        CHECK(pad.angle_deg > -180.0 && pad.angle_deg <= 180.0);
        CHECK(pad.kinds == (PAD_INNER | PAD_RING));
        NEAR(pad.ring_share, 1.0, 0.05);
    }
}

static void test_heights_and_places(void)
{
    static const double heights_m[] = {0.25, 0.4, 0.8, 1.3, 1.9, 2.6};
    static const double places[][2] = {{0.0, 0.0}, {0.35, 0.0}, {0.0, -0.2}, {-0.4, 0.15}};

    for (unsigned i = 0; i < sizeof heights_m / sizeof heights_m[0]; i++) {
        for (unsigned j = 0; j < sizeof places / sizeof places[0]; j++) {
            const struct scene scene = {
                .height_m = heights_m[i],
                .right_m = places[j][0] * heights_m[i],
                .forward_m = places[j][1] * heights_m[i],
                .heading_deg = 33.0,
            };
            test_case("height %.2f m, %.2f right, %.2f ahead", scene.height_m, scene.right_m, scene.forward_m);
            check_level(&scene);
        }
    }
}

static void test_tilt(void)
{
    static const double tilts[][2] = {{8.0, 0.0}, {0.0, -8.0}, {-12.0, 8.0}, {20.0, 0.0}, {0.0, 25.0}, {-20.0, -20.0}};

    for (unsigned i = 0; i < sizeof tilts / sizeof tilts[0]; i++) {
        for (int heading = 0; heading < 360; heading += 60) {
            const struct scene scene = {
                .height_m = i % 2U == 0U ? 1.0 : 0.5,
                .heading_deg = heading,
                .roll_deg = tilts[i][0],
                .pitch_deg = tilts[i][1],
            };
            test_case("roll %.0f, pitch %.0f, heading %d", scene.roll_deg, scene.pitch_deg, heading);
            CHECK(find_pad(&scene));
            check_centre(&scene, 0.2);
            const struct pad_view truth = scene_view(&scene);
            const double level = cos(scene.roll_deg * RADIANS_PER_DEGREE) * cos(scene.pitch_deg * RADIANS_PER_DEGREE);
            NEAR(pad.height_m, scene.height_m / level, 0.02 * scene.height_m); // along the axis, not the plumb line
            NEAR(pad.view.value[PAD_TILT_X], truth.value[PAD_TILT_X], 0.06);
            NEAR(pad.view.value[PAD_TILT_Y], truth.value[PAD_TILT_Y], 0.06);
        }
    }
}

// The plain line between the shapes is what perspective moves; the fitted view takes that out.
static void test_perspective(void)
{
    const struct scene scene = {.height_m = 0.35, .heading_deg = 10.0, .pitch_deg = 22.0};
    double x_px;
    double y_px;

    test_case("perspective");
    CHECK(find_pad(&scene));
    check_centre(&scene, 0.2);
    CHECK(find(DETECT_ALL & ~DETECT_PERSPECTIVE));
    scene_project_centre(&scene, &x_px, &y_px);
    CHECK(hypot(pad.x_px - x_px, pad.y_px - y_px) > 1.0);
    test_case("a hint of the tilt");
    const struct pad_view truth = scene_view(&scene);
    const struct detect_hint hint = {.tilt = {truth.value[PAD_TILT_X], truth.value[PAD_TILT_Y], 0.02}};
    CHECK(scene_search(&record, &hint, DETECT_ALL, &scratch, &pad));
    NEAR(pad.view.value[PAD_TILT_X], hint.tilt.x, 0.01);
    NEAR(pad.view.value[PAD_TILT_Y], hint.tilt.y, 0.01);
}

// So low or so far aside that the border cuts the ring, then the shapes.
static void test_cut_by_the_border(void)
{
    static const struct scene scenes[] = {
        {.height_m = 0.19, .heading_deg = 90.0},
        {.height_m = 0.17, .heading_deg = 0.0},
        {.height_m = 0.17, .heading_deg = 180.0},
        {.height_m = 0.6, .forward_m = 0.31, .heading_deg = 120.0},
        {.height_m = 0.8, .right_m = -0.94, .heading_deg = -90.0},
        {.height_m = 0.17, .forward_m = -0.08, .heading_deg = 0.0}, // all of the rectangle but a strip
    };

    for (unsigned i = 0; i < sizeof scenes / sizeof scenes[0]; i++) {
        test_case("cut by the border, scene %u", i);
        CHECK(find_pad(&scenes[i]));
        check_centre(&scenes[i], 0.6);
        NEAR(turn(pad.angle_deg - scenes[i].heading_deg), 0.0, 6.0);
        NEAR(pad.height_m, scenes[i].height_m, 0.05 * scenes[i].height_m);
    }
    test_case("without what looks from close by, a cut rectangle is nothing");
    CHECK(find_pad(&scenes[5]));
    CHECK((pad.kinds & PAD_SMALL_RING) != 0U);
    CHECK(!find(DETECT_ALL & ~DETECT_CLOSE));
}

static bool gap(double x_mm, double y_mm)
{
    return fabs(x_mm + y_mm) < 8.0 || fabs(x_mm - y_mm) < 8.0;
}

static bool right_piece(double x_mm, double y_mm)
{
    return scene_ring(x_mm, y_mm) && !gap(x_mm, y_mm) && x_mm > fabs(y_mm);
}

static bool left_piece(double x_mm, double y_mm)
{
    return right_piece(-x_mm, y_mm);
}

static bool lower_piece(double x_mm, double y_mm)
{
    return right_piece(y_mm, x_mm);
}

static bool upper_piece(double x_mm, double y_mm)
{
    return right_piece(-y_mm, x_mm);
}

// A speck between the ring and the edge of the paper.
static bool beside(double x_mm, double y_mm)
{
    return fabs(x_mm - 138.0) < 8.0 && fabs(y_mm) < 12.0;
}

static bool beside_centre(double x_mm, double y_mm)
{
    return fabs(x_mm - 60.0) < 10.0 && fabs(y_mm) < 15.0;
}

// Square, rectangle and half of the ring.
static void paint_half(const struct scene *scene)
{
    scene_clear(&record);
    scene_paint(&record, scene, upper_piece);
    scene_paint(&record, scene, left_piece);
    scene_paint(&record, scene, scene_square);
    scene_paint(&record, scene, scene_rectangle);
}

static void test_broken_ring(void)
{
    const struct scene scene = {.height_m = 1.1, .right_m = 0.2, .heading_deg = 50.0};

    test_case("broken ring");
    scene_clear(&record);
    scene_paint(&record, &scene, left_piece);
    scene_paint(&record, &scene, right_piece);
    scene_paint(&record, &scene, upper_piece);
    scene_paint(&record, &scene, lower_piece);
    scene_paint(&record, &scene, scene_square);
    scene_paint(&record, &scene, scene_rectangle);
    CHECK(find(DETECT_ALL));
    check_centre(&scene, 0.2);
    CHECK((pad.kinds & PAD_RING) != 0U);
    const double doubt = pad.doubt;
    CHECK(!find(DETECT_ALL & ~DETECT_RING_PIECES));
    test_case("with half of the ring, there is more doubt");
    paint_half(&scene);
    CHECK(find(DETECT_ALL));
    NEAR(pad.ring_share, 0.5, 0.1);
    CHECK(pad.doubt > doubt + 0.5);
    check_centre(&scene, 0.3);
}

// From afar the filters take the rings.
static void test_far(void)
{
    const struct scene scene = {.height_m = 2.4, .right_m = 0.3, .heading_deg = 75.0};
    struct detect_hint hint = detect_no_hint;

    test_case("square and rectangle from afar");
    scene_clear(&record);
    scene_paint(&record, &scene, scene_square);
    scene_paint(&record, &scene, scene_rectangle);
    CHECK(!find(DETECT_ALL));
    hint.height_m = 2.45;
    CHECK(!scene_search(&record, &hint, DETECT_ALL, &scratch, &pad)); // no attitude
    hint.tilt.sigma = 0.025;
    CHECK(scene_search(&record, &hint, DETECT_ALL, &scratch, &pad));
    check_centre(&scene, 0.2);
    CHECK(!scene_search(&record, &hint, DETECT_ALL & ~DETECT_FAR, &scratch, &pad));
    hint.height_m = 1.7; // another size of the same shapes
    CHECK(!scene_search(&record, &hint, DETECT_ALL, &scratch, &pad));
    test_case("a LiDAR that contradicts a whole pad raises the doubt");
    hint = detect_no_hint;
    scene_clear(&record);
    scene_paint_pad(&record, &scene);
    hint.height_m = 2.4;
    CHECK(scene_search(&record, &hint, DETECT_ALL, &scratch, &pad));
    const double doubt = pad.doubt;
    hint.height_m = 1.5;
    CHECK(scene_search(&record, &hint, DETECT_ALL, &scratch, &pad));
    CHECK(pad.doubt > doubt + 0.5);
}

static bool find_with(const struct detect_hint *hint)
{
    return scene_search(&record, hint, DETECT_ALL, &scratch, &pad);
}

// Other factors than the usual one show much that is no pad, and a full record holds the least of it.
static void test_clutter_needs_more(void)
{
    const struct scene far = {.height_m = 2.4, .right_m = 0.3, .heading_deg = 75.0};
    const struct scene near = {.height_m = 1.1, .right_m = 0.2, .heading_deg = 50.0};
    struct detect_hint hint = {.tilt = {.sigma = 0.025}, .height_m = 2.45};

    test_case("two specks are no pad while factors are tried");
    scene_clear(&record);
    scene_paint(&record, &far, scene_square);
    scene_paint(&record, &far, scene_rectangle);
    CHECK(find_with(&hint));
    hint.searching = true;
    CHECK(!find_with(&hint));
    test_case("half of a ring is nothing when the record is full");
    hint.height_m = 1.12 * near.height_m;
    hint.searching = false;
    paint_half(&near);
    CHECK(find_with(&hint));
    record.header.objects_dropped = 1U;
    CHECK(!find_with(&hint));
    test_case("three quarters of it are enough");
    scene_paint(&record, &near, right_piece);
    CHECK(find_with(&hint));
    CHECK(pad.doubt > 0.1 && pad.doubt < 0.8);
    test_case("what lies on the paper beside the ring does not belong");
    record.header.objects_dropped = 0U;
    const double doubt = pad.doubt;
    scene_paint(&record, &near, beside);
    CHECK(find_with(&hint));
    CHECK(pad.doubt > doubt + 0.1);
    test_case("a whole pad is found all the same");
    scene_clear(&record);
    scene_paint_pad(&record, &near);
    record.header.objects_dropped = 1U;
    CHECK(find_with(&hint));
    check_centre(&near, 0.2);
}

// Half of a ring, in as many specks as it has 15 degrees.
static double speck_deg;

static bool ring_speck(double x_mm, double y_mm)
{
    const double radius_mm = (RING_OUTER_RADIUS_MM + RING_INNER_RADIUS_MM) / 2.0;
    const double x = x_mm - radius_mm * cos(speck_deg * acos(-1.0) / 180.0);
    const double y = y_mm - radius_mm * sin(speck_deg * acos(-1.0) / 180.0);

    return hypot(x, y) < 12.5;
}

// Square and rectangle, and so many specks where the ring would be.
static void paint_specks(const struct scene *scene, int count)
{
    scene_clear(&record);
    scene_paint(&record, scene, scene_square);
    scene_paint(&record, scene, scene_rectangle);
    for (int speck = 0; speck < count; speck++) {
        speck_deg = 15.0 * speck;
        scene_paint(&record, scene, ring_speck);
    }
}

// What all else confirms may lack more of the ring.
static void test_confirmed(void)
{
    const struct scene scene = {.height_m = 1.1, .right_m = 0.2, .heading_deg = 50.0};
    struct detect_hint hint = {.tilt = {.sigma = 0.025}, .height_m = scene.height_m, .searching = true};

    test_case("half of a ring among clutter, with LiDAR and attitude");
    paint_half(&scene);
    record.header.objects_dropped = 1U;
    CHECK(find_with(&hint));
    check_centre(&scene, 0.3);
    CHECK(pad.doubt > 0.6 && pad.doubt <= 1.5);
    test_case("not with another height");
    hint.height_m = 0.88 * scene.height_m;
    CHECK(!find_with(&hint));
    hint.height_m = 1.12 * scene.height_m;
    CHECK(!find_with(&hint));
    test_case("nor without one, or without attitude");
    hint.height_m = 0.0;
    CHECK(!find_with(&hint));
    hint.height_m = scene.height_m;
    hint.tilt.sigma = detect_no_hint.tilt.sigma;
    CHECK(!find_with(&hint));
    hint.tilt.sigma = 0.025;
    test_case("nor with something inside that does not belong");
    scene_paint(&record, &scene, beside_centre);
    CHECK(!find_with(&hint));
    test_case("nor with specks in the ring's place");
    paint_specks(&scene, 18);
    hint.searching = false;
    CHECK(find_with(&hint));
    NEAR(pad.ring_share, 0.5, 0.15);
    hint.searching = true;
    record.header.objects_dropped = 1U;
    CHECK(!find_with(&hint));
}

// From afar, where the opening takes most of the ring, an arc of it is enough.
static void test_traces_of_the_ring(void)
{
    const struct scene scene = {.height_m = 2.4, .right_m = 0.3, .heading_deg = 75.0};
    struct detect_hint hint = {.tilt = {.sigma = 0.025}, .height_m = scene.height_m, .searching = true};

    test_case("an arc of a far ring");
    scene_clear(&record);
    scene_paint(&record, &scene, scene_square);
    scene_paint(&record, &scene, scene_rectangle);
    CHECK(!find_with(&hint));
    scene_paint(&record, &scene, right_piece);
    CHECK(find_with(&hint));
    CHECK(pad.ring_share > 0.12 && pad.ring_share < 0.3);
    check_centre(&scene, 0.3);
    hint.height_m = 1.15 * scene.height_m;
    CHECK(!find_with(&hint));
    hint.height_m = scene.height_m;
    hint.tilt.sigma = detect_no_hint.tilt.sigma;
    CHECK(!find_with(&hint));
    hint.tilt.sigma = 0.025;
    test_case("specks are no arc");
    paint_specks(&scene, 6);
    CHECK(!find_with(&hint));
}

// The frame's border touches the rectangle, or cuts into it.
static void test_pair_at_the_border(void)
{
    struct scene scene = {.height_m = 0.8, .right_m = 1.36, .heading_deg = -90.0};
    struct detect_hint hint = {.tilt = {.sigma = 0.025}, .height_m = scene.height_m};
    static const scene_shape pieces[] = {upper_piece, lower_piece, left_piece, right_piece};
    uint32_t touching = 0U;

    test_case("square and rectangle that touch the border");
    for (int i = 0; i < 40; i++) {
        scene.right_m = 1.2 + 0.01 * i;
        scene_clear(&record);
        scene_paint(&record, &scene, scene_rectangle);
        if (record.objects[0].box_max_x != 1279U) {
            continue;
        }
        scene_paint(&record, &scene, scene_square);
        scene_paint(&record, &scene, scene_ring);
        hint.searching = false;
        CHECK(find_with(&hint));
        check_centre(&scene, 2.0);
        hint.searching = true;
        CHECK(find_with(&hint));
        // A ring in pieces is less of a witness.
        record.header.object_count--;
        for (size_t piece = 0; piece < sizeof pieces / sizeof pieces[0]; piece++) {
            scene_paint(&record, &scene, pieces[piece]);
        }
        CHECK(!find_with(&hint));
        hint.searching = false;
        CHECK(find_with(&hint));
        touching++;
        break;
    }
    CHECK(touching == 1U);
}

// Far off the axis the ring is thin where it lies across the line of sight, and the opening takes it there.
static void test_thin_ring(void)
{
    const struct scene scene = {.height_m = 0.9, .right_m = 1.5, .heading_deg = 20.0};
    struct detect_hint hint = {.tilt = {.sigma = 0.025}, .height_m = scene.height_m};

    test_case("what is too thin to be seen is no doubt");
    paint_half(&scene);
    CHECK(find_with(&hint));
    check_centre(&scene, 0.5);
    const double doubt = pad.doubt;
    record.header.objects_dropped = 1U;
    CHECK(!find_with(&hint) || pad.doubt > doubt + 0.3);
}

// Without the ring, only a LiDAR tells a pad from smaller shapes nearer by.
static void test_no_ring_and_another_height(void)
{
    const struct scene scene = {.height_m = 0.5, .heading_deg = 140.0};
    struct detect_hint hint = {.tilt = {.sigma = 0.025}, .height_m = scene.height_m};

    test_case("no ring where one should be, and a LiDAR that contradicts");
    scene_clear(&record);
    scene_paint(&record, &scene, scene_square);
    scene_paint(&record, &scene, scene_rectangle);
    scene_paint(&record, &scene, scene_small_ring);
    CHECK(find_with(&hint));
    hint.height_m = 0.25;
    CHECK(!find_with(&hint));
    scene_paint(&record, &scene, scene_ring);
    CHECK(find_with(&hint));
}

// Where the pad was is where the fit starts, never what it ends with.
static void test_last_view(void)
{
    const struct scene before = {.height_m = 1.0, .right_m = 0.1, .heading_deg = 30.0};
    const struct scene now = {.height_m = 0.99, .right_m = 0.115, .forward_m = 0.01, .heading_deg = 31.5};
    const struct scene elsewhere = {.height_m = 1.6, .right_m = -0.3, .forward_m = 0.2, .heading_deg = 200.0};
    struct pad_view moved = scene_view(&before);
    const struct pad_view wrong = scene_view(&elsewhere);
    struct detect_hint hint = detect_no_hint;

    test_case("a pad that has moved a little is the same with and without its last view");
    CHECK(find_pad(&now));
    const struct pad_estimate searched = pad;
    hint.last = &moved;
    CHECK(find_with(&hint));
    NEAR(pad.x_px, searched.x_px, 0.01);
    NEAR(pad.y_px, searched.y_px, 0.01);
    NEAR(pad.angle_deg, searched.angle_deg, 0.02);
    NEAR(pad.height_m, searched.height_m, 0.001);

    test_case("a last view that is of somewhere else hides nothing and makes nothing up");
    hint.last = &wrong;
    CHECK(find_with(&hint));
    NEAR(pad.x_px, searched.x_px, 0.01);
    NEAR(pad.angle_deg, searched.angle_deg, 0.02);
    scene_clear(&record);
    hint.last = &moved;
    CHECK(!find_with(&hint));

    test_case("a pad that left doubt is searched for again when it leaves more than it did");
    CHECK(find_pad(&now));
    hint.last = NULL;
    hint.height_m = 2.0 * now.height_m;
    CHECK(find_with(&hint));
    const double doubt = pad.doubt;
    CHECK(doubt > 1.0);
    CHECK(pad.search_doubt == doubt);
    hint.last = &moved;
    hint.last_doubt = 0.9 * doubt;
    CHECK(find_with(&hint));
    CHECK(pad.search_doubt < hint.last_doubt && pad.search_doubt > 0.95 * hint.last_doubt);
    NEAR(pad.x_px, searched.x_px, 0.05);
    hint.last_doubt = 0.8 * doubt;
    for (int frames = 0; frames == 0 || (pad.search_doubt == 0.0 && frames < 20); frames++) {
        CHECK(detect_pad(&record, &camera_default, &hint, DETECT_ALL, &scratch, &pad) == 0);
        NEAR(pad.x_px, searched.x_px, 0.05);
        moved = pad.view;
        hint.last_doubt = pad.search_doubt;
    }
    CHECK(pad.search_doubt == pad.doubt);
}

void test_detect(void)
{
    test_last_view();
    test_clutter_needs_more();
    test_confirmed();
    test_traces_of_the_ring();
    test_pair_at_the_border();
    test_thin_ring();
    test_no_ring_and_another_height();
    test_all_headings();
    test_heights_and_places();
    test_tilt();
    test_perspective();
    test_cut_by_the_border();
    test_broken_ring();
    test_far();
}

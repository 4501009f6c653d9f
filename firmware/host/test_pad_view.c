// SPDX-License-Identifier: Apache-2.0
// The pad's view against geometry that was written without it: the painter's
// rotations, and shapes counted point by point.
#include <math.h>

#include "pad_geometry.h"
#include "pad_view.h"
#include "test.h"
#include "test_scene.h"

#define PI 3.14159265358979323846
#define TAN_40 0.8390996

static const struct {
    unsigned kind;
    scene_shape shape;
} shapes[PAD_KINDS] = {{PAD_SQUARE, scene_square},
                       {PAD_RECTANGLE, scene_rectangle},
                       {PAD_SMALL_RING, scene_small_ring},
                       {PAD_RING, scene_ring}};

// The real lens of a cheap camera bends about as much.
static struct camera bent_camera(void)
{
    struct camera camera = camera_default;

    camera.radial_2 = -0.05;
    camera.radial_4 = 0.01;
    return camera;
}

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void test_plane(void)
{
    const struct pad_view view = {{700.0, 300.0, log(1500.0), 0.6, TAN_40, -0.3, 0.0}};
    struct pad_view lost = view;
    struct pad_plane plane;

    test_case("plane");
    CHECK(pad_plane_of(&view, &camera_default, &plane) == 0);
    NEAR(sqrt(dot(plane.centre, plane.centre)), 1500.0, 1e-9);
    NEAR(dot(plane.across, plane.across), 1.0, 1e-12);
    NEAR(dot(plane.down, plane.down), 1.0, 1e-12);
    NEAR(dot(plane.across, plane.down), 0.0, 1e-12);
    NEAR(dot(plane.across, plane.normal), 0.0, 1e-12);
    NEAR(dot(plane.down, plane.normal), 0.0, 1e-12);
    NEAR(atan2(plane.across[1], plane.across[0]), 0.6, 1e-12);
    NEAR(plane.normal[0] / plane.normal[2], TAN_40, 1e-12);
    NEAR(plane.normal[1] / plane.normal[2], -0.3, 1e-12);
    lost.value[PAD_X_PX] = 640.0 + 930.0;
    CHECK(pad_plane_of(&lost, &camera_default, &plane) == CAMERA_E_OUTSIDE);
    lost.value[PAD_X_PX] = (double)NAN;
    CHECK(pad_plane_of(&lost, &camera_default, &plane) == CAMERA_E_OUTSIDE);
}

// Painted objects hold the sums of real pixels; the painter has its own rotations.
static void test_against_painter(void)
{
    static const double tilts[][2] = {{0.0, 0.0}, {20.0, 0.0}, {0.0, -20.0}, {-10.0, 15.0}};
    static struct landing_record record;

    for (int heading = -167; heading < 180; heading += 45) {
        for (unsigned i = 0; i < sizeof tilts / sizeof tilts[0]; i++) {
            const struct scene scene = {.height_m = 0.5,
                                        .right_m = 0.1,
                                        .forward_m = -0.05,
                                        .heading_deg = heading,
                                        .roll_deg = tilts[i][0],
                                        .pitch_deg = tilts[i][1]};
            const struct pad_view view = scene_view(&scene);
            struct pad_plane plane;
            test_case("painter, heading %d, roll %.0f, pitch %.0f", heading, scene.roll_deg, scene.pitch_deg);
            CHECK(pad_plane_of(&view, &camera_default, &plane) == 0);
            for (int k = 0; k < PAD_KINDS; k++) {
                struct shape painted;
                struct shape expected;
                scene_clear(&record);
                scene_paint(&record, &scene, shapes[k].shape);
                CHECK(shape_from_object(&record.objects[0], &painted) == 0);
                NEAR(pad_plane_moments(&plane, &camera_default, shapes[k].kind, false, &expected), 1.0, 1e-12);
                NEAR(expected.x_px, painted.x_px, 0.15);
                NEAR(expected.y_px, painted.y_px, 0.15);
                NEAR(expected.area_px / painted.area_px, 1.0, 0.03);
                NEAR(expected.cov_xx / painted.cov_xx, 1.0, 0.03);
                NEAR(expected.cov_yy / painted.cov_yy, 1.0, 0.03);
            }
        }
    }
}

static void check_moments(const struct camera *camera, const struct pad_view *view, bool clipped, double tolerance)
{
    struct pad_plane plane;

    CHECK(pad_plane_of(view, camera, &plane) == 0);
    for (int k = 0; k < PAD_KINDS; k++) {
        struct shape counted;
        struct shape expected = {0};
        const double whole = scene_count(&plane, camera, shapes[k].shape, clipped ? 2 : 3, clipped, &counted);
        const double inside = pad_plane_moments(&plane, camera, shapes[k].kind, clipped, &expected);
        const double spread = sqrt(counted.cov_xx + counted.cov_yy);
        NEAR(inside, counted.area_px / whole, tolerance);
        if (counted.area_px < 0.2 * whole) {
            continue; // a sliver, and pad_view.h promises little of it
        }
        NEAR(expected.area_px / counted.area_px, 1.0, 2.0 * tolerance);
        NEAR((expected.x_px - counted.x_px) / spread, 0.0, tolerance);
        NEAR((expected.y_px - counted.y_px) / spread, 0.0, tolerance);
        NEAR((expected.cov_xx - counted.cov_xx) / (spread * spread), 0.0, 2.0 * tolerance);
        NEAR((expected.cov_xy - counted.cov_xy) / (spread * spread), 0.0, 2.0 * tolerance);
        NEAR((expected.cov_yy - counted.cov_yy) / (spread * spread), 0.0, 2.0 * tolerance);
    }
}

static void test_whole_moments(void)
{
    static const struct pad_view views[] = {
        {{640.0, 360.0, 6.4, 0.3, 0.0, 0.0, 0.0}},      // level, 0.6 m
        {{900.0, 150.0, 6.7, 2.0, 0.2, -0.1, 0.0}},     // far off the axis
        {{500.0, 400.0, 6.6, -1.0, TAN_40, 0.0, 0.0}},  // 40 degrees
        {{1100.0, 560.0, 6.4, -2.5, -0.4, 0.5, 0.0}},
        {{20.0, 360.0, 6.7, 1.0, 0.1, 0.0, 0.0}},       // beyond the border, and counted
    };
    const struct camera bent = bent_camera();

    for (unsigned i = 0; i < sizeof views / sizeof views[0]; i++) {
        test_case("moments of the whole, view %u", i);
        check_moments(&camera_default, &views[i], false, 0.003);
        test_case("moments of the whole, view %u, real lens", i);
        check_moments(&bent, &views[i], false, 0.003);
    }
}

// Where a pixel is a mm.
static double edges_of(unsigned kinds)
{
    const struct shape seen = {.area_px = pad_area_mm2(kinds)};

    return pad_edges_px(kinds, &seen, 1.0);
}

static void test_clipped_moments(void)
{
    static const double centres[][2] = {{640.0, 360.0}, {5.0, 300.0}, {640.0, 700.0}, {1270.0, 10.0}, {30.0, -20.0}};
    const struct camera bent = bent_camera();

    for (unsigned i = 0; i < sizeof centres / sizeof centres[0]; i++) {
        const struct pad_view view = {{centres[i][0], centres[i][1], 6.5, 0.7, 0.15, -0.2, 0.0}};
        test_case("moments of what is inside the frame, centre %.0f, %.0f", centres[i][0], centres[i][1]);
        check_moments(&camera_default, &view, true, 0.04);
        check_moments(&bent, &view, true, 0.04);
    }
}

// Several shapes as one: as their sums add.
static void test_union(void)
{
    const struct pad_view view = {{640.0, 360.0, 6.9, 0.3, 0.1, 0.1, 0.0}};
    struct pad_plane plane;
    struct shape square;
    struct shape rectangle;
    struct shape both;

    test_case("square and rectangle as one");
    CHECK(pad_plane_of(&view, &camera_default, &plane) == 0);
    pad_plane_moments(&plane, &camera_default, PAD_SQUARE, false, &square);
    pad_plane_moments(&plane, &camera_default, PAD_RECTANGLE, false, &rectangle);
    pad_plane_moments(&plane, &camera_default, PAD_SQUARE | PAD_RECTANGLE, false, &both);
    const double area = square.area_px + rectangle.area_px;
    const double share = square.area_px / area;
    const struct vector line = shape_offset(&square, &rectangle);
    NEAR(both.area_px, area, 1e-9);
    NEAR(both.x_px, share * square.x_px + (1.0 - share) * rectangle.x_px, 1e-9);
    NEAR(both.y_px, share * square.y_px + (1.0 - share) * rectangle.y_px, 1e-9);
    const double within = share * square.cov_xy + (1.0 - share) * rectangle.cov_xy;
    NEAR(both.cov_xy, within + share * (1.0 - share) * line.x * line.y, 1e-6);
    test_case("lengths and areas");
    NEAR(edges_of(PAD_SQUARE), 200.0, 1e-9);
    NEAR(edges_of(PAD_RECTANGLE), 300.0, 1e-9);
    NEAR(edges_of(PAD_RING), 2.0 * PI * 225.0, 1e-9);
    NEAR(edges_of(PAD_SMALL_RING | PAD_SQUARE), 2.0 * PI * 25.0 + 200.0, 1e-9);
    NEAR(pad_area_mm2(PAD_SQUARE | PAD_RECTANGLE), 7500.0, 1e-9);
    NEAR(pad_area_mm2(PAD_RING), PI * (125.0 * 125.0 - 100.0 * 100.0), 1e-9);
    NEAR(pad_area_mm2(PAD_SMALL_RING), PI * (17.5 * 17.5 - 7.5 * 7.5), 1e-9);
}

static void test_out_of_frame(void)
{
    const struct pad_view gone = {{-250.0, 360.0, 6.9, 0.0, 0.0, 0.0, 0.0}};
    struct pad_plane plane;
    struct shape seen;

    test_case("nothing inside the frame");
    CHECK(pad_plane_of(&gone, &camera_default, &plane) == 0);
    NEAR(pad_plane_moments(&plane, &camera_default, PAD_RING, true, &seen), 0.0, 0.0);
    NEAR(pad_plane_moments(&plane, &camera_default, PAD_RING, false, &seen), 1.0, 0.0);
}

static void test_inverse(void)
{
    static const struct pad_view views[] = {{{640.0, 360.0, 6.9, 0.0, 0.0, 0.0, 0.0}},
                                            {{300.0, 600.0, 7.5, 1.0, 0.5, -TAN_40, 0.0}}};
    const struct camera cameras[] = {camera_default, bent_camera()};

    for (unsigned i = 0; i < 4U; i++) {
        struct pad_plane plane;
        test_case("pad to image and back, view %u, camera %u", i / 2U, i % 2U);
        CHECK(pad_plane_of(&views[i / 2U], &cameras[i % 2U], &plane) == 0);
        for (int k = 0; k < 25; k++) {
            const double x_mm = (k % 5 - 2) * 60.0;
            const double y_mm = (k / 5 - 2) * 60.0;
            double x_px;
            double y_px;
            double back_x;
            double back_y;
            pad_plane_project(&plane, &cameras[i % 2U], x_mm, y_mm, &x_px, &y_px);
            CHECK(pad_plane_unproject(&plane, &cameras[i % 2U], x_px, y_px, &back_x, &back_y) == 0);
            NEAR(back_x, x_mm, 1e-5);
            NEAR(back_y, y_mm, 1e-5);
            if (k == 12) {
                NEAR(x_px, views[i / 2U].value[PAD_X_PX], 1e-6);
                NEAR(y_px, views[i / 2U].value[PAD_Y_PX], 1e-6);
            }
        }
    }
    // The plane's horizon is 50 degrees off the axis, to the left.
    const struct pad_view steep = {{640.0, 360.0, 6.9, 0.0, TAN_40, 0.0, 0.0}};
    struct pad_plane plane;
    double x_mm;
    double y_mm;
    test_case("past the plane");
    CHECK(pad_plane_of(&steep, &camera_default, &plane) == 0);
    CHECK(pad_plane_unproject(&plane, &camera_default, 640.0 - 2.0 * 552.0 * tan(55.0 * PI / 360.0), 360.0, &x_mm,
                              &y_mm) != 0);
    CHECK(pad_plane_unproject(&plane, &camera_default, 640.0 - 2.0 * 552.0 * tan(40.0 * PI / 360.0), 360.0, &x_mm,
                              &y_mm) == 0);
    CHECK(pad_plane_unproject(&plane, &camera_default, (double)NAN, 360.0, &x_mm, &y_mm) != 0);
}

void test_pad_view(void)
{
    test_plane();
    test_against_painter();
    test_whole_moments();
    test_clipped_moments();
    test_union();
    test_out_of_frame();
    test_inverse();
}

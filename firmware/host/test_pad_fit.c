// SPDX-License-Identifier: Apache-2.0
// The fit gets back the view whose moments it is given. From so near that the
// corners, which the fit takes for lost, count for nothing.
#include <math.h>

#include "pad_fit.h"
#include "pad_geometry.h"
#include "test.h"
#include "test_scene.h"

#define HEIGHT_MM 300.0

static const struct tilt_hint no_hint = {.x = 0.0, .y = 0.0, .sigma = 100.0};

// A fit that has all the time it needs.
static int fit_in_time(const struct pad_evidence *evidence, const struct camera *camera, const struct tilt_hint *tilt,
                       struct pad_view *view, double *misfit, double *worst)
{
    struct work work = {.done = -100 * WORK_A_FRAME};
    struct pad_fit_progress progress = {.steps = 0};

    return pad_fit(evidence, camera, tilt, view, misfit, worst, &progress, &work);
}

static struct pad_evidence evidence_of(const struct pad_view *view, const struct camera *camera, bool clipped)
{
    static const unsigned kinds[] = {PAD_SQUARE, PAD_RECTANGLE, PAD_SMALL_RING, PAD_RING};
    struct pad_evidence evidence = {.count = 0};
    struct pad_plane plane;

    CHECK(pad_plane_of(view, camera, &plane) == 0);
    for (int i = 0; i < PAD_KINDS; i++) {
        struct sighting *sighting = &evidence.sightings[evidence.count];
        if (pad_plane_moments(&plane, camera, kinds[i], clipped, &sighting->seen) > 0.3) {
            sighting->kinds = kinds[i];
            sighting->clipped = clipped;
            evidence.count++;
        }
    }
    return evidence;
}

static struct pad_view moved(const struct pad_view *view, double much)
{
    struct pad_view away = *view;

    away.value[PAD_X_PX] += 6.0 * much;
    away.value[PAD_Y_PX] -= 5.0 * much;
    away.value[PAD_LOG_DISTANCE_MM] += 0.1 * much;
    away.value[PAD_YAW_RAD] -= 0.15 * much;
    return away;
}

static void check_same(const struct pad_view *got, const struct pad_view *truth, double scale)
{
    static const double tolerances[PAD_PARAMETERS] = {0.03, 0.03, 0.001, 0.001, 0.003, 0.003, 0.06};

    for (int i = 0; i < PAD_PARAMETERS; i++) {
        NEAR(got->value[i], truth->value[i], tolerances[i] * scale);
    }
}

static void test_recovers(void)
{
    struct camera bent = camera_default;

    bent.radial_2 = -0.05;
    for (int tilt = 0; tilt <= 40; tilt += 10) {
        for (int turn = 0; turn < 6; turn++) {
            const double slope = tan(tilt * acos(-1.0) / 180.0);
            const struct pad_view truth = {{600.0 + 30.0 * turn, 400.0, log(HEIGHT_MM), turn * 1.1, slope * cos(turn),
                                            slope * sin(turn), 0.0}};
            const struct camera *camera = turn % 2 == 0 ? &camera_default : &bent;
            const struct pad_evidence evidence = evidence_of(&truth, camera, false);
            struct pad_view view = moved(&truth, turn % 2 == 0 ? 1.0 : -1.0);
            double misfit = 0.0;
            double worst = 0.0;
            test_case("fit from a level start, tilt %d, turn %d", tilt, turn);
            view.value[PAD_TILT_X] = 0.0;
            view.value[PAD_TILT_Y] = 0.0;
            CHECK(evidence.count == 4);
            CHECK(fit_in_time(&evidence, camera, &no_hint, &view, &misfit, &worst) == 0);
            check_same(&view, &truth, 1.0);
            NEAR(misfit, 0.0, 0.01);
            NEAR(worst, 0.0, 0.2);
        }
    }
}

static void test_cut_by_the_border(void)
{
    const struct pad_view truth = {{60.0, 100.0, log(600.0), 2.5, 0.1, -0.05, 0.0}};
    const struct pad_evidence evidence = evidence_of(&truth, &camera_default, true);
    const struct tilt_hint hint = {.x = 0.1, .y = -0.05, .sigma = 0.05};
    struct pad_view view = moved(&truth, 0.5);
    double misfit;
    double worst;

    test_case("cut by the border");
    CHECK(evidence.count >= 3);
    CHECK(fit_in_time(&evidence, &camera_default, &hint, &view, &misfit, &worst) == 0);
    check_same(&view, &truth, 5.0);
}

// Shapes of a level pad below the camera whose edges have moved by this.
static double grown_mm;

static bool grown_box(double x_mm, double y_mm, double centre_y_mm, double width_mm, double height_mm)
{
    return fabs(x_mm) <= width_mm / 2.0 + grown_mm && fabs(y_mm - centre_y_mm) <= height_mm / 2.0 + grown_mm;
}

static bool grown_square(double x_mm, double y_mm)
{
    return grown_box(x_mm, y_mm, SQUARE_CENTRE_Y_MM, SQUARE_SIDE_MM, SQUARE_SIDE_MM);
}

static bool grown_rectangle(double x_mm, double y_mm)
{
    return grown_box(x_mm, y_mm, RECTANGLE_CENTRE_Y_MM, RECTANGLE_WIDTH_MM, RECTANGLE_HEIGHT_MM);
}

static bool grown_ring(double x_mm, double y_mm)
{
    const double radius = hypot(x_mm, y_mm);

    return radius <= RING_OUTER_RADIUS_MM + grown_mm && radius >= RING_INNER_RADIUS_MM - grown_mm;
}

static void test_moved_edges(void)
{
    static const double edges_px[] = {-0.8, -0.3, 0.4, 1.0};
    const struct pad_view truth = {{640.0, 360.0, log(HEIGHT_MM), 0.4, 0.0, 0.0, 0.0}};
    struct pad_plane plane;

    CHECK(pad_plane_of(&truth, &camera_default, &plane) == 0);
    for (unsigned i = 0; i < sizeof edges_px / sizeof edges_px[0]; i++) {
        struct pad_evidence evidence = evidence_of(&truth, &camera_default, false);
        const struct tilt_hint level = {.x = 0.0, .y = 0.0, .sigma = 0.1};
        struct pad_view view = moved(&truth, 0.5);
        double misfit;
        double worst;
        test_case("edges moved by %.1f px", edges_px[i]);
        grown_mm = edges_px[i] * HEIGHT_MM / camera_default.focal_px;
        scene_count(&plane, &camera_default, grown_square, 2, false, &evidence.sightings[0].seen);
        scene_count(&plane, &camera_default, grown_rectangle, 2, false, &evidence.sightings[1].seen);
        evidence.sightings[2] = evidence.sightings[3];
        evidence.count = 3;
        scene_count(&plane, &camera_default, grown_ring, 2, false, &evidence.sightings[2].seen);
        CHECK(fit_in_time(&evidence, &camera_default, &level, &view, &misfit, &worst) == 0);
        NEAR(view.value[PAD_EDGE_PX], edges_px[i], 0.15);
        NEAR(view.value[PAD_X_PX], 640.0, 0.08);
        NEAR(view.value[PAD_Y_PX], 360.0, 0.08);
        NEAR(view.value[PAD_LOG_DISTANCE_MM], log(HEIGHT_MM), 0.005);
        NEAR(view.value[PAD_YAW_RAD], 0.4, 0.001);
    }
}

static void test_hint_holds(void)
{
    const struct pad_view truth = {{640.0, 360.0, log(1500.0), 0.4, 0.3, 0.0, 0.0}};
    struct pad_evidence evidence = evidence_of(&truth, &camera_default, false);
    const struct tilt_hint sure = {.x = 0.0, .y = 0.0, .sigma = 1e-3};
    struct pad_view view = truth;
    double misfit;
    double worst;

    test_case("a sure hint of the tilt is kept, and the misfit tells");
    CHECK(fit_in_time(&evidence, &camera_default, &sure, &view, &misfit, &worst) == 0);
    NEAR(view.value[PAD_TILT_X], 0.0, 0.01);
    CHECK(misfit > 0.05);
    test_case("shapes in each other's place do not fit");
    const struct shape square = evidence.sightings[0].seen;
    evidence.sightings[0].seen = evidence.sightings[1].seen;
    evidence.sightings[1].seen = square;
    view = truth;
    CHECK(fit_in_time(&evidence, &camera_default, &no_hint, &view, &misfit, &worst) != 0 || (misfit > 10.0 && worst > 5.0));
}

static void test_lost(void)
{
    const struct pad_view truth = {{640.0, 360.0, log(1000.0), 0.0, 0.0, 0.0, 0.0}};
    const struct pad_evidence evidence = evidence_of(&truth, &camera_default, true);
    const struct pad_evidence nothing = {.count = 0};
    struct pad_view view = truth;
    double misfit;
    double worst;

    test_case("lost");
    CHECK(fit_in_time(&nothing, &camera_default, &no_hint, &view, &misfit, &worst) == PAD_FIT_E_LOST);
    view.value[PAD_X_PX] = 640.0 + 930.0; // where the camera cannot see
    CHECK(fit_in_time(&evidence, &camera_default, &no_hint, &view, &misfit, &worst) == PAD_FIT_E_LOST);
    view.value[PAD_X_PX] = -400.0; // nothing of it inside the frame
    CHECK(fit_in_time(&evidence, &camera_default, &no_hint, &view, &misfit, &worst) == PAD_FIT_E_LOST);
    view = truth;
    view.value[PAD_LOG_DISTANCE_MM] = log(1e6); // smaller than a pixel
    CHECK(fit_in_time(&evidence, &camera_default, &no_hint, &view, &misfit, &worst) == PAD_FIT_E_LOST);
    for (int i = 0; i < PAD_EDGE_PX; i++) {
        view = truth;
        view.value[i] = (double)NAN;
        CHECK(fit_in_time(&evidence, &camera_default, &no_hint, &view, &misfit, &worst) == PAD_FIT_E_LOST);
    }
}

static void test_in_parts(void)
{
    const struct pad_view truth = {{640.0, 360.0, log(HEIGHT_MM), 0.4, 0.3, -0.2, 0.0}};
    const struct pad_evidence evidence = evidence_of(&truth, &camera_default, false);
    struct pad_view view = moved(&truth, 1.0);
    const struct pad_view start = view;
    double misfit;
    double worst;
    double before = HUGE_VAL;
    int calls = 0;
    struct pad_fit_progress progress = {.steps = 0};
    int result = PAD_FIT_UNFINISHED;

    test_case("without time nothing is fitted");
    struct work over = {.done = WORK_A_FRAME};
    CHECK(pad_fit(&evidence, &camera_default, &no_hint, &view, &misfit, &worst, &progress, &over) == PAD_FIT_UNFINISHED);
    for (int i = 0; i < PAD_PARAMETERS; i++) {
        NEAR(view.value[i], start.value[i], 0.0);
    }
    test_case("a step a call comes to the same end");
    while (result == PAD_FIT_UNFINISHED && calls < PAD_FIT_STEPS) {
        struct work work = {.done = WORK_A_FRAME, .granted = true};
        result = pad_fit(&evidence, &camera_default, &no_hint, &view, &misfit, &worst, &progress, &work);
        CHECK(misfit < before);
        CHECK(work.done > WORK_A_FRAME && work.done < 2 * WORK_A_FRAME);
        before = misfit;
        calls++;
    }
    CHECK(result == 0);
    CHECK(calls > 2);
    CHECK(progress.steps > 1 && progress.steps < PAD_FIT_STEPS);
    check_same(&view, &truth, 1.0);
    test_case("after so many steps it ends where it is");
    progress.steps = PAD_FIT_STEPS;
    view = start;
    CHECK(pad_fit(&evidence, &camera_default, &no_hint, &view, &misfit, &worst, &progress, &(struct work){.done = 0}) == 0);
    NEAR(view.value[PAD_X_PX], start.value[PAD_X_PX], 0.0);
}

void test_pad_fit(void)
{
    test_recovers();
    test_cut_by_the_border();
    test_in_parts();
    test_moved_edges();
    test_hint_holds();
    test_lost();
}

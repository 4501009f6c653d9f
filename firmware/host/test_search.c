// SPDX-License-Identifier: Apache-2.0
// From frame to frame: what is in doubt is searched for again, and a search that has no time left goes on.
#include <math.h>
#include <string.h>

#include "detect.h"
#include "test.h"
#include "test_scene.h"

#define MOST_A_FRAME (5 * WORK_A_FRAME / 4)
#define TURNS 60 // more frames than a round takes

static struct landing_record record;
static struct detect_scratch scratch;
static struct pad_estimate pad;

static bool find_with(const struct detect_hint *hint)
{
    return detect_pad(&record, &camera_default, hint, DETECT_ALL, &scratch, &pad) == 0;
}

static void paint_without_small_ring(const struct scene *scene)
{
    scene_paint(&record, scene, scene_rectangle);
    scene_paint(&record, scene, scene_square);
    scene_paint(&record, scene, scene_ring);
}

static void test_a_better_one_is_found(void)
{
    const struct scene poor = {.height_m = 0.65, .right_m = -0.3};
    const struct scene good = {.height_m = 0.65, .right_m = 0.3};
    const struct pad_view truth = scene_view(&good);
    struct detect_hint hint = detect_no_hint;
    struct pad_view last;
    int frames = 0;

    test_case("a pad in doubt is followed");
    scene_clear(&record);
    paint_without_small_ring(&poor);
    for (int i = 0; i < 20; i++) {
        CHECK(find_with(&hint));
        last = pad.view;
        hint.last = &last;
        hint.last_doubt = pad.search_doubt;
    }
    CHECK(pad.doubt > 1.0);
    test_case("until there is a better one");
    scene_paint_pad(&record, &good);
    while (frames < 40 && fabs(pad.x_px - truth.value[PAD_X_PX]) > 1.0) {
        frames++;
        CHECK(find_with(&hint));
        last = pad.view;
        hint.last_doubt = pad.search_doubt;
    }
    CHECK(frames > 0 && frames <= 15);
    CHECK(pad.doubt < 0.6);
}

// Square and rectangle of a pad, and the ring of one that is seen from elsewhere.
static void paint_decoy(double right_m, double forward_m, double heading_deg)
{
    const struct scene inner = {
        .height_m = 2.0, .right_m = right_m, .forward_m = forward_m, .heading_deg = heading_deg};
    const struct scene ring = {
        .height_m = 1.8, .right_m = 0.9 * right_m + 0.02, .forward_m = 0.9 * forward_m, .heading_deg = 0.0};

    scene_paint(&record, &inner, scene_rectangle);
    scene_paint(&record, &inner, scene_square);
    scene_paint(&record, &ring, scene_ring);
}

// Fewer than there are hypotheses in a frame.
static void paint_decoys(void)
{
    static const double places_m[][2] = {{-0.8, 0.0}, {-0.4, -0.4}, {0.4, -0.4}, {0.8, 0.0}, {0.4, 0.4}};

    scene_clear(&record);
    for (unsigned i = 0; i < sizeof places_m / sizeof places_m[0]; i++) {
        paint_decoy(places_m[i][0], places_m[i][1], 40.0 * i);
    }
}

static void test_time_for_a_search(void)
{
    const struct scene among = {.height_m = 2.0, .heading_deg = 77.0, .roll_deg = 9.0};
    int spent = 0;
    int ended = 0;

    test_case("a frame full of decoys takes no longer, and the next goes on");
    paint_decoys();
    memset(&scratch, 0, sizeof scratch);
    for (int i = 0; i < TURNS; i++) {
        const int result = detect_pad(&record, &camera_default, &detect_no_hint, DETECT_ALL, &scratch, &pad);
        CHECK(result == DETECT_E_GOES_ON || result == DETECT_E_NO_PAD);
        CHECK(scratch.work > 0 && scratch.work <= MOST_A_FRAME);
        spent += result == DETECT_E_GOES_ON ? 1 : 0;
        ended += result == DETECT_E_NO_PAD ? 1 : 0;
    }
    CHECK(spent > 0 && ended > 1);

    test_case("a pad among them has its turn");
    scene_paint_pad(&record, &among);
    int frames = 1;
    while (frames < TURNS && !find_with(&detect_no_hint)) {
        frames++;
    }
    CHECK(frames > 1 && frames <= 20);
}

static void test_nothing_where_it_was(void)
{
    const struct scene scene = {.height_m = 1.0, .right_m = 0.3, .heading_deg = 20.0};
    const struct scene before = {.height_m = 1.0, .right_m = -0.3, .heading_deg = 20.0};
    const struct pad_view last = scene_view(&before);
    const struct detect_hint hint = {.tilt = {.sigma = 0.025}, .height_m = 1.0, .last = &last, .last_doubt = 0.1};
    const double followed = 0.98 * hint.last_doubt;
    int frames = 1;

    test_case("where nothing is twice, the search has every other frame for itself");
    scene_clear(&record);
    paint_decoys();
    scene_paint_pad(&record, &scene);
    memset(&scratch, 0, sizeof scratch);
    while (frames < TURNS && !find_with(&hint)) {
        CHECK(scratch.missed == frames);
        frames++;
    }
    CHECK(frames > 1 && frames <= 4);

    test_case("one that comes back after a frame is followed at once");
    scene_clear(&record);
    paint_decoys();
    memset(&scratch, 0, sizeof scratch);
    CHECK(!find_with(&hint));
    CHECK(scratch.missed == 1 && scratch.round.under_way);
    scene_paint_pad(&record, &before);
    CHECK(find_with(&hint));
    CHECK(scratch.missed == 0 && !scratch.round.under_way);
    CHECK(fabs(pad.search_doubt - followed) < 1e-9);

    test_case("and no sooner than in the next frame but one when it was away for longer");
    scratch.missed = 2;
    CHECK(!find_with(&hint) || fabs(pad.search_doubt - followed) > 1e-9);
    scratch.missed = 3;
    CHECK(find_with(&hint) && fabs(pad.search_doubt - followed) < 1e-9);
}

static bool upper_arc(double x_mm, double y_mm)
{
    return scene_ring(x_mm, y_mm) && y_mm < -0.18 * fabs(x_mm);
}

static bool lower_arc(double x_mm, double y_mm)
{
    return upper_arc(x_mm, -y_mm);
}

static void test_ring_in_or_out(void)
{
    const struct scene scene = {.height_m = 1.0, .right_m = 0.1, .heading_deg = 20.0};
    const struct pad_view last = scene_view(&scene);
    struct detect_hint hint = {.tilt = {.sigma = 0.025}, .height_m = 1.0, .last = &last, .last_doubt = 0.1};

    test_case("a ring that is nearly whole is fitted as it was a moment ago");
    scene_clear(&record);
    scene_paint(&record, &scene, scene_square);
    scene_paint(&record, &scene, scene_rectangle);
    scene_paint(&record, &scene, scene_small_ring);
    scene_paint(&record, &scene, upper_arc);
    scene_paint(&record, &scene, lower_arc);
    memset(&scratch, 0, sizeof scratch);
    CHECK(find_with(&hint));
    CHECK(pad.ring_share > 0.85 && pad.ring_share < 0.92);
    CHECK(!pad.ringless);
    hint.last_ringless = true;
    CHECK(find_with(&hint));
    CHECK(pad.ringless);
}

void test_search(void)
{
    test_nothing_where_it_was();
    test_ring_in_or_out();
    test_a_better_one_is_found();
    test_time_for_a_search();
}

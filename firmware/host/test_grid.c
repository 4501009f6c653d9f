// SPDX-License-Identifier: Apache-2.0
// A search in the grid finds what looking at every candidate finds.
#include <math.h>
#include <stdlib.h>

#include "camera.h"
#include "grid.h"
#include "test.h"

static struct detect_scratch scratch;
static struct grid grid;
static struct grid_near near;

static double between(double least, double greatest)
{
    return least + (greatest - least) * (double)rand() / (double)RAND_MAX;
}

static bool is_near(int candidate, double x_px, double y_px, double square_reach_px)
{
    const double x = scratch.candidates[candidate].shape.x_px - x_px;
    const double y = scratch.candidates[candidate].shape.y_px - y_px;

    return x * x + y * y <= square_reach_px;
}

static void check_near(double x_px, double y_px, double square_reach_px)
{
    bool found[LANDING_RECORD_MAX_OBJECTS] = {false};
    int expected = 0;

    grid_near(&grid, x_px, y_px, square_reach_px, &near);
    for (int i = 0; i < near.count; i++) {
        CHECK(!found[near.list[i]]);
        found[near.list[i]] = true;
    }
    for (int i = 0; i < scratch.count; i++) {
        expected += is_near(i, x_px, y_px, square_reach_px) ? 1 : 0;
        CHECK(found[i] == is_near(i, x_px, y_px, square_reach_px));
    }
    CHECK(near.count == expected);
}

static void scatter(int count, double width_px, double height_px)
{
    scratch.count = count;
    for (int i = 0; i < count; i++) {
        scratch.candidates[i].shape.x_px = between(0.0, width_px - 1.0);
        scratch.candidates[i].shape.y_px = between(0.0, height_px - 1.0);
    }
}

void test_grid(void)
{
    static const int counts[] = {0, 1, 30, LANDING_RECORD_MAX_OBJECTS};
    const struct camera small = camera_scaled(&camera_default, 37.0);
    const struct camera *cameras[] = {&camera_default, &small};

    srand(4);
    for (int i = 0; i < 8; i++) {
        const struct camera *camera = cameras[i % 2];
        const double width = camera->width_px;
        const double height = camera->height_px;
        test_case("near places among %d candidates, frame %.0f wide", counts[i / 2], width);
        scatter(counts[i / 2], width, height);
        grid_sort(&scratch, camera, &grid);
        for (int k = 0; k < 40; k++) {
            const double reach = between(0.0, k % 4 == 0 ? width : 0.1 * width);
            // Beyond the frame too: a pad's centre can be there.
            check_near(between(-0.2 * width, 1.2 * width), between(-0.2 * height, 1.2 * height), reach * reach);
        }
        test_case("the whole frame, one point, and no number at all");
        check_near(0.5 * width, 0.5 * height, 4.0 * width * width);
        check_near(scratch.candidates[0].shape.x_px, scratch.candidates[0].shape.y_px, 0.0);
        check_near(1e300, -1e300, 1.0);
        check_near((double)NAN, 0.0, 1.0);
        check_near(0.0, 0.0, (double)NAN);
    }
    test_case("all in one cell, and in the frame's corners");
    scatter(LANDING_RECORD_MAX_OBJECTS, 1.5, 1.5);
    scratch.candidates[7].shape.x_px = camera_default.width_px - 1.0;
    scratch.candidates[7].shape.y_px = camera_default.height_px - 1.0;
    grid_sort(&scratch, &camera_default, &grid);
    check_near(0.5, 0.5, 0.25);
    check_near(camera_default.width_px, camera_default.height_px, 4.0);
    CHECK(near.count == 1);
}

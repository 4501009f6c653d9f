// SPDX-License-Identifier: Apache-2.0
#include "grid.h"

#include <math.h>

#include "bounds.h"

// Which of so many; what lies outside belongs to the first or the last.
static int place_in(double place, double count)
{
    return (int)at_most(at_least(place, 0.0), count - 1.0);
}

static int cell_of(const struct grid *grid, double x_px, double y_px)
{
    const int row = place_in(y_px * grid->rows_per_px, GRID_ROWS);

    return row * GRID_COLUMNS + place_in(x_px * grid->columns_per_px, GRID_COLUMNS);
}

void grid_sort(const struct detect_scratch *scratch, const struct camera *camera, struct grid *grid)
{
    uint16_t cells[LANDING_RECORD_MAX_OBJECTS] = {0U};

    grid->scratch = scratch;
    grid->columns_per_px = GRID_COLUMNS / camera->width_px;
    grid->rows_per_px = GRID_ROWS / camera->height_px;
    for (int i = 0; i <= GRID_ROWS * GRID_COLUMNS; i++) {
        grid->first[i] = 0U;
    }
    for (int i = 0; i < scratch->count; i++) {
        const struct shape *shape = &scratch->candidates[i].shape;
        cells[i] = (uint16_t)cell_of(grid, shape->x_px, shape->y_px);
        grid->first[cells[i]]++;
    }
    for (int i = 1; i <= GRID_ROWS * GRID_COLUMNS; i++) {
        grid->first[i] = (uint16_t)(grid->first[i] + grid->first[i - 1]);
    }
    // These are the ends by now; as each cell fills from its end, they become the firsts.
    for (int i = scratch->count - 1; i >= 0; i--) {
        uint16_t *place = &grid->first[cells[i]];
        (*place)--;
        grid->order[*place] = (uint16_t)i;
    }
}

void grid_near(const struct grid *grid, double x_px, double y_px, double square_reach_px, struct grid_near *near)
{
    const double reach_px = sqrt(square_reach_px);
    const int last_row = place_in((y_px + reach_px) * grid->rows_per_px, GRID_ROWS);
    const int first_column = place_in((x_px - reach_px) * grid->columns_per_px, GRID_COLUMNS);
    const int last_column = place_in((x_px + reach_px) * grid->columns_per_px, GRID_COLUMNS);

    int looked_at = 0;
    int count = 0;
    for (int row = place_in((y_px - reach_px) * grid->rows_per_px, GRID_ROWS); row <= last_row; row++) {
        const int end = grid->first[row * GRID_COLUMNS + last_column + 1];
        const int begin = grid->first[row * GRID_COLUMNS + first_column];
        looked_at += end - begin;
        for (int i = begin; i < end; i++) {
            const struct shape *shape = &grid->scratch->candidates[grid->order[i]].shape;
            const double x = shape->x_px - x_px;
            const double y = shape->y_px - y_px;
            if (x * x + y * y <= square_reach_px) {
                near->list[count] = grid->order[i];
                count++;
            }
        }
    }
    near->looked_at = looked_at;
    near->count = count;
}

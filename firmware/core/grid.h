// SPDX-License-Identifier: Apache-2.0
// Candidates by the cell of the frame in which they lie: a search around a place need not look at all of them.
#ifndef TOUCHDOWN_GRID_H
#define TOUCHDOWN_GRID_H

#include <stdint.h>

#include "detect.h"

#define GRID_COLUMNS 24
#define GRID_ROWS 14

struct grid {
    const struct detect_scratch *scratch;
    double columns_per_px;
    double rows_per_px;
    uint16_t first[GRID_ROWS * GRID_COLUMNS + 1]; // of each cell, row after row, in `order`; and the end of the last
    uint16_t order[LANDING_RECORD_MAX_OBJECTS];
};

// Candidates, by their number.
struct grid_near {
    int looked_at; // in the cells gone through
    int count;
    uint16_t list[LANDING_RECORD_MAX_OBJECTS];
};

// `scratch` has to outlive the grid.
void grid_sort(const struct detect_scratch *scratch, const struct camera *camera, struct grid *grid);

// Those whose centroid is no farther from a place than that.
void grid_near(const struct grid *grid, double x_px, double y_px, double square_reach_px, struct grid_near *near);

#endif

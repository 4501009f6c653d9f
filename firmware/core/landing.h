// SPDX-License-Identifier: Apache-2.0
// The landing's phases. The table (firmware/landing.toml) says what leads where;
// here is what the facts mean. docs/landing.md.
#ifndef TOUCHDOWN_LANDING_H
#define TOUCHDOWN_LANDING_H

#include <stdbool.h>
#include <stdint.h>

#include "autopilot.h"
#include "landing_table.h"
#include "parameters.h"
#include "steering.h"

// Asked for by the ground or the pilot; each counts for one cycle.
#define LANDING_ASKED                                                                                                  \
    (LANDING_FACT_START | LANDING_FACT_ABORT | LANDING_FACT_PAUSE | LANDING_FACT_GO_ON)

// A pad that was seen longer ago is not seen.
#define LANDING_PAD_FRESH_US 100000U

// What is known in a cycle. Times are of arrival, 0 = never.
struct landing_known {
    const struct autopilot *autopilot;
    const struct parameters *parameters;
    uint32_t asked;       // LANDING_FACT_START, _ABORT, _PAUSE, _GO_ON
    uint64_t record_us;   // newest good record
    uint64_t lidar_us;    // newest usable reading
    double lidar_m;       // its height along the plumb line
    uint64_t attitude_us; // newest ATTITUDE that is one
    uint64_t pad_us;      // newest frame with the pad
    uint64_t level_us;    // newest frame whose pad could be turned level
    struct level_pad pad; // in that frame
    uint32_t pad_row;     // such frames in a row, of one track
    uint64_t agreed_us;   // newest frame in which the LiDAR did not contradict the pad's size
    uint64_t ground_us;   // newest HEARTBEAT of a ground station
};

struct landing {
    enum landing_phase phase;
    uint64_t entered_us;
    uint64_t off_centre_us; // when the pad was last not centred
    uint64_t off_angle_us;  // when it was last not aligned
    uint64_t not_low_us;    // when it was last not low enough to commit
    bool committed;
    uint32_t times_lost;
};

void landing_init(struct landing *landing, uint64_t now_us);

// What holds now.
uint32_t landing_facts(struct landing *landing, const struct landing_known *known, uint64_t now_us);

// One cycle. Returns the rule that was followed, or NULL.
const struct landing_rule *landing_step(struct landing *landing, uint32_t facts, uint64_t now_us);

// The height above ground, along the plumb line; false when nothing fresh says.
bool landing_height_m(const struct landing_known *known, uint64_t now_us, double *height_m);

// True when the pad is seen, in a row of frames, and what is level is known: then it may be steered by.
bool landing_sees_pad(const struct landing_known *known, uint64_t now_us);

#endif

// SPDX-License-Identifier: Apache-2.0
#include "landing.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

#include "bounds.h"

#define US_PER_S 1000000U
#define CAMERA_LOST_US 300000U
#define LIDAR_STALE_US 300000U
#define ATTITUDE_STALE_US 250000U
#define CONTRADICTS_US 500000U
#define PAD_LOST_US 500000U
#define PAD_ROW_MIN 5U
#define GROUND_LOST_US 5000000U
#define SETTLED_US 1000000U
#define ALIGNED_RAD 0.07
#define HIGH_TOLERANCE_M 0.1
#define AT_SEARCH_TOLERANCE_M 0.2
// Longer than one reading of the LiDAR counts: 60 ms in the hardware, then until it is stale.
#define COMMIT_AFTER_US 400000U
#define COMMIT_BELOW_ALIGN_M 0.1 // from the height for aligning LAND can always turn back

void landing_init(struct landing *landing, uint64_t now_us)
{
    memset(landing, 0, sizeof *landing);
    landing->phase = LANDING_PHASE_STANDBY;
    landing->entered_us = now_us;
}

// Never heard of is old.
static bool is_fresh(uint64_t arrived_us, uint64_t now_us, uint64_t most_us)
{
    return arrived_us != 0U && now_us <= arrived_us + most_us;
}

bool landing_sees_pad(const struct landing_known *known, uint64_t now_us)
{
    return known->pad_row >= PAD_ROW_MIN && is_fresh(known->level_us, now_us, LANDING_PAD_FRESH_US) &&
           is_fresh(known->attitude_us, now_us, ATTITUDE_STALE_US);
}

bool landing_height_m(const struct landing_known *known, uint64_t now_us, double *height_m)
{
    if (landing_sees_pad(known, now_us)) {
        *height_m = known->pad.down_m;
        return true;
    }
    if (is_fresh(known->lidar_us, now_us, LIDAR_STALE_US)) {
        *height_m = known->lidar_m;
        return true;
    }
    return false;
}

static uint32_t when(bool holds, uint32_t fact)
{
    return holds ? fact : 0U;
}

static uint32_t autopilot_facts(const struct landing *landing, const struct landing_known *known, uint64_t now_us)
{
    const struct autopilot *autopilot = known->autopilot;
    const enum landing_mode mode = landing_phase_table[landing->phase].mode;
    const bool low = autopilot->battery_known &&
                     (float)autopilot->battery_percent < known->parameters->battery_min_percent;

    return when(!autopilot_is_heard(autopilot, now_us), LANDING_FACT_AUTOPILOT_SILENT) |
           when(autopilot->armed, LANDING_FACT_ARMED) | when(autopilot_is_in(autopilot, mode), LANDING_FACT_IN_MODE) |
           when(mode != LANDING_MODE_NONE && autopilot->mode_taken, LANDING_FACT_PILOT) |
           when(autopilot->wanted == mode && autopilot_refuses(autopilot, now_us), LANDING_FACT_REFUSED) |
           when(autopilot->on_ground, LANDING_FACT_ON_GROUND) | when(low, LANDING_FACT_BATTERY_LOW);
}

static uint32_t sensor_facts(const struct landing_known *known, uint64_t now_us)
{
    // Until the pad is lost there is a size to contradict, also where it is seen only now and then.
    const bool contradicts = is_fresh(known->pad_us, now_us, PAD_LOST_US) &&
                             !is_fresh(known->agreed_us, known->pad_us, CONTRADICTS_US);
    const bool ground_lost = known->parameters->ground_needed >= 0.5F &&
                             !is_fresh(known->ground_us, now_us, GROUND_LOST_US);

    return when(!is_fresh(known->record_us, now_us, CAMERA_LOST_US), LANDING_FACT_CAMERA_LOST) |
           when(!is_fresh(known->lidar_us, now_us, LIDAR_STALE_US), LANDING_FACT_LIDAR_STALE) |
           when(!is_fresh(known->attitude_us, now_us, ATTITUDE_STALE_US), LANDING_FACT_ATTITUDE_STALE) |
           when(contradicts, LANDING_FACT_LIDAR_CONTRADICTS) | when(ground_lost, LANDING_FACT_GROUND_LOST);
}

static bool is_low_to_commit(const struct landing_known *known, uint64_t now_us)
{
    const struct parameters *parameters = known->parameters;
    const double below_m = at_most((double)parameters->commit_height_m,
                                   (double)parameters->align_height_m - COMMIT_BELOW_ALIGN_M);
    // Of two heights that contradict each other one is wrong.
    const bool contradicted = is_fresh(known->pad_us, now_us, LANDING_PAD_FRESH_US) && known->agreed_us != known->pad_us;
    double height_m;

    return !contradicted && landing_height_m(known, now_us, &height_m) && height_m < below_m;
}

static uint32_t pad_facts(struct landing *landing, const struct landing_known *known, uint64_t now_us)
{
    const struct parameters *parameters = known->parameters;
    const bool seen = landing_sees_pad(known, now_us);
    const double off_m = hypot(known->pad.forward_m, known->pad.right_m);
    double height_m = 0.0;
    const bool high_known = landing_height_m(known, now_us, &height_m);

    if (!seen || off_m > steering_centred_m(known->pad.down_m)) {
        landing->off_centre_us = now_us;
    }
    if (!seen || fabs(known->pad.angle_rad) > ALIGNED_RAD) {
        landing->off_angle_us = now_us;
    }
    if (!is_low_to_commit(known, now_us)) {
        landing->not_low_us = now_us;
    }
    landing->committed = landing->committed || (landing->phase == LANDING_PHASE_LAND &&
                                                now_us >= landing->not_low_us + COMMIT_AFTER_US);
    const bool centred = now_us >= landing->off_centre_us + SETTLED_US;
    const bool aligned = centred && now_us >= landing->off_angle_us + SETTLED_US;
    const double above_search_m = height_m - (double)parameters->search_height_m;

    return when(seen, LANDING_FACT_PAD) | when(!is_fresh(known->pad_us, now_us, PAD_LOST_US), LANDING_FACT_PAD_LOST) |
           when(centred, LANDING_FACT_CENTRED) | when(aligned, LANDING_FACT_ALIGNED) |
           when(high_known && above_search_m >= -HIGH_TOLERANCE_M, LANDING_FACT_HIGH) |
           when(high_known && fabs(above_search_m) <= AT_SEARCH_TOLERANCE_M, LANDING_FACT_AT_SEARCH) |
           when(high_known && height_m <= (double)parameters->align_height_m, LANDING_FACT_LOW) |
           when(landing->committed, LANDING_FACT_COMMITTED) |
           when((float)landing->times_lost > parameters->tries, LANDING_FACT_TRIES_USED);
}

// Of two that contradict each other in one cycle, the one that flies less counts.
static uint32_t asked_facts(uint32_t asked)
{
    const uint32_t outdone = when((asked & LANDING_FACT_ABORT) != 0U, LANDING_FACT_START) |
                             when((asked & LANDING_FACT_PAUSE) != 0U, LANDING_FACT_GO_ON);

    return asked & LANDING_ASKED & ~outdone;
}

uint32_t landing_facts(struct landing *landing, const struct landing_known *known, uint64_t now_us)
{
    const uint32_t limit_s = landing_phase_table[landing->phase].limit_s;
    const bool time_out = limit_s != 0U && now_us >= landing->entered_us + (uint64_t)limit_s * US_PER_S;

    return asked_facts(known->asked) | when(time_out, LANDING_FACT_TIME_OUT) |
           autopilot_facts(landing, known, now_us) | sensor_facts(known, now_us) | pad_facts(landing, known, now_us);
}

static void enter(struct landing *landing, enum landing_phase phase, uint64_t now_us)
{
    if (phase == LANDING_PHASE_WAIT) {
        landing->times_lost++;
    }
    if (phase == LANDING_PHASE_ENGAGE) {
        landing->times_lost = 0U;
    }
    landing->committed = landing->committed && phase == LANDING_PHASE_TOUCHDOWN;
    landing->off_centre_us = now_us;
    landing->off_angle_us = now_us;
    landing->not_low_us = now_us;
    landing->phase = phase;
    landing->entered_us = now_us;
}

const struct landing_rule *landing_step(struct landing *landing, uint32_t facts, uint64_t now_us)
{
    for (size_t i = 0; i < LANDING_RULES; i++) {
        const struct landing_rule *rule = &landing_rules[i];

        if ((rule->from >> (uint32_t)landing->phase & 1U) != 0U && (facts & rule->when) == rule->when &&
            (facts & rule->unless) == 0U) {
            if (rule->to != landing->phase) {
                enter(landing, rule->to, now_us);
            }
            return rule;
        }
    }
    return NULL;
}

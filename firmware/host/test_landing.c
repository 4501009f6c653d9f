// SPDX-License-Identifier: Apache-2.0
#include <string.h>

#include <common/mavlink.h>

#include "landing.h"
#include "test.h"

#define SECOND 1000000U
#define COMMIT_AFTER_US 400000U

static struct landing landing;
static struct autopilot autopilot;
static struct parameters parameters;
static struct landing_known known;

// All is well at `now_us`, the pad right below.
static void all_well(uint64_t now_us)
{
    memset(&known, 0, sizeof known);
    autopilot_init(&autopilot, rates_of(RATES_AUTOPILOT, 0U));
    autopilot.profile = AUTOPILOT_ARDUPILOT;
    autopilot.heard = true;
    autopilot.armed = true;
    autopilot.heartbeat_us = now_us;
    parameters_init(&parameters);
    known.autopilot = &autopilot;
    known.parameters = &parameters;
    known.record_us = known.lidar_us = known.attitude_us = known.agreed_us = known.ground_us = now_us;
    known.pad_us = known.level_us = now_us;
    known.lidar_m = 1.5;
    known.pad_row = 5U;
    known.pad.down_m = 1.5;
}

static uint32_t facts_at(uint64_t now_us)
{
    return landing_facts(&landing, &known, now_us);
}

static void test_each_fact(void)
{
    const uint64_t t = 100U * (uint64_t)SECOND;
    const uint32_t wrong = LANDING_FACT_AUTOPILOT_SILENT | LANDING_FACT_PILOT | LANDING_FACT_REFUSED |
                           LANDING_FACT_BATTERY_LOW | LANDING_FACT_GROUND_LOST | LANDING_FACT_CAMERA_LOST |
                           LANDING_FACT_LIDAR_STALE | LANDING_FACT_LIDAR_CONTRADICTS | LANDING_FACT_ATTITUDE_STALE |
                           LANDING_FACT_PAD_LOST | LANDING_FACT_TRIES_USED | LANDING_FACT_TIME_OUT;

    test_case("all well");
    landing_init(&landing, t);
    all_well(t);
    CHECK((facts_at(t) & wrong) == 0U);
    CHECK((facts_at(t) & LANDING_FACT_PAD) != 0U && (facts_at(t) & LANDING_FACT_ARMED) != 0U);
    test_case("what grows old");
    CHECK((facts_at(t + 3U * SECOND + 1U) & LANDING_FACT_AUTOPILOT_SILENT) != 0U);
    CHECK((facts_at(t + 300000U) & LANDING_FACT_CAMERA_LOST) == 0U);
    CHECK((facts_at(t + 300001U) & LANDING_FACT_CAMERA_LOST) != 0U);
    CHECK((facts_at(t + 300000U) & LANDING_FACT_LIDAR_STALE) == 0U);
    CHECK((facts_at(t + 300001U) & LANDING_FACT_LIDAR_STALE) != 0U);
    CHECK((facts_at(t + 250000U) & LANDING_FACT_ATTITUDE_STALE) == 0U);
    CHECK((facts_at(t + 250001U) & LANDING_FACT_ATTITUDE_STALE) != 0U);
    CHECK((facts_at(t + 100000U) & LANDING_FACT_PAD) != 0U);
    CHECK((facts_at(t + 100001U) & LANDING_FACT_PAD) == 0U);
    CHECK((facts_at(t + 500000U) & LANDING_FACT_PAD_LOST) == 0U);
    CHECK((facts_at(t + 500001U) & LANDING_FACT_PAD_LOST) != 0U);
    test_case("a ground station is needed only where it is said to be");
    CHECK((facts_at(t + 9U * (uint64_t)SECOND) & LANDING_FACT_GROUND_LOST) == 0U);
    parameters.ground_needed = 1.0F;
    CHECK((facts_at(t + 5U * (uint64_t)SECOND) & LANDING_FACT_GROUND_LOST) == 0U);
    CHECK((facts_at(t + 5U * (uint64_t)SECOND + 1U) & LANDING_FACT_GROUND_LOST) != 0U);
    test_case("four frames are no pad yet");
    known.pad_row = 4U;
    CHECK((facts_at(t) & LANDING_FACT_PAD) == 0U);
    test_case("never heard of is old");
    known.record_us = 0U;
    known.lidar_us = known.attitude_us = known.pad_us = known.level_us = 0U;
    CHECK((facts_at(1U) & (LANDING_FACT_CAMERA_LOST | LANDING_FACT_LIDAR_STALE | LANDING_FACT_ATTITUDE_STALE |
                           LANDING_FACT_PAD_LOST)) ==
          (LANDING_FACT_CAMERA_LOST | LANDING_FACT_LIDAR_STALE | LANDING_FACT_ATTITUDE_STALE | LANDING_FACT_PAD_LOST));
}

static void test_autopilot_facts(void)
{
    const uint64_t t = 100U * (uint64_t)SECOND;

    all_well(t);
    landing_init(&landing, t);
    test_case("battery");
    autopilot.battery_known = true;
    autopilot.battery_percent = 20U;
    CHECK((facts_at(t) & LANDING_FACT_BATTERY_LOW) == 0U);
    autopilot.battery_percent = 19U;
    CHECK((facts_at(t) & LANDING_FACT_BATTERY_LOW) != 0U);
    autopilot.battery_known = false;
    CHECK((facts_at(t) & LANDING_FACT_BATTERY_LOW) == 0U);
    test_case("modes count only in phases that want one");
    autopilot.mode_taken = true;
    autopilot.custom_mode = 4U;
    CHECK((facts_at(t) & (LANDING_FACT_PILOT | LANDING_FACT_IN_MODE)) == 0U);
    landing.phase = LANDING_PHASE_SEARCH;
    CHECK((facts_at(t) & (LANDING_FACT_PILOT | LANDING_FACT_IN_MODE)) == (LANDING_FACT_PILOT | LANDING_FACT_IN_MODE));
    test_case("a refusal of the mode of the phase before does not count");
    autopilot.wanted = LANDING_MODE_LAND;
    autopilot.rejected = true;
    CHECK((facts_at(t) & LANDING_FACT_REFUSED) == 0U);
    autopilot.wanted = LANDING_MODE_STEER;
    autopilot.custom_mode = 5U;
    CHECK((facts_at(t) & LANDING_FACT_REFUSED) != 0U);
    test_case("only what may be asked for is asked for");
    known.asked = UINT32_MAX;
    autopilot.on_ground = false;
    CHECK((facts_at(t) & LANDING_FACT_ON_GROUND) == 0U);
    CHECK((facts_at(t) & LANDING_FACT_ABORT) != 0U);
}

static void test_asked_at_once(void)
{
    const uint64_t t = 100U * (uint64_t)SECOND;

    all_well(t);
    landing_init(&landing, t);
    test_case("start and abort between two cycles: no start");
    known.asked = LANDING_FACT_START;
    CHECK((facts_at(t) & LANDING_ASKED) == LANDING_FACT_START);
    known.asked = LANDING_FACT_START | LANDING_FACT_ABORT;
    CHECK((facts_at(t) & LANDING_ASKED) == LANDING_FACT_ABORT);
    (void)landing_step(&landing, facts_at(t), t);
    CHECK(landing.phase == LANDING_PHASE_STANDBY);
    test_case("pause and go on between two cycles: it stands still");
    known.asked = LANDING_FACT_PAUSE | LANDING_FACT_GO_ON;
    CHECK((facts_at(t) & LANDING_ASKED) == LANDING_FACT_PAUSE);
    known.asked = LANDING_FACT_GO_ON;
    CHECK((facts_at(t) & LANDING_ASKED) == LANDING_FACT_GO_ON);
}

static void test_lidar_contradicts(void)
{
    const uint64_t t = 100U * (uint64_t)SECOND;

    test_case("LiDAR and size disagree for half a second");
    all_well(t);
    landing_init(&landing, t);
    known.agreed_us = t - 500000U;
    CHECK((facts_at(t) & LANDING_FACT_LIDAR_CONTRADICTS) == 0U);
    known.agreed_us = t - 500001U;
    CHECK((facts_at(t) & LANDING_FACT_LIDAR_CONTRADICTS) != 0U);
    test_case("a pad that is seen only now and then is contradicted until it is lost");
    CHECK((facts_at(t + 500000U) & LANDING_FACT_LIDAR_CONTRADICTS) != 0U);
    CHECK((facts_at(t + 500001U) & LANDING_FACT_LIDAR_CONTRADICTS) == 0U);
    known.agreed_us = t - 400000U;
    CHECK((facts_at(t + 400000U) & LANDING_FACT_LIDAR_CONTRADICTS) == 0U);
}

static void test_settling(void)
{
    const uint64_t t = 100U * (uint64_t)SECOND;
    const uint32_t heights = LANDING_FACT_LOW | LANDING_FACT_HIGH | LANDING_FACT_AT_SEARCH;

    test_case("centred and aligned for a second");
    all_well(t);
    landing_init(&landing, t);
    known.pad.angle_rad = 0.2;
    landing.off_centre_us = t - SECOND + 1U;
    CHECK((facts_at(t) & LANDING_FACT_CENTRED) == 0U);
    landing.off_centre_us = t - SECOND;
    CHECK((facts_at(t) & LANDING_FACT_CENTRED) != 0U);
    CHECK((facts_at(t) & LANDING_FACT_ALIGNED) == 0U);
    known.pad.angle_rad = 0.05;
    landing.off_angle_us = t - SECOND;
    CHECK((facts_at(t) & LANDING_FACT_ALIGNED) != 0U);
    test_case("off the centre the second begins anew");
    known.pad.right_m = 0.3;
    CHECK((facts_at(t) & (LANDING_FACT_CENTRED | LANDING_FACT_ALIGNED)) == 0U);
    known.pad.right_m = 0.0;
    CHECK((facts_at(t + 99999U) & LANDING_FACT_CENTRED) == 0U);
    test_case("heights: of the pad while it is seen, else of the LiDAR, else none");
    known.pad.down_m = 0.9;
    CHECK((facts_at(t) & heights) == LANDING_FACT_LOW);
    known.pad_us = known.level_us = 0U;
    known.lidar_m = 1.75;
    CHECK((facts_at(t) & heights) == (LANDING_FACT_HIGH | LANDING_FACT_AT_SEARCH));
    known.lidar_m = 1.65;
    CHECK((facts_at(t) & heights) == LANDING_FACT_AT_SEARCH);
    known.lidar_m = 1.55;
    CHECK((facts_at(t) & heights) == 0U);
    known.lidar_m = 1.95;
    CHECK((facts_at(t) & heights) == (LANDING_FACT_HIGH | LANDING_FACT_AT_SEARCH));
    known.lidar_m = 2.05;
    CHECK((facts_at(t) & heights) == LANDING_FACT_HIGH);
    known.lidar_us = 0U;
    CHECK((facts_at(t) & heights) == 0U);
}

// Whether it is committed after it was not low at `from_us`, and at this height from then on.
static bool commits(uint64_t from_us, double height_m, uint64_t for_us)
{
    bool committed = false;

    landing.committed = false;
    known.lidar_m = known.pad.down_m = 1.0;
    (void)facts_at(from_us);
    known.lidar_m = known.pad.down_m = height_m;
    for (uint64_t us = 0U; us <= for_us; us += 10000U) {
        known.pad_us = known.level_us = known.agreed_us = from_us + us;
        known.lidar_us = known.attitude_us = from_us + us;
        committed = (facts_at(from_us + us) & LANDING_FACT_COMMITTED) != 0U;
    }
    return committed;
}

static void test_not_committed(void)
{
    const uint64_t t = 100U * (uint64_t)SECOND;

    test_case("not before it has been low for some time");
    all_well(t);
    landing_init(&landing, t);
    landing.phase = LANDING_PHASE_LAND;
    CHECK(!commits(t, 0.3, COMMIT_AFTER_US - 10000U));
    CHECK(commits(t, 0.3, COMMIT_AFTER_US));
    test_case("a height that is not low begins the time anew");
    CHECK(!commits(t, 0.3, COMMIT_AFTER_US - 10000U));
    CHECK(!commits(t + COMMIT_AFTER_US, 0.3, COMMIT_AFTER_US - 10000U));
    test_case("one reading of the LiDAR, for as long as it counts, is not enough");
    all_well(t);
    landing.committed = false;
    known.pad_us = known.level_us = 0U;
    (void)facts_at(t);
    known.lidar_m = 0.3;
    for (uint64_t us = 0U; us <= SECOND; us += 5000U) {
        known.lidar_us = us <= 60000U ? t + us : known.lidar_us;
        CHECK((facts_at(t + us) & LANDING_FACT_COMMITTED) == 0U);
    }
    test_case("nor is a height that the LiDAR contradicts");
    all_well(t);
    known.pad.down_m = 0.3;
    for (uint64_t us = 10000U; us <= SECOND; us += 10000U) {
        known.pad_us = known.level_us = known.lidar_us = known.attitude_us = t + us;
        CHECK((facts_at(t + us) & LANDING_FACT_COMMITTED) == 0U);
    }
    test_case("at the height for aligning it can turn back, whatever TD_COMMIT_M says");
    all_well(t);
    parameters.commit_height_m = 0.8F;
    parameters.align_height_m = 0.6F;
    CHECK(!commits(t, 0.55, COMMIT_AFTER_US));
    CHECK(commits(t, 0.45, COMMIT_AFTER_US));
}

static void test_committed(void)
{
    const uint64_t t = 100U * (uint64_t)SECOND;

    test_case("committed low down in LAND, and from then on");
    all_well(t);
    landing_init(&landing, t);
    CHECK(!commits(t, 0.3, COMMIT_AFTER_US));
    landing.phase = LANDING_PHASE_LAND;
    CHECK(!commits(t, 0.5, COMMIT_AFTER_US));
    CHECK(commits(t, 0.3, COMMIT_AFTER_US));
    known.pad_us = known.level_us = known.lidar_us = 0U;
    CHECK((facts_at(t) & LANDING_FACT_COMMITTED) != 0U);
    CHECK(landing_step(&landing, LANDING_FACT_ARMED | LANDING_FACT_ON_GROUND, t) != NULL);
    CHECK(landing.phase == LANDING_PHASE_TOUCHDOWN && (facts_at(t) & LANDING_FACT_COMMITTED) != 0U);
    CHECK(landing_step(&landing, LANDING_FACT_COMMITTED, t) != NULL);
    CHECK(landing.phase == LANDING_PHASE_LANDED && (facts_at(t) & LANDING_FACT_COMMITTED) == 0U);
}

static void test_steps(void)
{
    static const struct {
        uint32_t facts;
        enum landing_phase to;
    } way[] = {
        {LANDING_FACT_START, LANDING_PHASE_ENGAGE},
        {LANDING_FACT_IN_MODE, LANDING_PHASE_SEARCH},
        {LANDING_FACT_PAD, LANDING_PHASE_CENTRE},
        {LANDING_FACT_PAD | LANDING_FACT_CENTRED | LANDING_FACT_AT_SEARCH, LANDING_PHASE_DESCEND},
        {LANDING_FACT_PAD | LANDING_FACT_CENTRED | LANDING_FACT_LOW, LANDING_PHASE_ALIGN},
        {LANDING_FACT_PAD_LOST, LANDING_PHASE_WAIT},
        {LANDING_FACT_TIME_OUT, LANDING_PHASE_CLIMB},
        {LANDING_FACT_HIGH, LANDING_PHASE_SEARCH},
        {LANDING_FACT_PAUSE, LANDING_PHASE_HOLD},
        {LANDING_FACT_GO_ON, LANDING_PHASE_SEARCH},
        {LANDING_FACT_PAD, LANDING_PHASE_CENTRE},
        {LANDING_FACT_BATTERY_LOW | LANDING_FACT_PAD, LANDING_PHASE_LAND},
        {LANDING_FACT_ABORT, LANDING_PHASE_GIVE_UP},
        {LANDING_FACT_IN_MODE, LANDING_PHASE_STANDBY},
    };

    test_case("a way through the phases");
    landing_init(&landing, SECOND);
    for (size_t i = 0; i < sizeof way / sizeof way[0]; i++) {
        CHECK(landing_step(&landing, LANDING_FACT_ARMED, SECOND) == NULL);
        const struct landing_rule *rule = landing_step(&landing, LANDING_FACT_ARMED | way[i].facts, SECOND);
        CHECK(rule != NULL && rule->to == way[i].to);
        CHECK(landing.phase == way[i].to);
    }
    CHECK(landing.times_lost == 1U);
    test_case("a refusal to start is said and changes nothing");
    const struct landing_rule *rule = landing_step(&landing, LANDING_FACT_START | LANDING_FACT_BATTERY_LOW |
                                                                 LANDING_FACT_ARMED, SECOND);
    CHECK(rule != NULL && landing.phase == LANDING_PHASE_STANDBY);
    test_case("each limit ends its phase");
    for (int phase = 0; phase < LANDING_PHASES; phase++) {
        landing_init(&landing, 0U);
        landing.phase = (enum landing_phase)phase;
        if (landing_phase_table[phase].limit_s != 0U) {
            CHECK(landing_step(&landing, LANDING_FACT_ARMED | LANDING_FACT_TIME_OUT, SECOND) != NULL);
            CHECK(landing.phase != (enum landing_phase)phase);
        }
    }
}

void test_landing(void)
{
    test_each_fact();
    test_autopilot_facts();
    test_asked_at_once();
    test_lidar_contradicts();
    test_settling();
    test_not_committed();
    test_committed();
    test_steps();
}

// SPDX-License-Identifier: Apache-2.0
// What a row of frames makes of single detections, and what the firmware knows
// beforehand: tracker, factor search and attitude as the two links show them.
#include <math.h>
#include <string.h>

#include <common/mavlink.h>

#include "app.h"
#include "test.h"
#include "test_scene.h"

#define FRAME_US 16667U
#define CONFIRMED 6
#define RADIANS_PER_DEGREE 0.017453292519943295

static const struct scene near_scene = {.height_m = 0.6, .right_m = 0.1, .heading_deg = 70.0};
static const struct scene jump_scene = {.height_m = 0.6, .right_m = -0.2, .heading_deg = 70.0};

static struct app app;
static struct landing_record with_pad;
static struct landing_record elsewhere;
static struct landing_record empty;
static uint32_t frame_number;
static uint64_t now_us;

// What the last record brought.
static int targets;
static mavlink_landing_target_t target;
static int arrays;
static float array[58];

// The autopilot: it answers TIMESYNC when it does, its clock ahead of ours by so much.
static bool answers;
static int64_t asked_ns;

static bool take(void *context, enum app_link link, const uint8_t *bytes, size_t size)
{
    static mavlink_message_t assembling;
    static mavlink_status_t assembling_status;
    mavlink_message_t message;
    mavlink_status_t status;

    (void)context;
    for (size_t i = 0; i < size; i++) {
        if (mavlink_frame_char_buffer(&assembling, &assembling_status, bytes[i], &message, &status) !=
            MAVLINK_FRAMING_OK) {
            continue;
        }
        if (message.msgid == MAVLINK_MSG_ID_LANDING_TARGET) {
            CHECK(link == APP_LINK_AUTOPILOT);
            targets++;
            mavlink_msg_landing_target_decode(&message, &target);
        } else if (message.msgid == MAVLINK_MSG_ID_TIMESYNC) {
            mavlink_timesync_t timesync;
            mavlink_msg_timesync_decode(&message, &timesync);
            CHECK(link == APP_LINK_AUTOPILOT && timesync.tc1 == 0);
            asked_ns = timesync.ts1;
        } else if (message.msgid == MAVLINK_MSG_ID_DEBUG_FLOAT_ARRAY) {
            CHECK(link == APP_LINK_GROUND);
            arrays++;
            mavlink_msg_debug_float_array_get_data(&message, array);
        }
    }
    return true;
}

static void start(void)
{
    const struct app_port port = {.write = take, .context = NULL};

    frame_number = 0U;
    now_us = 1000000U;
    app_init(&app, &port, now_us, NULL);
}

// The next frame shows this, taken with the factor that is in force.
static void show(struct landing_record *record)
{
    now_us += FRAME_US;
    record->header.frame_number = ++frame_number;
    record->header.start_time_us = now_us;
    record->header.threshold_factor = app_threshold_register(&app) & LANDING_REG_THRESHOLD_FACTOR_MASK;
    targets = 0;
    arrays = 0;
    CHECK(app_on_record(&app, record, sizeof *record, now_us) == 0);
    CHECK(arrays == 1);
}

static bool bridged(void)
{
    return ((uint32_t)array[APP_PAD_FLAGS] & APP_FLAG_BRIDGED) != 0U;
}

static void check_measured(const struct scene *scene)
{
    CHECK(targets == 1 && array[APP_PAD_FOUND] > 0.0F && !bridged());
    NEAR((double)array[APP_PAD_RIGHT_M], scene->right_m, 0.005);
    CHECK(((uint32_t)array[APP_PAD_FLAGS] & APP_FLAG_RING) != 0U);
}

static void check_bridged(const struct scene *scene)
{
    CHECK(targets == 1 && array[APP_PAD_FOUND] > 0.0F && bridged());
    NEAR((double)array[APP_PAD_RIGHT_M], scene->right_m, 0.005);
    NEAR((double)target.angle_x, atan(scene->right_m / scene->height_m), 0.01);
    CHECK(target.time_usec == now_us);
    // Nothing of it was seen.
    CHECK(((uint32_t)array[APP_PAD_FLAGS] & (APP_FLAG_RING | APP_FLAG_SMALL_RING)) == 0U);
}

static void check_nothing(void)
{
    CHECK(targets == 0 && !bridged());
    for (int i = APP_PAD_FOUND; i < APP_PAD_FIELDS; i++) {
        CHECK(i == APP_PAD_FRAME_NUMBER || i == APP_PAD_OBJECT_COUNT || fabsf(array[i]) <= 0.0F);
    }
}

static void follow(int frames)
{
    start();
    for (int i = 0; i < frames; i++) {
        show(&with_pad);
        check_measured(&near_scene);
    }
}

static void test_bridges(void)
{
    test_case("no frame is bridged before the track is confirmed");
    follow(CONFIRMED - 1);
    show(&empty);
    check_nothing();
    test_case("two frames are bridged, the third is not; none of them counts as found");
    follow(CONFIRMED);
    for (int i = 0; i < 2; i++) {
        show(&empty);
        check_bridged(&near_scene);
    }
    for (int i = 0; i < 20; i++) {
        show(&empty);
        check_nothing();
    }
    CHECK(app.health[APP_HEALTH_PADS] == (uint32_t)CONFIRMED);
    CHECK(app.health[APP_HEALTH_RECORDS] == (uint32_t)CONFIRMED + 22U);
}

static void test_refuses(void)
{
    test_case("a jump is refused, and believed in the third frame");
    follow(CONFIRMED);
    show(&elsewhere);
    check_bridged(&near_scene);
    show(&elsewhere);
    check_bridged(&near_scene);
    show(&elsewhere);
    check_measured(&jump_scene);
    test_case("without the tracker each frame stands alone");
    follow(CONFIRMED);
    app.detect_options = DETECT_ALL & ~DETECT_TRACK;
    show(&elsewhere);
    check_measured(&jump_scene);
    show(&empty);
    check_nothing();
}

static uint32_t factor(void)
{
    return (app_threshold_register(&app) & LANDING_REG_THRESHOLD_FACTOR_MASK) >> LANDING_REG_THRESHOLD_FACTOR_SHIFT;
}

static void test_factors(void)
{
    test_case("frames without a pad walk through the factors; the one that shows it stays");
    follow(CONFIRMED);
    for (int i = 0; i < 18; i++) {
        CHECK(factor() == 128U);
        show(&empty); // bridged frames show no pad either
    }
    CHECK(factor() == 160U);
    for (int i = 0; i < 20; i++) {
        show(&with_pad);
    }
    CHECK(factor() == 160U);
    CHECK((app_threshold_register(&app) & LANDING_REG_THRESHOLD_FLAT_LIMIT_MASK) >>
              LANDING_REG_THRESHOLD_FLAT_LIMIT_SHIFT ==
          16U);
    test_case("the first frame of a factor has the thresholds of the one before, and does not count");
    start();
    for (int i = 0; i < 19; i++) {
        CHECK(factor() == 128U); // the very first has none at all
        show(&empty);
    }
    for (int i = 0; i < 7; i++) {
        CHECK(factor() == 160U);
        show(&empty);
    }
    CHECK(factor() == 208U);
    test_case("the search can be left out");
    start();
    app.detect_options = DETECT_ALL & ~DETECT_FACTORS;
    for (int i = 0; i < 100; i++) {
        show(&empty);
    }
    CHECK(factor() == 128U);
}

static void tell_attitude(enum app_link link, double roll_deg, double pitch_deg)
{
    uint8_t bytes[MAVLINK_MAX_PACKET_LEN];
    mavlink_message_t message;

    mavlink_msg_attitude_pack(1, 1, &message, 0U, (float)(roll_deg * RADIANS_PER_DEGREE),
                              (float)(pitch_deg * RADIANS_PER_DEGREE), 0.5F, 0.0F, 0.0F, 0.0F);
    app_on_bytes(&app, link, bytes, mavlink_msg_to_send_buffer(bytes, &message), now_us);
}

// Doubt of a pad that lies level, seen `later_us` after an attitude that says otherwise.
static double doubt_after(enum app_link link, uint64_t later_us)
{
    start();
    tell_attitude(link, 3.0, -3.0);
    now_us += later_us - FRAME_US;
    show(&with_pad);
    return (double)array[APP_PAD_DOUBT];
}

static uint32_t row_after(struct landing_record *record)
{
    tell_attitude(APP_LINK_AUTOPILOT, 0.0, 0.0);
    show(record);
    return app.flight.known.pad_row;
}

static void test_row_of_frames(void)
{
    test_case("frames with the pad count, one that is bridged does not");
    start();
    for (uint32_t i = 1U; i <= CONFIRMED; i++) {
        CHECK(row_after(&with_pad) == i);
    }
    CHECK(row_after(&empty) == CONFIRMED);
    CHECK(row_after(&with_pad) == CONFIRMED + 1U);
    test_case("a pad elsewhere has a row of its own");
    CHECK(row_after(&elsewhere) == CONFIRMED + 1U);
    CHECK(row_after(&elsewhere) == CONFIRMED + 1U);
    CHECK(row_after(&elsewhere) == 1U);
    CHECK(row_after(&elsewhere) == 2U);
    CHECK(row_after(&with_pad) == 1U);
}

static void test_attitude_of_the_autopilot(void)
{
    start();
    show(&with_pad);
    const double alone = (double)array[APP_PAD_DOUBT];

    test_case("an attitude that contradicts the pad makes it doubtful");
    CHECK(doubt_after(APP_LINK_AUTOPILOT, FRAME_US) > alone + 0.1);
    test_case("one from the ground's link does not count");
    NEAR(doubt_after(APP_LINK_GROUND, FRAME_US), alone, 0.0);
    test_case("a stale one does not count");
    CHECK(doubt_after(APP_LINK_AUTOPILOT, 250000U) > alone + 0.1);
    NEAR(doubt_after(APP_LINK_AUTOPILOT, 250001U), alone, 0.0);
    test_case("one that is no attitude does not count");
    start();
    tell_attitude(APP_LINK_AUTOPILOT, (double)NAN, 0.0);
    show(&with_pad);
    NEAR((double)array[APP_PAD_DOUBT], alone, 0.0);
}

#define AHEAD_US 7000000U
#define LATE_US 10000U
#define SCAN_US 16000U

static void hear(mavlink_message_t *message)
{
    uint8_t bytes[MAVLINK_MAX_PACKET_LEN];

    app_on_bytes(&app, APP_LINK_AUTOPILOT, bytes, mavlink_msg_to_send_buffer(bytes, message), now_us);
}

static void answer_time(void)
{
    mavlink_message_t message;

    if (answers && asked_ns != 0) {
        // A millisecond after the question, half of it on the way back.
        mavlink_msg_timesync_pack(1, 1, &message, (int64_t)(now_us - 500U + AHEAD_US) * 1000, asked_ns);
        hear(&message);
    }
    asked_ns = 0;
}

// How far the pad, level, is from where it is, after 4 s of rolling to and fro at 1 rad/s; ATTITUDE arrives late.
static double off_m_while_rolling(void)
{
    static struct landing_record record;
    mavlink_message_t message;
    double off_m = 0.0;

    start();
    for (unsigned ms = 0U; ms < 4000U; ms++) {
        now_us += 1000U;
        // Roll is a triangle between -0.1 and 0.1 rad.
        const uint64_t sampled_us = now_us - LATE_US;
        const uint64_t exposed_us = now_us - SCAN_US / 2U;
        const double roll_rad = fabs(fmod(1e-6 * (double)sampled_us, 0.4) - 0.2) - 0.1;
        if (ms % 1000U == 0U) {
            mavlink_msg_heartbeat_pack(1, 1, &message, 2, MAV_AUTOPILOT_ARDUPILOTMEGA, 0, 0, 0);
            hear(&message);
        }
        if (ms % 20U == 0U) {
            mavlink_msg_attitude_pack(1, 1, &message, (uint32_t)((sampled_us + AHEAD_US) / 1000U), (float)roll_rad,
                                      0.0F, 0.0F, 0.0F, 0.0F, 0.0F);
            hear(&message);
        }
        answer_time();
        app_tick(&app, now_us, NULL);
        // In the middle of a side of the triangle.
        if (ms == 3900U) {
            const double true_rad = fabs(fmod(1e-6 * (double)exposed_us, 0.4) - 0.2) - 0.1;
            const struct scene scene = {.height_m = 1.0, .right_m = 0.1, .roll_deg = true_rad / RADIANS_PER_DEGREE};
            scene_clear(&record);
            scene_paint_pad(&record, &scene);
            record.header.frame_number = 1U;
            record.header.start_time_us = now_us - SCAN_US;
            record.header.scan_time_us = SCAN_US;
            CHECK(app_on_record(&app, &record, sizeof record, now_us) == 0);
            CHECK(app.flight.known.pad_row == 1U);
            off_m = fabs(app.flight.known.pad.right_m - scene.right_m);
        }
    }
    return off_m;
}

static void test_attitude_at_exposure(void)
{
    uint32_t round_trip_us;

    test_case("at 1 rad/s, with clocks that are known to each other, the pad stays where it is");
    answers = true;
    const double known_m = off_m_while_rolling();
    CHECK(timesync_is_known(&app.timesync, now_us, &round_trip_us) && round_trip_us == 1000U);
    CHECK(app.health[APP_HEALTH_TIMESYNC_US] == 1000U);
    CHECK(known_m < 0.003);
    test_case("without, it moves by the 10 ms that ATTITUDE was late");
    answers = false;
    const double unknown_m = off_m_while_rolling();
    CHECK(!timesync_is_known(&app.timesync, now_us, &round_trip_us));
    NEAR(unknown_m, 0.010, 0.003);
}

void test_app_track(void)
{
    test_attitude_at_exposure();
    scene_clear(&with_pad);
    scene_paint_pad(&with_pad, &near_scene);
    scene_clear(&elsewhere);
    scene_paint_pad(&elsewhere, &jump_scene);
    scene_clear(&empty);
    test_bridges();
    test_refuses();
    test_factors();
    test_row_of_frames();
    test_attitude_of_the_autopilot();
}

// SPDX-License-Identifier: Apache-2.0
// What only the C interface shows; the bytes themselves are decoded by
// firmware/test_messages.py.
#include <string.h>

#include "app.h"
#include "crash.h"
#include "test.h"
#include "test_scene.h"

static struct app app;
static struct landing_record record;
static int messages[APP_LINKS];
static bool wire_is_full;
static char last_text[51];

static bool count(void *context, enum app_link link, const uint8_t *bytes, size_t size)
{
    (void)context;
    CHECK(size >= 12U && bytes[0] == 0xFDU);
    messages[link]++;
    if (bytes[7] == 253U) { // STATUSTEXT: severity, then text
        memset(last_text, 0, sizeof last_text);
        memcpy(last_text, bytes + 11, bytes[1] - 1U < 50U ? bytes[1] - 1U : 50U);
    }
    return !wire_is_full;
}

static uint64_t waited_until_us;
static int targets_before_wait;

static void wait_until(void *context, uint64_t time_us)
{
    (void)context;
    waited_until_us = time_us;
    targets_before_wait = messages[APP_LINK_AUTOPILOT];
}

static void start(void)
{
    const struct app_port port = {.write = count, .context = NULL};

    memset(messages, 0, sizeof messages);
    app_init(&app, &port, 0, NULL);
}

static void give(uint32_t objects_dropped)
{
    record.header.frame_number++;
    record.header.objects_dropped = objects_dropped;
    record.header.min_area = app_min_area_px(&app);
    CHECK(app_on_record(&app, &record, sizeof record, 1000) == 0);
}

static void test_min_area(void)
{
    test_case("minimum area follows the clutter, within its limits");
    start();
    scene_clear(&record);
    const uint32_t first = app_min_area_px(&app);
    CHECK(first == 100U);
    give(10U);
    CHECK(app_min_area_px(&app) == 125U);
    record.header.frame_number++;
    record.header.min_area = 1U; // a frame from before the change
    const uint32_t second = app_min_area_px(&app);
    CHECK(app_on_record(&app, &record, sizeof record, 2000) == 0);
    CHECK(app_min_area_px(&app) == second);
    for (int i = 0; i < 100; i++) {
        give(10U);
    }
    CHECK(app_min_area_px(&app) == 150U);
    for (int i = 0; i < 100; i++) {
        give(0U);
    }
    CHECK(app_min_area_px(&app) == 30U);
    give(1U);
    CHECK(app_min_area_px(&app) == 37U);
}

static bool all(int x, int y)
{
    (void)x;
    (void)y;
    return true;
}

static void test_min_area_rests(void)
{
    test_case("a record that is nearly full leaves the minimum area as it is");
    start();
    scene_clear(&record);
    for (uint16_t i = 0; i < 215U; i++) {
        scene_paint_pixels(&record, (uint16_t)(4U * i), 0, 2, 2, all);
    }
    give(0U);
    CHECK(app_min_area_px(&app) == 100U);
    record.header.object_count--;
    give(0U);
    CHECK(app_min_area_px(&app) == 80U);
}

static void test_late_tick(void)
{
    const struct lidar_reading lidar = {.valid = true, .distance_mm = 1000, .age_us = 0};

    test_case("a late caller gets one turn, not a burst");
    start();
    app_tick(&app, 0, &lidar);
    memset(messages, 0, sizeof messages);
    app_tick(&app, 10000000U, &lidar);
    CHECK(messages[APP_LINK_AUTOPILOT] == 2); // HEARTBEAT and DISTANCE_SENSOR
    app_tick(&app, 10000001U, &lidar);
    CHECK(messages[APP_LINK_AUTOPILOT] == 2);
}

static void test_rejected(void)
{
    test_case("a rejected record sends nothing");
    start();
    scene_clear(&record);
    record.header.id_magic = 0U;
    memset(messages, 0, sizeof messages);
    CHECK(app_on_record(&app, &record, sizeof record, 1000) == RECORD_E_MAGIC);
    CHECK(messages[APP_LINK_AUTOPILOT] == 0 && messages[APP_LINK_GROUND] == 0);
}

static int number_given(uint32_t frame_number)
{
    record.header.frame_number = frame_number;
    memset(messages, 0, sizeof messages);
    const int error = app_on_record(&app, &record, sizeof record, 1000);
    CHECK(messages[APP_LINK_AUTOPILOT] == (error == 0 ? 1 : 0));
    return error;
}

static void test_frames_go_forward(void)
{
    const struct scene scene = {.height_m = 0.9, .right_m = 0.1, .heading_deg = 70.0};

    test_case("no frame twice, none older than the last");
    start();
    scene_clear(&record);
    scene_paint_pad(&record, &scene);
    CHECK(number_given(5U) == 0);
    CHECK(number_given(5U) == RECORD_E_OLD);
    CHECK(number_given(4U) == RECORD_E_OLD);
    CHECK(number_given(9U) == 0);
    CHECK(app.health[APP_HEALTH_RECORDS] == 2U && app.health[APP_HEALTH_RECORDS_REJECTED] == 0U);
    test_case("frame numbers wrap");
    start();
    CHECK(number_given(0xFFFFFFFFU) == 0);
    CHECK(number_given(2U) == 0);
    CHECK(number_given(0xFFFFFFFFU) == RECORD_E_OLD);
}

static void test_complaints(void)
{
    const struct app_complaints none = {.frames_unwritten = 0};
    const struct app_complaints refused = {.write_error = true, .frames_unwritten = 1};
    const struct app_complaints dark = {.lidar_fault = true, .frames_unwritten = 1};

    test_case("what the hardware complains of reaches the ground, at a bounded rate");
    start();
    memset(messages, 0, sizeof messages);
    app_on_complaints(&app, &none, 0);
    CHECK(messages[APP_LINK_GROUND] == 0);
    app_on_complaints(&app, &refused, 1000U);
    CHECK(messages[APP_LINK_GROUND] == 2);
    app_on_complaints(&app, &dark, 2000U);
    CHECK(messages[APP_LINK_GROUND] == 3);
    CHECK(strcmp(last_text, "Touchdown: LiDAR gives no valid reading") == 0);
    for (uint64_t now_us = 100000U; now_us < 10000000U; now_us += 100000U) {
        app_on_complaints(&app, &dark, now_us);
    }
    CHECK(messages[APP_LINK_GROUND] == 3);
    app_on_complaints(&app, &dark, 10002000U);
    CHECK(messages[APP_LINK_GROUND] == 4);
    CHECK(messages[APP_LINK_AUTOPILOT] == 0);
    CHECK(app.health[APP_HEALTH_FRAMES_UNWRITTEN] == 1U);
    CHECK(app.health[APP_HEALTH_WRITE_ERRORS] == 1U);
    CHECK(app.health[APP_HEALTH_LIDAR_FAULTS] == 101U);
}

static void test_full_wire(void)
{
    const struct lidar_reading lidar = {.valid = true, .distance_mm = 1000, .age_us = 0};

    test_case("messages that find no room are counted");
    start();
    wire_is_full = true;
    app_tick(&app, 0, &lidar);
    wire_is_full = false;
    CHECK(app.links.dropped[APP_LINK_AUTOPILOT] == 2U);
    CHECK(app.links.dropped[APP_LINK_GROUND] == 2U); // HEARTBEAT and HEALTH
}

static void test_no_thresholds_yet(void)
{
    test_case("a frame without thresholds says nothing about clutter");
    start();
    scene_clear(&record);
    const uint32_t first = app_min_area_px(&app);
    record.header.flags = LANDING_HEADER_FLAGS_THRESHOLDS_MISSING_MASK;
    give(0U);
    CHECK(app_min_area_px(&app) == first);
}

// Where the minimum area comes to rest without clutter.
static uint32_t rest_at(uint32_t altitude_mm, uint32_t age_us)
{
    start();
    scene_clear(&record);
    record.header.flags = LANDING_HEADER_FLAGS_ALTITUDE_VALID_MASK;
    record.header.altitude_mm = altitude_mm;
    record.header.altitude_age_us = age_us;
    for (int i = 0; i < 100; i++) {
        give(0U);
    }
    return app_min_area_px(&app);
}

static void test_min_area_of_a_height(void)
{
    test_case("the LiDAR says how small a shape of the pad can be: 0.06 of the square's area below the camera");
    CHECK(rest_at(1000U, 0U) == 45U);
    CHECK(rest_at(750U, 0U) == 81U);
    CHECK(rest_at(500U, 0U) == 150U);
    CHECK(rest_at(3000U, 0U) == 30U);
    test_case("a reading that is too old says nothing");
    CHECK(rest_at(500U, FUSION_LIDAR_MAX_AGE_US + 1U) == 30U);
}

static void test_restart(void)
{
    uint8_t bytes[PARAMETERS_STORED_BYTES];

    test_case("parameters as they were kept hold from the start; a damaged block is none");
    start();
    app.flight.parameters.speed_m_s = 0.3F;
    parameters_store(&app.flight.parameters, bytes);
    start();
    CHECK(app.flight.parameters.speed_m_s == 0.5F);
    app_load_parameters(&app, bytes, sizeof bytes);
    CHECK(app.flight.parameters.speed_m_s == 0.3F);
    bytes[8]++;
    start();
    app_load_parameters(&app, bytes, sizeof bytes);
    CHECK(app.flight.parameters.speed_m_s == 0.5F);
    test_case("why the run before ended");
    app_on_crash(&app, CRASH_DATA, 0x2000000U);
    CHECK(strcmp(last_text, "restarted: data abort at 02000000") == 0);
    app_on_watchdog(&app);
    CHECK(strcmp(last_text, "restarted: watchdog") == 0);
}

static void test_health_of_the_board(void)
{
    const struct app_vitals vitals = {.stack_used_bytes = 9000U, .busy_permille = 321U, .frame_worst_us = 4567U,
                                      .rx_full_bytes = {11U, 12U}, .rx_overruns = {13U, 14U}};
    struct lidar_reading lidar = {.valid = true, .distance_mm = 1000U, .age_us = 12345U};

    test_case("what the board knows of itself, and how old the LiDAR's reading is");
    start();
    app_on_vitals(&app, &vitals);
    app_tick(&app, 0, &lidar);
    CHECK(app.health[APP_HEALTH_STACK_BYTES] == 9000U && app.health[APP_HEALTH_BUSY_PERMILLE] == 321U);
    CHECK(app.health[APP_HEALTH_RX_FULL_AUTOPILOT] == 11U && app.health[APP_HEALTH_RX_FULL_GROUND] == 12U);
    CHECK(app.health[APP_HEALTH_RX_OVERRUNS_AUTOPILOT] == 13U && app.health[APP_HEALTH_RX_OVERRUNS_GROUND] == 14U);
    CHECK(app.health[APP_HEALTH_FRAME_US] == 4567U && app.health[APP_HEALTH_LIDAR_AGE_MS] == 12U);
    lidar = (struct lidar_reading){.valid = false, .age_us = UINT32_MAX};
    app_tick(&app, 1000000U, &lidar);
    CHECK(app.health[APP_HEALTH_LIDAR_AGE_MS] == APP_LIDAR_AGE_MAX_MS);
    app_tick(&app, 2000000U, NULL);
    CHECK(app.health[APP_HEALTH_LIDAR_AGE_MS] == APP_LIDAR_AGE_MAX_MS);
}

static void test_other_pixels(void)
{
    const struct scene scene = {.height_m = 1.0, .heading_deg = 20.0};
    struct picture picture;

    test_case("a pad that is not the camera's is shown, and nothing is told to the autopilot");
    start();
    scene_clear(&record);
    scene_paint_pad(&record, &scene);
    app_on_source(&app, false);
    app_picture(&app, &picture);
    CHECK(!picture.has_pad);
    for (int i = 0; i < 3; i++) {
        give(0U);
    }
    CHECK(messages[APP_LINK_AUTOPILOT] == 0);
    app_picture(&app, &picture);
    CHECK(picture.has_pad && picture.boxes[PICTURE_RING].shown);
    CHECK(strncmp(picture.text[0], "STANDBY ", 8U) == 0);
    CHECK(app.flight.known.pad_us == 0U);
    app_tick(&app, 1000U, NULL);
    CHECK(strcmp(last_text, "Touchdown: pixels are not the camera's") == 0);

    test_case("and the camera's again is, from when no record of the other can come any more");
    last_text[0] = '\0';
    memset(messages, 0, sizeof messages);
    app_on_source(&app, true);
    for (uint32_t i = 0; i < APP_STAGED_FRAMES; i++) {
        give(0U);
    }
    CHECK(messages[APP_LINK_AUTOPILOT] == 0);
    CHECK(app.flight.known.pad_us == 0U);
    give(0U);
    CHECK(messages[APP_LINK_AUTOPILOT] > 0);
    app_tick(&app, 2001000U, NULL);
    CHECK(strcmp(last_text, "Touchdown: pixels are not the camera's") != 0);

    test_case("a frame without a pad");
    const uint32_t number = record.header.frame_number;
    scene_clear(&record);
    record.header.frame_number = number;
    give(0U);
    give(0U);
    give(0U);
    app_picture(&app, &picture);
    CHECK(!picture.has_pad);
}

static void test_fault(void)
{
    const struct app_port port = {.write = count, .context = NULL};
    const struct lidar_reading lidar = {.valid = true, .distance_mm = 1000, .age_us = 0};

    test_case("with a fault the reason is said with each heartbeat, and nothing flies");
    app_init(&app, &port, 0, "Touchdown: no landing_core");
    memset(messages, 0, sizeof messages);
    app_tick(&app, 0, &lidar);
    CHECK(strcmp(last_text, "Touchdown: no landing_core") == 0);
    CHECK(messages[APP_LINK_GROUND] == 2);
    app_tick(&app, 5000000U, &lidar);
    CHECK(messages[APP_LINK_GROUND] == 4); // neither HEALTH nor word of missing frames
    CHECK(app.flight.known.lidar_us == 0U);
}

static void test_no_frames(void)
{
    const char *missing = "Touchdown: no frames, check camera and FRAME_SIZE";

    test_case("missing frames are said once, and when they come again");
    start();
    scene_clear(&record);
    app_tick(&app, 2000000U, NULL);
    CHECK(strcmp(last_text, "Touchdown: started") == 0);
    app_tick(&app, 2000001U, NULL);
    CHECK(strcmp(last_text, missing) == 0);
    links_say(&app.links, MAVLINK_OUT_INFO, "other words");
    app_tick(&app, 3000000U, NULL);
    CHECK(strcmp(last_text, "other words") == 0);
    CHECK(app_on_record(&app, &record, sizeof record, 3000000U) == 0);
    app_tick(&app, 3000001U, NULL);
    CHECK(strcmp(last_text, "Touchdown: frames again") == 0);
}

static void test_lidar_that_is_not_there(void)
{
    const struct lidar_reading none = {.valid = false, .distance_mm = 0, .age_us = 0};
    const struct lidar_reading some = {.valid = true, .distance_mm = 1000, .age_us = 0};

    test_case("a LiDAR that has never worked claims nothing, one that has says it is out of range");
    start();
    memset(messages, 0, sizeof messages);
    app_tick(&app, 0, &none);
    CHECK(messages[APP_LINK_AUTOPILOT] == 1); // HEARTBEAT
    app_tick(&app, 100000U, &some);
    CHECK(messages[APP_LINK_AUTOPILOT] == 2);
    app_tick(&app, 200000U, &none);
    CHECK(messages[APP_LINK_AUTOPILOT] == 3);
    app_tick(&app, 300000U, NULL);
    CHECK(messages[APP_LINK_AUTOPILOT] == 3);
}

static void give_sent(enum app_link link, const mavlink_message_t *message)
{
    uint8_t bytes[MAVLINK_MAX_PACKET_LEN];

    app_on_bytes(&app, link, bytes, mavlink_msg_to_send_buffer(bytes, message), 1000U);
}

static void test_bytes(void)
{
    mavlink_message_t message;

    test_case("whoever asks for the time is answered on that link");
    start();
    memset(messages, 0, sizeof messages);
    mavlink_msg_timesync_pack(1, 1, &message, 0, 77);
    give_sent(APP_LINK_GROUND, &message);
    CHECK(messages[APP_LINK_GROUND] == 1 && messages[APP_LINK_AUTOPILOT] == 0);
    test_case("an attitude is the autopilot's or none");
    mavlink_msg_attitude_pack(1, 1, &message, 0U, 0.25F, 0.125F, 0.0F, 0.0F, 0.0F, 0.0F);
    give_sent(APP_LINK_GROUND, &message);
    CHECK(!app.attitude.known);
    give_sent(APP_LINK_AUTOPILOT, &message);
    CHECK(app.attitude.known && app.attitude.roll_rad == 0.25 && app.attitude.pitch_rad == 0.125);
}

// A target leaves when it is due, and what else is due waits for it.
static void test_waiting(void)
{
    const struct app_port port = {.write = count, .wait_until = wait_until, .context = NULL};
    const struct scene scene = {.height_m = 1.0};

    test_case("LANDING_TARGET waits for its time, the heartbeat for LANDING_TARGET");
    memset(messages, 0, sizeof messages);
    app_init(&app, &port, 0, NULL);
    scene_clear(&record);
    scene_paint_pad(&record, &scene);
    record.header.scan_time_us = 16000U;
    for (uint32_t i = 1U; i <= 2U; i++) {
        record.header.frame_number = i;
        record.header.start_time_us = 20000U * i;
        CHECK(app_on_record(&app, &record, sizeof record, 20000U * i + 16100U) == 0);
        CHECK(waited_until_us == 20000U * i + 16950U);
        CHECK(targets_before_wait == (int)i - 1 && messages[APP_LINK_AUTOPILOT] == (int)i);
    }
    app_tick(&app, 76000U, NULL); // the next target is due at 76950
    CHECK(messages[APP_LINK_AUTOPILOT] == 2);
    app_tick(&app, 77500U, NULL);
    CHECK(messages[APP_LINK_AUTOPILOT] == 3);
}

void test_app(void)
{
    test_waiting();
    test_health_of_the_board();
    test_fault();
    test_other_pixels();
    test_no_frames();
    test_lidar_that_is_not_there();
    test_bytes();
    test_restart();
    test_full_wire();
    test_no_thresholds_yet();
    test_min_area();
    test_min_area_rests();
    test_min_area_of_a_height();
    test_late_tick();
    test_rejected();
    test_frames_go_forward();
    test_complaints();
}

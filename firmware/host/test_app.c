// SPDX-License-Identifier: Apache-2.0
// What only the C interface shows; the bytes themselves are decoded by
// firmware/test_firmware.py.
#include <string.h>

#include "app.h"
#include "test.h"
#include "test_scene.h"

static struct app app;
static struct landing_record record;
static int messages[APP_LINKS];

static void count(void *context, enum app_link link, const uint8_t *bytes, size_t size)
{
    (void)context;
    CHECK(size >= 12U && bytes[0] == 0xFDU);
    messages[link]++;
}

static void start(void)
{
    const struct app_port port = {.write = count, .context = NULL};

    memset(messages, 0, sizeof messages);
    app_init(&app, &port, 0, NULL);
}

static void give(uint32_t objects_dropped)
{
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
    give(10U);
    CHECK(app_min_area_px(&app) > first);
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
}

static void test_late_tick(void)
{
    const struct lidar_reading lidar = {.valid = true, .distance_mm = 1000, .age_us = 0};

    test_case("a late caller gets one turn, not a burst");
    start();
    app_tick(&app, 0, &lidar);
    memset(messages, 0, sizeof messages);
    app_tick(&app, 10000000U, &lidar);
    CHECK(messages[APP_LINK_AUTOPILOT] == 2); // HEARTBEAT, DISTANCE_SENSOR
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

void test_app(void)
{
    test_min_area();
    test_late_tick();
    test_rejected();
}

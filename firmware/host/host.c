// SPDX-License-Identifier: Apache-2.0
#include "host.h"

#include <string.h>

#include "app.h"

static struct app app;
static struct landing_record record;
static touchdown_write write_bytes;
static uint32_t bauds[APP_LINKS];

static bool forward(void *context, enum app_link link, const uint8_t *bytes, size_t size)
{
    write_bytes(context, (int)link, bytes, size);
    return true;
}

void touchdown_set_bauds(uint32_t autopilot, uint32_t ground)
{
    bauds[APP_LINK_AUTOPILOT] = autopilot;
    bauds[APP_LINK_GROUND] = ground;
}

void touchdown_init(touchdown_write write, void *context, uint64_t now_us)
{
    const struct app_port port = {
        .write = forward,
        .context = context,
        .baud = {[APP_LINK_AUTOPILOT] = bauds[APP_LINK_AUTOPILOT], [APP_LINK_GROUND] = bauds[APP_LINK_GROUND]},
    };

    write_bytes = write;
    app_init(&app, &port, now_us, NULL);
}

int touchdown_on_record(const void *bytes, size_t size, uint64_t now_us)
{
    // Copied, because the caller's bytes may be unaligned.
    memcpy(&record, bytes, size < sizeof record ? size : sizeof record);
    return app_on_record(&app, &record, size, now_us);
}

void touchdown_set_options(uint32_t options)
{
    app.detect_options = options;
}

uint32_t touchdown_min_area(void)
{
    return app_min_area_px(&app);
}

uint32_t touchdown_threshold(void)
{
    return app_threshold_register(&app);
}

void touchdown_on_bytes(int link, const uint8_t *bytes, size_t size, uint64_t now_us)
{
    app_on_bytes(&app, link == TOUCHDOWN_AUTOPILOT ? APP_LINK_AUTOPILOT : APP_LINK_GROUND, bytes, size, now_us);
}

void touchdown_tick(uint64_t now_us, bool lidar_valid, uint32_t lidar_distance_mm, uint32_t lidar_age_us)
{
    const struct lidar_reading lidar = {
        .valid = lidar_valid,
        .distance_mm = lidar_distance_mm,
        .age_us = lidar_age_us,
    };

    app_tick(&app, now_us, &lidar);
}

// SPDX-License-Identifier: Apache-2.0
#include "app.h"

#include <math.h>
#include <string.h>

#include "bounds.h"
#include "crash.h"
#include "pad_geometry.h"

#define HEARTBEAT_PERIOD_US 1000000U
#define CAMERA_LOST_US 2000000U
#define COMPLAINT_PERIOD_US 10000000U
// A few frames: longer ago the pad may be anywhere.
#define LAST_VIEW_US 100000U
#define SCAN_MAX_US 50000U // no camera takes longer from its first pixel to its last
#define US_PER_MS 1000U
#define PAD_ARRAY_ID 1U
#define HEALTH_ARRAY_ID 2U

// On grass, half of all frames have more than 256 shapes of 30 pixels, hardly
// any has of 150; and the square, seen from 1.9 m, has about 170. Below 30 no
// shape can be told from another.
#define MIN_AREA_START_PX 100U
#define MIN_AREA_LEAST_PX 30U
#define MIN_AREA_GREATEST_PX 150U
// Of a square below the camera; 50 degrees off the axis its image is four times
// smaller, 30 degrees off it nearly half, and the filters take its corners.
#define SQUARE_SHARE_LEAST 0.06
#define SQUARE_SHARE_GREATEST 0.4
// A window of 128x128 with less contrast shows paper or a black shape alone, and
// is judged by its neighbour's threshold. The noise of a camera stays below it.
#define FLAT_LIMIT 16U
#define OBJECTS_FEW 215U
#define RECORD_FLAGS                                                                                                   \
    (LANDING_HEADER_FLAGS_THRESHOLDS_MISSING_MASK | LANDING_HEADER_FLAGS_THRESHOLDS_STALE_MASK |                       \
     LANDING_HEADER_FLAGS_OBJECTS_OVERFLOW_MASK | LANDING_HEADER_FLAGS_ALTITUDE_VALID_MASK)
#define RING_WIDTH_M (2.0 * RING_OUTER_RADIUS_MM / 1000.0)

void app_init(struct app *app, const struct app_port *port, uint64_t now_us, const char *fault)
{
    memset(app, 0, sizeof *app);
    links_init(&app->links, port);
    flight_init(&app->flight, app->links.rates[APP_LINK_AUTOPILOT], now_us);
    timesync_init(&app->timesync);
    app->fault = fault;
    app->min_area_px = MIN_AREA_START_PX;
    app->detect_options = DETECT_ALL;
    app->next_heartbeat_us = now_us;
    app->next_distance_us = now_us;
    app->last_record_us = now_us;
    for (int link = 0; link < APP_LINKS; link++) {
        mavlink_in_init(&app->in[link]);
    }
    links_say(&app->links, MAVLINK_OUT_INFO, "Touchdown: started");
}

void app_load_parameters(struct app *app, const uint8_t *bytes, size_t size)
{
    (void)parameters_load(&app->flight.parameters, bytes, size);
}

void app_on_crash(struct app *app, uint32_t kind, uint32_t address)
{
    struct text text = {.length = 0U};

    text_append(&text, "restarted: ");
    crash_append(&text, kind, address);
    links_say(&app->links, MAVLINK_OUT_CRITICAL, text.chars);
}

void app_on_watchdog(struct app *app)
{
    links_say(&app->links, MAVLINK_OUT_CRITICAL, "restarted: watchdog");
}

void app_on_vitals(struct app *app, const struct app_vitals *vitals)
{
    app->health[APP_HEALTH_STACK_BYTES] = vitals->stack_used_bytes;
    app->health[APP_HEALTH_BUSY_PERMILLE] = vitals->busy_permille;
    app->health[APP_HEALTH_FRAME_US] = vitals->frame_worst_us;
    app->health[APP_HEALTH_RX_FULL_AUTOPILOT] = vitals->rx_full_bytes[APP_LINK_AUTOPILOT];
    app->health[APP_HEALTH_RX_FULL_GROUND] = vitals->rx_full_bytes[APP_LINK_GROUND];
    app->health[APP_HEALTH_RX_OVERRUNS_AUTOPILOT] = vitals->rx_overruns[APP_LINK_AUTOPILOT];
    app->health[APP_HEALTH_RX_OVERRUNS_GROUND] = vitals->rx_overruns[APP_LINK_GROUND];
}

static void send_landing_target(struct app *app, const struct landing_record *record, const struct pad_estimate *pad,
                                const struct altitude *altitude, uint64_t now_us)
{
    uint8_t bytes[MAVLINK_OUT_MAX_BYTES];

    if (!rates_frame_is_due(app->links.rates[APP_LINK_AUTOPILOT]->frame_period_us, now_us, &app->last_target_us)) {
        return;
    }
    const struct mavlink_out_target target = {
        .time_us = record->header.start_time_us,
        .right = pad->right_m / pad->depth_m,
        .forward = pad->forward_m / pad->depth_m,
        .height_m = pad->depth_m * altitude->pad_scale,
        .pad_width_m = RING_WIDTH_M,
    };

    links_send(&app->links, APP_LINK_AUTOPILOT, bytes,
               mavlink_out_landing_target(&app->links.out[APP_LINK_AUTOPILOT], &target, bytes));
}

// `pad` is NULL when none was found.
static void send_pad_array(struct app *app, const struct landing_record *record, const struct pad_estimate *pad,
                           bool bridged, const struct altitude *altitude, uint64_t now_us)
{
    uint8_t bytes[MAVLINK_OUT_MAX_BYTES];
    float values[APP_PAD_FIELDS] = {0.0F};
    uint32_t flags = record->header.flags & RECORD_FLAGS;

    if (!rates_frame_is_due(app->links.rates[APP_LINK_GROUND]->frame_period_us, now_us, &app->last_pad_us)) {
        return;
    }
    flags |= altitude->from_lidar ? APP_FLAG_ALTITUDE_LIDAR : 0U;
    flags |= altitude->from_pad ? APP_FLAG_ALTITUDE_PAD : 0U;
    flags |= altitude->lidar_implausible ? APP_FLAG_LIDAR_IMPLAUSIBLE : 0U;
    flags |= bridged ? APP_FLAG_BRIDGED : 0U;
    if (pad != NULL) {
        flags |= (pad->kinds & PAD_RING) != 0U ? APP_FLAG_RING : 0U;
        flags |= (pad->kinds & PAD_SMALL_RING) != 0U ? APP_FLAG_SMALL_RING : 0U;
        values[APP_PAD_FOUND] = 1.0F;
        values[APP_PAD_X_PX] = (float)pad->x_px;
        values[APP_PAD_Y_PX] = (float)pad->y_px;
        values[APP_PAD_ANGLE_DEG] = (float)pad->angle_deg;
        values[APP_PAD_RIGHT_M] = (float)(pad->right_m * altitude->pad_scale);
        values[APP_PAD_FORWARD_M] = (float)(pad->forward_m * altitude->pad_scale);
        values[APP_PAD_DOUBT] = (float)pad->doubt;
        values[APP_PAD_SIZE_ALTITUDE_M] = (float)pad->height_m;
    }
    values[APP_PAD_ALTITUDE_M] = (float)altitude->height_m;
    values[APP_PAD_FRAME_NUMBER] = (float)record->header.frame_number;
    values[APP_PAD_OBJECT_COUNT] = (float)record->header.object_count;
    values[APP_PAD_FLAGS] = (float)flags;
    links_send(&app->links, APP_LINK_GROUND, bytes,
               mavlink_out_float_array(&app->links.out[APP_LINK_GROUND], record->header.start_time_us, PAD_ARRAY_ID,
                                       "PAD", values, APP_PAD_FIELDS, bytes));
}

struct area_limits {
    uint32_t least_px;
    uint32_t greatest_px;
};

static uint32_t limited_area_px(double area_px)
{
    return (uint32_t)at_most(at_least(area_px, (double)MIN_AREA_LEAST_PX), (double)MIN_AREA_GREATEST_PX);
}

// The least and greatest MIN_AREA that make sense at a height: close to the ground
// all shapes of the pad are large, and what is smaller only costs time; from afar
// the square is small, and better the last objects of a frame are lost than it.
static struct area_limits area_limits_of(const struct lidar_reading *lidar, const struct camera *camera)
{
    struct area_limits limits = {.least_px = MIN_AREA_LEAST_PX, .greatest_px = MIN_AREA_GREATEST_PX};

    if (fusion_lidar_usable(lidar)) {
        const double side_px = SQUARE_SIDE_MM * camera->focal_px / at_least((double)lidar->distance_mm, 1.0);
        limits.least_px = limited_area_px(SQUARE_SHARE_LEAST * side_px * side_px);
        limits.greatest_px = limited_area_px(SQUARE_SHARE_GREATEST * side_px * side_px);
    }
    return limits;
}

static void adapt_min_area(struct app *app, const struct landing_result_header *header,
                           const struct lidar_reading *lidar, const struct camera *camera)
{
    const struct area_limits limits = area_limits_of(lidar, camera);

    // A change shows a few frames later, and without thresholds there are no
    // objects: until then there is nothing to learn.
    if (header->min_area != app->min_area_px || (header->flags & LANDING_HEADER_FLAGS_THRESHOLDS_MISSING_MASK) != 0U) {
        return;
    }
    if (header->objects_dropped != 0U) {
        app->min_area_px += app->min_area_px / 4U;
    } else if (header->object_count < OBJECTS_FEW) {
        app->min_area_px -= app->min_area_px / 5U;
    }
    app->min_area_px = app->min_area_px < limits.least_px      ? limits.least_px
                       : app->min_area_px > limits.greatest_px ? limits.greatest_px
                                                               : app->min_area_px;
}

uint32_t app_min_area_px(const struct app *app)
{
    return app->min_area_px;
}

uint32_t app_threshold_register(const struct app *app)
{
    return factor_search_factor(&app->factor_search) << LANDING_REG_THRESHOLD_FACTOR_SHIFT |
           FLAT_LIMIT << LANDING_REG_THRESHOLD_FLAT_LIMIT_SHIFT;
}

void app_on_lost_record(struct app *app)
{
    app->health[APP_HEALTH_RECORDS_REJECTED]++;
}

// A shutter that rolls exposes line after line: the middle of the picture stands for all of it.
static uint64_t exposed_us_of(const struct landing_result_header *header)
{
    const uint32_t scan_us = header->scan_time_us < SCAN_MAX_US ? header->scan_time_us : SCAN_MAX_US;

    return header->start_time_us + scan_us / 2U;
}

static void count_record(struct app *app, const struct landing_result_header *header, uint64_t now_us)
{
    app->last_frame_number = header->frame_number;
    app->last_record_us = now_us;
    app->health[APP_HEALTH_RECORDS]++;
    app->health[APP_HEALTH_FRAMES_MALFORMED] = header->frames_malformed;
    app->health[APP_HEALTH_FRAMES_OVERFLOW] = header->frames_overflow;
    app->health[APP_HEALTH_OBJECTS_DROPPED] = header->objects_dropped;
}

// The thresholds are those of the frame before: after a change, a frame's own factor is not theirs yet.
static uint32_t factor_of(struct app *app, const struct landing_result_header *header)
{
    const uint32_t factor = header->threshold_factor == app->factor_before ? app->factor_before : FACTOR_SEARCH_MIXED;

    app->factor_before = header->threshold_factor;
    return factor;
}

static struct detect_hint hint_of(const struct app *app, const struct landing_result_header *header,
                                  const struct lidar_reading *lidar, uint32_t factor, uint64_t now_us)
{
    struct detect_hint hint = detect_no_hint;

    hint.height_m = fusion_lidar_usable(lidar) ? 0.001 * (double)lidar->distance_mm : 0.0;
    hint.searching = !factor_search_is_usual(factor);
    // Without a fresh attitude the hint stays what it is without any.
    (void)attitude_tilt(&app->attitude, exposed_us_of(header), now_us, &hint.tilt);
    if ((app->detect_options & DETECT_TRACK) != 0U && app->has_last_view &&
        header->start_time_us - app->last_view_us <= LAST_VIEW_US) {
        hint.last = &app->last_view;
        hint.last_fused = app->last_fused;
        hint.last_ringless = app->last_ringless;
        hint.last_doubt = app->last_doubt;
    }
    return hint;
}

static void release_landing_target(struct app *app, const struct landing_record *record, const struct pad_estimate *pad,
                                   const struct altitude *altitude, uint64_t now_us)
{
    const uint64_t release_us = release_of(&record->header);

    release_note(&app->release, release_us);
    links_wait_until(&app->links, release_us);
    send_landing_target(app, record, pad, altitude, now_us);
}

// For the next hint.
static void keep_view(struct app *app, const struct pad_estimate *pad, uint64_t start_us)
{
    app->has_last_view = true;
    app->last_view = pad->view;
    app->last_fused = pad->fused;
    app->last_ringless = pad->ringless;
    app->last_doubt = pad->search_doubt;
    app->last_view_us = start_us;
}

// For the monitor.
static void keep_seen(struct app *app, const struct camera *camera, const struct altitude *altitude,
                      const struct pad_estimate *pad)
{
    app->seen_camera = *camera;
    app->seen_altitude = *altitude;
    app->has_seen_pad = pad != NULL;
    if (pad != NULL) {
        app->seen_pad = *pad;
    }
}

static void count_staged(struct app *app)
{
    if (!app->has_other_source && app->staged_frames != 0U) {
        app->staged_frames--;
        // What was followed is not there any more.
        tracker_init(&app->tracker);
    }
}

int app_on_record(struct app *app, const struct landing_record *record, size_t size_bytes, uint64_t now_us)
{
    struct pad_estimate pad;
    const int error = record_check(record, size_bytes);

    if (error != 0) {
        app_on_lost_record(app);
        return error;
    }
    // The hardware may announce a frame twice. Numbers wrap.
    if (app->last_frame_number != 0U && record->header.frame_number - app->last_frame_number - 1U > INT32_MAX) {
        return RECORD_E_OLD;
    }
    count_record(app, &record->header, now_us);
    const struct lidar_reading lidar = {
        .valid = (record->header.flags & LANDING_HEADER_FLAGS_ALTITUDE_VALID_MASK) != 0U,
        .distance_mm = record->header.altitude_mm,
        .age_us = record->header.altitude_age_us,
    };
    // Smaller frames are the same camera, binned.
    struct camera camera = camera_scaled(&camera_default, (double)record->header.frame_size_width);
    camera.height_px = (double)record->header.frame_size_height;
    adapt_min_area(app, &record->header, &lidar, &camera);
    const uint64_t exposed_us = exposed_us_of(&record->header);
    const uint32_t factor = factor_of(app, &record->header);
    const struct detect_hint hint = hint_of(app, &record->header, &lidar, factor, now_us);
    const int detected = detect_pad(record, &camera, &hint, app->detect_options, &app->scratch, &pad);
    const bool seen = detected == 0;
    const enum track_result track =
        (app->detect_options & DETECT_TRACK) != 0U
            ? tracker_update(&app->tracker, &camera, record->header.start_time_us, seen, &pad)
            : seen ? TRACK_MEASURED
                   : TRACK_NONE;
    const bool found = track != TRACK_NONE;

    if (track == TRACK_MEASURED) {
        keep_view(app, &pad, record->header.start_time_us);
    }
    if ((app->detect_options & DETECT_FACTORS) != 0U) {
        factor_search_update(&app->factor_search, seen, detected != DETECT_E_GOES_ON, factor);
    }
    const struct altitude altitude = fusion_altitude(&lidar, found ? &pad : NULL);

    if (tracker_has_begun(&app->tracker)) {
        flight_on_new_track(&app->flight);
    }
    // A prediction is good for a target, not for steering: it neither counts as a frame with the pad nor as one without.
    const bool flown_by = found && app->staged_frames == 0U;

    if (track != TRACK_BRIDGED) {
        flight_on_frame(&app->flight, &app->attitude, flown_by ? &pad : NULL, &altitude, exposed_us, now_us);
    }
    app->health[APP_HEALTH_PADS] += found && seen ? 1U : 0U;
    if (flown_by) {
        release_landing_target(app, record, &pad, &altitude, now_us);
    }
    send_pad_array(app, record, found ? &pad : NULL, track == TRACK_BRIDGED, &altitude, now_us);
    keep_seen(app, &camera, &altitude, found ? &pad : NULL);
    count_staged(app);
    return 0;
}

void app_on_source(struct app *app, bool is_camera)
{
    app->has_other_source = !is_camera;
    if (app->has_other_source) {
        app->staged_frames = APP_STAGED_FRAMES;
    }
}

void app_picture(const struct app *app, struct picture *picture)
{
    picture_of(picture, &app->seen_camera, app->has_seen_pad ? &app->seen_pad : NULL, &app->seen_altitude,
               landing_phase_table[app->flight.landing.phase].name);
}

static void on_autopilot(struct app *app, const struct mavlink_in_message *message, uint64_t now_us)
{
    if (message->kind == MAVLINK_IN_TIMESYNC_ANSWER) {
        timesync_on_answer(&app->timesync, message->as.timesync.request_ns, message->as.timesync.answer_ns, now_us);
    }
    if (message->kind == MAVLINK_IN_ATTITUDE) {
        const struct mavlink_in_attitude *said = &message->as.attitude;
        const uint64_t time_us =
            timesync_to_ours(&app->timesync, (uint64_t)said->time_ms * US_PER_MS, ATTITUDE_MAX_AGE_US, now_us);
        attitude_set(&app->attitude, (double)said->roll_rad, (double)said->pitch_rad, time_us, now_us);
    }
}

void app_on_bytes(struct app *app, enum app_link link, const uint8_t *bytes, size_t size, uint64_t now_us)
{
    for (size_t i = 0; i < size; i++) {
        struct mavlink_in_message message;
        const enum mavlink_in_kind kind = mavlink_in_byte(&app->in[link], bytes[i], &message);

        if (kind == MAVLINK_IN_NOTHING) {
            continue;
        }
        if (kind == MAVLINK_IN_TIMESYNC_REQUEST) {
            uint8_t reply[MAVLINK_OUT_MAX_BYTES];
            links_send(&app->links, link, reply,
                       mavlink_out_timesync_reply(&app->links.out[link], now_us, message.as.timesync.request_ns, reply));
        }
        if (link == APP_LINK_AUTOPILOT && mavlink_in_is_autopilot(&message)) {
            on_autopilot(app, &message, now_us);
        }
        flight_on_message(&app->flight, &app->links, link, &message, now_us);
    }
}

static void send_health(struct app *app, uint64_t now_us, const struct lidar_reading *lidar)
{
    const uint32_t age_ms = lidar != NULL ? lidar->age_us / US_PER_MS : APP_LIDAR_AGE_MAX_MS;
    uint32_t round_trip_us;
    uint8_t bytes[MAVLINK_OUT_MAX_BYTES];
    float values[APP_HEALTH_FIELDS];

    app->health[APP_HEALTH_MIN_AREA_PX] = app->min_area_px;
    app->health[APP_HEALTH_PHASE] = (uint32_t)app->flight.landing.phase;
    app->health[APP_HEALTH_DROPPED_AUTOPILOT] = app->links.dropped[APP_LINK_AUTOPILOT];
    app->health[APP_HEALTH_DROPPED_GROUND] = app->links.dropped[APP_LINK_GROUND];
    app->health[APP_HEALTH_LIDAR_AGE_MS] = age_ms < APP_LIDAR_AGE_MAX_MS ? age_ms : APP_LIDAR_AGE_MAX_MS;
    app->health[APP_HEALTH_TIMESYNC_US] = 0U;
    if (timesync_is_known(&app->timesync, now_us, &round_trip_us)) {
        app->health[APP_HEALTH_TIMESYNC_US] = round_trip_us;
    }
    for (int i = 0; i < APP_HEALTH_FIELDS; i++) {
        values[i] = (float)app->health[i];
    }
    links_send(&app->links, APP_LINK_GROUND, bytes,
               mavlink_out_float_array(&app->links.out[APP_LINK_GROUND], now_us, HEALTH_ARRAY_ID, "HEALTH", values,
                                       APP_HEALTH_FIELDS, bytes));
}

// True once a period. A caller that comes late gets one turn, not a burst.
static bool due(uint64_t *next_us, uint64_t now_us, uint64_t period_us)
{
    if (now_us < *next_us) {
        return false;
    }
    *next_us += period_us;
    if (*next_us <= now_us) {
        *next_us = now_us + period_us;
    }
    return true;
}

static void watch_camera(struct app *app, uint64_t now_us)
{
    const bool lost = now_us > app->last_record_us && now_us - app->last_record_us > CAMERA_LOST_US;

    if (lost && !app->camera_lost) {
        links_say(&app->links, MAVLINK_OUT_WARNING, "Touchdown: no frames, check camera and FRAME_SIZE");
    }
    if (!lost && app->camera_lost) {
        links_say(&app->links, MAVLINK_OUT_INFO, "Touchdown: frames again");
    }
    app->camera_lost = lost;
}

static void complain(struct app *app, enum app_complaint kind, uint64_t now_us, const char *text)
{
    if (due(&app->next_complaint_us[kind], now_us, COMPLAINT_PERIOD_US)) {
        links_say(&app->links, MAVLINK_OUT_WARNING, text);
    }
}

void app_on_complaints(struct app *app, const struct app_complaints *complaints, uint64_t now_us)
{
    if (complaints->write_error) {
        app->health[APP_HEALTH_WRITE_ERRORS]++;
        complain(app, APP_COMPLAINT_WRITE, now_us, "Touchdown: memory refused a result");
    }
    if (complaints->lidar_fault) {
        app->health[APP_HEALTH_LIDAR_FAULTS]++;
        complain(app, APP_COMPLAINT_LIDAR, now_us, "Touchdown: LiDAR gives no valid reading");
    }
    if (complaints->frames_unwritten != app->health[APP_HEALTH_FRAMES_UNWRITTEN]) {
        app->health[APP_HEALTH_FRAMES_UNWRITTEN] = complaints->frames_unwritten;
        complain(app, APP_COMPLAINT_UNWRITTEN, now_us, "Touchdown: results not written in time");
    }
}

static void ask_for_time(struct app *app, uint64_t now_us)
{
    int64_t request_ns;

    if (autopilot_is_heard(&app->flight.autopilot, now_us) && timesync_ask(&app->timesync, now_us, &request_ns)) {
        uint8_t bytes[MAVLINK_OUT_MAX_BYTES];
        links_send(&app->links, APP_LINK_AUTOPILOT, bytes,
                   mavlink_out_timesync_request(&app->links.out[APP_LINK_AUTOPILOT], request_ns, bytes));
    }
}

void app_tick(struct app *app, uint64_t now_us, const struct lidar_reading *lidar)
{
    uint8_t bytes[MAVLINK_OUT_MAX_BYTES];

    // Whatever is due waits for 2 ms, rather than LANDING_TARGET for it.
    if (release_is_near(&app->release, now_us)) {
        return;
    }
    if (due(&app->next_heartbeat_us, now_us, HEARTBEAT_PERIOD_US)) {
        const char *why_not = app->fault == NULL && app->has_other_source ? "Touchdown: pixels are not the camera's" : app->fault;
        for (int link = 0; link < APP_LINKS; link++) {
            links_send(&app->links, (enum app_link)link, bytes,
                       mavlink_out_heartbeat(&app->links.out[link], why_not == NULL, bytes));
        }
        if (why_not != NULL) {
            links_say(&app->links, MAVLINK_OUT_CRITICAL, why_not);
        }
        if (app->fault == NULL) {
            send_health(app, now_us, lidar);
        }
    }
    // "Out of range" would let an autopilot arm with a sensor that is not there.
    app->lidar_worked = app->lidar_worked || (lidar != NULL && lidar->valid);
    if (lidar != NULL && app->lidar_worked && due(&app->next_distance_us, now_us, app->links.rates[APP_LINK_AUTOPILOT]->distance_period_us)) {
        links_send(&app->links, APP_LINK_AUTOPILOT, bytes,
                   mavlink_out_distance_sensor(&app->links.out[APP_LINK_AUTOPILOT], (uint32_t)(now_us / 1000U),
                                               fusion_lidar_usable(lidar), lidar->distance_mm, bytes));
    }
    if (app->fault == NULL) {
        watch_camera(app, now_us);
        ask_for_time(app, now_us);
        flight_tick(&app->flight, &app->links, &app->attitude, lidar, now_us);
    }
}

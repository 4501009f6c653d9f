// SPDX-License-Identifier: Apache-2.0
// What the firmware does, without the board: records, time and bytes in,
// MAVLink bytes out. The board and the host library differ only in the port.
#ifndef TOUCHDOWN_APP_H
#define TOUCHDOWN_APP_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "attitude.h"
#include "camera.h"
#include "detect.h"
#include "factor_search.h"
#include "flight.h"
#include "fusion.h"
#include "links.h"
#include "mavlink_in.h"
#include "mavlink_out.h"
#include "picture.h"
#include "record.h"
#include "release.h"
#include "timesync.h"
#include "tracker.h"

// What each element of the ground station's DEBUG_FLOAT_ARRAY "PAD" holds.
enum app_pad_field {
    APP_PAD_FOUND,         // 1 or 0; with 0 the fields that describe the pad are 0
    APP_PAD_X_PX,          // image of the ring's centre
    APP_PAD_Y_PX,
    APP_PAD_ANGLE_DEG,     // 0 = square above rectangle, clockwise
    APP_PAD_ALTITUDE_M,    // 0 = not known
    APP_PAD_RIGHT_M,       // pad from the camera, body axes
    APP_PAD_FORWARD_M,
    APP_PAD_FRAME_NUMBER,  // exact below 2^24
    APP_PAD_OBJECT_COUNT,
    APP_PAD_FLAGS,         // APP_FLAG_*
    APP_PAD_DOUBT,         // doubt: misfit (1 = noise alone) and what is missing or does not belong
    APP_PAD_SIZE_ALTITUDE_M, // altitude from the pad's size alone
    APP_PAD_FIELDS
};

// Bits of APP_PAD_FLAGS. The low four are the flags of the record.
#define APP_FLAG_RING 0x10U              // the ring was seen
#define APP_FLAG_SMALL_RING 0x20U        // the small ring was seen
#define APP_FLAG_ALTITUDE_LIDAR 0x40U    // the LiDAR counts in the altitude
#define APP_FLAG_ALTITUDE_PAD 0x80U      // the pad's size counts in the altitude
#define APP_FLAG_LIDAR_IMPLAUSIBLE 0x100U
#define APP_FLAG_BRIDGED 0x200U // not seen in this frame: the track's prediction

// What each element of the ground station's DEBUG_FLOAT_ARRAY "HEALTH" holds,
// once a second. Counts are since start; of records, those of the newest.
enum app_health_field {
    APP_HEALTH_RECORDS,
    APP_HEALTH_RECORDS_REJECTED, // torn or nonsense
    APP_HEALTH_PADS,             // records in which the pad was found
    APP_HEALTH_FRAMES_MALFORMED,
    APP_HEALTH_FRAMES_OVERFLOW,
    APP_HEALTH_OBJECTS_DROPPED, // of the newest record
    APP_HEALTH_MIN_AREA_PX,
    APP_HEALTH_DROPPED_AUTOPILOT, // messages that found no room on the wire
    APP_HEALTH_DROPPED_GROUND,
    APP_HEALTH_FRAMES_UNWRITTEN, // frames that the hardware could not write
    APP_HEALTH_WRITE_ERRORS,     // looks that found a refused memory write
    APP_HEALTH_LIDAR_FAULTS,     // looks that found a LiDAR fault
    APP_HEALTH_PHASE,            // enum landing_phase
    APP_HEALTH_LIDAR_AGE_MS,     // of the newest reading; APP_LIDAR_AGE_MAX_MS = that or more, or none
    APP_HEALTH_TIMESYNC_US,      // shortest of the last round trips; 0 = the autopilot's clock is not known
    APP_HEALTH_STACK_BYTES,      // the most that was in use
    APP_HEALTH_BUSY_PERMILLE,    // of the processor, in the last second
    APP_HEALTH_FRAME_US,         // the longest that a frame took the processor
    APP_HEALTH_RX_FULL_AUTOPILOT, // bytes that arrived and found no room in memory
    APP_HEALTH_RX_FULL_GROUND,
    APP_HEALTH_RX_OVERRUNS_AUTOPILOT, // times that the UART itself had lost bytes
    APP_HEALTH_RX_OVERRUNS_GROUND,
    APP_HEALTH_FIELDS
};

#define APP_LIDAR_AGE_MAX_MS 9999U

// One being streamed, one being written, two that wait to be read.
#define APP_STAGED_FRAMES 4U

// What only the board knows of itself.
struct app_vitals {
    uint32_t stack_used_bytes;
    uint32_t busy_permille;
    uint32_t frame_worst_us;
    uint32_t rx_full_bytes[APP_LINKS]; // as APP_HEALTH_RX_*
    uint32_t rx_overruns[APP_LINKS];
};

// What the hardware complains of, since the last look.
struct app_complaints {
    bool write_error;
    bool lidar_fault;
    uint32_t frames_unwritten; // its count so far
};

enum app_complaint { APP_COMPLAINT_WRITE, APP_COMPLAINT_LIDAR, APP_COMPLAINT_UNWRITTEN, APP_COMPLAINTS };

struct app {
    struct links links;
    struct mavlink_in in[APP_LINKS];
    struct flight flight;
    const char *fault;
    uint64_t next_heartbeat_us;
    uint64_t next_distance_us;
    uint64_t last_record_us;
    uint32_t last_frame_number; // 0 = none yet
    uint64_t last_target_us; // 0 = none yet
    uint64_t last_pad_us;
    uint64_t next_complaint_us[APP_COMPLAINTS];
    struct attitude attitude;
    struct timesync timesync; // with the autopilot
    struct tracker tracker;
    struct release release;
    struct pad_view last_view; // of the newest pad that was seen
    uint64_t last_view_us;     // start of its frame
    double last_doubt; // that it left when it was searched for
    bool has_last_view;
    bool last_fused; // its inner shapes were seen as one
    bool last_ringless; // it was fitted without the ring
    bool camera_lost;
    bool lidar_worked; // since power-up
    uint32_t min_area_px;
    struct factor_search factor_search;
    uint32_t factor_before; // of the newest record: the next one has its thresholds
    uint32_t health[APP_HEALTH_FIELDS];
    uint32_t detect_options; // DETECT_*
    struct detect_scratch scratch;
    struct camera seen_camera; // of the newest record, as what follows
    struct pad_estimate seen_pad;
    struct altitude seen_altitude;
    bool has_seen_pad; // found, or bridged
    bool has_other_source;  // than the camera
    uint32_t staged_frames; // records that still count as the other source's
};

// `fault` is NULL, or one sentence of at most 50 characters that says why
// landing cannot work: then HEARTBEAT is CRITICAL and the sentence is repeated.
void app_init(struct app *app, const struct app_port *port, uint64_t now_us, const char *fault);

// Parameters as they were kept over a restart, if they were. Before anything else happens.
void app_load_parameters(struct app *app, const uint8_t *bytes, size_t size);

// Says why the run before this one ended.
void app_on_crash(struct app *app, uint32_t kind, uint32_t address);

// Says that it was the watchdog that ended it.
void app_on_watchdog(struct app *app);

// For HEALTH; to be called once a second.
void app_on_vitals(struct app *app, const struct app_vitals *vitals);

// One record of `size_bytes`, as copied. Returns 0, or the RECORD_E_* for which
// it was rejected. Frames go forward only: one that is not newer than the last is
// dropped (RECORD_E_OLD), so that no LANDING_TARGET repeats and no time goes back.
int app_on_record(struct app *app, const struct landing_record *record, size_t size_bytes, uint64_t now_us);

// A record that was lost on its way here.
void app_on_lost_record(struct app *app);

// Counts in HEALTH; tells the ground station of each kind at once, then at most
// every 10 s.
void app_on_complaints(struct app *app, const struct app_complaints *complaints, uint64_t now_us);

// What MIN_AREA should be from now on. Rises while records overflow and falls
// while they are far from full, so that grass does not push the pad out.
uint32_t app_min_area_px(const struct app *app);

// Whether records are of the camera, as they are at first, or of a built-in source: then the pad is told of and shown, but
// no target goes out, nothing is steered by it, and HEARTBEAT is CRITICAL with the reason. The same goes for the first
// APP_STAGED_FRAMES records after the change back: they may have been on their way.
void app_on_source(struct app *app, bool is_camera);

// What a monitor should show of the newest record, if there was one.
void app_picture(const struct app *app, struct picture *picture);

// What THRESHOLD should hold from now on.
uint32_t app_threshold_register(const struct app *app);

// Bytes that arrived on a link.
void app_on_bytes(struct app *app, enum app_link link, const uint8_t *bytes, size_t size, uint64_t now_us);

// To be called at least every 5 ms. `lidar` is NULL when there is no LiDAR
// hardware: then, as with a LiDAR that has not given one reading since power-up,
// nothing claims a distance and the autopilot sees "no data".
void app_tick(struct app *app, uint64_t now_us, const struct lidar_reading *lidar);

#endif

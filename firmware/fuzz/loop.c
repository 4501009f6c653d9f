// SPDX-License-Identifier: Apache-2.0
// The whole application: records, bytes on both links, ticks, readings and complaints in any
// order, time that jumps, and an autopilot that flies along when the input lets it.
#include <string.h>

#include <common/mavlink.h>

#include "app.h"
#include "crash.h"
#include "frame.h"
#include "records.h"
#include "sent.h"
#include "target.h"

#define STEPS_MAX 200
#define TICK_MESSAGES_MAX 12U
#define RC_ON_US 1900U
#define RC_OFF_US 1100U

static struct app app;
static struct sent sent;
static struct landing_record record;
static struct lidar_reading lidar;
static bool lidar_there;
static uint64_t now_us;
static uint8_t kept[PARAMETERS_STORED_BYTES]; // at the last PARAM_SET
static bool has_kept;

// As the autopilot reports the modes of enum landing_mode.
static const uint32_t ardupilot_modes[LANDING_MODES] = {5U, 4U, 9U, 17U};
static const uint32_t px4_modes[LANDING_MODES] = {3U << 16U, 6U << 16U, 4U << 16U | 9U << 24U, 4U << 16U | 3U << 24U};

static enum app_link link_of(uint8_t what)
{
    return (what & 0x80U) != 0U ? APP_LINK_GROUND : APP_LINK_AUTOPILOT;
}

static void give_message(enum app_link link, uint32_t message, const uint8_t *payload, size_t size)
{
    uint8_t bytes[FRAME_MAX_BYTES];

    app_on_bytes(&app, link, bytes, frame_pack(message, payload, size, bytes), now_us);
}

static void give_heartbeat(bool px4, enum landing_mode mode, bool armed)
{
    const uint32_t code = px4 ? px4_modes[mode] : ardupilot_modes[mode];
    uint8_t payload[9] = {0};

    memcpy(payload, &code, sizeof code);
    payload[4] = (uint8_t)MAV_TYPE_QUADROTOR;
    payload[5] = (uint8_t)(px4 ? MAV_AUTOPILOT_PX4 : MAV_AUTOPILOT_ARDUPILOTMEGA);
    payload[6] = (uint8_t)(armed ? MAV_MODE_FLAG_SAFETY_ARMED : 0);
    give_message(APP_LINK_AUTOPILOT, MAVLINK_MSG_ID_HEARTBEAT, payload, sizeof payload);
}

static void give_attitude(float roll_rad, float pitch_rad)
{
    uint8_t payload[28] = {0};

    memcpy(payload + 4, &roll_rad, sizeof roll_rad);
    memcpy(payload + 8, &pitch_rad, sizeof pitch_rad);
    give_message(APP_LINK_AUTOPILOT, MAVLINK_MSG_ID_ATTITUDE, payload, sizeof payload);
}

static void give_state(struct input *input)
{
    const uint8_t landed[2] = {0U, input_u8(input)};
    uint8_t status[31] = {0};

    status[30] = input_u8(input);
    give_message(APP_LINK_AUTOPILOT, MAVLINK_MSG_ID_EXTENDED_SYS_STATE, landed, sizeof landed);
    give_message(APP_LINK_AUTOPILOT, MAVLINK_MSG_ID_SYS_STATUS, status, sizeof status);
}

static void give_rc(uint16_t value_us)
{
    uint8_t payload[42] = {0};

    for (size_t i = 0; i < MAVLINK_IN_RC_CHANNELS; i++) {
        memcpy(payload + 4U + 2U * i, &value_us, sizeof value_us);
    }
    give_message(APP_LINK_AUTOPILOT, MAVLINK_MSG_ID_RC_CHANNELS, payload, sizeof payload);
}

static void give_command(enum app_link link, uint16_t command, float first)
{
    uint8_t payload[33] = {0};

    memcpy(payload, &first, sizeof first);
    memcpy(payload + 28, &command, sizeof command);
    payload[30] = MAVLINK_OUT_SYSTEM_ID;
    payload[31] = MAVLINK_OUT_COMPONENT_ID;
    give_message(link, MAVLINK_MSG_ID_COMMAND_LONG, payload, sizeof payload);
}

static void give_any_command(struct input *input)
{
    static const uint16_t commands[] = {(uint16_t)MAV_CMD_NAV_LAND, (uint16_t)MAV_CMD_DO_GO_AROUND,
                                        (uint16_t)MAV_CMD_DO_PAUSE_CONTINUE, (uint16_t)MAV_CMD_DO_PAUSE_CONTINUE,
                                        (uint16_t)MAV_CMD_USER_1, (uint16_t)MAV_CMD_DO_SET_MODE};
    const uint8_t what = input_u8(input);

    give_command(link_of(what), commands[what % 6U], what % 6U == 3U ? 1.0F : 0.0F);
}

static void give_frame(struct input *input)
{
    uint8_t bytes[FRAME_MAX_BYTES];
    const uint8_t what = input_u8(input);
    bool intact;

    app_on_bytes(&app, link_of(what), bytes, frame_from_input(input, bytes, &intact), now_us);
}

static void give_noise(struct input *input)
{
    uint8_t bytes[64];
    const uint8_t what = input_u8(input);

    app_on_bytes(&app, link_of(what), bytes, input_take(input, bytes, what % sizeof bytes), now_us);
}

static bool commands(void)
{
    return landing_phase_table[app.flight.landing.phase].mode != LANDING_MODE_NONE;
}

static void tick(void)
{
    const bool commanded = commands();
    const uint32_t asked = app.flight.known.asked;
    const uint32_t before = sent.count[APP_LINK_AUTOPILOT] + sent.count[APP_LINK_GROUND];
    const struct autopilot *autopilot = &app.flight.autopilot;
    // LANDING_TARGET is about to go out: for 2 ms nothing else does, and nothing is decided.
    const bool waits = release_is_near(&app.release, now_us);
    const enum landing_phase phase = app.flight.landing.phase;

    sent.now_us = now_us;
    app_tick(&app, now_us, lidar_there ? &lidar : NULL);
    if (waits) {
        DEMAND(sent.count[APP_LINK_AUTOPILOT] + sent.count[APP_LINK_GROUND] == before);
        DEMAND(app.flight.landing.phase == phase && app.flight.known.asked == asked);
        return;
    }
    DEMAND(app.flight.landing.phase < LANDING_PHASES);
    const enum landing_mode mode = landing_phase_table[app.flight.landing.phase].mode;
    DEMAND(sent.count[APP_LINK_AUTOPILOT] + sent.count[APP_LINK_GROUND] - before <= TICK_MESSAGES_MAX);
    // No one lands who was not asked to, and whoever asks for an end gets it.
    DEMAND(commanded || !commands() || (asked & LANDING_FACT_START) != 0U);
    DEMAND((asked & LANDING_FACT_ABORT) == 0U || mode == LANDING_MODE_NONE || mode == LANDING_MODE_HOLD);
    DEMAND(!commands() || (autopilot_is_heard(autopilot, now_us) && autopilot->armed && !autopilot->mode_taken));
}

static void give_record(void)
{
    sent.now_us = now_us;
    (void)app_on_record(&app, &record, records_size(&record), now_us);
    DEMAND(app_min_area_px(&app) >= 30U && app_min_area_px(&app) <= 150U);
}

static void complain(struct input *input)
{
    const uint8_t what = input_u8(input);
    const struct app_complaints complaints = {
        .write_error = (what & 1U) != 0U, .lidar_fault = (what & 2U) != 0U, .frames_unwritten = what >> 4U};

    app_on_complaints(&app, &complaints, now_us);
}

static void keep(void *context, const uint8_t *bytes, size_t size)
{
    struct parameters loaded;

    (void)context;
    DEMAND(size == sizeof kept);
    memcpy(kept, bytes, sizeof kept);
    parameters_init(&loaded);
    DEMAND(parameters_load(&loaded, kept, sizeof kept) == 0);
    DEMAND(memcmp(&loaded, &app.flight.parameters, sizeof loaded) == 0);
    has_kept = true;
}

static void load_kept(struct input *input)
{
    const uint8_t what = input_u8(input);

    if (has_kept) {
        kept[what % sizeof kept] ^= what >> 4U;
        app_load_parameters(&app, kept, sizeof kept);
        has_kept = false;
    }
}

static void set_parameter(struct input *input)
{
    const size_t index = input_u8(input) % PARAMETERS_COUNT;
    const float value = input_float(input);
    uint8_t payload[23] = {0};

    memcpy(payload, &value, sizeof value);
    payload[4] = MAVLINK_OUT_SYSTEM_ID;
    payload[5] = MAVLINK_OUT_COMPONENT_ID;
    (void)strncpy((char *)payload + 6, parameters_name(index), MAVLINK_IN_PARAM_NAME_CHARS);
    payload[22] = (uint8_t)MAV_PARAM_TYPE_REAL32;
    give_message(APP_LINK_GROUND, MAVLINK_MSG_ID_PARAM_SET, payload, sizeof payload);
}

static void set_lidar(struct input *input)
{
    const uint8_t what = input_u8(input);

    lidar_there = what < 250U;
    lidar.valid = what < 230U;
    lidar.distance_mm = input_u16(input);
    lidar.age_us = what < 200U ? 0U : 1000U * input_u8(input);
}

// An autopilot that obeys, a pad or none below, a LiDAR that says the same.
static void fly_along(struct input *input)
{
    const uint8_t how = input_u8(input);
    const int steps = 1 + input_u8(input) % 24;
    const uint64_t step_us = 2000U * (uint64_t)(1U + input_u8(input) % 50U);
    const double height_m = 0.2 + 2.3 * input_share(input);
    const double x_px = 400.0 * (input_share(input) - 0.5);
    const double y_px = 400.0 * (input_share(input) - 0.5);
    const double yaw_rad = 6.3 * (input_share(input) - 0.5);
    const bool px4 = (how & 1U) != 0U;

    lidar_there = true;
    lidar = (struct lidar_reading){.valid = true, .distance_mm = (uint32_t)(1000.0 * height_m)};
    const uint32_t number = record.header.frame_number;
    const uint64_t start_us = record.header.start_time_us;
    records_clear(&record);
    record.header.frame_number = number;
    record.header.start_time_us = start_us;
    record.header.flags = LANDING_HEADER_FLAGS_ALTITUDE_VALID_MASK;
    record.header.altitude_mm = lidar.distance_mm;
    if ((how & 2U) != 0U) {
        records_paint(&record, (how & 4U) != 0U ? PAD_RING | PAD_SMALL_RING | PAD_SQUARE : PAD_RING | PAD_INNER, x_px,
                      y_px, height_m, yaw_rad, 0.0, 0.0);
    }
    for (int i = 0; i < steps; i++) {
        now_us += step_us;
        record.header.frame_number++;
        record.header.start_time_us += step_us;
        give_heartbeat(px4, landing_phase_table[app.flight.landing.phase].mode, true);
        give_attitude(0.0F, 0.0F);
        give_record();
        tick();
    }
}

static void set_switch(struct input *input)
{
    const uint8_t what = input_u8(input);

    give_rc(what < 100U ? RC_OFF_US : what < 200U ? RC_ON_US : input_u16(input));
}

static void say_heartbeat(struct input *input)
{
    const uint8_t what = input_u8(input);

    give_heartbeat((what & 1U) != 0U, (enum landing_mode)(what >> 1U & 3U), (what & 8U) == 0U);
}

static void say_attitude(struct input *input)
{
    const float roll_rad = (float)input_share(input) - 0.5F;

    give_attitude(roll_rad, (float)input_share(input) - 0.5F);
}

static void restart_words(struct input *input)
{
    const uint8_t kind = input_u8(input);

    if (kind < 128U) {
        app_on_crash(&app, kind % (CRASH_KINDS + 1U), input_u32(input));
    } else {
        app_on_lost_record(&app);
    }
}

static void step(struct input *input)
{
    const uint8_t what = input_u8(input);

    switch (what % 16U) {
    case 0:
        now_us += 1000U * (uint64_t)(what / 16U);
        tick();
        break;
    case 1:
        now_us += 1000U * (uint64_t)input_u8(input);
        tick();
        break;
    case 2:
        now_us += (uint64_t)input_u32(input) << what / 16U;
        tick();
        break;
    case 3:
        fly_along(input);
        break;
    case 4:
        give_any_command(input);
        break;
    case 5:
        say_heartbeat(input);
        break;
    case 6:
        say_attitude(input);
        break;
    case 7:
        records_next(input, &record);
        give_record();
        break;
    case 8:
        give_frame(input);
        break;
    case 9:
        give_noise(input);
        break;
    case 10:
        set_switch(input);
        break;
    case 11:
        give_state(input);
        break;
    case 12:
        set_parameter(input);
        break;
    case 13:
        set_lidar(input);
        break;
    case 14:
        load_kept(input);
        complain(input);
        break;
    default:
        restart_words(input);
        sent.full = (what & 0x80U) != 0U;
        break;
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size)
{
    struct input input = {.bytes = bytes, .left = size};
    const struct app_port port = {.write = sent_write, .keep = keep, .context = &sent};
    const uint8_t how = input_u8(&input);

    sent_init(&sent, &app.flight);
    now_us = how / 2U;
    lidar_there = false;
    has_kept = false;
    app_init(&app, &port, now_us, how == 255U ? "Touchdown: no landing_core, load the bitstream" : NULL);
    records_clear(&record);
    for (int i = 0; i < STEPS_MAX && input.left != 0U; i++) {
        step(&input);
        sent_parameters_are_sane(&app.flight.parameters);
    }
    return 0;
}

// SPDX-License-Identifier: Apache-2.0
// Joins the platform-independent application to the board.
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include "app.h"
#include "board.h"
#include "display_hw.h"
#include "gic.h"
#include "keep.h"
#include "landing_hw.h"
#include "mavlink_out.h"
#include "stack.h"
#include "timer.h"
#include "uart.h"
#include "vitals.h"
#include "watchdog.h"

#define READ_BYTES 64U
#define COMPLAINTS_PERIOD_US 100000U
#define VITALS_PERIOD_US 1000000U
#define WAIT_MAX_US 1000U
#define WAIT_TURNS 200U // more than 1 us, so that there are fewer looks than that

_Static_assert((int)UARTS == (int)VITALS_WIRES, "each UART is a wire that is watched");

static struct app app;
static struct landing_record record;
static struct vitals vitals;
static struct picture picture;
static bool has_hardware;
static bool has_display;

static enum uart_id uart_of(enum app_link link)
{
    return link == APP_LINK_AUTOPILOT ? UART_0 : UART_1;
}

static bool write(void *context, enum app_link link, const uint8_t *bytes, size_t size)
{
    (void)context;
    // Late messages are worse than lost ones: what does not fit is dropped.
    return uart_write(uart_of(link), bytes, size);
}

static void keep_parameters(void *context, const uint8_t *bytes, size_t size)
{
    (void)context;
    memcpy(keep.parameters, bytes, size <= sizeof keep.parameters ? size : 0U);
}

static uint64_t clock_us(void)
{
    return has_hardware ? landing_hw_time_us() : timer_now_us();
}

// Not farther ahead than a frame takes to be told of: the PL may have been set back.
static void wait_until(void *context, uint64_t time_us)
{
    (void)context;
    for (uint32_t looks = 0U; looks < WAIT_MAX_US; looks++) {
        const uint64_t now_us = clock_us();
        if (now_us >= time_us || time_us - now_us > WAIT_MAX_US) {
            return;
        }
        // Looks at the PL keep its bus busy.
        for (uint32_t turn = 0U; turn < WAIT_TURNS; turn++) {
            __asm__ volatile("nop");
        }
    }
}

static void read(enum app_link link, uint64_t now_us)
{
    uint8_t bytes[READ_BYTES];
    const size_t size = uart_read(uart_of(link), bytes, sizeof bytes);

    app_on_bytes(&app, link, bytes, size, now_us);
}

// An interrupt between the look and the sleep would be slept over. It is masked
// here, which does not keep it from ending the sleep.
static void sleep_until_interrupt(void)
{
    interrupts_disable();
    if (!landing_hw_frame_pending() && !uart_has_input(UART_0) && !uart_has_input(UART_1)) {
        __asm__ volatile("dsb\n\twfi" ::: "memory");
    }
    interrupts_enable();
}

// The watchdog cuts a message off, and whoever receives it takes the first bytes of this run for its rest. Zeros, as
// many as the longest message has, end it.
static void end_cut_message(void)
{
    static const uint8_t zeros[MAVLINK_OUT_MAX_BYTES];

    uart_write_polled(UART_1, zeros, sizeof zeros);
}

// Why the run before this one ended, if not by its power. After a crash the watchdog is what restarts.
static void report_restart(bool bitten)
{
    uint32_t kind;
    uint32_t address;

    if (crash_take(&keep.crash, &kind, &address)) {
        app_on_crash(&app, kind, address);
    } else if (bitten) {
        app_on_watchdog(&app);
    }
}

static void take_frame(uint64_t now_us)
{
    const int size = landing_hw_take_frame(&record);

    if (size > 0) {
        (void)app_on_record(&app, &record, (size_t)size, now_us);
        landing_hw_adapt(app_min_area_px(&app), app_threshold_register(&app));
        vitals_frame(&vitals, now_us, clock_us());
        if (has_display) {
            app_picture(&app, &picture);
            display_hw_show(&picture);
        }
    } else {
        app_on_lost_record(&app);
    }
}

static void tell_vitals(uint64_t now_us)
{
    struct app_vitals own = {
        .stack_used_bytes = stack_used_bytes(),
        .busy_permille = vitals_busy_permille(&vitals, now_us),
        .frame_worst_us = vitals.frame_worst_us,
    };

    for (int i = 0; i < APP_LINKS; i++) {
        const struct uart_losses losses = uart_lost(uart_of((enum app_link)i));
        own.rx_full_bytes[i] = losses.full_bytes;
        own.rx_overruns[i] = losses.overruns;
    }
    app_on_vitals(&app, &own);
}

static void poll_display(void)
{
    const bool frames = app.last_frame_number != 0U && !app.camera_lost;
    const struct display_lights lights = {
        .frames = frames,
        .pad = frames && app.has_seen_pad,
        .lidar = app.lidar_worked,
    };

    display_hw_poll(&lights);
    app_on_source(&app, display_hw_shows_camera());
}

static void tick(uint64_t now_us)
{
    static uint64_t next_complaints_us;
    static uint64_t next_vitals_us;

    if (now_us >= next_vitals_us) {
        tell_vitals(now_us);
        next_vitals_us = now_us + VITALS_PERIOD_US;
    }
    if (!has_hardware) {
        app_tick(&app, now_us, NULL);
        return;
    }
    const struct lidar_reading lidar = landing_hw_lidar();

    if (now_us >= next_complaints_us) {
        const struct app_complaints complaints = landing_hw_complaints();
        app_on_complaints(&app, &complaints, now_us);
        if (has_display) {
            poll_display();
        }
        next_complaints_us = now_us + COMPLAINTS_PERIOD_US;
    }
    app_tick(&app, now_us, &lidar);
}

static void feed_watchdog(uint64_t now_us)
{
    struct vitals_signs signs = {.now_us = now_us, .ticks = timer_ticks()};

    for (int i = 0; i < UARTS; i++) {
        signs.wires[i].waiting = uart_is_sending((enum uart_id)i);
        signs.wires[i].sent = uart_sent((enum uart_id)i);
    }
    if (vitals_may_feed(&vitals, &signs)) {
        watchdog_feed();
    }
}

static void round_of_main_loop(void)
{
    const uint64_t woke_us = clock_us();
    uint64_t now_us = woke_us;

    if (landing_hw_frame_pending()) {
        take_frame(now_us);
        // A record takes long enough to make TIMESYNC's answer late.
        now_us = clock_us();
    }
    read(APP_LINK_AUTOPILOT, now_us);
    read(APP_LINK_GROUND, now_us);
    tick(now_us);
    now_us = clock_us();
    feed_watchdog(now_us);
    vitals_round(&vitals, woke_us, now_us);
}

int main(void)
{
    static const struct app_port port = {
        .write = write,
        .wait_until = wait_until,
        .keep = keep_parameters,
        .context = NULL,
        .baud = {[APP_LINK_AUTOPILOT] = BOARD_AUTOPILOT_BAUD, [APP_LINK_GROUND] = BOARD_GROUND_BAUD},
    };

    gic_init();
    timer_init();
    uart_init(UART_0, BOARD_AUTOPILOT_BAUD);
    uart_init(UART_1, BOARD_GROUND_BAUD);
    interrupts_enable();

    // Asked in any case: the note must not be there for the next start.
    const bool bitten = watchdog_has_bitten();
    if (bitten) {
        end_cut_message();
    }
    const char *fault = landing_hw_fault();
    has_hardware = fault == NULL;
    app_init(&app, &port, clock_us(), fault);
    report_restart(bitten);
    app_load_parameters(&app, keep.parameters, sizeof keep.parameters);
    if (has_hardware) {
        landing_hw_start(app_min_area_px(&app), app_threshold_register(&app));
        has_display = display_hw_is_there();
        if (has_display) {
            display_hw_start();
        }
    }
    vitals_init(&vitals, clock_us());
    watchdog_start();
    // Endless: the main loop; each turn ends in a sleep of at most one tick.
    for (;;) {
        round_of_main_loop();
        sleep_until_interrupt();
    }
}

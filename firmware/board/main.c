// SPDX-License-Identifier: Apache-2.0
// Joins the platform-independent application to the board.
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "app.h"
#include "board.h"
#include "gic.h"
#include "keep.h"
#include "landing_hw.h"
#include "timer.h"
#include "uart.h"

#define READ_BYTES 64U
#define COMPLAINTS_PERIOD_US 100000U

static struct app app;
static struct landing_record record;

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

static void report_crash(void)
{
    uint32_t kind;
    uint32_t address;

    if (crash_take(&keep.crash, &kind, &address)) {
        app_on_crash(&app, kind, address);
    }
}

int main(void)
{
    static const struct app_port port = {
        .write = write,
        .context = NULL,
        .baud = {[APP_LINK_AUTOPILOT] = BOARD_AUTOPILOT_BAUD, [APP_LINK_GROUND] = BOARD_GROUND_BAUD},
    };

    gic_init();
    timer_init();
    uart_init(UART_0, BOARD_AUTOPILOT_BAUD);
    uart_init(UART_1, BOARD_GROUND_BAUD);
    interrupts_enable();

    const char *fault = landing_hw_fault();
    const bool has_hardware = fault == NULL;
    app_init(&app, &port, has_hardware ? landing_hw_time_us() : timer_now_us(), fault);
    report_crash();
    app_load_parameters(&app, keep.parameters, sizeof keep.parameters);
    if (has_hardware) {
        landing_hw_start(app_min_area_px(&app), app_threshold_register(&app));
    }
    uint64_t next_complaints_us = 0;
    // Endless: the main loop; each turn ends in a sleep of at most one tick.
    for (;;) {
        uint64_t now_us = has_hardware ? landing_hw_time_us() : timer_now_us();

        if (landing_hw_frame_pending()) {
            const int size = landing_hw_take_frame(&record);
            if (size > 0) {
                (void)app_on_record(&app, &record, (size_t)size, now_us);
                landing_hw_adapt(app_min_area_px(&app), app_threshold_register(&app));
                // A record takes long enough to make TIMESYNC's answer late.
                now_us = landing_hw_time_us();
            } else {
                app_on_lost_record(&app);
            }
        }
        read(APP_LINK_AUTOPILOT, now_us);
        read(APP_LINK_GROUND, now_us);
        if (has_hardware) {
            const struct lidar_reading lidar = landing_hw_lidar();
            if (now_us >= next_complaints_us) {
                const struct app_complaints complaints = landing_hw_complaints();
                app_on_complaints(&app, &complaints, now_us);
                next_complaints_us = now_us + COMPLAINTS_PERIOD_US;
            }
            app_tick(&app, now_us, &lidar);
        } else {
            app_tick(&app, now_us, NULL);
        }
        (void)app_parameters_to_keep(&app, keep.parameters);
        sleep_until_interrupt();
    }
}

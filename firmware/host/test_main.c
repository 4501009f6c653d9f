// SPDX-License-Identifier: Apache-2.0
#include <math.h>
#include <stdarg.h>
#include <stdio.h>

#include "test.h"

static int checks;
static int failures;
static char about[120] = "start";

void test_case(const char *format, ...)
{
    va_list arguments;

    va_start(arguments, format);
    (void)vsnprintf(about, sizeof about, format, arguments);
    va_end(arguments);
}

void test_check(bool ok, const char *file, int line, const char *text)
{
    checks++;
    if (!ok) {
        failures++;
        (void)fprintf(stderr, "%s:%d: %s: not true: %s\n", file, line, about, text);
    }
}

void test_near(double got, double expected, double tolerance, const char *file, int line, const char *text)
{
    checks++;
    if (!(fabs(got - expected) <= tolerance)) {
        failures++;
        (void)fprintf(stderr, "%s:%d: %s: %s is %.9g, expected %.9g within %.3g\n", file, line, about, text, got,
                      expected, tolerance);
    }
}

int main(void)
{
    test_app();
    test_app_track();
    test_attitude();
    test_autopilot();
    test_byte_ring();
    test_camera();
    test_crash();
    test_detect();
    test_detect_not();
    test_display_hw();
    test_factor_search();
    test_flight();
    test_flight_modes();
    test_frame_queue();
    test_fusion();
    test_grid();
    test_ground();
    test_hypothesis();
    test_landing();
    test_landing_hw();
    test_mavlink_in();
    test_mavlink_out();
    test_pad_fit();
    test_pad_view();
    test_parameters();
    test_picture();
    test_rates();
    test_record();
    test_release();
    test_record_torn();
    test_search();
    test_shapes();
    test_steering();
    test_timesync();
    test_tracker();
    test_uart();
    test_uart_baud();
    test_vitals();
    test_watchdog();
    (void)printf("unit_tests: %d checks, %d failures\n", checks, failures);
    return failures == 0 ? 0 : 1;
}

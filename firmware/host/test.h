// SPDX-License-Identifier: Apache-2.0
// The least that a unit test needs: checks that print what they saw, and go on.
#ifndef TOUCHDOWN_TEST_H
#define TOUCHDOWN_TEST_H

#include <stdbool.h>

void test_check(bool ok, const char *file, int line, const char *text);
void test_near(double got, double expected, double tolerance, const char *file, int line, const char *text);

#define CHECK(condition) test_check((condition), __FILE__, __LINE__, #condition)
#define NEAR(got, expected, tolerance) test_near((got), (expected), (tolerance), __FILE__, __LINE__, #got)

// What the checks that follow are about; printed with a failure.
void test_case(const char *format, ...) __attribute__((format(printf, 1, 2)));

void test_app(void);
void test_app_track(void);
void test_attitude(void);
void test_autopilot(void);
void test_byte_ring(void);
void test_camera(void);
void test_crash(void);
void test_detect(void);
void test_detect_not(void);
void test_display_hw(void);
void test_factor_search(void);
void test_flight(void);
void test_flight_modes(void);
void test_frame_queue(void);
void test_fusion(void);
void test_grid(void);
void test_ground(void);
void test_hypothesis(void);
void test_landing(void);
void test_landing_hw(void);
void test_mavlink_in(void);
void test_mavlink_out(void);
void test_pad_fit(void);
void test_pad_view(void);
void test_parameters(void);
void test_picture(void);
void test_rates(void);
void test_record(void);
void test_release(void);
void test_record_torn(void);
void test_search(void);
void test_shapes(void);
void test_steering(void);
void test_timesync(void);
void test_tracker(void);
void test_uart(void);
void test_uart_baud(void);
void test_vitals(void);
void test_watchdog(void);

#endif

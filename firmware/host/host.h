// SPDX-License-Identifier: Apache-2.0
// The firmware as a library on the host: the same core as on the board, without
// the board. One instance a process.
#ifndef TOUCHDOWN_HOST_H
#define TOUCHDOWN_HOST_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum touchdown_link { TOUCHDOWN_AUTOPILOT = 0, TOUCHDOWN_GROUND = 1 }; // UART0, UART1

// Called with one whole MAVLink message at a time, from within the calls below.
typedef void (*touchdown_write)(void *context, int link, const uint8_t *bytes, size_t size);

// How fast the wires of the next touchdown_init are, in baud; at first, and with 0, without a limit.
void touchdown_set_bauds(uint32_t autopilot, uint32_t ground);

// All times are microseconds since reset of the hardware, and never go back.
void touchdown_init(touchdown_write write, void *context, uint64_t now_us);

// A result record: header and its objects, as the ring holds them. Returns 0,
// or a negative number (core/record.h) when it is rejected. Frame numbers must rise.
int touchdown_on_record(const void *bytes, size_t size, uint64_t now_us);

// What the firmware would now write into MIN_AREA, in pixels.
uint32_t touchdown_min_area(void);

// What THRESHOLD should hold from now on.
uint32_t touchdown_threshold(void);

// DETECT_* of firmware/core/detect.h; touchdown_init sets all.
void touchdown_set_options(uint32_t options);

// Bytes that the other end of a link sent.
void touchdown_on_bytes(int link, const uint8_t *bytes, size_t size, uint64_t now_us);

// To be called every millisecond or so; sends what is due. The LiDAR's values
// are those of the registers LIDAR_STATUS.valid, LIDAR_DISTANCE and LIDAR_AGE.
void touchdown_tick(uint64_t now_us, bool lidar_valid, uint32_t lidar_distance_mm, uint32_t lidar_age_us);

#endif

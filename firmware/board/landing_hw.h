// SPDX-License-Identifier: Apache-2.0
// landing_core in the PL: its registers, interrupt and result ring.
#ifndef TOUCHDOWN_LANDING_HW_H
#define TOUCHDOWN_LANDING_HW_H

#include <stdbool.h>
#include <stdint.h>

#include "app.h"
#include "fusion.h"
#include "landing_regs.h"

// NULL when the hardware is there and fits this firmware, or one sentence that
// says what is wrong.
const char *landing_hw_fault(void);

// Configures the hardware, then enables it.
void landing_hw_start(uint32_t min_area_px, uint32_t threshold);

// MIN_AREA and THRESHOLD, from the next frame on.
void landing_hw_adapt(uint32_t min_area_px, uint32_t threshold);

// Microseconds since reset of the PL. Only from the main loop: reading the low
// half latches the high one.
uint64_t landing_hw_time_us(void);

struct lidar_reading landing_hw_lidar(void);

// Acknowledges what it reports.
struct app_complaints landing_hw_complaints(void);

bool landing_hw_frame_pending(void);

// Copies the oldest pending record. Returns its size in bytes, or RECORD_E_TORN
// or RECORD_E_COUNT.
int landing_hw_take_frame(struct landing_record *record);

#endif

// SPDX-License-Identifier: Apache-2.0
// The monitor, where the bitstream has one (FEATURES.display of landing_core), with the board's buttons, switches and LEDs.
#ifndef TOUCHDOWN_DISPLAY_HW_H
#define TOUCHDOWN_DISPLAY_HW_H

#include <stdbool.h>

#include "picture.h"

// What the LEDs tell: LED 0 to 3.
struct display_lights {
    bool frames; // records come
    bool pad;    // the pad is seen
    bool lidar;  // the LiDAR has given a reading since power-up
};

// True when there is a display that this firmware knows; then only may the rest be called.
bool display_hw_is_there(void);

void display_hw_start(void);

// Draws; of the text only characters that have changed are written.
void display_hw_show(const struct picture *picture);

// Buttons, switches and LEDs: to be called a few times a second or more often. Button 0 takes the next view. Switches
// 1 and 0: 0 camera, 1 pattern, 2 pattern that moves, 3 stored picture.
void display_hw_poll(const struct display_lights *lights);

// False from the moment on in which display_hw_poll chose another source.
bool display_hw_shows_camera(void);

#endif

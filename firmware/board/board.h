// SPDX-License-Identifier: Apache-2.0
// Facts of the board (Arty Z7-20) and of its wiring that no register tells.
#ifndef TOUCHDOWN_BOARD_H
#define TOUCHDOWN_BOARD_H

#include <assert.h>

// Half of the CPU clock of 650 MHz. Only time without the PL and the length of
// a tick depend on it: with the PL, the PL's microseconds are the time.
#define BOARD_PERIPHCLK_HZ 325000000U
#define BOARD_UART_CLOCK_HZ 100000000U

// make's AUTOPILOT_BAUD and GROUND_BAUD say otherwise.
#ifndef BOARD_AUTOPILOT_BAUD
#define BOARD_AUTOPILOT_BAUD 921600U // UART0
#endif
#ifndef BOARD_GROUND_BAUD
#define BOARD_GROUND_BAUD 57600U // UART1
#endif
// Below, the rates do not fit.
static_assert(BOARD_AUTOPILOT_BAUD >= 57600U && BOARD_GROUND_BAUD >= 57600U,
              "AUTOPILOT_BAUD and GROUND_BAUD have to be 57600 or more");

#define BOARD_FRAME_WIDTH_PX 1280U
#define BOARD_FRAME_HEIGHT_PX 720U
#define BOARD_STORED_PICTURE_ADDRESS 0x04000000U // what frame_source plays; beyond what the firmware uses

#endif

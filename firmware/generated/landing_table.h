// SPDX-License-Identifier: Apache-2.0
// Generated from firmware/landing.toml by python -m scripts.landing. Do not edit.
#ifndef LANDING_TABLE_H
#define LANDING_TABLE_H

#include <stdint.h>

enum landing_phase {
    LANDING_PHASE_STANDBY,
    LANDING_PHASE_ENGAGE,
    LANDING_PHASE_SEARCH,
    LANDING_PHASE_CENTRE,
    LANDING_PHASE_DESCEND,
    LANDING_PHASE_ALIGN,
    LANDING_PHASE_LAND,
    LANDING_PHASE_TOUCHDOWN,
    LANDING_PHASE_LANDED,
    LANDING_PHASE_HOLD,
    LANDING_PHASE_WAIT,
    LANDING_PHASE_CLIMB,
    LANDING_PHASE_GIVE_UP,
    LANDING_PHASES
};

enum landing_mode {
    LANDING_MODE_NONE,
    LANDING_MODE_STEER,
    LANDING_MODE_LAND,
    LANDING_MODE_HOLD,
    LANDING_MODES
};

enum landing_steer {
    LANDING_STEER_NONE,
    LANDING_STEER_STOP,
    LANDING_STEER_SEARCH,
    LANDING_STEER_CENTRE,
    LANDING_STEER_DESCEND,
    LANDING_STEER_ALIGN,
    LANDING_STEER_CLIMB,
    LANDING_STEERS
};

// What is known in a cycle.
#define LANDING_FACT_TIME_OUT 0x00000001u // the phase's time limit has passed
#define LANDING_FACT_START 0x00000002u // a start is wanted: RC switch turned on, or command from the ground; holds for one cycle
#define LANDING_FACT_ABORT 0x00000004u // an abort is wanted: RC switch turned off, or command from the ground; holds for one cycle
#define LANDING_FACT_PAUSE 0x00000008u // the ground wants it to stand still; holds for one cycle
#define LANDING_FACT_GO_ON 0x00000010u // the ground wants it to go on; holds for one cycle
#define LANDING_FACT_AUTOPILOT_SILENT 0x00000020u // no HEARTBEAT of the autopilot for 3 s
#define LANDING_FACT_ARMED 0x00000040u // its newest HEARTBEAT says so
#define LANDING_FACT_IN_MODE 0x00000080u // the autopilot is in the mode that the phase wants
#define LANDING_FACT_PILOT 0x00000100u // the autopilot went into a mode that was not asked for
#define LANDING_FACT_REFUSED 0x00000200u // it rejected the mode, did not take it after 5 requests, or accepted it and has not shown it for 2.5 s
#define LANDING_FACT_ON_GROUND 0x00000400u // EXTENDED_SYS_STATE says landed
#define LANDING_FACT_BATTERY_LOW 0x00000800u // SYS_STATUS says less than TD_BATT_MIN percent
#define LANDING_FACT_GROUND_LOST 0x00001000u // TD_GCS_NEEDED is 1, and no HEARTBEAT of a ground station for 5 s
#define LANDING_FACT_CAMERA_LOST 0x00002000u // no good record for 0.3 s
#define LANDING_FACT_LIDAR_STALE 0x00004000u // no usable reading for 0.3 s
#define LANDING_FACT_LIDAR_CONTRADICTS 0x00008000u // for 0.5 s and more each reading contradicted the size of the pad, which is not lost
#define LANDING_FACT_ATTITUDE_STALE 0x00010000u // no ATTITUDE for 0.25 s: what is level is not known
#define LANDING_FACT_PAD 0x00020000u // the pad is seen: in 5 frames in a row of one track, with no gap of more than 0.1 s and a fresh ATTITUDE to each; a frame that the tracker bridges does not count
#define LANDING_FACT_PAD_LOST 0x00040000u // no frame with the pad for 0.5 s
#define LANDING_FACT_TRIES_USED 0x00080000u // it had to WAIT more than TD_TRIES times since the start
#define LANDING_FACT_HIGH 0x00100000u // within 0.1 m of the search height, or above
#define LANDING_FACT_AT_SEARCH 0x00200000u // within 0.2 m of the search height
#define LANDING_FACT_CENTRED 0x00400000u // for 1 s the pad was within 8 cm + 5 % of the height of the point below the camera
#define LANDING_FACT_LOW 0x00800000u // at the height for aligning, or below
#define LANDING_FACT_ALIGNED 0x01000000u // centred, and for 1 s within 4 degrees of the pad's orientation
#define LANDING_FACT_COMMITTED 0x02000000u // for 0.4 s without a break lower than TD_COMMIT_M, and than TD_ALIGN_M less 0.1 m, uncontradicted: landing is safer than turning back

struct landing_phase_row {
    const char *name;
    enum landing_mode mode;   // what the autopilot is to be in
    enum landing_steer steer; // how velocities are made
    uint32_t limit_s;         // 0 = none
};

struct landing_rule {
    uint32_t from;   // a bit a phase
    uint32_t when;   // facts that have to hold
    uint32_t unless; // facts that must not
    enum landing_phase to;
    uint8_t severity; // MAV_SEVERITY
    const char *reason;
};

#define LANDING_RULES 59u

extern const struct landing_phase_row landing_phase_table[LANDING_PHASES];
extern const struct landing_rule landing_rules[LANDING_RULES];

#endif

// SPDX-License-Identifier: Apache-2.0
// Generated from firmware/landing.toml by python -m scripts.landing. Do not edit.
#ifndef LANDING_PARAMETERS_H
#define LANDING_PARAMETERS_H

// X(member, name on the wire, least, most, usual)
#define LANDING_PARAMETERS(X) \
    X(search_height_m, "TD_SEARCH_M", 1.0F, 3.0F, 1.8F) \
    X(align_height_m, "TD_ALIGN_M", 0.6F, 1.5F, 1.0F) \
    X(commit_height_m, "TD_COMMIT_M", 0.2F, 0.8F, 0.4F) \
    X(speed_m_s, "TD_SPEED", 0.1F, 1.0F, 0.5F) \
    X(descent_m_s, "TD_DESCENT", 0.1F, 0.5F, 0.25F) \
    X(gain_per_s, "TD_GAIN", 0.2F, 1.5F, 0.7F) \
    X(yaw_rate_deg_s, "TD_YAW_RATE", 5.0F, 45.0F, 20.0F) \
    X(tries, "TD_TRIES", 1.0F, 10.0F, 3.0F) \
    X(rc_channel, "TD_RC_CHAN", 0.0F, 18.0F, 8.0F) \
    X(battery_min_percent, "TD_BATT_MIN", 0.0F, 80.0F, 20.0F) \
    X(ground_needed, "TD_GCS_NEEDED", 0.0F, 1.0F, 0.0F)

#endif

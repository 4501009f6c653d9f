// SPDX-License-Identifier: Apache-2.0
#include "attitude.h"

#include <math.h>

#include "bounds.h"

// Beyond it no one lands, and the tangents grow without bound.
#define ANGLE_MAX_RAD 1.0
// Of the message, of the camera's mounting, and of the ground, which is not quite level.
#define TILT_SIGMA 0.025
// A line through two that are further apart says little of what comes after, and this much later it says nothing.
#define LINE_MAX_US 100000U
#define AHEAD_MAX_US 50000U

static const struct attitude_sample *sample_of(const struct attitude *attitude, uint32_t back)
{
    return &attitude->samples[(attitude->newest + ATTITUDE_SAMPLES - back) % ATTITUDE_SAMPLES];
}

static void hold(struct attitude *attitude, const struct attitude_sample *sample)
{
    const uint64_t before_us = sample_of(attitude, 0U)->time_us;

    if (attitude->count != 0U && sample->time_us == before_us) {
        attitude->samples[attitude->newest] = *sample;
        return;
    }
    // Over a gap nothing is known, and time that goes back is another clock.
    if (attitude->count != 0U &&
        (sample->time_us < before_us || sample->time_us - before_us > ATTITUDE_MAX_AGE_US)) {
        attitude->count = 0U;
    }
    attitude->newest = (attitude->newest + 1U) % ATTITUDE_SAMPLES;
    attitude->samples[attitude->newest] = *sample;
    attitude->count += attitude->count < ATTITUDE_SAMPLES ? 1U : 0U;
}

void attitude_set(struct attitude *attitude, double roll_rad, double pitch_rad, uint64_t time_us, uint64_t now_us)
{
    // Also false for NaN.
    if (!(fabs(roll_rad) <= ANGLE_MAX_RAD) || !(fabs(pitch_rad) <= ANGLE_MAX_RAD)) {
        attitude->known = false;
        attitude->count = 0U;
        return;
    }
    const struct attitude_sample sample = {.time_us = time_us, .roll_rad = roll_rad, .pitch_rad = pitch_rad};

    hold(attitude, &sample);
    attitude->known = true;
    attitude->received_us = now_us;
    attitude->roll_rad = roll_rad;
    attitude->pitch_rad = pitch_rad;
}

static double on_line(double from, double to, double share)
{
    return at_most(at_least(from + (to - from) * share, -ANGLE_MAX_RAD), ANGLE_MAX_RAD);
}

// `time_us` is not before `from`.
static void read_line(const struct attitude_sample *from, const struct attitude_sample *to, uint64_t time_us,
                      double *roll_rad, double *pitch_rad)
{
    const double share = (double)(time_us - from->time_us) / (double)(to->time_us - from->time_us);

    *roll_rad = on_line(from->roll_rad, to->roll_rad, share);
    *pitch_rad = on_line(from->pitch_rad, to->pitch_rad, share);
}

static uint64_t least(uint64_t a, uint64_t b)
{
    return a < b ? a : b;
}

bool attitude_at(const struct attitude *attitude, uint64_t time_us, uint64_t now_us, double *roll_rad,
                 double *pitch_rad)
{
    if (!attitude->known || now_us > attitude->received_us + ATTITUDE_MAX_AGE_US) {
        return false;
    }
    const struct attitude_sample *to = sample_of(attitude, 0U);
    const uint64_t wanted_us = least(time_us, now_us);

    *roll_rad = to->roll_rad;
    *pitch_rad = to->pitch_rad;
    for (uint32_t back = 1U; back < attitude->count; back++) {
        const struct attitude_sample *from = sample_of(attitude, back);
        const uint64_t apart_us = to->time_us - from->time_us;

        if (wanted_us > to->time_us) {
            // Only with the newest pair.
            if (apart_us <= LINE_MAX_US) {
                const uint64_t ahead_us = least(least(wanted_us - to->time_us, apart_us), AHEAD_MAX_US);
                read_line(from, to, to->time_us + ahead_us, roll_rad, pitch_rad);
            }
            return true;
        }
        if (wanted_us >= from->time_us) {
            read_line(from, to, wanted_us, roll_rad, pitch_rad);
            return true;
        }
        *roll_rad = from->roll_rad;
        *pitch_rad = from->pitch_rad;
        to = from;
    }
    return true;
}

bool attitude_tilt(const struct attitude *attitude, uint64_t time_us, uint64_t now_us, struct tilt_hint *tilt)
{
    double roll_rad;
    double pitch_rad;

    if (!attitude_at(attitude, time_us, now_us, &roll_rad, &pitch_rad)) {
        return false;
    }
    // Down, turned by pitch and roll, in camera axes: (sin r cos p, sin p, cos r cos p).
    tilt->x = tan(roll_rad);
    tilt->y = tan(pitch_rad) / cos(roll_rad);
    tilt->sigma = TILT_SIGMA;
    return true;
}

// SPDX-License-Identifier: Apache-2.0
#include "attempt.h"

#include <stddef.h>

#include "doubt.h"
#include "estimate.h"

// How much doubt a view may leave: its misfit, and what is missing or does not belong.
#define DOUBT_MAX 2.0
// A view this bad may be the mirror image of a better one.
#define MIRROR_MISFIT 1.5

// The same picture to first order: a plane that is tilted the other way about the ray to its centre.
static bool mirror(const struct detect_context *context, struct pad_view *view)
{
    struct pad_plane plane;
    double direction[3];

    if (pad_plane_of(view, context->camera, &plane) != 0 ||
        camera_direction(context->camera, view->value[PAD_X_PX], view->value[PAD_Y_PX], direction) != 0) {
        return false;
    }
    const double along =
        plane.normal[0] * direction[0] + plane.normal[1] * direction[1] + plane.normal[2] * direction[2];
    const double z = 2.0 * along * direction[2] - plane.normal[2];
    if (!(z > 0.3)) {
        return false;
    }
    view->value[PAD_TILT_X] = (2.0 * along * direction[0] - plane.normal[0]) / z;
    view->value[PAD_TILT_Y] = (2.0 * along * direction[1] - plane.normal[1]) / z;
    return true;
}

// `whole`: to its end, and DETECT_E_GOES_ON when time is over before; the hypothesis has come nearer then. Else as near as
// there is time.
static int fit(const struct detect_context *context, bool whole, struct hypothesis *hypothesis,
               struct reading *reading, double *misfit, double *worst)
{
    struct reading before = {.kinds = 0U};

    // The first fit brings all shapes into reach; the second uses them, if there are others now.
    // Bounded: the second time round the hypothesis is fitted, and the loop ends.
    for (;;) {
        if (reading_take(context, hypothesis, reading) != 0 || reading->evidence.count < 2) {
            return DETECT_E_NO_PAD;
        }
        if (hypothesis->fitted && reading_same(reading, &before)) {
            return 0;
        }
        const int result = pad_fit(&reading->evidence, context->camera, &context->hint->tilt, &hypothesis->view, misfit,
                                   worst, &hypothesis->progress, context->work);
        if (result == PAD_FIT_E_LOST) {
            return DETECT_E_NO_PAD;
        }
        if (whole && result == PAD_FIT_UNFINISHED) {
            return DETECT_E_GOES_ON;
        }
        if (hypothesis->fitted) {
            return 0;
        }
        hypothesis->fitted = true;
        hypothesis->progress = (struct pad_fit_progress){.steps = 0};
        before = *reading;
        if (whole && work_is_over(context->work)) {
            return DETECT_E_GOES_ON;
        }
    }
}

// Takes the mirror image where that is the better one.
static void try_mirrored(const struct detect_context *context, bool fused, struct search_round *round,
                         struct reading *reading, struct pad_estimate *pad)
{
    struct hypothesis other = {.view = pad->view, .fused = fused, .mirrored = true};
    struct pad_estimate mirrored = {.fused = fused};
    struct reading mirrored_reading;
    double worst = 0.0;

    if (!mirror(context, &other.view)) {
        return;
    }
    if (work_is_over(context->work)) {
        round->fitting = true;
        round->fit = other;
        return;
    }
    const int result = fit(context, true, &other, &mirrored_reading, &mirrored.misfit, &worst);
    if (result == DETECT_E_GOES_ON) {
        round->fitting = true;
        round->fit = other;
    }
    if (result != 0) {
        return;
    }
    mirrored.view = other.view;
    mirrored.doubt = doubt_of(context, &mirrored_reading, &other.view, mirrored.misfit, worst);
    if (mirrored.doubt >= 0.0 && (pad->doubt < 0.0 || mirrored.doubt < pad->doubt)) {
        *pad = mirrored;
        *reading = mirrored_reading;
    }
}

int attempt(const struct detect_context *context, const struct hypothesis *hypothesis, struct search_round *round,
            struct pad_estimate *pad)
{
    struct hypothesis tried = *hypothesis;
    struct reading reading;
    double worst = 0.0;

    pad->misfit = 0.0;
    const int result = fit(context, round != NULL, &tried, &reading, &pad->misfit, &worst);
    if (round != NULL && result == DETECT_E_GOES_ON) {
        round->fitting = true;
        round->fit = tried;
    }
    if (result != 0) {
        return DETECT_E_NO_PAD;
    }
    pad->view = tried.view;
    pad->fused = tried.fused;
    pad->doubt = doubt_of(context, &reading, &pad->view, pad->misfit, worst);
    // What is followed had its mirror image tried when it was searched for.
    if (round != NULL && !tried.mirrored && pad->misfit > MIRROR_MISFIT && reading.evidence.count >= 3) {
        try_mirrored(context, tried.fused, round, &reading, pad);
    }
    if (pad->doubt < 0.0 || pad->doubt > DOUBT_MAX) {
        return DETECT_E_NO_PAD;
    }
    pad->ringless = !reading_has(&reading, PAD_RING);
    return estimate_of(context, &reading, pad);
}

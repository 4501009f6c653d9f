// SPDX-License-Identifier: Apache-2.0
#include "detect.h"

#include <stddef.h>

#include "attempt.h"
#include "bounds.h"
#include "hypothesis.h"

// A shape smaller than this has edges that are as large as itself.
#define AREA_MIN_PX 20U
// Among so many objects some lie as a pad's would.
#define CROWD 150

// With this little doubt no other hypothesis is tried.
#define DOUBT_NONE 0.6
// As much as when it was searched for, but for noise. In each frame a little less is allowed, so that what leaves doubt
// is searched for again after ten: something better may have come into sight.
#define DOUBT_SAME 1.2
#define DOUBT_FADES 0.98
// A fit that has not ended after so many frames of its share is given up.
#define FIT_FRAMES_MAX 16
// So long the places of a list are good enough for a fit, though the camera moves.
#define LIST_FRAMES_MAX 3
// So many lists of a kind at most, each from a few candidates before the one with which the last has ended.
#define LISTS_MAX 6
#define DRIFT 4

const struct detect_hint detect_no_hint = {
    .tilt = {.x = 0.0, .y = 0.0, .sigma = 0.25}, .height_m = 0.0, .searching = false, .last = NULL};

static const struct search_round no_round = {.kind = SEARCH_PAIRS};

static void collect(const struct landing_record *record, const struct camera *camera, struct detect_scratch *scratch)
{
    const uint32_t right = (uint32_t)camera->width_px - 1U;
    const uint32_t bottom = (uint32_t)camera->height_px - 1U;

    scratch->count = 0;
    for (uint32_t i = 0; i < record->header.object_count; i++) {
        const struct landing_object *object = &record->objects[i];
        struct candidate *candidate = &scratch->candidates[scratch->count];
        if (object->area < AREA_MIN_PX || shape_from_object(object, &candidate->shape) != 0) {
            continue;
        }
        candidate->clipped = object->box_min_x == 0U || object->box_min_y == 0U || object->box_max_x >= right ||
                             object->box_max_y >= bottom;
        candidate->sight = SIGHT_UNKNOWN;
        scratch->count++;
    }
}

// Makes the list of which the round is to try the hypotheses.
static void make_list(const struct detect_context *context, struct search_round *round)
{
    const struct hypothesis_source source = {.grid = context->grid,
                                             .camera = context->camera,
                                             .height_m = context->hint->height_m,
                                             .options = context->options};
    struct work *work = context->work;
    struct hypotheses *list = &round->list;

    // What a list has taken, no fit may take again.
    work->granted = false;
    list->count = 0;
    round->listed = true;
    round->list_frames = 0;
    round->next = 0;
    round->of = context->scratch->count;
    if (round->kind == SEARCH_PAIRS) {
        round->next = hypotheses_from_pairs(&source, round->from, work, list);
    } else if (round->kind == SEARCH_SMALL_RINGS && (context->options & DETECT_CLOSE) != 0U) {
        round->next = hypotheses_from_small_rings(&source, round->from, work, list);
    } else if (round->kind == SEARCH_RINGS && (context->options & DETECT_FUSED) != 0U) {
        round->next = hypotheses_from_rings(&source, round->from, work, list);
    }
}

// Tries one and keeps the better of it and what was found in this frame. True when nothing better can come.
static bool try_one(const struct detect_context *context, const struct hypothesis *hypothesis,
                    struct pad_estimate *pad, bool *found)
{
    struct search_round *round = &context->scratch->round;
    struct pad_estimate tried;

    round->fitting = false;
    if (attempt(context, hypothesis, round, &tried) != 0) {
        return false;
    }
    round->found = true;
    if (!*found || tried.doubt < pad->doubt) {
        *pad = tried;
        *found = true;
    }
    return tried.doubt < DOUBT_NONE;
}

// The fit that had no time to end. True when the rest has time in this frame.
static bool go_on_fitting(const struct detect_context *context, struct pad_estimate *pad, bool *found)
{
    struct search_round *round = &context->scratch->round;
    const struct hypothesis hypothesis = round->fit;

    round->fit_frames++;
    if (try_one(context, &hypothesis, pad, found)) {
        return true;
    }
    if (round->fit_frames >= FIT_FRAMES_MAX) {
        round->fitting = false;
    }
    return !round->fitting;
}

// Those of the list that had no turn yet. True when all had theirs.
static bool try_list(const struct detect_context *context, struct pad_estimate *pad, bool *found)
{
    struct search_round *round = &context->scratch->round;

    // Bounded: turn rises by one each time, to at most HYPOTHESES.
    while (round->turn < round->list.count) {
        if (work_is_scarce(context->work)) {
            return false;
        }
        const struct hypothesis *hypothesis = &round->list.list[round->turn];
        round->turn++;
        round->fit_frames = 0;
        if (try_one(context, hypothesis, pad, found)) {
            return true;
        }
        if (round->fitting) {
            return false;
        }
    }
    return true;
}

static bool is_sure(const struct pad_estimate *pad, bool found)
{
    return found && pad->doubt < DOUBT_NONE;
}

// What comes after a list all of which was tried, among `count` candidates. `known`: there is a place where the pad may
// be already.
static void next_list(struct search_round *round, int count, bool known)
{
    // What has its pair is not looked for by its rings.
    const bool enough = known || round->found;

    round->listed = false;
    round->turn = 0;
    round->lists++;
    if (round->next != 0 && round->lists < LISTS_MAX) {
        // The same candidate as then, or one shortly before it: shapes come and go, in this order.
        const int place = (int)((double)round->next * count / round->of) - DRIFT;
        round->from = place > 0 ? place : 0;
        return;
    }
    round->from = 0;
    round->lists = 0;
    round->kind = enough ? SEARCH_LISTS : round->kind + 1;
}

// From where the frame before left off. `known`: where the pad may be, but something better is looked for.
static int search_on(const struct detect_context *context, bool known, struct pad_estimate *pad)
{
    struct search_round *round = &context->scratch->round;
    bool found = false;
    bool in_time = !round->fitting || go_on_fitting(context, pad, &found);

    round->under_way = true;
    round->list_frames++;
    // Bounded: each list costs work, and the next one comes after at most LISTS_MAX of a kind.
    while (in_time && !is_sure(pad, found) && round->kind != SEARCH_LISTS) {
        if (!round->listed || round->list_frames > LIST_FRAMES_MAX) {
            if (work_is_scarce(context->work)) {
                in_time = false;
                break;
            }
            make_list(context, round);
        }
        in_time = try_list(context, pad, &found);
        if (in_time) {
            next_list(round, context->scratch->count, known);
        }
    }
    if (in_time) {
        *round = no_round;
    }
    if (!found) {
        return in_time ? DETECT_E_NO_PAD : DETECT_E_GOES_ON;
    }
    // None is excused before all had their turn.
    pad->search_doubt = in_time ? pad->doubt : 0.0;
    return 0;
}

// From frame to frame the pad moves less than what the fit bridges; searching costs twice as much, and finds nothing
// better where it found nothing better just before.
static int follow(const struct detect_context *context, struct pad_estimate *pad)
{
    const struct detect_hint *hint = context->hint;
    struct search_round *round = &context->scratch->round;
    struct pad_estimate last = {.doubt = 0.0};
    struct hypothesis there = {.fused = hint->last_fused, .ringless = hint->last_ringless, .followed = true};
    // A step of light takes a pad away for one frame; if it stays away, every other one is the search's alone.
    const int missed = context->scratch->missed;
    const bool tries = hint->last != NULL && (missed == 0 || missed % 2 != 0);

    if (tries) {
        there.view = *hint->last;
    }
    const bool known = tries && attempt(context, &there, NULL, &last) == 0;
    if (known && last.doubt < at_least(DOUBT_SAME * hint->last_doubt, DOUBT_NONE)) {
        *round = no_round;
        *pad = last;
        pad->search_doubt = DOUBT_FADES * hint->last_doubt;
        return 0;
    }
    const int result = search_on(context, known, pad);
    if (!known || (result == 0 && pad->doubt < last.doubt)) {
        return result;
    }
    *pad = last;
    pad->search_doubt = round->under_way ? 0.0 : last.doubt;
    return 0;
}

int detect_pad(const struct landing_record *record, const struct camera *camera, const struct detect_hint *hint,
               uint32_t options, struct detect_scratch *scratch, struct pad_estimate *pad)
{
    struct work work = {.done = WORK_OBJECT * (int)record->header.object_count, .granted = true};
    struct grid grid;

    collect(record, camera, scratch);
    grid_sort(scratch, camera, &grid);
    const struct detect_context context = {
        .scratch = scratch,
        .grid = &grid,
        .camera = camera,
        .hint = hint,
        .options = options,
        .work = &work,
        .crowded = record->header.objects_dropped != 0U || scratch->count >= CROWD,
    };
    const int result = follow(&context, pad);

    scratch->missed = result == 0 || hint->last == NULL ? 0 : scratch->missed + 1;
    scratch->work = work.done;
    return result;
}

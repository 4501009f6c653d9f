// SPDX-License-Identifier: Apache-2.0
#include "detect.h"

#include <math.h>
#include <stddef.h>

#include "bounds.h"
#include "doubt.h"
#include "hypothesis.h"
#include "pad_geometry.h"
#include "reading.h"

#define DEGREES_PER_RADIAN 57.29577951308232
#define METRES_PER_MM 0.001
#define BASELINE (RECTANGLE_CENTRE_Y_MM - SQUARE_CENTRE_Y_MM)
#define CENTRE_FRACTION (RECTANGLE_CENTRE_Y_MM / BASELINE)

// A shape smaller than this has edges that are as large as itself.
#define AREA_MIN_PX 20.0
// Among so many objects some lie as a pad's would.
#define CROWD 150

// How much doubt a view may leave: its misfit, and what is missing or does not belong.
#define DOUBT_MAX 2.0
// With this little no other hypothesis is tried.
#define DOUBT_NONE 0.6
// As much as when it was searched for, but for noise. In each frame a little less is allowed, so that what leaves doubt
// is searched for again after ten: something better may have come into sight.
#define DOUBT_SAME 1.2
#define DOUBT_FADES 0.98
// A view this bad may be the mirror image of a better one.
#define MIRROR_MISFIT 1.5

// So much a frame may cost: when the slopes have been taken this often, the hypotheses that are left wait for the next
// frame. Of 4600 frames in which a pad was found, on photographs and rendered, 7 needed more.
#define SLOPES_A_FRAME 8

// How well each way of telling the centre knows it.
#define SMALL_RING_SIGMA_PX 0.04
#define SMALL_RING_PRECISE_AREA_PX 150.0 // below it the hole closes
#define LINE_SIGMA_PX 0.03
#define LINE_SIGMA_RING 0.001 // of the ring's diameter

const struct detect_hint detect_no_hint = {
    .tilt = {.x = 0.0, .y = 0.0, .sigma = 0.25}, .height_m = 0.0, .searching = false, .last = NULL, .last_doubt = 0.0};

static void collect(const struct landing_record *record, const struct camera *camera, struct detect_scratch *scratch)
{
    const double right = camera->width_px - 1.0;
    const double bottom = camera->height_px - 1.0;

    scratch->count = 0;
    for (uint32_t i = 0; i < record->header.object_count; i++) {
        const struct landing_object *object = &record->objects[i];
        struct candidate *candidate = &scratch->candidates[scratch->count];
        if ((double)object->area < AREA_MIN_PX || shape_from_object(object, &candidate->shape) != 0) {
            continue;
        }
        candidate->clipped = object->box_min_x == 0U || object->box_min_y == 0U ||
                             (double)object->box_max_x >= right || (double)object->box_max_y >= bottom;
        scratch->count++;
    }
}

// What was seen of a shape less what the view expects of it, at its centroid.
static struct vector left_over(const struct detect_context *context, const struct pad_plane *plane,
                               const struct reading *reading, unsigned kind)
{
    const struct sighting *sighting = reading_of(reading, kind);
    const struct vector nothing = {.x = 0.0};
    struct shape expected;

    if (!(pad_plane_moments(plane, context->camera, kind, sighting->clipped, &expected) > 0.0)) {
        return nothing;
    }
    return shape_offset(&expected, &sighting->seen);
}

// The view explains all shapes together; near the centre the shapes that are
// there know better, as paper is curled and shutters roll. What they leave over
// moves the centre, each by its weight.
static void centre_of(const struct detect_context *context, const struct pad_plane *plane,
                      const struct reading *reading, struct pad_estimate *pad)
{
    double weight = 0.0;
    double x = 0.0;
    double y = 0.0;

    if (reading_has(reading, PAD_SMALL_RING) && !reading_of(reading, PAD_SMALL_RING)->clipped) {
        const double area = reading_of(reading, PAD_SMALL_RING)->seen.area_px;
        const double blur = SMALL_RING_PRECISE_AREA_PX / area;
        const double sigma = SMALL_RING_SIGMA_PX + blur * blur;
        const struct vector left = left_over(context, plane, reading, PAD_SMALL_RING);
        weight += 1.0 / (sigma * sigma);
        x += left.x / (sigma * sigma);
        y += left.y / (sigma * sigma);
    }
    if (reading_has_whole_pair(reading)) {
        const struct vector square = left_over(context, plane, reading, PAD_SQUARE);
        const struct vector rectangle = left_over(context, plane, reading, PAD_RECTANGLE);
        const struct shape *seen = &reading_of(reading, PAD_RECTANGLE)->seen;
        const double ring_px = 2.0 * RING_OUTER_RADIUS_MM * sqrt(seen->area_px / pad_area_mm2(PAD_RECTANGLE));
        const double sigma = LINE_SIGMA_PX + LINE_SIGMA_RING * ring_px;
        weight += 1.0 / (sigma * sigma);
        x += (CENTRE_FRACTION * square.x + (1.0 - CENTRE_FRACTION) * rectangle.x) / (sigma * sigma);
        y += (CENTRE_FRACTION * square.y + (1.0 - CENTRE_FRACTION) * rectangle.y) / (sigma * sigma);
    }
    pad->x_px = pad->view.value[PAD_X_PX] + (weight > 0.0 ? x / weight : 0.0);
    pad->y_px = pad->view.value[PAD_Y_PX] + (weight > 0.0 ? y / weight : 0.0);
}

// From the rectangle's centre to the square's. What is seen are centroids of
// their images, which perspective moves apart; what they leave over is right.
static struct vector direction_up(const struct detect_context *context, const struct pad_plane *plane,
                                  const struct reading *reading)
{
    struct vector square;
    struct vector rectangle;

    pad_plane_project(plane, context->camera, SQUARE_CENTRE_X_MM, SQUARE_CENTRE_Y_MM, &square.x, &square.y);
    pad_plane_project(plane, context->camera, RECTANGLE_CENTRE_X_MM, RECTANGLE_CENTRE_Y_MM, &rectangle.x,
                      &rectangle.y);
    struct vector up = {.x = square.x - rectangle.x, .y = square.y - rectangle.y};
    if (reading_has_whole_pair(reading)) {
        const struct vector square_left = left_over(context, plane, reading, PAD_SQUARE);
        const struct vector rectangle_left = left_over(context, plane, reading, PAD_RECTANGLE);
        up.x += square_left.x - rectangle_left.x;
        up.y += square_left.y - rectangle_left.y;
    }
    return up;
}

static int report(const struct detect_context *context, const struct reading *reading, struct pad_estimate *pad)
{
    struct pad_plane plane;

    if (pad_plane_of(&pad->view, context->camera, &plane) != 0) {
        return DETECT_E_NO_PAD;
    }
    if ((context->options & DETECT_PERSPECTIVE) != 0U) {
        centre_of(context, &plane, reading, pad);
    } else if (reading_has(reading, PAD_SQUARE | PAD_RECTANGLE)) {
        const struct shape *square = &reading_of(reading, PAD_SQUARE)->seen;
        const struct shape *rectangle = &reading_of(reading, PAD_RECTANGLE)->seen;
        pad->x_px = rectangle->x_px + CENTRE_FRACTION * (square->x_px - rectangle->x_px);
        pad->y_px = rectangle->y_px + CENTRE_FRACTION * (square->y_px - rectangle->y_px);
    }
    const struct vector up = direction_up(context, &plane, reading);
    // Turned by 90 degrees: up in the image becomes 0.
    pad->angle_deg = atan2(up.x, -up.y) * DEGREES_PER_RADIAN;
    struct camera_ray ray;
    if (camera_unproject(context->camera, pad->x_px, pad->y_px, &ray) != 0) {
        return DETECT_E_NO_PAD;
    }
    pad->depth_m = plane.centre[2] * METRES_PER_MM;
    pad->right_m = ray.right * pad->depth_m;
    pad->forward_m = ray.forward * pad->depth_m;
    pad->height_m = pad_plane_height_m(&plane);
    pad->ring_share = reading->ring_share;
    pad->kinds = reading->kinds | (reading->ring_share >= RING_SHARE_MIN ? (unsigned)PAD_RING : 0U);
    return 0;
}

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

static int fit(const struct detect_context *context, bool fused, struct pad_view *view, struct reading *reading,
               double *misfit, double *worst)
{
    struct reading before = {.kinds = 0U};

    // The first fit brings all shapes into reach; the second uses them, if there are others now.
    for (int round = 0; round < 2; round++) {
        if (reading_take(context, view, fused, round > 0, reading) != 0 || reading->evidence.count < 2) {
            return DETECT_E_NO_PAD;
        }
        if (round > 0 && reading_same(reading, &before)) {
            return 0;
        }
        if (pad_fit(&reading->evidence, context->camera, &context->hint->tilt, view, misfit, worst,
                    &context->search->slopes_taken) != 0) {
            return DETECT_E_NO_PAD;
        }
        before = *reading;
    }
    return 0;
}

static int try_view(const struct detect_context *context, const struct hypothesis *hypothesis, struct pad_estimate *pad)
{
    struct reading reading;
    double worst;

    pad->view = hypothesis->view;
    if (fit(context, hypothesis->fused, &pad->view, &reading, &pad->misfit, &worst) != 0) {
        return DETECT_E_NO_PAD;
    }
    pad->doubt = doubt_of(context, &reading, &pad->view, pad->misfit, worst);
    if (pad->misfit > MIRROR_MISFIT && reading.evidence.count >= 3) {
        struct pad_estimate other = {.view = pad->view};
        struct reading mirrored;
        if (mirror(context, &other.view) &&
            fit(context, hypothesis->fused, &other.view, &mirrored, &other.misfit, &worst) == 0) {
            other.doubt = doubt_of(context, &mirrored, &other.view, other.misfit, worst);
            if (other.doubt >= 0.0 && (pad->doubt < 0.0 || other.doubt < pad->doubt)) {
                *pad = other;
                reading = mirrored;
            }
        }
    }
    if (pad->doubt < 0.0 || pad->doubt > DOUBT_MAX) {
        return DETECT_E_NO_PAD;
    }
    return report(context, &reading, pad);
}

// True when the next hypothesis is to be tried in this frame.
static bool has_turn(struct search *search)
{
    // The best of a frame is tried in any case: it may be a pad that has just come into sight.
    if (search->turn > 0 && search->turn < search->skip) {
        search->turn++;
        return false;
    }
    // And so is one of those that had no turn yet, or the search would never come to its end.
    search->spent = search->spent || (search->went_on && search->slopes_taken >= SLOPES_A_FRAME);
    if (search->spent) {
        return false;
    }
    search->went_on = search->turn >= search->skip;
    search->turn++;
    return true;
}

static int try_all(const struct detect_context *context, const struct hypotheses *hypotheses, struct pad_estimate *pad)
{
    int result = DETECT_E_NO_PAD;

    for (int i = 0; i < hypotheses->count; i++) {
        struct pad_estimate tried;
        if (!has_turn(context->search)) {
            continue;
        }
        if (try_view(context, &hypotheses->list[i], &tried) != 0) {
            continue;
        }
        if (result != 0 || tried.doubt < pad->doubt) {
            *pad = tried;
            pad->search_doubt = tried.doubt;
            result = 0;
        }
        if (pad->doubt < DOUBT_NONE) {
            break;
        }
    }
    return result;
}

// From frame to frame the pad moves less than what the fit bridges; searching costs twice as much, and finds nothing
// better where it found nothing better just before.
static bool still_there(const struct detect_context *context, struct pad_estimate *pad)
{
    const struct detect_hint *hint = context->hint;

    if (hint->last == NULL) {
        return false;
    }
    const struct hypothesis hypothesis = {.view = *hint->last, .fused = false, .error = 0.0};
    if (try_view(context, &hypothesis, pad) != 0 ||
        pad->doubt >= at_least(DOUBT_SAME * hint->last_doubt, DOUBT_NONE)) {
        return false;
    }
    pad->search_doubt = DOUBT_FADES * hint->last_doubt;
    return true;
}

static int search_for(const struct detect_context *context, struct pad_estimate *pad)
{
    const struct detect_scratch *scratch = context->scratch;
    const uint32_t options = context->options;
    struct hypotheses hypotheses = {.count = 0};

    hypotheses_from_pairs(scratch, context->camera, context->hint->height_m, options, &hypotheses);
    int result = try_all(context, &hypotheses, pad);
    if (result != 0 && (options & DETECT_CLOSE) != 0U && !context->search->spent) {
        hypotheses.count = 0;
        hypotheses_from_small_rings(scratch, context->camera, &hypotheses);
        result = try_all(context, &hypotheses, pad);
    }
    if (result != 0 && (options & DETECT_FUSED) != 0U && !context->search->spent) {
        hypotheses.count = 0;
        hypotheses_from_rings(scratch, context->camera, &hypotheses);
        result = try_all(context, &hypotheses, pad);
    }
    return result;
}

int detect_pad(const struct landing_record *record, const struct camera *camera, const struct detect_hint *hint,
               uint32_t options, struct detect_scratch *scratch, struct pad_estimate *pad)
{
    struct search search = {.skip = scratch->skip};

    collect(record, camera, scratch);
    const struct detect_context context = {
        .scratch = scratch,
        .camera = camera,
        .hint = hint,
        .options = options,
        .search = &search,
        .crowded = record->header.objects_dropped != 0U || scratch->count >= CROWD,
    };
    const int result = still_there(&context, pad) ? 0 : search_for(&context, pad);

    scratch->slopes_taken = search.slopes_taken;
    scratch->skip = result != 0 && search.spent ? search.turn : 0;
    return result;
}

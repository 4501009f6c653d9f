// SPDX-License-Identifier: Apache-2.0
#include "pad_fit.h"

#include <math.h>

#include "bounds.h"

#define RESIDUALS_A_SIGHTING 6
#define RESIDUALS (RESIDUALS_A_SIGHTING * PAD_FIT_SIGHTINGS)
#define CONVERGED_PX 1e-3
#define GAIN_MIN 1e-3
// What is this bad after so many steps is no pad. Square and rectangle alone are in any clutter, but then never near:
// of the fits that became a pad, on photographs and rendered frames, none with two sightings cost more than 13 after the
// second step. With three, seen obliquely, up to 4000 after the third and 220 after the sixth.
#define HOPELESS_STEPS 5
#define HOPELESS_COST 500.0
#define HOPELESS_PAIR_STEPS 1
#define HOPELESS_PAIR_COST 100.0
#define CRAWLING_PAIR_STEPS 4
#define CRAWLING_PAIR_COST 40.0
// Twice the misfit that a pad may have, and a step that makes it no smaller.
#define STUCK_MISFIT 4.0
#define STUCK_GAIN 0.02

// How well each thing can be known. Centroids of solid shapes: to a fraction of
// a pixel, and paper is curled by some thousandths of its size. A wide ring
// suffers more from curl, shadow and grass.
#define CENTROID_SIGMA_PX 0.12
#define CENTROID_SIGMA_SIZE 0.004
#define RING_SIGMA_PX 0.5
#define RING_SIGMA_SIZE 0.01
// A small ring of less than this has a hole that the opening may close, on one side first.
#define SMALL_RING_PRECISE_AREA_PX 150.0
#define SMALL_RING_SIGMA_MAX_PX 3.0
// Blur, threshold and opening round the corners of a square or rectangle:
// 19 px for all four, whatever the size: firmware/test_corners.py measures it.
#define CORNERS_LOST_PX 19.0
#define CORNER_SIZE_PX 2.4
// And the opening eats a ring thinner than this where it is thinnest.
#define RING_THIN_PX 7.0
#define RING_SIGMA_THIN 0.6
#define RING_SIGMA_EDGE 0.5
#define EDGE_SIGMA_PX 0.12
#define SMALL_RING_EDGE_SIGMA_PX 0.6 // the opening may take much of it
#define AREA_SIGMA 0.02
#define SPREAD_SIGMA_PX 0.10
#define SPREAD_SIGMA 0.015
#define FACING_MIN 0.2
#define PIECES_FACTOR 3.0
#define CLIPPED_SIGMA_PX 0.5
#define CLIPPED_SIGMA_SIZE 0.01
#define EDGE_PRIOR_SIGMA_PX 1.0

// Two edges of a box that move by 1 change its standard deviation by 2 / sqrt(12).
#define SPREAD_OF_EDGE 0.577

static const double step_sizes[PAD_PARAMETERS] = {0.02, 0.02, 1e-4, 1e-4, 1e-3, 1e-3, 1e-2};
static const double small_steps[PAD_PARAMETERS] = {0.5, 0.5, 0.03, 0.03, 0.04, 0.04, 0.3};

struct terms {
    int count;
    double residual[RESIDUALS]; // in standard deviations
};

static void add(struct terms *terms, double difference, double sigma)
{
    terms->residual[terms->count] = difference / sigma;
    terms->count++;
}

// Residuals of one sighting. All are lengths in pixels before they are divided.
// `facing`: cosine of the angle at which the plane is seen. Obliquely, two corners
// of a square are acute, and the opening takes more of them than of the others.
static void compare(struct terms *terms, const struct sighting *sighting, const struct shape *expected, double inside,
                    double edge_px, double facing)
{
    const struct shape *seen = &sighting->seen;
    const bool ring = (sighting->kinds & PAD_RING) != 0U;
    const double doubt = sighting->pieces ? PIECES_FACTOR : 1.0;
    const double spread = sqrt((expected->cov_xx + expected->cov_yy) / 2.0);
    const double edges_px = pad_edges_px(sighting->kinds, expected, inside);
    const double width_px = 2.0 * expected->area_px / edges_px;
    double sigma = ring ? RING_SIGMA_PX + RING_SIGMA_SIZE * spread : CENTROID_SIGMA_PX + CENTROID_SIGMA_SIZE * spread;

    if (ring) {
        // Bloom that eats the ring eats more of it on the brighter side.
        sigma += RING_SIGMA_EDGE * fabs(edge_px) + RING_SIGMA_THIN * at_least(RING_THIN_PX - width_px, 0.0);
    }
    if (sighting->kinds == PAD_SMALL_RING) {
        const double blur = SMALL_RING_PRECISE_AREA_PX / seen->area_px;
        sigma += at_most(blur * blur, SMALL_RING_SIGMA_MAX_PX);
    }
    if (sighting->clipped) {
        sigma += CLIPPED_SIGMA_PX + CLIPPED_SIGMA_SIZE * spread;
    }
    add(terms, seen->x_px - expected->x_px, doubt * sigma);
    add(terms, seen->y_px - expected->y_px, doubt * sigma);

    // Whatever moves edges moves all of them alike.
    const bool box = sighting->kinds == PAD_SQUARE || sighting->kinds == PAD_RECTANGLE;
    const double lost = box && !sighting->clipped ? CORNERS_LOST_PX : 0.0;
    const double area = at_least(expected->area_px + edge_px * edges_px - lost, 1.0);
    const double edge_sigma_px = sighting->kinds == PAD_SMALL_RING ? SMALL_RING_EDGE_SIGMA_PX : EDGE_SIGMA_PX;
    const double area_sigma = edge_sigma_px * edges_px + AREA_SIGMA * area;
    add(terms, sqrt(seen->area_px) - sqrt(area), doubt * area_sigma / (2.0 * sqrt(area)));

    if (sighting->clipped || sighting->kinds == PAD_SMALL_RING) {
        return;
    }
    double xx = expected->cov_xx;
    double xy = expected->cov_xy;
    double yy = expected->cov_yy;
    if (box) {
        // What the corners lose lies at sqrt(3) standard deviations along both sides, less its own size.
        const double near = at_least(1.0 - CORNER_SIZE_PX / sqrt(expected->area_px), 0.0);
        const double keep = at_least(1.0 - lost * (3.0 * near * near - 1.0) / area, 0.1);
        xx *= keep;
        xy *= keep;
        yy *= keep;
        // (C^1/2 + m)^2 is nearly C + 2 m C^1/2
        const double root = sqrt(at_least(xx * yy - xy * xy, 0.0));
        const double move = 2.0 * SPREAD_OF_EDGE * edge_px / sqrt(xx + yy + 2.0 * root);
        xx += move * (expected->cov_xx + root);
        yy += move * (expected->cov_yy + root);
        xy += move * expected->cov_xy;
    }
    const double spread_sigma =
        doubt * (ring ? RING_SIGMA_PX + RING_SIGMA_SIZE * spread : (SPREAD_SIGMA_PX + SPREAD_SIGMA * spread) / facing);
    add(terms, (seen->cov_xx - xx) / (2.0 * spread), spread_sigma);
    add(terms, (seen->cov_xy - xy) / (2.0 * spread), spread_sigma);
    add(terms, (seen->cov_yy - yy) / (2.0 * spread), spread_sigma);
}

// What a view makes us expect of each sighting. The edges' shift plays no part in it.
struct expectation {
    struct shape shapes[PAD_FIT_SIGHTINGS];
    double inside[PAD_FIT_SIGHTINGS];
    double facing;
};

static enum pad_sampling sampling_of(const struct sighting *sighting, bool rough)
{
    return !sighting->clipped ? PAD_WHOLE : rough ? PAD_ROUGH : PAD_CLIPPED;
}

// What the expectation of a view costs, and what is compared with it.
static int work_of_view(const struct pad_evidence *evidence, bool rough)
{
    int work = WORK_VIEW;

    for (int i = 0; i < evidence->count; i++) {
        const struct sighting *sighting = &evidence->sightings[i];
        work += pad_plane_work(sighting->kinds, sampling_of(sighting, rough));
    }
    return work;
}

static int expect(const struct pad_evidence *evidence, const struct camera *camera, const struct pad_view *view,
                  bool rough, struct expectation *expectation)
{
    struct pad_plane plane;

    if (pad_plane_of(view, camera, &plane) != 0) {
        return PAD_FIT_E_LOST;
    }
    expectation->facing = at_least(pad_plane_facing(&plane), FACING_MIN);
    for (int i = 0; i < evidence->count; i++) {
        const struct sighting *sighting = &evidence->sightings[i];
        struct shape *shape = &expectation->shapes[i];
        expectation->inside[i] =
            pad_plane_moments(&plane, camera, sighting->kinds, sampling_of(sighting, rough), shape);
        if (!(expectation->inside[i] > 0.02) || !(shape->area_px > 1.0)) {
            return PAD_FIT_E_LOST;
        }
    }
    return 0;
}

static void residuals_of(const struct pad_evidence *evidence, const struct expectation *expectation, double edge_px,
                         struct terms *terms)
{
    terms->count = 0;
    for (int i = 0; i < evidence->count; i++) {
        compare(terms, &evidence->sightings[i], &expectation->shapes[i], expectation->inside[i], edge_px,
                expectation->facing);
    }
}

// Solves matrix * x = x in place, for a symmetric positive matrix (Cholesky).
static bool solve(double matrix[PAD_PARAMETERS][PAD_PARAMETERS], double x[PAD_PARAMETERS])
{
    for (int i = 0; i < PAD_PARAMETERS; i++) {
        for (int j = 0; j <= i; j++) {
            double sum = matrix[i][j];
            for (int k = 0; k < j; k++) {
                sum -= matrix[i][k] * matrix[j][k];
            }
            if (i != j) {
                matrix[i][j] = sum / matrix[j][j];
            } else if (sum > 0.0) {
                matrix[i][i] = sqrt(sum);
            } else {
                return false;
            }
        }
    }
    for (int i = 0; i < PAD_PARAMETERS; i++) {
        for (int k = 0; k < i; k++) {
            x[i] -= matrix[i][k] * x[k];
        }
        x[i] /= matrix[i][i];
    }
    for (int i = PAD_PARAMETERS - 1; i >= 0; i--) {
        for (int k = i + 1; k < PAD_PARAMETERS; k++) {
            x[i] -= matrix[k][i] * x[k];
        }
        x[i] /= matrix[i][i];
    }
    return true;
}

static double square_of(double value)
{
    return value * value;
}

static double cost_of(const struct terms *terms, const struct tilt_hint *tilt, const struct pad_view *view)
{
    double cost = square_of((view->value[PAD_TILT_X] - tilt->x) / tilt->sigma) +
                  square_of((view->value[PAD_TILT_Y] - tilt->y) / tilt->sigma) +
                  square_of(view->value[PAD_EDGE_PX] / EDGE_PRIOR_SIGMA_PX);

    for (int i = 0; i < terms->count; i++) {
        cost += square_of(terms->residual[i]);
    }
    return cost;
}

// A view and how well it explains what was seen.
struct guess {
    struct pad_view view;
    struct expectation expectation;
    struct terms terms;
    double cost;
};

// Of freedom. The priors stand for as many observations as there are parameters less four.
static double degrees_of(const struct guess *guess)
{
    return guess->terms.count > 5 ? guess->terms.count - 4 : 1;
}

// How the residuals answer to each parameter.
struct slopes {
    double of[PAD_PARAMETERS][RESIDUALS];
};

// What slopes and the step along them cost.
static int work_of_step(const struct pad_evidence *evidence)
{
    return PAD_PARAMETERS * work_of_view(evidence, true) + work_of_view(evidence, false) + WORK_STEP;
}

static bool is_clipped(const struct pad_evidence *evidence)
{
    bool clipped = false;

    for (int i = 0; i < evidence->count; i++) {
        clipped = clipped || evidence->sightings[i].clipped;
    }
    return clipped;
}

static int work_of_small_step(const struct pad_evidence *evidence)
{
    return work_of_view(evidence, false) + WORK_STEP;
}

static bool slopes_at(const struct pad_evidence *evidence, const struct camera *camera, const struct guess *at,
                      struct slopes *slopes)
{
    struct expectation rough;
    struct terms rough_terms;
    const struct expectation *here = &at->expectation;
    const struct terms *terms = &at->terms;

    if (is_clipped(evidence)) {
        if (expect(evidence, camera, &at->view, true, &rough) != 0) {
            return false;
        }
        residuals_of(evidence, &rough, at->view.value[PAD_EDGE_PX], &rough_terms);
        here = &rough;
        terms = &rough_terms;
    }
    for (int i = 0; i < PAD_PARAMETERS; i++) {
        struct pad_view moved = at->view;
        struct expectation moved_expectation;
        struct terms there;
        moved.value[i] += step_sizes[i];
        if (i != PAD_EDGE_PX && expect(evidence, camera, &moved, true, &moved_expectation) != 0) {
            return false;
        }
        residuals_of(evidence, i != PAD_EDGE_PX ? &moved_expectation : here, moved.value[PAD_EDGE_PX], &there);
        for (int k = 0; k < there.count; k++) {
            slopes->of[i][k] = (terms->residual[k] - there.residual[k]) / step_sizes[i];
        }
    }
    return true;
}

static bool is_hopeless(const struct pad_evidence *evidence, int steps, double cost)
{
    if (evidence->count > 2) {
        return steps >= HOPELESS_STEPS && cost > HOPELESS_COST;
    }
    return (steps >= HOPELESS_PAIR_STEPS && cost > HOPELESS_PAIR_COST) ||
           (steps >= CRAWLING_PAIR_STEPS && cost > CRAWLING_PAIR_COST);
}

// Neither near nor getting nearer.
static bool is_stuck(const struct guess *at, double gain)
{
    return gain < STUCK_GAIN * at->cost && at->cost > STUCK_MISFIT * degrees_of(at);
}

// So small a step that the slopes where it began serve for the next one too: taking them costs six times what a step
// does.
static bool is_small(const double step[PAD_PARAMETERS])
{
    bool small = true;

    for (int i = 0; i < PAD_PARAMETERS; i++) {
        small = small && fabs(step[i]) < small_steps[i];
    }
    return small;
}

// The step of Gauss and Newton, damped by `damping` (Levenberg and Marquardt).
static bool step_of(const struct slopes *slopes, const struct tilt_hint *tilt, const struct guess *at, double damping,
                    double step[PAD_PARAMETERS])
{
    double matrix[PAD_PARAMETERS][PAD_PARAMETERS]; // its lower half

    for (int i = 0; i < PAD_PARAMETERS; i++) {
        step[i] = 0.0;
        for (int k = 0; k < at->terms.count; k++) {
            step[i] += slopes->of[i][k] * at->terms.residual[k];
        }
        for (int j = 0; j <= i; j++) {
            matrix[i][j] = 0.0;
            for (int k = 0; k < at->terms.count; k++) {
                matrix[i][j] += slopes->of[i][k] * slopes->of[j][k];
            }
        }
    }
    const double tilt_weight = 1.0 / square_of(tilt->sigma);
    const double edge_weight = 1.0 / square_of(EDGE_PRIOR_SIGMA_PX);
    matrix[PAD_TILT_X][PAD_TILT_X] += tilt_weight;
    matrix[PAD_TILT_Y][PAD_TILT_Y] += tilt_weight;
    matrix[PAD_EDGE_PX][PAD_EDGE_PX] += edge_weight;
    step[PAD_TILT_X] += tilt_weight * (tilt->x - at->view.value[PAD_TILT_X]);
    step[PAD_TILT_Y] += tilt_weight * (tilt->y - at->view.value[PAD_TILT_Y]);
    step[PAD_EDGE_PX] -= edge_weight * at->view.value[PAD_EDGE_PX];
    for (int i = 0; i < PAD_PARAMETERS; i++) {
        matrix[i][i] *= 1.0 + damping;
    }
    return solve(matrix, step);
}

static bool weigh(const struct pad_evidence *evidence, const struct camera *camera, const struct tilt_hint *tilt,
                  struct guess *guess)
{
    guess->terms.count = 0;
    if (expect(evidence, camera, &guess->view, false, &guess->expectation) != 0) {
        return false;
    }
    residuals_of(evidence, &guess->expectation, guess->view.value[PAD_EDGE_PX], &guess->terms);
    guess->cost = cost_of(&guess->terms, tilt, &guess->view);
    return true;
}

// From where it starts to the nearest least cost, or as far as there is time.
static int descend(const struct pad_evidence *evidence, const struct camera *camera, const struct tilt_hint *tilt,
                   struct guess *best, struct pad_fit_progress *progress, struct work *work)
{
    struct slopes slopes;
    bool known = false; // the slopes, well enough for the next step
    bool here = false;  // they were taken at this view
    double *const damping = &progress->damping;

    if (progress->steps == 0) {
        *damping = 1e-4;
    }
    // Bounded: by PAD_FIT_STEPS.
    for (; progress->steps < PAD_FIT_STEPS; progress->steps++) {
        double step[PAD_PARAMETERS];
        struct guess moved;
        if (!work_take(work, known ? work_of_small_step(evidence) : work_of_step(evidence))) {
            return PAD_FIT_UNFINISHED;
        }
        if (!known && !slopes_at(evidence, camera, best, &slopes)) {
            return PAD_FIT_E_LOST;
        }
        here = here || !known;
        if (!step_of(&slopes, tilt, best, *damping, step)) {
            return PAD_FIT_E_LOST;
        }
        for (int k = 0; k < PAD_PARAMETERS; k++) {
            moved.view.value[k] = best->view.value[k] + step[k];
        }
        const bool valid = weigh(evidence, camera, tilt, &moved);
        if (!valid || !(moved.cost < best->cost)) {
            if ((valid && moved.cost < best->cost + GAIN_MIN) || is_hopeless(evidence, progress->steps, best->cost)) {
                break;
            }
            // Slopes of the view before are taken anew first.
            known = here;
            *damping = here ? *damping * 30.0 + 1e-3 : *damping;
            continue;
        }
        const double gain = best->cost - moved.cost;
        *best = moved;
        *damping /= 10.0;
        known = is_small(step);
        here = false;
        if (fabs(step[PAD_X_PX]) + fabs(step[PAD_Y_PX]) < CONVERGED_PX || gain < GAIN_MIN ||
            is_stuck(best, gain) || is_hopeless(evidence, progress->steps, best->cost)) {
            break;
        }
    }
    return 0;
}

int pad_fit(const struct pad_evidence *evidence, const struct camera *camera, const struct tilt_hint *tilt,
            struct pad_view *view, double *misfit, double *worst, struct pad_fit_progress *progress,
            struct work *work)
{
    struct guess best;

    best.view = *view;
    work->done += work_of_view(evidence, false);
    const int result =
        weigh(evidence, camera, tilt, &best) ? descend(evidence, camera, tilt, &best, progress, work) : PAD_FIT_E_LOST;
    if (result == PAD_FIT_E_LOST) {
        return result;
    }
    *view = best.view;
    *misfit = best.cost / degrees_of(&best);
    *worst = 0.0;
    for (int i = 0; i < best.terms.count; i++) {
        *worst = at_least(fabs(best.terms.residual[i]), *worst);
    }
    return result;
}

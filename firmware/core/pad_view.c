// SPDX-License-Identifier: Apache-2.0
#include "pad_view.h"

#include <math.h>

#include "bounds.h"
#include "pad_geometry.h"
#include "work.h"

#define PI 3.14159265358979323846

// Two points and equal weights integrate cubic polynomials exactly.
#define GAUSS_2 0.28867513459481287
#define CELLS_COARSE 2
#define CELLS_FINE 6
#define CELLS_ROUGH 3
// Angles on an annulus, in tens of degrees.
#define TENS_FINE 1
#define TENS_ROUGH 2
#define RADII_FINE 2

struct box {
    double x_mm;
    double y_mm;
    double width_mm;
    double height_mm;
};

struct annulus {
    double outer_mm;
    double inner_mm;
    int tens_coarse; // from point to point; the larger the annulus, the more perspective bends it
};

static const struct box square = {SQUARE_CENTRE_X_MM, SQUARE_CENTRE_Y_MM, SQUARE_SIDE_MM, SQUARE_SIDE_MM};
static const struct box rectangle = {RECTANGLE_CENTRE_X_MM, RECTANGLE_CENTRE_Y_MM, RECTANGLE_WIDTH_MM,
                                     RECTANGLE_HEIGHT_MM};
static const struct annulus small_ring = {SMALL_RING_OUTER_RADIUS_MM, SMALL_RING_INNER_RADIUS_MM, 6};
static const struct annulus ring = {RING_OUTER_RADIUS_MM, RING_INNER_RADIUS_MM, 4};

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

int pad_plane_of(const struct pad_view *view, const struct camera *camera, struct pad_plane *plane)
{
    const double *value = view->value;
    const double distance_mm = exp(value[PAD_LOG_DISTANCE_MM]);
    const double scale =
        1.0 / sqrt(value[PAD_TILT_X] * value[PAD_TILT_X] + value[PAD_TILT_Y] * value[PAD_TILT_Y] + 1.0);
    double direction[3];

    if (camera_direction(camera, value[PAD_X_PX], value[PAD_Y_PX], direction) != 0) {
        return CAMERA_E_OUTSIDE;
    }
    const double normal[3] = {scale * value[PAD_TILT_X], scale * value[PAD_TILT_Y], scale};
    // Of all vectors in the plane, the one whose projection has the yaw.
    const double x = cos(value[PAD_YAW_RAD]);
    const double y = sin(value[PAD_YAW_RAD]);
    const double z = -(x * value[PAD_TILT_X] + y * value[PAD_TILT_Y]);
    const double length = 1.0 / sqrt(1.0 + z * z);
    const double across[3] = {x * length, y * length, z * length};

    for (int i = 0; i < 3; i++) {
        plane->centre[i] = distance_mm * direction[i];
        plane->normal[i] = normal[i];
        plane->across[i] = across[i];
    }
    plane->down[0] = normal[1] * across[2] - normal[2] * across[1];
    plane->down[1] = normal[2] * across[0] - normal[0] * across[2];
    plane->down[2] = normal[0] * across[1] - normal[1] * across[0];
    plane->height_mm = dot(plane->centre, normal);
    plane->foot_x_mm = -dot(plane->centre, plane->across);
    plane->foot_y_mm = -dot(plane->centre, plane->down);
    // Where a pixel of noise is metres.
    plane->grazing_mm = 0.05 * plane->height_mm * plane->height_mm / distance_mm;
    return 0;
}

double pad_plane_facing(const struct pad_plane *plane)
{
    return fabs(plane->height_mm) / sqrt(dot(plane->centre, plane->centre));
}

static void point_of(const struct pad_plane *plane, double x_mm, double y_mm, double point[3])
{
    point[0] = plane->centre[0] + x_mm * plane->across[0] + y_mm * plane->down[0];
    point[1] = plane->centre[1] + x_mm * plane->across[1] + y_mm * plane->down[1];
    point[2] = plane->centre[2] + x_mm * plane->across[2] + y_mm * plane->down[2];
}

void pad_plane_project(const struct pad_plane *plane, const struct camera *camera, double x_mm, double y_mm,
                       double *x_px, double *y_px)
{
    double point[3];

    point_of(plane, x_mm, y_mm, point);
    (void)camera_image(camera, point, x_px, y_px);
}

int pad_plane_meet(const struct pad_plane *plane, const double direction[3], double *x_mm, double *y_mm)
{
    const double slope = dot(direction, plane->normal);
    if (!(slope * plane->height_mm > plane->grazing_mm)) {
        return CAMERA_E_OUTSIDE;
    }
    const double distance_mm = plane->height_mm / slope;
    *x_mm = plane->foot_x_mm + distance_mm * dot(direction, plane->across);
    *y_mm = plane->foot_y_mm + distance_mm * dot(direction, plane->down);
    return 0;
}

int pad_plane_unproject(const struct pad_plane *plane, const struct camera *camera, double x_px, double y_px,
                        double *x_mm, double *y_mm)
{
    double direction[3];

    if (camera_direction(camera, x_px, y_px, direction) != 0) {
        return CAMERA_E_OUTSIDE;
    }
    return pad_plane_meet(plane, direction, x_mm, y_mm);
}

// Sums over the sample points of one sighting.
struct sums {
    const struct pad_plane *plane;
    const struct camera *camera;
    enum pad_sampling sampling;
    double height_mm;   // of the camera above the plane
    double origin_x_px; // near the shapes, so that nothing cancels
    double origin_y_px;
    double whole; // area without the frame's border, pixels
    double area;
    double x;
    double y;
    double xx;
    double xy;
    double yy;
};

// Share of a small square of this size that lies inside the frame.
static double share_inside(const struct camera *camera, double x_px, double y_px, double size_px)
{
    const double across = at_most(x_px + 0.5, camera->width_px - 0.5 - x_px);
    const double down = at_most(y_px + 0.5, camera->height_px - 0.5 - y_px);

    return at_most(at_least(0.5 + at_most(across, down) / size_px, 0.0), 1.0);
}

static void add_point(struct sums *sums, double x_mm, double y_mm, double area_mm2)
{
    double point[3];
    double x_px;
    double y_px;

    point_of(sums->plane, x_mm, y_mm, point);
    const double scale = camera_image(sums->camera, point, &x_px, &y_px);
    // Both ways a mm across the ray becomes sqrt(scale) pixels; the plane is inclined to it.
    double area = area_mm2 * scale * sums->height_mm / sqrt(dot(point, point));

    sums->whole += area;
    if (sums->sampling != PAD_WHOLE) {
        area *= share_inside(sums->camera, x_px, y_px, sqrt(area));
    }
    const double x = x_px - sums->origin_x_px;
    const double y = y_px - sums->origin_y_px;
    sums->area += area;
    sums->x += area * x;
    sums->y += area * y;
    sums->xx += area * x * x;
    sums->xy += area * x * y;
    sums->yy += area * y * y;
}

// Along each side of a box.
static int cells_of(enum pad_sampling sampling)
{
    return sampling == PAD_WHOLE ? CELLS_COARSE : sampling == PAD_CLIPPED ? CELLS_FINE : CELLS_ROUGH;
}

static int tens_of(const struct annulus *annulus, enum pad_sampling sampling)
{
    return sampling == PAD_WHOLE ? annulus->tens_coarse : sampling == PAD_CLIPPED ? TENS_FINE : TENS_ROUGH;
}

static int radii_of(enum pad_sampling sampling)
{
    return sampling == PAD_CLIPPED ? RADII_FINE : 1;
}

static void add_box(struct sums *sums, const struct box *box)
{
    const int cells = cells_of(sums->sampling);
    const double pitch = sums->sampling != PAD_WHOLE ? 1.0 / cells : 2.0 * GAUSS_2;
    const double first = -0.5 * pitch * (cells - 1);
    const double area = box->width_mm * box->height_mm / (cells * cells);

    for (int i = 0; i < cells; i++) {
        for (int j = 0; j < cells; j++) {
            add_point(sums, box->x_mm + (first + i * pitch) * box->width_mm,
                      box->y_mm + (first + j * pitch) * box->height_mm, area);
        }
    }
}

// Cosine and sine of multiples of 10 degrees.
static const double circle[36][2] = {
    {1.0, 0.0},
    {0.984807753012208, 0.17364817766693033},
    {0.9396926207859084, 0.3420201433256688},
    {0.8660254037844387, 0.5},
    {0.766044443118978, 0.6427876096865394},
    {0.6427876096865394, 0.766044443118978},
    {0.5, 0.8660254037844387},
    {0.3420201433256688, 0.9396926207859084},
    {0.17364817766693033, 0.984807753012208},
    {0.0, 1.0},
    {-0.17364817766693033, 0.984807753012208},
    {-0.3420201433256688, 0.9396926207859084},
    {-0.5, 0.8660254037844387},
    {-0.6427876096865394, 0.766044443118978},
    {-0.766044443118978, 0.6427876096865394},
    {-0.8660254037844387, 0.5},
    {-0.9396926207859084, 0.3420201433256688},
    {-0.984807753012208, 0.17364817766693033},
    {-1.0, 0.0},
    {-0.984807753012208, -0.17364817766693033},
    {-0.9396926207859084, -0.3420201433256688},
    {-0.8660254037844387, -0.5},
    {-0.766044443118978, -0.6427876096865394},
    {-0.6427876096865394, -0.766044443118978},
    {-0.5, -0.8660254037844387},
    {-0.3420201433256688, -0.9396926207859084},
    {-0.17364817766693033, -0.984807753012208},
    {0.0, -1.0},
    {0.17364817766693033, -0.984807753012208},
    {0.3420201433256688, -0.9396926207859084},
    {0.5, -0.8660254037844387},
    {0.6427876096865394, -0.766044443118978},
    {0.766044443118978, -0.6427876096865394},
    {0.8660254037844387, -0.5},
    {0.9396926207859084, -0.3420201433256688},
    {0.984807753012208, -0.17364817766693033},
};

static void add_annulus(struct sums *sums, const struct annulus *annulus)
{
    const int step = tens_of(annulus, sums->sampling);
    const int radii = radii_of(sums->sampling);
    const double outer = annulus->outer_mm * annulus->outer_mm;
    const double inner = annulus->inner_mm * annulus->inner_mm;
    const double area = PI * (outer - inner) * step / (36 * radii);

    for (int i = 0; i < radii; i++) {
        // Rings of equal area; the one radius has the right second moments.
        const double radius = sqrt(inner + (outer - inner) * (i + 0.5) / radii);
        for (int tens = 0; tens < 36; tens += step) {
            add_point(sums, radius * circle[tens][0], radius * circle[tens][1], area);
        }
    }
}

double pad_plane_moments(const struct pad_plane *plane, const struct camera *camera, unsigned kinds,
                         enum pad_sampling sampling, struct shape *seen)
{
    // One by one: the compiler calls memset for what an initializer leaves out.
    struct sums sums;

    sums.plane = plane;
    sums.camera = camera;
    sums.sampling = sampling;
    sums.height_mm = fabs(plane->height_mm);
    sums.whole = 0.0;
    sums.area = 0.0;
    sums.x = 0.0;
    sums.y = 0.0;
    sums.xx = 0.0;
    sums.xy = 0.0;
    sums.yy = 0.0;
    (void)camera_image(camera, plane->centre, &sums.origin_x_px, &sums.origin_y_px);
    if ((kinds & PAD_SQUARE) != 0U) {
        add_box(&sums, &square);
    }
    if ((kinds & PAD_RECTANGLE) != 0U) {
        add_box(&sums, &rectangle);
    }
    if ((kinds & PAD_SMALL_RING) != 0U) {
        add_annulus(&sums, &small_ring);
    }
    if ((kinds & PAD_RING) != 0U) {
        add_annulus(&sums, &ring);
    }
    if (!(sums.area > 0.0)) {
        return 0.0;
    }
    const double x = sums.x / sums.area;
    const double y = sums.y / sums.area;
    seen->area_px = sums.area;
    seen->x_px = sums.origin_x_px + x;
    seen->y_px = sums.origin_y_px + y;
    seen->cov_xx = sums.xx / sums.area - x * x;
    seen->cov_xy = sums.xy / sums.area - x * y;
    seen->cov_yy = sums.yy / sums.area - y * y;
    return sums.area / sums.whole;
}

static int points_of(const struct annulus *annulus, enum pad_sampling sampling)
{
    return (int)(36.0 * radii_of(sampling) / tens_of(annulus, sampling));
}

int pad_plane_work(unsigned kinds, enum pad_sampling sampling)
{
    const int box = cells_of(sampling) * cells_of(sampling);

    const int points = ((kinds & PAD_SQUARE) != 0U ? box : 0) + ((kinds & PAD_RECTANGLE) != 0U ? box : 0) +
                       ((kinds & PAD_SMALL_RING) != 0U ? points_of(&small_ring, sampling) : 0) +
                       ((kinds & PAD_RING) != 0U ? points_of(&ring, sampling) : 0);

    return points * (sampling == PAD_WHOLE ? WORK_POINT : WORK_CLIPPED_POINT);
}

static double box_edge_mm(const struct box *box)
{
    return 2.0 * (box->width_mm + box->height_mm);
}

static double annulus_edge_mm(const struct annulus *annulus)
{
    return 2.0 * PI * (annulus->outer_mm + annulus->inner_mm);
}

static double annulus_area_mm2(const struct annulus *annulus)
{
    return PI * (annulus->outer_mm * annulus->outer_mm - annulus->inner_mm * annulus->inner_mm);
}

static double edges_mm(unsigned kinds)
{
    return ((kinds & PAD_SQUARE) != 0U ? box_edge_mm(&square) : 0.0) +
           ((kinds & PAD_RECTANGLE) != 0U ? box_edge_mm(&rectangle) : 0.0) +
           ((kinds & PAD_SMALL_RING) != 0U ? annulus_edge_mm(&small_ring) : 0.0) +
           ((kinds & PAD_RING) != 0U ? annulus_edge_mm(&ring) : 0.0);
}

double pad_area_mm2(unsigned kinds)
{
    return ((kinds & PAD_SQUARE) != 0U ? square.width_mm * square.height_mm : 0.0) +
           ((kinds & PAD_RECTANGLE) != 0U ? rectangle.width_mm * rectangle.height_mm : 0.0) +
           ((kinds & PAD_SMALL_RING) != 0U ? annulus_area_mm2(&small_ring) : 0.0) +
           ((kinds & PAD_RING) != 0U ? annulus_area_mm2(&ring) : 0.0);
}

double pad_edges_px(unsigned kinds, const struct shape *seen, double inside)
{
    // A pixel is so many mm, on the average of both directions.
    return inside * edges_mm(kinds) * sqrt(seen->area_px / (inside * pad_area_mm2(kinds)));
}

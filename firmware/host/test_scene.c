// SPDX-License-Identifier: Apache-2.0
#include "test_scene.h"

#include <math.h>
#include <string.h>

#include "pad_geometry.h"
#include "test.h"

#define RADIANS_PER_DEGREE 0.017453292519943295
#define WIDTH 1280
#define HEIGHT 720
#define REACH_M 0.16 // farther than the ring's edge, tilted towards the camera
#define REACH_MM (1000.0 * REACH_M)

// Blur and the opening of the mask cut corners, whatever the shape's size: 19 px of a box in all.
#define CORNER_PX 3.1

#define FRAMES_MAX 60 // that a search takes

static double corner_mm; // sides of the triangle that each corner loses

static bool in_box(double x_mm, double y_mm, double width_mm, double height_mm)
{
    const double inside_x_mm = width_mm / 2.0 - fabs(x_mm);
    const double inside_y_mm = height_mm / 2.0 - fabs(y_mm);

    return inside_x_mm >= 0.0 && inside_y_mm >= 0.0 && inside_x_mm + inside_y_mm >= corner_mm;
}

bool scene_ring(double x_mm, double y_mm)
{
    const double r = hypot(x_mm, y_mm);

    return r <= RING_OUTER_RADIUS_MM && r >= RING_INNER_RADIUS_MM;
}

bool scene_square(double x_mm, double y_mm)
{
    return in_box(x_mm - SQUARE_CENTRE_X_MM, y_mm - SQUARE_CENTRE_Y_MM, SQUARE_SIDE_MM, SQUARE_SIDE_MM);
}

bool scene_rectangle(double x_mm, double y_mm)
{
    return in_box(x_mm - RECTANGLE_CENTRE_X_MM, y_mm - RECTANGLE_CENTRE_Y_MM, RECTANGLE_WIDTH_MM,
                  RECTANGLE_HEIGHT_MM);
}

bool scene_small_ring(double x_mm, double y_mm)
{
    const double r = hypot(x_mm, y_mm);

    return r <= SMALL_RING_OUTER_RADIUS_MM && r >= SMALL_RING_INNER_RADIUS_MM;
}

void scene_clear(struct landing_record *record)
{
    memset(record, 0, sizeof *record);
    record->header.id_magic = LANDING_HEADER_ID_MAGIC_RESET;
    record->header.id_version = LANDING_HEADER_ID_VERSION_RESET;
    record->header.frame_number = 1U;
    record->header.frame_size_width = WIDTH;
    record->header.frame_size_height = HEIGHT;
}

struct attitude {
    double rows[3][3];
};

// Rows are the level axes (forward, right, down) of a body-frame vector: roll
// about forward, then pitch about right.
static struct attitude attitude_of(const struct scene *scene)
{
    const double cr = cos(scene->roll_deg * RADIANS_PER_DEGREE);
    const double sr = sin(scene->roll_deg * RADIANS_PER_DEGREE);
    const double cp = cos(scene->pitch_deg * RADIANS_PER_DEGREE);
    const double sp = sin(scene->pitch_deg * RADIANS_PER_DEGREE);
    const struct attitude attitude = {{{cp, sp * sr, sp * cr}, {0.0, cr, -sr}, {-sp, cp * sr, cp * cr}}};

    return attitude;
}

// Pixel to pad frame; false when it does not look at the ground.
static bool look(const struct scene *scene, const struct attitude *attitude, int x, int y, double *x_mm, double *y_mm)
{
    struct camera_ray ray;

    if (camera_unproject(&camera_default, x, y, &ray) != 0) {
        return false;
    }
    const double body[3] = {ray.forward, ray.right, 1.0};
    double level[3];
    for (int i = 0; i < 3; i++) {
        level[i] = attitude->rows[i][0] * body[0] + attitude->rows[i][1] * body[1] + attitude->rows[i][2] * body[2];
    }
    if (!(level[2] > 0.05)) {
        return false;
    }
    const double forward_mm = (level[0] / level[2] * scene->height_m - scene->forward_m) * 1000.0;
    const double right_mm = (level[1] / level[2] * scene->height_m - scene->right_m) * 1000.0;
    const double c = cos(scene->heading_deg * RADIANS_PER_DEGREE);
    const double s = sin(scene->heading_deg * RADIANS_PER_DEGREE);
    *x_mm = c * right_mm - s * forward_mm;
    *y_mm = -(s * right_mm + c * forward_mm);
    return true;
}

static void add_pixel(struct landing_object *object, int x, int y)
{
    const uint64_t ux = (uint64_t)x;
    const uint64_t uy = (uint64_t)y;

    if (object->area == 0U) {
        object->box_min_x = object->box_max_x = (uint16_t)x;
        object->box_min_y = object->box_max_y = (uint16_t)y;
    }
    object->box_min_x = (uint16_t)(x < object->box_min_x ? x : object->box_min_x);
    object->box_max_x = (uint16_t)(x > object->box_max_x ? x : object->box_max_x);
    object->box_min_y = (uint16_t)(y < object->box_min_y ? y : object->box_min_y);
    object->box_max_y = (uint16_t)(y > object->box_max_y ? y : object->box_max_y);
    object->area++;
    object->sum_x += ux;
    object->sum_y += uy;
    object->sum_xx += ux * ux;
    object->sum_yy += uy * uy;
    object->sum_xy += ux * uy;
}

static void append(struct landing_record *record, const struct landing_object *object)
{
    if (object->area != 0U && record->header.object_count < LANDING_RECORD_MAX_OBJECTS) {
        record->objects[record->header.object_count++] = *object;
    }
}

void scene_paint(struct landing_record *record, const struct scene *scene, scene_shape shape)
{
    const struct attitude attitude = attitude_of(scene);
    struct landing_object object = {0};
    double centre_x;
    double centre_y;

    // The rest of the frame cannot see the pad; looking there takes most of the time.
    scene_project_centre(scene, &centre_x, &centre_y);
    corner_mm = CORNER_PX * 1000.0 * scene->height_m / camera_default.focal_px;
    const int reach = (int)(REACH_M * camera_default.focal_px / scene->height_m);
    for (int y = (int)fmax(centre_y - reach, 0.0); y < (int)fmin(centre_y + reach, HEIGHT); y++) {
        for (int x = (int)fmax(centre_x - reach, 0.0); x < (int)fmin(centre_x + reach, WIDTH); x++) {
            double x_mm;
            double y_mm;
            if (look(scene, &attitude, x, y, &x_mm, &y_mm) && shape(x_mm, y_mm)) {
                add_pixel(&object, x, y);
            }
        }
    }
    append(record, &object);
}

void scene_paint_pad(struct landing_record *record, const struct scene *scene)
{
    scene_paint(record, scene, scene_ring);
    scene_paint(record, scene, scene_square);
    scene_paint(record, scene, scene_small_ring);
    scene_paint(record, scene, scene_rectangle);
}

void scene_paint_pixels(struct landing_record *record, uint16_t x, uint16_t y, uint16_t width, uint16_t height,
                        bool (*inside)(int x, int y))
{
    struct landing_object object = {0};

    for (int i = 0; i < height; i++) {
        for (int j = 0; j < width; j++) {
            if (inside(j, i)) {
                add_pixel(&object, x + j, y + i);
            }
        }
    }
    append(record, &object);
}

// Level axes (forward, right, down) to the camera's (right, down in the image, along its axis).
static void to_camera(const struct attitude *attitude, const double level[3], double camera[3])
{
    double body[3];

    for (int i = 0; i < 3; i++) {
        body[i] = attitude->rows[0][i] * level[0] + attitude->rows[1][i] * level[1] + attitude->rows[2][i] * level[2];
    }
    camera[0] = body[1];
    camera[1] = -body[0];
    camera[2] = body[2];
}

void scene_project_centre(const struct scene *scene, double *x_px, double *y_px)
{
    const struct attitude attitude = attitude_of(scene);
    const double level[3] = {scene->forward_m, scene->right_m, scene->height_m};
    double centre[3];

    to_camera(&attitude, level, centre);
    const struct camera_ray ray = {.right = centre[0] / centre[2], .forward = -centre[1] / centre[2]};
    camera_project(&camera_default, &ray, x_px, y_px);
}

struct pad_view scene_view(const struct scene *scene)
{
    const struct attitude attitude = attitude_of(scene);
    const double heading = scene->heading_deg * RADIANS_PER_DEGREE;
    const double level_across[3] = {-sin(heading), cos(heading), 0.0};
    const double level_normal[3] = {0.0, 0.0, 1.0};
    double across[3];
    double normal[3];
    struct pad_view view = {0};

    to_camera(&attitude, level_across, across);
    to_camera(&attitude, level_normal, normal);
    scene_project_centre(scene, &view.value[PAD_X_PX], &view.value[PAD_Y_PX]);
    view.value[PAD_LOG_DISTANCE_MM] =
        log(1000.0 * sqrt(scene->forward_m * scene->forward_m + scene->right_m * scene->right_m +
                          scene->height_m * scene->height_m));
    view.value[PAD_YAW_RAD] = atan2(across[1], across[0]);
    view.value[PAD_TILT_X] = normal[0] / normal[2];
    view.value[PAD_TILT_Y] = normal[1] / normal[2];
    return view;
}

double scene_count(const struct pad_plane *plane, const struct camera *camera, scene_shape shape, int fineness,
                   bool clipped, struct shape *seen)
{
    const double pitch = 1.0 / fineness;
    double sums[6] = {0.0};
    double whole = 0.0;
    double left_px = (double)INFINITY;
    double right_px = -(double)INFINITY;
    double top_px = (double)INFINITY;
    double bottom_px = -(double)INFINITY;

    corner_mm = 0.0;
    // The corners of a square that holds the pad: lines of the plane bend in the image, so it is larger than the ring.
    for (int i = 0; i < 4; i++) {
        double x_px;
        double y_px;
        pad_plane_project(plane, camera, i % 2 == 0 ? -REACH_MM : REACH_MM, i / 2 == 0 ? -REACH_MM : REACH_MM, &x_px,
                          &y_px);
        left_px = fmin(left_px, x_px);
        right_px = fmax(right_px, x_px);
        top_px = fmin(top_px, y_px);
        bottom_px = fmax(bottom_px, y_px);
    }
    const int columns = (int)((right_px - left_px) * fineness);
    const int rows = (int)((bottom_px - top_px) * fineness);
    for (int row = 0; row < rows; row++) {
        for (int column = 0; column < columns; column++) {
            const double x = (column + 0.5) * pitch;
            const double y = (row + 0.5) * pitch;
            const double x_px = left_px + x;
            const double y_px = top_px + y;
            double x_mm;
            double y_mm;
            if (pad_plane_unproject(plane, camera, x_px, y_px, &x_mm, &y_mm) != 0 || !shape(x_mm, y_mm)) {
                continue;
            }
            whole += pitch * pitch;
            if (clipped && (fabs(x_px + 0.5 - camera->width_px / 2.0) > camera->width_px / 2.0 ||
                            fabs(y_px + 0.5 - camera->height_px / 2.0) > camera->height_px / 2.0)) {
                continue;
            }
            const double terms[6] = {1.0, x, y, x * x, x * y, y * y};
            for (int i = 0; i < 6; i++) {
                sums[i] += pitch * pitch * terms[i];
            }
        }
    }
    const double x = sums[1] / sums[0];
    const double y = sums[2] / sums[0];
    *seen = (struct shape){.area_px = sums[0],
                           .x_px = left_px + x,
                           .y_px = top_px + y,
                           .cov_xx = sums[3] / sums[0] - x * x,
                           .cov_xy = sums[4] / sums[0] - x * y,
                           .cov_yy = sums[5] / sums[0] - y * y};
    return whole;
}

bool scene_search(const struct landing_record *record, const struct detect_hint *hint, uint32_t options,
                  struct detect_scratch *scratch, struct pad_estimate *pad)
{
    int result = DETECT_E_GOES_ON;

    memset(scratch, 0, sizeof *scratch);
    for (int frame = 0; frame < FRAMES_MAX && result == DETECT_E_GOES_ON; frame++) {
        result = detect_pad(record, &camera_default, hint, options, scratch, pad);
    }
    CHECK(result != DETECT_E_GOES_ON);
    return result == 0;
}

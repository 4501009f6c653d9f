// SPDX-License-Identifier: Apache-2.0
// Records painted from ideal geometry: what the hardware would report if it
// saw the pad, or any other set of pixels, without noise.
#ifndef TOUCHDOWN_TEST_SCENE_H
#define TOUCHDOWN_TEST_SCENE_H

#include <stdbool.h>
#include <stdint.h>

#include "camera.h"
#include "detect.h"
#include "landing_regs.h"
#include "pad_view.h"
#include "shapes.h"

struct scene {
    double height_m;    // camera above the ground
    double right_m;     // pad from the point below the camera, in the level frame
    double forward_m;
    double heading_deg; // of the pad, clockwise as seen from above
    double roll_deg;    // right side down
    double pitch_deg;   // nose up
};

// True when the point of the pad frame (mm) belongs to the shape.
typedef bool (*scene_shape)(double x_mm, double y_mm);

bool scene_ring(double x_mm, double y_mm);
bool scene_square(double x_mm, double y_mm);
bool scene_rectangle(double x_mm, double y_mm);
bool scene_small_ring(double x_mm, double y_mm);

// An empty record of a 1280x720 frame.
void scene_clear(struct landing_record *record);

// Appends one object: the pixels whose centres see the shape, less its corners,
// which the hardware's filters take.
void scene_paint(struct landing_record *record, const struct scene *scene, scene_shape shape);

// Appends all four shapes.
void scene_paint_pad(struct landing_record *record, const struct scene *scene);

// Appends the pixels of the box for which `inside` is true.
void scene_paint_pixels(struct landing_record *record, uint16_t x, uint16_t y, uint16_t width, uint16_t height,
                        bool (*inside)(int x, int y));

// Where the ring's physical centre appears.
void scene_project_centre(const struct scene *scene, double *x_px, double *y_px);

// The same, as the firmware describes it; edges not moved.
struct pad_view scene_view(const struct scene *scene);

// Moments of the image of a shape of the pad by counting points, 1 / `fineness`
// pixels apart, that see it, corners and all. `clipped`: only points inside the frame.
// Returns the area without the frame's border.
double scene_count(const struct pad_plane *plane, const struct camera *camera, scene_shape shape, int fineness,
                   bool clipped, struct shape *seen);

// Shows the record to a detection that begins anew, until its search has come to an end. True when it found the pad.
bool scene_search(const struct landing_record *record, const struct detect_hint *hint, uint32_t options,
                  struct detect_scratch *scratch, struct pad_estimate *pad);

#endif

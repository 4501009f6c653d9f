// SPDX-License-Identifier: Apache-2.0
// Where the pad lies before the camera, and what the camera then sees of each
// of its shapes: exact perspective and lens, no small-angle formula.
#ifndef TOUCHDOWN_PAD_VIEW_H
#define TOUCHDOWN_PAD_VIEW_H

#include <stdbool.h>

#include "camera.h"
#include "shapes.h"

// The shapes, as bits: a sighting can be of several that have run together.
enum pad_kind { PAD_SQUARE = 1, PAD_RECTANGLE = 2, PAD_SMALL_RING = 4, PAD_RING = 8 };
#define PAD_KINDS 4
#define PAD_INNER (PAD_SQUARE | PAD_RECTANGLE | PAD_SMALL_RING)

// What is estimated.
enum pad_parameter {
    PAD_X_PX,            // image of the ring's physical centre
    PAD_Y_PX,
    PAD_LOG_DISTANCE_MM, // ln of the distance from the camera to that centre
    PAD_YAW_RAD,         // direction of the pad's x axis about the optical axis, clockwise in the image
    PAD_TILT_X,          // the pad's normal is (tilt x, tilt y, 1) in camera axes
    PAD_TILT_Y,
    PAD_EDGE_PX,         // by how much edges appear moved outwards: blur, bloom and threshold
    PAD_PARAMETERS
};

struct pad_view {
    double value[PAD_PARAMETERS];
};

// The plane of the pad in camera axes, mm.
struct pad_plane {
    double centre[3];
    double across[3]; // unit vectors: the pad's x and y
    double down[3];
    double normal[3];
    double height_mm;  // of the camera above it, signed as the normal points
    double foot_x_mm;  // of the perpendicular from the camera, on the pad
    double foot_y_mm;
    double grazing_mm; // rays that rise less towards it meet it too far away
};

// Fails when the centre is outside of what the camera can see.
int pad_plane_of(const struct pad_view *view, const struct camera *camera, struct pad_plane *plane);

// Image of a point of the pad.
void pad_plane_project(const struct pad_plane *plane, const struct camera *camera, double x_mm, double y_mm,
                       double *x_px, double *y_px);

// Point of the pad in a direction, a unit vector. Fails when that leads past the plane.
int pad_plane_meet(const struct pad_plane *plane, const double direction[3], double *x_mm, double *y_mm);

// Point of the pad that is seen at a pixel. Fails when the pixel looks past the plane.
int pad_plane_unproject(const struct pad_plane *plane, const struct camera *camera, double x_px, double y_px,
                        double *x_mm, double *y_mm);

// Cosine of the angle between the plane's normal and the ray to the pad's centre.
double pad_plane_facing(const struct pad_plane *plane);

// Which points of the print stand for all of it.
enum pad_sampling {
    PAD_WHOLE,   // as if the frame had no border
    PAD_CLIPPED, // only what lies inside the frame, on a grid as fine as its border needs
    PAD_ROUGH    // the same, but for differences between views that are hardly apart
};

// Moments of the image of the shapes in `kinds`, taken as one. The invariant is not computed.
// Returns the share of the shapes' print that is inside the frame; 0 leaves `seen` undefined.
double pad_plane_moments(const struct pad_plane *plane, const struct camera *camera, unsigned kinds,
                         enum pad_sampling sampling, struct shape *seen);

// What that costs: see work.h.
int pad_plane_work(unsigned kinds, enum pad_sampling sampling);

// Area of the shapes' print.
double pad_area_mm2(unsigned kinds);

// Length of the edges of what is seen of the shapes: `inside` is the share of
// their print that `seen` is the image of.
double pad_edges_px(unsigned kinds, const struct shape *seen, double inside);

#endif

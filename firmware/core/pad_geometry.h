// SPDX-License-Identifier: Apache-2.0
// Dimensions of the landing pad. The owner of these numbers is
// golden/pad_geometry.py; firmware/test_firmware.py compares the two.
// Pad frame: origin at the centre of the ring, x right, y down as printed.
#ifndef TOUCHDOWN_PAD_GEOMETRY_H
#define TOUCHDOWN_PAD_GEOMETRY_H

#define RING_OUTER_RADIUS_MM 125.0
#define RING_INNER_RADIUS_MM 100.0

#define SQUARE_SIDE_MM 50.0
#define SQUARE_CENTRE_X_MM 0.0
#define SQUARE_CENTRE_Y_MM (-52.771)

#define RECTANGLE_WIDTH_MM 100.0
#define RECTANGLE_HEIGHT_MM 50.0
#define RECTANGLE_CENTRE_X_MM 0.0
#define RECTANGLE_CENTRE_Y_MM 50.806

#define SMALL_RING_OUTER_RADIUS_MM 17.5
#define SMALL_RING_INNER_RADIUS_MM 7.5

#endif

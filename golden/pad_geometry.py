# SPDX-License-Identifier: Apache-2.0
"""Dimensions of the landing pad in millimetres.

Pad frame: origin at the centre of the ring, x right, y down as the marker is
printed (square above, rectangle below).
"""

RING_OUTER_RADIUS_MM = 125.0
RING_INNER_RADIUS_MM = 100.0

SQUARE_SIDE_MM = 50.0
SQUARE_CENTRE_X_MM = 0.0
SQUARE_CENTRE_Y_MM = -52.771

RECTANGLE_WIDTH_MM = 100.0
RECTANGLE_HEIGHT_MM = 50.0
RECTANGLE_CENTRE_X_MM = 0.0
RECTANGLE_CENTRE_Y_MM = 50.806

SMALL_RING_OUTER_RADIUS_MM = 17.5
SMALL_RING_INNER_RADIUS_MM = 7.5

PAPER_WIDTH_MM = 297.0
PAPER_HEIGHT_MM = 420.0
PAPER_LEFT_MM = -152.82
PAPER_TOP_MM = -200.066

# SPDX-License-Identifier: Apache-2.0
"""The rules of the paper, to compare with: proportions of boxes, sizes expected from the altitude, containment.

The paper names the quantities and refers to its authors' published software for the limits; these are the limits of
its first version. The size of the ring comes from the camera's model in place of their table for another lens.
"""

import math
from typing import NamedTuple

import numpy as np

from golden import pad_geometry
from sim.world.camera import Camera

_RING_TO_SQUARE = 2 * pad_geometry.RING_OUTER_RADIUS_MM / pad_geometry.SQUARE_SIDE_MM
_RING_M = 2 * pad_geometry.RING_OUTER_RADIUS_MM / 1000.0
_LOW_PX = 150
_VERY_LOW_PX = 500


class Found(NamedTuple):
    """Whole pixels and degrees, as the authors' software gives them; metres by the size that the ring should have."""

    x_px: int
    y_px: int
    angle_deg: int
    right_m: float
    forward_m: float


def ring_width_px(altitude_m: float) -> float:
    """Width of the ring straight below the camera at this altitude."""
    half_angle = math.atan(pad_geometry.RING_OUTER_RADIUS_MM / 1000.0 / altitude_m)
    return 4.0 * Camera().focal_px * math.tan(half_angle / 2.0)


def find_pad(objects: np.ndarray, altitude_m: float) -> Found | None:
    """The pad among the objects of a frame.

    Args:
        objects: `OBJECT_DTYPE`.
        altitude_m: What the LiDAR measures.
    """
    camera = Camera()
    ring = ring_width_px(altitude_m)
    side = ring / _RING_TO_SQUARE
    area = objects["area"].astype(np.float64)
    left, top = objects["box_min_x"].astype(int), objects["box_min_y"].astype(int)
    width, height = objects["box_max_x"] - left + 1, objects["box_max_y"] - top + 1
    centre = np.column_stack([left + width // 2, top + height // 2])
    proportion = np.maximum(width, height) / np.minimum(width, height)
    box = (width * height).astype(np.float64)
    emptiness = box / area
    mean_side = (width + height) / 2

    round_box = proportion < 1.15
    circle = (emptiness > 2.75) & (mean_side > 0.5 * ring) & (mean_side < 1.5 * ring)
    if _LOW_PX < ring < _VERY_LOW_PX:
        small = (emptiness > 1.55) & (emptiness < 2.0) & (mean_side < 1.1 * side)
        circle |= small & (area > 0.005 * ring**2) & (area < 0.04 * ring**2)
    elif ring >= _VERY_LOW_PX:
        circle |= (emptiness > 1.5) & (emptiness < 2.0) & (area > 0.01 * ring**2)
    circle &= round_box
    square = ~circle & (proportion < 1.25) & (emptiness < 2.25) & (box < 3.0 * side**2)
    square &= (area > 0.4 * side**2) & (area < 1.7 * side**2)
    rectangle = ~circle & ~square & (proportion < 2.4) & (emptiness < 2.2)
    rectangle &= (box > 1.3 * side**2) & (area > 0.4 * side**2)

    nearest = (0.2 if ring > 200 else 0.3) * ring
    low, high = np.column_stack([left, top]), np.column_stack([left + width, top + height])
    found = None
    # The last one wins, as in the authors' loops.
    for c in np.nonzero(circle)[0]:
        inside = ((low[c] < centre) & (centre < high[c])).all(axis=1)
        for s in np.nonzero(square & inside)[0]:
            for r in np.nonzero(rectangle & inside)[0]:
                along = centre[s] - centre[r]
                if nearest < math.hypot(*along) < 0.65 * ring:
                    x, y = (centre[s] + centre[r]) // 2
                    angle = int(math.degrees(math.atan2(along[1], along[0]) + math.pi / 2))
                    right, back = (np.array([x, y]) - (camera.centre_x, camera.centre_y)) * _RING_M / ring
                    found = Found(int(x), int(y), angle, float(right), -float(back))
    return found

# SPDX-License-Identifier: Apache-2.0
"""What the hardware made of the pad's shapes in a frame that was missed: the cause, as far as the record shows it."""

import math

import numpy as np

from golden import pad_geometry as pad
from sim.accuracy.rows import Reference
from sim.world.camera import Camera

_RING_AREA = math.pi * (pad.RING_OUTER_RADIUS_MM**2 - pad.RING_INNER_RADIUS_MM**2)
_SMALL_RING_AREA = math.pi * (pad.SMALL_RING_OUTER_RADIUS_MM**2 - pad.SMALL_RING_INNER_RADIUS_MM**2)
_INNER = {
    "square": (pad.SQUARE_CENTRE_Y_MM, pad.SQUARE_SIDE_MM**2),
    "rectangle": (pad.RECTANGLE_CENTRE_Y_MM, pad.RECTANGLE_WIDTH_MM * pad.RECTANGLE_HEIGHT_MM),
    "small ring": (0.0, _SMALL_RING_AREA),
}
_NEAR_MM = 22.0
_RING_OFF_MM = 45.0
_RING_SIDE = (0.6, 1.5)
_RING_RATIO = 12.0
_ALONE = 2.0
_LIKE = (0.6, 1.5)
_ABSENT = "absent"


def shapes_seen(objects: np.ndarray, truth: Reference, lidar_m: float, min_area_px: int) -> str:
    """Which shapes are in the record as they should be, and which are not.

    A shape is sought where the true centre, the true angle and the distance put it; its area is compared with that of
    its print. Tilt and lens are left out, so that a factor below 1.5 means nothing.

    Args:
        objects: `OBJECT_DTYPE`.
        truth: With centre and angle.
        lidar_m: Where the truth gives no distance.
        min_area_px: MIN_AREA of the record, which takes away what is smaller.
    """
    if truth.x_px is None or truth.y_px is None or truth.angle_deg is None:
        return ""
    scale = Camera().focal_px / (1000.0 * (truth.altitude_m or lidar_m))
    turn = math.radians(truth.angle_deg)
    down = np.array([-math.sin(turn), math.cos(turn)])
    centre = np.array([truth.x_px, truth.y_px])
    places = {name: centre + y_mm * scale * down for name, (y_mm, _) in _INNER.items()}
    ratios = {name: objects["area"] / (area_mm * scale**2) for name, (_, area_mm) in _INNER.items()}
    centroid = np.column_stack([objects["sum_x"], objects["sum_y"]]) / objects["area"][:, None]
    near = {name: np.linalg.norm(centroid - place, axis=1) < _NEAR_MM * scale for name, place in places.items()}
    words = [f"ring {_ring(objects, centre, scale)}"]
    for name, place in places.items():
        # A shape alone in its place has not joined another one, however far its box reaches.
        alone = np.any([near[other] & (ratios[other] < _ALONE) for other in places if other != name], axis=0)
        said = _inner(ratios[name][near[name] | (_around(objects, place) & ~alone)])
        area_px = _INNER[name][1] * scale**2
        small = said == _ABSENT and area_px < min_area_px
        words.append(f"{name} {said}{f' (its {area_px:.0f} px are less than MIN_AREA)' * small}")
    return ", ".join(words)


def _ring(objects: np.ndarray, centre: np.ndarray, scale: float) -> str:
    low = np.column_stack([objects["box_min_x"], objects["box_min_y"]]).astype(float)
    high = np.column_stack([objects["box_max_x"], objects["box_max_y"]]).astype(float)
    side = (high - low).max(axis=1) / (2 * pad.RING_OUTER_RADIUS_MM * scale)
    off = np.linalg.norm((low + high) / 2 - centre, axis=1) / scale
    fits = (off < _RING_OFF_MM) & (side > _RING_SIDE[0]) & (side < _RING_SIDE[1])
    if not fits.any():
        return "absent or in pieces"
    nearest = np.flatnonzero(fits)[np.argmin(off[fits])]
    return _like(objects["area"][nearest] / (_RING_AREA * scale**2))


def _around(objects: np.ndarray, place: np.ndarray) -> np.ndarray:
    """Whose box holds a place."""
    inside = (objects["box_min_x"] <= place[0]) & (place[0] <= objects["box_max_x"])
    return inside & (objects["box_min_y"] <= place[1]) & (place[1] <= objects["box_max_y"])


def _inner(ratios: np.ndarray) -> str:
    # More than that is the ring, whose box holds everything.
    ratios = ratios[ratios < _RING_RATIO]
    return _like(float(ratios[np.argmin(np.abs(np.log(ratios)))])) if ratios.size else _ABSENT


def _like(ratio: float) -> str:
    if ratio < _LIKE[0]:
        return f"{ratio:.1f} of its area"
    return "seen" if ratio <= _LIKE[1] else f"joined ({ratio:.1f} times its area)"

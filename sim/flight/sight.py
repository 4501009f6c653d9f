# SPDX-License-Identifier: Apache-2.0
"""What the hardware would report of the pad from a pose: painted and labelled. No light, no noise, no ground."""

import cv2
import numpy as np

from golden import pad_geometry as pad
from golden.ccl import ccl
from sim.world.camera import Camera
from sim.world.pose import Pose, project_pad

_SHIFT = 6
_TURN = np.linspace(0.0, 2.0 * np.pi, 180, endpoint=False)
_CIRCLE = np.column_stack([np.cos(_TURN), np.sin(_TURN)])
_SIDE = np.linspace(-0.5, 0.5, 12, endpoint=False)
_HALF = np.full_like(_SIDE, 0.5)
_BOX = np.concatenate(
    [
        np.column_stack([_SIDE, -_HALF]),
        np.column_stack([_HALF, _SIDE]),
        np.column_stack([-_SIDE, _HALF]),
        np.column_stack([-_HALF, -_SIDE]),
    ]
)
_OUTLINES = (
    (1, pad.RING_OUTER_RADIUS_MM * _CIRCLE),
    (0, pad.RING_INNER_RADIUS_MM * _CIRCLE),
    (1, [pad.SQUARE_CENTRE_X_MM, pad.SQUARE_CENTRE_Y_MM] + pad.SQUARE_SIDE_MM * _BOX),
    (
        1,
        [pad.RECTANGLE_CENTRE_X_MM, pad.RECTANGLE_CENTRE_Y_MM]
        + np.array([pad.RECTANGLE_WIDTH_MM, pad.RECTANGLE_HEIGHT_MM]) * _BOX,
    ),
    (1, pad.SMALL_RING_OUTER_RADIUS_MM * _CIRCLE),
    (0, pad.SMALL_RING_INNER_RADIUS_MM * _CIRCLE),
)
"""What is printed, one over the other: 1 = black."""


def objects_of(camera: Camera, pose: Pose, min_area: int) -> np.ndarray:
    """The pad's shapes as `OBJECT_DTYPE`.

    Args:
        camera: The camera.
        pose: Where the vehicle is; a pad out of sight gives no objects.
        min_area: Smaller ones are left out.
    """
    rim = project_pad(camera, pose, _OUTLINES[0][1])
    left, top = np.clip(np.floor(rim.min(axis=0)).astype(int) - 1, 0, (camera.width, camera.height))
    right, bottom = np.clip(np.ceil(rim.max(axis=0)).astype(int) + 2, 0, (camera.width, camera.height))
    if right <= left or bottom <= top:
        return ccl(np.zeros((1, 1), np.uint8))
    picture = np.zeros((bottom - top, right - left), np.uint8)
    for colour, outline in _OUTLINES:
        points = project_pad(camera, pose, np.asarray(outline)) - (left, top)
        cv2.fillPoly(picture, [np.round(points * (1 << _SHIFT)).astype(np.int32)], colour, shift=_SHIFT)
    return _moved(ccl(picture, min_area), int(left), int(top))


def _moved(objects: np.ndarray, x: int, y: int) -> np.ndarray:
    """The same objects in a picture that has so many more columns and lines before."""
    area, sum_x, sum_y = (objects[name].astype(np.int64) for name in ("area", "sum_x", "sum_y"))
    for name, add in {
        "sum_xx": 2 * x * sum_x + x * x * area,
        "sum_yy": 2 * y * sum_y + y * y * area,
        "sum_xy": y * sum_x + x * sum_y + x * y * area,
        "sum_x": x * area,
        "sum_y": y * area,
        "box_min_x": x,
        "box_max_x": x,
        "box_min_y": y,
        "box_max_y": y,
    }.items():
        objects[name] = objects[name].astype(np.int64) + add
    return objects

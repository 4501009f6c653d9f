# SPDX-License-Identifier: Apache-2.0
"""The landing pad as a target: centroids of its shapes and the ellipse of its ring, as the cores would report them.

The four centroids lie on one line, which says nothing of a turn about that line; so the ring's second moments count
too, and the paper is taken to lie level, give or take eight degrees. Both ends of the chain are the project's own: the
golden models find the shapes, the firmware says which is which.
"""

from collections.abc import Sequence
from functools import cache

import numpy as np

from firmware.library import GROUND, Firmware, make
from golden import pad_geometry as pad
from golden import result_writer
from golden.chain import Settings, run_frames
from scripts.calibrate_fit import View, pose_points
from sim.world.camera import Camera

NOISE_PX = 0.3
"""What a centroid is good for on a photo; against it the tilt is weighed."""
TILT_SIGMA = 0.14
_AREA_RATIO = 1.6
_SIDE_POINTS = 12
_TURN_POINTS = 96
_SETTINGS = Settings()
_FRAME_US = 16_667


def _box(x: float, y: float, width: float, height: float) -> np.ndarray:
    """Outline (n, 2) in mm."""
    along = np.linspace(-0.5, 0.5, _SIDE_POINTS, endpoint=False)
    half = np.full_like(along, 0.5)
    sides = [(along, -half), (half, along), (-along, half), (-half, -along)]
    return np.concatenate([np.column_stack(side) for side in sides]) * (width, height) + (x, y)


def _circle(radius: float) -> np.ndarray:
    turn = np.linspace(0.0, 2.0 * np.pi, _TURN_POINTS, endpoint=False)
    return radius * np.column_stack([np.cos(turn), np.sin(turn)])


_SHAPES = (
    (_box(pad.SQUARE_CENTRE_X_MM, pad.SQUARE_CENTRE_Y_MM, pad.SQUARE_SIDE_MM, pad.SQUARE_SIDE_MM),),
    (_box(pad.RECTANGLE_CENTRE_X_MM, pad.RECTANGLE_CENTRE_Y_MM, pad.RECTANGLE_WIDTH_MM, pad.RECTANGLE_HEIGHT_MM),),
    (_circle(pad.SMALL_RING_OUTER_RADIUS_MM), _circle(pad.SMALL_RING_INNER_RADIUS_MM)),
    (_circle(pad.RING_OUTER_RADIUS_MM), _circle(pad.RING_INNER_RADIUS_MM)),
)
"""Outer outline and hole of each shape; the ring is the last."""
_SMALL_RING = 2


def _polygon(points: np.ndarray) -> np.ndarray:
    """Area and the integrals of x, y, xx, xy, yy inside a polygon (n, 2) that runs clockwise in the image."""
    x, y = points[:, 0], points[:, 1]
    to_x, to_y = np.roll(x, -1), np.roll(y, -1)
    cross = x * to_y - to_x * y
    return np.array(
        [
            cross.sum() / 2,
            (cross * (x + to_x)).sum() / 6,
            (cross * (y + to_y)).sum() / 6,
            (cross * (x * x + x * to_x + to_x * to_x)).sum() / 12,
            (cross * (2 * x * y + x * to_y + to_x * y + 2 * to_x * to_y)).sum() / 24,
            (cross * (y * y + y * to_y + to_y * to_y)).sum() / 12,
        ]
    )


def _moved_out(points: np.ndarray, edge_px: float) -> np.ndarray:
    along = np.roll(points, -1, axis=0) - np.roll(points, 1, axis=0)
    along /= np.linalg.norm(along, axis=1)[:, None]
    return points + edge_px * np.column_stack([along[:, 1], -along[:, 0]])


def _moments(outlines: Sequence[np.ndarray], edge_px: float) -> tuple[float, np.ndarray, np.ndarray]:
    """Area, centroid (2,) and covariance xx, xy, yy (3,) of a shape whose edges have moved out by `edge_px`."""
    origin = outlines[0].mean(axis=0)
    sums = _polygon(_moved_out(outlines[0] - origin, edge_px))
    for hole in outlines[1:]:
        sums = sums - _polygon(_moved_out(hole - origin, -edge_px))
    area, (x, y) = sums[0], sums[1:3] / sums[0]
    return float(area), origin + np.array([x, y]), sums[3:] / area - (x * x, x * y, y * y)


def _predicted(
    camera: Camera, unknowns: np.ndarray, which: Sequence[int]
) -> list[tuple[float, np.ndarray, np.ndarray]]:
    return [
        _moments([camera.project(pose_points(outline, unknowns[:6])) for outline in _SHAPES[index]], unknowns[6])
        for index in which
    ]


def _tilt(unknowns: np.ndarray) -> np.ndarray:
    normal = np.cross(*(pose_points(np.eye(2), unknowns[:6]) - unknowns[3:6]))
    return normal[:2] / normal[2]


def _entries(shapes: Sequence[tuple[float, np.ndarray, np.ndarray]], ring_px: float, tilt: np.ndarray) -> np.ndarray:
    """What a view holds: centroids, then of the ring the covariance and the area, then the tilt, all as pixels.

    Args:
        shapes: Area, centroid and covariance of each.
        ring_px: Standard deviation of the ring along an axis; a change of it by a pixel counts as one.
        tilt: Of the pad's plane.
    """
    area, _, covariance = shapes[-1]
    ring = [*(covariance / (2.0 * ring_px)), area / (4.0 * np.pi * ring_px)]
    return np.concatenate([*(centroid for _, centroid, _ in shapes), ring, tilt * (NOISE_PX / TILT_SIGMA)])


@cache
def _build_firmware() -> None:
    make("host")


def _start(objects: np.ndarray, width: int, height: int) -> np.ndarray | None:
    """Where the firmware sees a level pad; shown twice, since a frame's thresholds are of the one before."""
    _build_firmware()
    firmware = Firmware()
    for number in range(2):
        header = {
            "frame_number": number,
            "start_time_us": number * _FRAME_US,
            "frame_size_width": width,
            "frame_size_height": height,
            "threshold_factor": _SETTINGS.factor,
        }
        firmware.on_record(result_writer.record(header, objects), number * _FRAME_US)
    found, _, _, angle, _, right, forward, *_, height = firmware.take(GROUND)[-1].data[:12]
    if not found:
        return None
    return np.array([0.0, 0.0, np.radians(angle), 1000.0 * right, -1000.0 * forward, 1000.0 * height, 0.0])


def _seen(entry: np.void) -> tuple[float, np.ndarray, np.ndarray]:
    area = float(entry["area"])
    x, y, xx, xy, yy = (float(entry[f"sum_{name}"]) / area for name in ("x", "y", "xx", "xy", "yy"))
    # A pixel is a unit square.
    return area, np.array([x, y]), np.array([xx - x * x + 1 / 12, xy - x * y, yy - y * y + 1 / 12])


def find_pad(rgb: np.ndarray, name: str, camera: Camera) -> View | None:
    """The view of the pad in a picture (height, width, 3); None where square, rectangle or ring is not seen whole.

    The small ring counts where it is seen; from afar the filters fill or take it.
    """
    *_, stages = run_frames([rgb, rgb], _SETTINGS)
    height, width = rgb.shape[:2]
    start = _start(stages.objects, width, height)
    if start is None:
        return None
    inside = [
        entry
        for entry in stages.objects
        if min(entry["box_min_x"], entry["box_min_y"]) > 0
        and entry["box_max_x"] < width - 1
        and entry["box_max_y"] < height - 1
    ]
    which, shapes = [], []
    for index, (area, centroid, _) in enumerate(_predicted(camera, start, range(len(_SHAPES)))):
        alike = [one for one in map(_seen, inside) if area / _AREA_RATIO < one[0] < area * _AREA_RATIO]
        nearest = min(alike, key=lambda one: np.linalg.norm(one[1] - centroid), default=None)
        if nearest is not None and np.linalg.norm(nearest[1] - centroid) < 0.5 * np.sqrt(area):
            which.append(index)
            shapes.append(nearest)
        elif index != _SMALL_RING:
            return None
    ring_px = float(np.sqrt((shapes[-1][2][0] + shapes[-1][2][2]) / 2.0))

    def predict(camera: Camera, unknowns: np.ndarray) -> np.ndarray:
        return _entries(_predicted(camera, unknowns, which), ring_px, _tilt(unknowns))

    return View(name, _entries(shapes, ring_px, np.zeros(2)), predict, start, 2 * len(shapes))

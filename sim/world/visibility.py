# SPDX-License-Identifier: Apache-2.0
"""How much of each shape of the pad is to be seen in a frame."""

import functools
from dataclasses import dataclass

import numpy as np

from sim.world.camera import Camera
from sim.world.curl import Curl
from sim.world.decal import Decal
from sim.world.pad import RECTANGLE, RING, SMALL_RING, SQUARE, Box, Ring
from sim.world.pose import Pose, project_pad

SHAPES: dict[str, Box | Ring] = {"ring": RING, "square": SQUARE, "rectangle": RECTANGLE, "small_ring": SMALL_RING}

_CELLS = 80
_RING_CELLS = (16, 720)


@dataclass(frozen=True)
class ShapeTruth:
    """What is to be seen of one shape.

    Attributes:
        share: Share of its printed area that is inside the frame and under nothing.
        area_px: Area of the image of the whole shape, also of what is outside the frame or covered.
        width_px: Narrower side of the box that spreads as the image of the whole shape does; of square and rectangle
            the width that a filter meets.
    """

    share: float
    area_px: float
    width_px: float


def shapes_of(
    camera: Camera, pose: Pose, curl: Curl, cover: Decal | None, frame_mask: np.ndarray | None
) -> dict[str, ShapeTruth]:
    """What is to be seen of each of `SHAPES`.

    Args:
        camera: The camera.
        pose: Where the drone is.
        curl: How the paper is bent.
        cover: What lies on the paper.
        frame_mask: (height, width) uint8, 255 where something of the drone's own is in view.
    """
    result = {}
    for name, shape in SHAPES.items():
        points = _cells(shape)
        image = project_pad(camera, pose, points, curl)
        # A pixel reaches half a pixel to each side of its centre.
        seen = ((image >= -0.5) & (image <= (camera.width - 0.5, camera.height - 0.5))).all(axis=1).astype(float)
        if cover:
            seen *= 1.0 - cover.opacity_at(points)
        if frame_mask is not None:
            column, line = np.clip(np.rint(image).astype(int), 0, (camera.width - 1, camera.height - 1)).T
            seen *= 1.0 - frame_mask[line, column] / 255.0
        area = sum(sign * _area(project_pad(camera, pose, outline, curl)) for sign, outline in _outlines(shape))
        result[name] = ShapeTruth(float(seen.mean()), area, _width(image))
    return result


@functools.lru_cache(maxsize=4)
def _cells(shape: Box | Ring) -> np.ndarray:
    """Middles (n, 2) of parts of equal area."""
    if isinstance(shape, Box):
        across, down = np.meshgrid(*[(np.arange(_CELLS) + 0.5) / _CELLS - 0.5] * 2)
        return np.column_stack([shape.x + shape.width * across.ravel(), shape.y + shape.height * down.ravel()])
    shells, turns = _RING_CELLS
    squares = shape.inner**2 + (shape.outer**2 - shape.inner**2) * (np.arange(shells) + 0.5) / shells
    turn = 2 * np.pi * (np.arange(turns) + 0.5) / turns
    radius, turn = (grid.ravel() for grid in np.meshgrid(np.sqrt(squares), turn))
    return np.column_stack([shape.x + radius * np.cos(turn), shape.y + radius * np.sin(turn)])


@functools.lru_cache(maxsize=4)
def _outlines(shape: Box | Ring) -> list[tuple[int, np.ndarray]]:
    """Closed outlines, and whether each adds area or takes it away."""
    if isinstance(shape, Box):
        along = np.linspace(-0.5, 0.5, 50, endpoint=False)
        edge = np.full(50, 0.5)
        sides = [(along, -edge), (edge, along), (-along, edge), (-edge, -along)]
        unit = np.concatenate([np.column_stack(side) for side in sides])
        return [(1, (shape.x, shape.y) + unit * (shape.width, shape.height))]
    turn = np.linspace(0, 2 * np.pi, 1000, endpoint=False)
    circle = np.column_stack([np.cos(turn), np.sin(turn)])
    return [(1, shape.outer * circle + (shape.x, shape.y)), (-1, shape.inner * circle + (shape.x, shape.y))]


def _width(image: np.ndarray) -> float:
    """A box of width w spreads across by w^2 / 12."""
    return float(np.sqrt(12.0 * max(np.linalg.eigvalsh(np.cov(image.T))[0], 0.0)))


def _area(outline: np.ndarray) -> float:
    """By the shoelace formula."""
    x, y = (outline - outline.mean(axis=0)).T
    return float(abs(x @ np.roll(y, -1) - y @ np.roll(x, -1)) / 2)

# SPDX-License-Identifier: Apache-2.0
"""How much of each pixel is paper and how much of it is print."""

import math
from dataclasses import dataclass

import numpy as np

from golden import pad_geometry as pad

_SUBSAMPLES = 4


@dataclass(frozen=True)
class Box:
    """A rectangle of the print or of the paper, in mm, turned clockwise about its own middle."""

    x: float
    y: float
    width: float
    height: float
    turn_deg: float = 0.0

    def distance(self, x: np.ndarray, y: np.ndarray) -> np.ndarray:
        """Signed distance in mm, negative inside; outside near a corner it is the larger axis' distance."""
        across, down = x - np.float32(self.x), y - np.float32(self.y)
        if self.turn_deg:
            turn = math.radians(self.turn_deg)
            cosine, sine = np.float32(math.cos(turn)), np.float32(math.sin(turn))
            across, down = cosine * across + sine * down, cosine * down - sine * across
        return np.maximum(np.abs(across) - self.width / 2, np.abs(down) - self.height / 2)


@dataclass(frozen=True)
class Ring:
    """A ring about x, y in mm; with `inner` 0 or less a disc."""

    outer: float
    inner: float
    x: float = 0.0
    y: float = 0.0

    def distance(self, x: np.ndarray, y: np.ndarray) -> np.ndarray:
        """Signed distance in mm, negative inside."""
        radius = np.hypot(x - np.float32(self.x), y - np.float32(self.y))
        outside = radius - self.outer
        return np.maximum(outside, self.inner - radius) if self.inner > 0 else outside


@dataclass(frozen=True)
class Sheet:
    """A paper and what is printed on it."""

    paper: Box
    shapes: tuple[Box | Ring, ...]


SQUARE = Box(pad.SQUARE_CENTRE_X_MM, pad.SQUARE_CENTRE_Y_MM, pad.SQUARE_SIDE_MM, pad.SQUARE_SIDE_MM)
RECTANGLE = Box(pad.RECTANGLE_CENTRE_X_MM, pad.RECTANGLE_CENTRE_Y_MM, pad.RECTANGLE_WIDTH_MM, pad.RECTANGLE_HEIGHT_MM)
RING = Ring(pad.RING_OUTER_RADIUS_MM, pad.RING_INNER_RADIUS_MM)
SMALL_RING = Ring(pad.SMALL_RING_OUTER_RADIUS_MM, pad.SMALL_RING_INNER_RADIUS_MM)
PAPER = Box(
    pad.PAPER_LEFT_MM + pad.PAPER_WIDTH_MM / 2,
    pad.PAPER_TOP_MM + pad.PAPER_HEIGHT_MM / 2,
    pad.PAPER_WIDTH_MM,
    pad.PAPER_HEIGHT_MM,
)
PAD = Sheet(PAPER, (RING, SMALL_RING, SQUARE, RECTANGLE))


def coverage(x_mm: np.ndarray, y_mm: np.ndarray, sheet: Sheet = PAD) -> tuple[np.ndarray, np.ndarray]:
    """Share of each pixel that paper and print cover.

    Pixels that an edge may cross are sampled 4 x 4 times, and each sample takes
    the share of its own small square that the distance to the edge tells. The
    plane within one pixel is taken as flat.

    Args:
        x_mm: (height, width) sheet x of each pixel centre.
        y_mm: (height, width) sheet y of each pixel centre.
        sheet: What lies there.

    Returns:
        (paper, black): (height, width) float32 in [0, 1]; black lies within paper.
    """
    x_down, x_across = np.gradient(x_mm)
    y_down, y_across = np.gradient(y_mm)
    # Half of both sides of the pixel's footprint: no edge farther than this can cross the pixel.
    reach = 0.5 * (np.hypot(x_across, y_across) + np.hypot(x_down, y_down))
    # Their mean is the width of a sample.
    footprint = reach / _SUBSAMPLES
    offsets = (np.arange(_SUBSAMPLES) + 0.5) / _SUBSAMPLES - 0.5
    across, down = (grid.ravel().astype(np.float32) for grid in np.meshgrid(offsets, offsets))

    layers = []
    for shapes in ((sheet.paper,), sheet.shapes):
        at_centre = _distance(x_mm, y_mm, shapes)
        layer = (at_centre < 0).astype(np.float32)
        edge = np.nonzero(np.abs(at_centre) <= reach)
        x_sub = x_mm[edge][:, None] + x_across[edge][:, None] * across + x_down[edge][:, None] * down
        y_sub = y_mm[edge][:, None] + y_across[edge][:, None] * across + y_down[edge][:, None] * down
        share = 0.5 - _distance(x_sub, y_sub, shapes) / footprint[edge][:, None]
        layer[edge] = np.clip(share, 0, 1).mean(axis=1)
        layers.append(layer)
    return layers[0], layers[1]


def _distance(x: np.ndarray, y: np.ndarray, shapes: tuple[Box | Ring, ...]) -> np.ndarray:
    """Signed distance in mm to the nearest of the shapes, negative inside one of them."""
    nearest = np.full(x.shape, np.inf, np.float32)
    for shape in shapes:
        np.minimum(nearest, shape.distance(x, y), out=nearest, casting="same_kind")
    return nearest

# SPDX-License-Identifier: Apache-2.0
"""How much of each pixel is paper and how much of it is print."""

from typing import NamedTuple

import numpy as np

from golden import pad_geometry as pad

_SUBSAMPLES = 4


class _Box(NamedTuple):
    """An upright rectangle of the print or of the paper, in mm."""

    x: float
    y: float
    width: float
    height: float


_PAPER = _Box(
    pad.PAPER_LEFT_MM + pad.PAPER_WIDTH_MM / 2,
    pad.PAPER_TOP_MM + pad.PAPER_HEIGHT_MM / 2,
    pad.PAPER_WIDTH_MM,
    pad.PAPER_HEIGHT_MM,
)
_SQUARE = _Box(pad.SQUARE_CENTRE_X_MM, pad.SQUARE_CENTRE_Y_MM, pad.SQUARE_SIDE_MM, pad.SQUARE_SIDE_MM)
_RECTANGLE = _Box(pad.RECTANGLE_CENTRE_X_MM, pad.RECTANGLE_CENTRE_Y_MM, pad.RECTANGLE_WIDTH_MM, pad.RECTANGLE_HEIGHT_MM)


def _box_distance(x: np.ndarray, y: np.ndarray, box: _Box) -> np.ndarray:
    """Signed distance to a box in mm, negative inside; outside near a corner it is the larger axis' distance."""
    return np.maximum(np.abs(x - box.x) - box.width / 2, np.abs(y - box.y) - box.height / 2)


def _paper_distance(x: np.ndarray, y: np.ndarray) -> np.ndarray:
    return _box_distance(x, y, _PAPER)


def _ring_distance(radius: np.ndarray, outer: float, inner: float) -> np.ndarray:
    return np.maximum(radius - outer, inner - radius)


def _print_distance(x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Signed distance in mm to the black shapes, negative inside one of them."""
    radius = np.hypot(x, y)
    rings = np.minimum(
        _ring_distance(radius, pad.RING_OUTER_RADIUS_MM, pad.RING_INNER_RADIUS_MM),
        _ring_distance(radius, pad.SMALL_RING_OUTER_RADIUS_MM, pad.SMALL_RING_INNER_RADIUS_MM),
    )
    return np.minimum(rings, np.minimum(_box_distance(x, y, _SQUARE), _box_distance(x, y, _RECTANGLE)))


def coverage(x_mm: np.ndarray, y_mm: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Share of each pixel that paper and print cover.

    Pixels that an edge may cross are sampled 4 x 4 times, and each sample takes
    the share of its own small square that the distance to the edge tells. The
    plane within one pixel is taken as flat.

    Args:
        x_mm: (height, width) pad x of each pixel centre.
        y_mm: (height, width) pad y of each pixel centre.

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
    for distance in (_paper_distance, _print_distance):
        at_centre = distance(x_mm, y_mm)
        layer = (at_centre < 0).astype(np.float32)
        edge = np.nonzero(np.abs(at_centre) <= reach)
        x_sub = x_mm[edge][:, None] + x_across[edge][:, None] * across + x_down[edge][:, None] * down
        y_sub = y_mm[edge][:, None] + y_across[edge][:, None] * across + y_down[edge][:, None] * down
        share = 0.5 - distance(x_sub, y_sub) / footprint[edge][:, None]
        layer[edge] = np.clip(share, 0, 1).mean(axis=1)
        layers.append(layer)
    return layers[0], layers[1]

# SPDX-License-Identifier: Apache-2.0
"""Pictures that lie on a plane, sampled without aliasing: halvings of the picture, blended by the size of a pixel."""

import cv2
import numpy as np

_SMALLEST_PX = 8
_DETAIL_STEP_PX = 8


class Texture:
    """A square picture on a plane, 8 bit, any number of channels cv2 takes (1, 3 or 4).

    Args:
        picture: (n, n, channels) or (n, n) uint8, n a power of two times `_SMALLEST_PX`.
        side_mm: Side of the picture on the plane.
        repeats: It repeats in both directions, with a corner at the origin. If not, its middle is the origin and beyond
            it there are zeros.
    """

    def __init__(self, picture: np.ndarray, side_mm: float, repeats: bool) -> None:
        self._side_mm, self._repeats = side_mm, repeats
        self._sizes: list[int] = []
        self._levels: list[np.ndarray] = []
        while True:
            self._sizes.append(len(picture))
            self._levels.append(cv2.copyMakeBorder(picture, 1, 1, 1, 1, cv2.BORDER_WRAP) if repeats else picture)
            if len(picture) <= _SMALLEST_PX:
                break
            half = len(picture) // 2
            picture = cv2.resize(picture, (half, half), interpolation=cv2.INTER_AREA)

    def sample(self, x_mm: np.ndarray, y_mm: np.ndarray, footprint_mm: np.ndarray) -> np.ndarray:
        """The picture at points of the plane.

        Args:
            x_mm: (height, width) float32.
            y_mm: (height, width) float32.
            footprint_mm: (height, width) float32 size of a pixel on the plane, smooth; detail below it is averaged.

        Returns:
            (height, width, channels) uint8.
        """
        scale = np.float32(1.0 / self._side_mm)
        u, v = x_mm * scale, y_mm * scale
        if self._repeats:
            u -= np.floor(u)
            v -= np.floor(v)
        else:
            u += np.float32(0.5)
            v += np.float32(0.5)
        detail = self._detail(footprint_mm)
        first = int(detail.min())
        result = self._level(first, u, v)
        for level in range(first + 1, int(np.ceil(detail.max())) + 1):
            weight = np.clip(detail - np.float32(level - 1), 0, 1)
            result = cv2.blendLinear(result, self._level(level, u, v), 1 - weight, weight)
        return result

    def _level(self, level: int, u: np.ndarray, v: np.ndarray) -> np.ndarray:
        size = np.float32(self._sizes[level])
        # Texel i reaches from i to i + 1; the border adds one in front.
        shift = np.float32(0.5 if self._repeats else -0.5)
        return cv2.remap(
            self._levels[level], u * size + shift, v * size + shift, cv2.INTER_LINEAR, borderMode=cv2.BORDER_CONSTANT
        )

    def _detail(self, footprint_mm: np.ndarray) -> np.ndarray:
        """Level of detail of each pixel; it is smooth, so a few knots and straight lines between are enough."""
        knots = coarse(footprint_mm, _DETAIL_STEP_PX)
        detail = np.log2(np.maximum(knots * (self._sizes[0] / self._side_mm), 1.0)).astype(np.float32)
        height, width = footprint_mm.shape
        return cv2.resize(np.minimum(detail, np.float32(len(self._levels) - 1)), (width, height))


def coarse(values: np.ndarray, step: int) -> np.ndarray:
    """Every `step`-th value each way, from the middle of the squares that `cv2.resize` spreads them over."""
    middle_line, middle_column = (min(step // 2, size - 1) for size in values.shape[:2])
    return np.ascontiguousarray(values[middle_line::step, middle_column::step])

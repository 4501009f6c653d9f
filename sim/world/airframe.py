# SPDX-License-Identifier: Apache-2.0
"""The drone's own legs: a dark grip at the left and at the right of the picture, always in the same place."""

import functools

import cv2
import numpy as np

_SUB = 16
_SUB_BITS = 4
_GRIP_RGB = (44.0, 44.0, 46.0)
_BAND_RGB = (176.0, 142.0, 40.0)
_CAP_RGB = (170.0, 44.0, 40.0)


@functools.lru_cache(maxsize=4)
def _layer(width: int, height: int, reach: float, seed: int) -> tuple[np.ndarray, np.ndarray]:
    """Colour (height, width, 3) and mask (height, width), uint8."""
    random = np.random.default_rng([seed, 24])
    colour = np.full((height, width, 3), _GRIP_RGB, np.uint8)
    mask = np.zeros((height, width), np.uint8)

    def bar(middle: float, half: float, top: float, bottom: float, rgb: tuple[float, float, float]) -> None:
        corners = [(middle - half, top), (middle + half, top), (middle + half, bottom), (middle - half, bottom)]
        points = np.rint((np.array(corners) * (width, height) - 0.5) * _SUB).astype(np.int32)
        cv2.fillPoly(colour, [points], rgb, cv2.LINE_AA, _SUB_BITS)
        cv2.fillPoly(mask, [points], 255, cv2.LINE_AA, _SUB_BITS)

    for middle in (random.uniform(0.04, 0.12), random.uniform(0.93, 0.99)):
        top = 1.0 - reach + random.uniform(0, 0.04)
        grip = top + 0.55 * reach
        bar(middle, 0.009, grip, 1.0, _GRIP_RGB)
        bar(middle, 0.011, top - 0.04, top, _CAP_RGB)
        bar(middle, 0.023, top, grip, _GRIP_RGB)
        for band in (0.12, 0.88):
            line = top + band * (grip - top)
            bar(middle, 0.023, line, line + 0.008, _BAND_RGB)
    return colour, mask


def legs(image: np.ndarray, reach: float, seed: int) -> tuple[np.ndarray, np.ndarray]:
    """The image (height, width, 3) float32 with the legs over it, and their mask (height, width) uint8."""
    height, width = image.shape[:2]
    colour, mask = _layer(width, height, reach, seed)
    share = mask[..., None] * np.float32(1 / 255)
    return image * (1 - share) + colour * share, mask

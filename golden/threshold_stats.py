# SPDX-License-Identifier: Apache-2.0
"""Integer model of `threshold_stats`: the least and greatest pixel and the threshold of each window."""

from typing import NamedTuple

import numpy as np
import numpy.typing as npt

FACTOR_ONE = 256
"""The factor 1.0 in Q1.8; larger factors act as this one."""

WINDOW_LOG2 = 7
"""Windows are 128 x 128 pixels."""


class WindowStats(NamedTuple):
    """One value a window, each array of shape (rows of windows, columns of windows)."""

    minimum: npt.NDArray[np.uint8]
    """Least pixel of the window."""
    maximum: npt.NDArray[np.uint8]
    """Greatest pixel of the window."""
    threshold: npt.NDArray[np.uint16]
    """`(minimum << 8) + factor * (maximum - minimum)`, of a flat window a neighbour's; Q8.8, at most 0xFF00."""

    def beats(self) -> npt.NDArray[np.uint32]:
        """Return `{maximum, minimum, threshold}` as the stat stream carries it, same shape."""
        return (
            (self.maximum.astype(np.uint32) << np.uint32(24))
            | (self.minimum.astype(np.uint32) << np.uint32(16))
            | self.threshold.astype(np.uint32)
        )


def window_count(pixels: int, window_log2: int = WINDOW_LOG2) -> int:
    """Return how many windows cover `pixels` pixels; the last may be cut."""
    return -(-pixels >> window_log2)


def threshold_stats(
    gray: npt.NDArray[np.uint8], factor: int, window_log2: int = WINDOW_LOG2, flat_limit: int = 0
) -> WindowStats:
    """Return the statistics of each window of a frame.

    Args:
        gray: uint8 frame of shape (height, width), both at least 1.
        factor: Q1.8, not negative; more than 256 acts as 256.
        window_log2: log2 of the side of a window.
        flat_limit: 0 to 255. A window with `maximum - minimum` below it takes the threshold of the window to its left,
            in the first column that of the window above, each as already replaced; the first window keeps its own.

    Returns:
        Statistics of shape (ceil(height / side), ceil(width / side)). Windows at the right and bottom border are cut.

    Raises:
        ValueError: the frame is not a non-empty uint8 plane, the factor is negative, or the limit has not 8 bits.
    """
    if gray.dtype != np.uint8 or gray.ndim != 2 or gray.size == 0:
        raise ValueError("threshold_stats takes a non-empty uint8 array of shape (height, width).")
    if factor < 0:
        raise ValueError("threshold_stats takes a factor of 0 or more.")
    if not 0 <= flat_limit <= 255:
        raise ValueError("threshold_stats takes a flat limit of 0 to 255.")
    height, width = gray.shape
    top = np.arange(0, height, 1 << window_log2)
    left = np.arange(0, width, 1 << window_log2)
    minimum = np.minimum.reduceat(np.minimum.reduceat(gray, top, axis=0), left, axis=1)
    maximum = np.maximum.reduceat(np.maximum.reduceat(gray, top, axis=0), left, axis=1)
    spread = maximum.astype(np.uint32) - minimum
    threshold = (minimum.astype(np.uint32) << np.uint32(8)) + np.uint32(min(factor, FACTOR_ONE)) * spread
    for row, column in np.argwhere(spread < flat_limit):  # In raster order.
        if column > 0:
            threshold[row, column] = threshold[row, column - 1]
        elif row > 0:
            threshold[row, 0] = threshold[row - 1, 0]
    return WindowStats(minimum, maximum, threshold.astype(np.uint16))

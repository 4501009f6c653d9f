# SPDX-License-Identifier: Apache-2.0
"""Integer model of `threshold_apply`: exact bilinear thresholds between window centres, and the decision."""

import numpy as np
import numpy.typing as npt

from golden.threshold_stats import WINDOW_LOG2, window_count

PIXEL_FRACTION_BITS = 8
"""Fraction bits of a window's threshold (Q8.8)."""


def _axis(pixels: int, window_log2: int) -> tuple[npt.NDArray[np.int64], npt.NDArray[np.int64], npt.NDArray[np.int64]]:
    """Return, for each position along an axis, the node before, the node after, and the weight of the latter.

    Node i lies at `side * i + (side - 1) / 2`. The distance of pixel x from it, in half pixels, is the odd integer
    `2 x - 2 side i - (side - 1)`: the weight of the node after, in units of `1 / (2 side)`. Beyond the outermost nodes
    both nodes are the outermost one.
    """
    side = 1 << window_log2
    last = window_count(pixels, window_log2) - 1
    position = np.arange(pixels, dtype=np.int64)
    segment = (2 * position - (side - 1)) // (2 * side)
    before = np.clip(segment, 0, last)
    after = np.clip(segment + 1, 0, last)
    weight = np.where(before == after, 0, 2 * position - (side - 1) - 2 * side * segment)
    return before, after, weight


def threshold_map(
    thresholds: npt.NDArray[np.uint16], width: int, height: int, window_log2: int = WINDOW_LOG2
) -> npt.NDArray[np.int64]:
    """Return the threshold of each pixel.

    Args:
        thresholds: uint16 of shape (rows, columns) of windows, Q8.8.
        width: pixels a line.
        height: lines.
        window_log2: log2 of the side of a window.

    Returns:
        int64 of shape (height, width), exact, with `10 + 2 * window_log2` fraction bits (Q8.24 for windows of 128).

    Raises:
        ValueError: the thresholds are not those of a frame of this size.
    """
    shape = (window_count(height, window_log2), window_count(width, window_log2))
    if thresholds.dtype != np.uint16 or thresholds.shape != shape:
        raise ValueError(f"A frame of {width}x{height} takes uint16 thresholds of shape {shape}.")
    one = 2 << window_log2
    above, below, weight_below = _axis(height, window_log2)
    left, right, weight_right = _axis(width, window_log2)
    nodes = thresholds.astype(np.int64)
    line = (one - weight_below)[:, None] * nodes[above] + weight_below[:, None] * nodes[below]
    return (one - weight_right) * line[:, left] + weight_right * line[:, right]


def threshold_apply(
    gray: npt.NDArray[np.uint8],
    thresholds: npt.NDArray[np.uint16] | None,
    dark_is_one: bool = False,
    window_log2: int = WINDOW_LOG2,
) -> npt.NDArray[np.uint8]:
    """Return the binary frame.

    Args:
        gray: uint8 frame of shape (height, width).
        thresholds: uint16, Q8.8, of shape (rows, columns) of windows, from the frame before; None while there are none:
            all pixels are bright then (the background).
        dark_is_one: True: 1 means dark. False: 1 means bright, which is `pixel > threshold`.
        window_log2: log2 of the side of a window.

    Returns:
        uint8 of zeros and ones, same shape.

    Raises:
        ValueError: the frame is not a uint8 plane, or the thresholds do not fit it.
    """
    if gray.dtype != np.uint8 or gray.ndim != 2:
        raise ValueError("threshold_apply takes a uint8 array of shape (height, width).")
    if thresholds is None:
        bright = np.ones(gray.shape, dtype=bool)
    else:
        height, width = gray.shape
        fraction_bits = PIXEL_FRACTION_BITS + 2 * (window_log2 + 1)
        levels = threshold_map(thresholds, width, height, window_log2)
        bright = (gray.astype(np.int64) << fraction_bits) > levels
    return (bright ^ dark_is_one).astype(np.uint8)

# SPDX-License-Identifier: Apache-2.0
"""Gaussian blur 5x5, the arithmetic of `cv2.GaussianBlur((5, 5), 0.65)` on 8-bit pictures."""

import numpy as np

KERNEL_Q8 = (1, 48, 158, 48, 1)
"""Weights of sigma 0.65 in Q0.8 as cv2 rounds them; they sum to 256."""


def gaussian5x5(gray: np.ndarray) -> np.ndarray:
    """Return the blurred picture.

    Args:
        gray: integer array (height, width), values 0 to 255, at least 3x3.

    Returns:
        uint8 array (height, width): (sum k[i] k[j] p[i][j] + 32768) >> 16, border reflected without its edge pixel.
    """
    height, width = gray.shape
    padded = np.pad(gray.astype(np.int64), 2, mode="reflect")
    total = np.zeros((height, width), np.int64)
    for row, row_weight in enumerate(KERNEL_Q8):
        for column, column_weight in enumerate(KERNEL_Q8):
            total += row_weight * column_weight * padded[row : row + height, column : column + width]
    return ((total + 32768) >> 16).astype(np.uint8)

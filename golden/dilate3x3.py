# SPDX-License-Identifier: Apache-2.0
"""Binary dilate 3x3, equal to `cv2.dilate` with a 3x3 box and its default border."""

import numpy as np


def dilate3x3(binary: np.ndarray) -> np.ndarray:
    """Return the picture in which a pixel is the maximum of its 3x3 neighbourhood.

    Args:
        binary: integer array (height, width) of 0 and 1.

    Returns:
        uint8 array (height, width) of 0 and 1. Pixels outside the picture do not count.
    """
    padded = np.pad(binary.astype(np.uint8), 1, constant_values=0)
    height, width = binary.shape
    shifts = [padded[dy : dy + height, dx : dx + width] for dy in range(3) for dx in range(3)]
    return np.maximum.reduce(shifts)

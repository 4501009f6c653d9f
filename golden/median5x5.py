# SPDX-License-Identifier: Apache-2.0
"""Binary median 5x5, equal to `cv2.medianBlur(5)`."""

import numpy as np


def median5x5(binary: np.ndarray) -> np.ndarray:
    """Return the picture in which a pixel is the majority of its 5x5 neighbourhood.

    Args:
        binary: integer array (height, width) of 0 and 1.

    Returns:
        uint8 array (height, width) of 0 and 1: 1 where at least 13 of 25 are 1. The border is replicated.
    """
    padded = np.pad(binary.astype(np.uint8), 2, mode="edge")
    height, width = binary.shape
    ones = sum(padded[dy : dy + height, dx : dx + width] for dy in range(5) for dx in range(5))
    return (ones >= 13).astype(np.uint8)

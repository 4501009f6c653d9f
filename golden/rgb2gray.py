# SPDX-License-Identifier: Apache-2.0
"""RGB to gray, the arithmetic of `cv2.cvtColor(COLOR_RGB2GRAY)` on 8-bit pictures."""

import numpy as np


def rgb2gray(rgb: np.ndarray) -> np.ndarray:
    """Return the gray values of RGB pixels.

    Args:
        rgb: uint8 array (..., 3), last axis R, G, B.

    Returns:
        uint8 array (...): (9798 R + 19235 G + 3735 B + 16384) >> 15, weights 0.299, 0.587, 0.114 in Q0.15.
    """
    red, green, blue = (rgb[..., channel].astype(np.int32) for channel in range(3))
    return ((9798 * red + 19235 * green + 3735 * blue + 16384) >> 15).astype(np.uint8)

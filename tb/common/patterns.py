# SPDX-License-Identifier: Apache-2.0
"""Test frames: integer arrays (height, width) with values of a given number of bits."""

from random import Random

import numpy as np


def random_frame(rng: Random, width: int, height: int, bits: int) -> np.ndarray:
    """Independent uniform values."""
    generator = np.random.default_rng(rng.getrandbits(64))
    return generator.integers(0, 1 << bits, (height, width), dtype=np.int64)


def structured_frames(rng: Random, width: int, height: int, bits: int) -> dict[str, np.ndarray]:
    """Frames that show faults which random ones hide: extremes, gradients, checkers, single pixels, borders."""
    top = (1 << bits) - 1
    y, x = np.mgrid[0:height, 0:width].astype(np.int64)
    frames = {
        "zeros": np.zeros((height, width), np.int64),
        "ones": np.full((height, width), top, np.int64),
        "checkerboard": ((x + y) & 1) * top,
        "stripes x": (x & 1) * top,
        "stripes y": (y & 1) * top,
        "gradient x": x * top // max(width - 1, 1),
        "gradient y": y * top // max(height - 1, 1),
        "sparse": np.where(random_frame(rng, width, height, 4) == 0, top, 0),
        "dense": np.where(random_frame(rng, width, height, 4) == 0, 0, top),
        "blocks": (((x // 3) + (y // 2)) & 1) * top,
    }
    border = np.zeros((height, width), np.int64)
    border[[0, -1], :] = top
    border[:, [0, -1]] = top
    frames["border"] = border
    for name, row, column in (
        ("top left", 0, 0),
        ("top right", 0, -1),
        ("bottom left", -1, 0),
        ("bottom right", -1, -1),
        ("centre", height // 2, width // 2),
    ):
        frames[f"one {name}"] = np.zeros((height, width), np.int64)
        frames[f"one {name}"][row, column] = top
        frames[f"hole {name}"] = top - frames[f"one {name}"]
    return frames

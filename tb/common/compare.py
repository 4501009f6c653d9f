# SPDX-License-Identifier: Apache-2.0
"""Comparison of frames whose message says all that is needed to find the fault."""

import numpy as np

from tb.common.run import where
from tb.common.stream import Taken, unpack


def check_markers(beats: list[Taken], width: int, name: str, ppc: int = 1) -> None:
    """Assert that only the first beat has `tuser` and the last beat of each line, and no other, has `tlast`."""
    for index, beat in enumerate(beats):
        y, x = divmod(index * ppc, width)
        expected = (int(index == 0), int(x == width - ppc))
        assert (beat.user & 1, beat.last) == expected, (
            f"{name}: (tuser, tlast) at x {x}, y {y} is {(beat.user & 1, beat.last)}, expected {expected}; {where()}"
        )


def check_frame(
    beats: list[Taken], expected: np.ndarray, name: str, border: int = 0, *, bits: int = 0, ppc: int = 1
) -> None:
    """Assert that the beats are exactly the expected frame, markers included.

    Args:
        beats: what the core sent.
        expected: integer array (height, width).
        name: what to call the frame in the message.
        border: width of the border whose wrong pixels the message counts apart.
        bits: width of a pixel; of no account if there is one a beat.
        ppc: pixels a beat.

    Raises:
        AssertionError: with the first bad pixel, expected and got values, counts, seed and replay command.
    """
    height, width = expected.shape
    got = np.array(unpack([beat.data for beat in beats], bits, ppc), dtype=object)
    count = min(got.size, expected.size)
    bad = np.flatnonzero(got[:count] != expected.ravel()[:count].astype(object))
    if bad.size:
        x, y = bad % width, bad // width
        inside = (x >= border) & (x < width - border) & (y >= border) & (y < height - border)
        raise AssertionError(
            f"{name} ({width}x{height}): first bad pixel x {x[0]}, y {y[0]}: expected {expected[y[0], x[0]]}, "
            f"got {got[bad[0]]}; {bad.size} of {count} pixels differ, {bad.size - int(inside.sum())} of them within "
            f"{border} of the border; {where()}"
        )
    check_markers(beats, width, name, ppc)
    assert got.size == expected.size, (
        f"{name} ({width}x{height}): {got.size} pixels came, expected {expected.size}; {where()}"
    )

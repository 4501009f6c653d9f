# SPDX-License-Identifier: Apache-2.0
"""What `video_out` gives a monitor: the camera's syncs later, and of each frame what came in time."""

from collections.abc import Sequence

BLANK = 0x202020
"""Colour of pixels that are missing."""


def syncs(camera: Sequence[tuple[int, int, int]], delay: int, idle: tuple[int, int, int]) -> list[tuple[int, int, int]]:
    """The monitor's syncs.

    Args:
        camera: (de, hsync, vsync) of each cycle of the pixel clock.
        delay: Cycles.
        idle: What was before.

    Returns:
        As many cycles as `camera` has.
    """
    return [*[idle] * min(delay, len(camera)), *camera[: max(len(camera) - delay, 0)]]


def shown(pixels: Sequence[int], in_time: int | None = None) -> list[int]:
    """A frame at the monitor.

    Args:
        pixels: 0xRRGGBB, all of them.
        in_time: How many from the first came in time; None = all.
    """
    count = len(pixels) if in_time is None else in_time
    return [*pixels[:count], *[BLANK] * (len(pixels) - count)]

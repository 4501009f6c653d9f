# SPDX-License-Identifier: Apache-2.0
"""What `pattern_source` sends: a drawn landing pad on a sheet, on textured ground, and the syncs around it."""

from dataclasses import dataclass
from fractions import Fraction

import numpy as np

from golden import pad_geometry as pad

WHITE, BLACK = 232, 24
"""Levels of the sheet and of the shapes on it."""
GROUND_LEAST, GROUND_STEPS, GROUND_BLOCK_PX = 112, 32, 8
"""Levels of the ground go from the least in so many steps of 1; a block of so many pixels each way has one."""
PX_PER_MM_OF_HEIGHT = Fraction(552, 1000 * 720)
"""Of the camera of 552 px focal length 1 m above the pad, for each line of the picture."""


@dataclass(frozen=True)
class Timing:
    """Pixels of a line and lines of a frame: those that are seen, those before the sync, the sync, all of them."""

    width: int = 1280
    h_front: int = 110
    h_sync: int = 40
    h_total: int = 1650
    height: int = 720
    v_front: int = 5
    v_sync: int = 5
    v_total: int = 750


def syncs(timing: Timing) -> np.ndarray:
    """The frame without its pixels.

    Returns:
        uint8 (v_total, h_total, 3) of 0 and 1: de, hsync, vsync, line by line from the first pixel.
    """
    line, place = np.mgrid[: timing.v_total, : timing.h_total]
    of_line = place - timing.width - timing.h_front
    of_frame = line - timing.height - timing.v_front
    de = (place < timing.width) & (line < timing.height)
    hsync = (of_line >= 0) & (of_line < timing.h_sync)
    vsync = (of_frame >= 0) & (of_frame < timing.v_sync)
    return np.stack([de, hsync, vsync], axis=-1).astype(np.uint8)


def px(length_mm: float, height: int) -> Fraction:
    """Pixels that a length of the pad takes in a picture of so many lines, not rounded."""
    return Fraction(str(length_mm)) * PX_PER_MM_OF_HEIGHT * height


def travel(width: int, height: int) -> tuple[int, int]:
    """How far the centre goes from the middle to either side, in x and y: half as far as the sheet stays in view."""
    spans = (
        (width, pad.PAPER_LEFT_MM, pad.PAPER_LEFT_MM + pad.PAPER_WIDTH_MM),
        (height, pad.PAPER_TOP_MM, pad.PAPER_TOP_MM + pad.PAPER_HEIGHT_MM),
    )
    most = []
    for size, low_mm, high_mm in spans:
        middle = size // 2
        room = min(middle - int(px(-low_mm, height)), size - 1 - middle - int(px(high_mm, height)))
        most.append(max(room, 0) // 2)
    return most[0], most[1]


def centre(number: int, move: bool, width: int = 1280, height: int = 720) -> tuple[int, int]:
    """Pixel in which the centre of the ring is.

    Args:
        number: Frames since the reset.
        move: What the port was at the frame's vsync; False: the pad stands in the middle.
        width: Of the picture.
        height: Of the picture.
    """

    def triangle(most: int) -> int:
        return most - abs((number + most) % (4 * most) - 2 * most) if most and move else 0

    right, down = (triangle(most) for most in travel(width, height))
    return width // 2 + right, height // 2 + down


def frame(number: int, move: bool, width: int = 1280, height: int = 720) -> np.ndarray:
    """A picture.

    A pixel belongs to a shape if its centre lies within or on the edge.

    Args:
        number: Frames since the reset.
        move: What the port was at the frame's vsync.
        width: Of the picture.
        height: Of the picture.

    Returns:
        uint8 (height, width, 3), RGB.
    """
    centre_x, centre_y = centre(number, move, width, height)
    line, place = np.mgrid[:height, :width]
    right, down = place - centre_x, line - centre_y
    squared = right**2 + down**2

    def disc(radius_mm: float) -> np.ndarray:
        return squared <= int(px(radius_mm, height) ** 2)

    def box(centre_mm: tuple[float, float], size_mm: tuple[float, float]) -> np.ndarray:
        within = np.ones((height, width), bool)
        for offset, middle, size in zip((right, down), centre_mm, size_mm, strict=True):
            low, high = px(middle, height) - px(size, height) / 2, px(middle, height) + px(size, height) / 2
            within &= (offset >= -((-low) // 1)) & (offset <= high // 1)
        return within

    paper = (pad.PAPER_WIDTH_MM, pad.PAPER_HEIGHT_MM)
    paper_centre = (
        float(Fraction(str(pad.PAPER_LEFT_MM)) + Fraction(str(paper[0])) / 2),
        float(Fraction(str(pad.PAPER_TOP_MM)) + Fraction(str(paper[1])) / 2),
    )
    square = (pad.SQUARE_SIDE_MM, pad.SQUARE_SIDE_MM)
    rectangle = (pad.RECTANGLE_WIDTH_MM, pad.RECTANGLE_HEIGHT_MM)
    shapes = (
        disc(pad.RING_OUTER_RADIUS_MM) & ~disc(pad.RING_INNER_RADIUS_MM),
        disc(pad.SMALL_RING_OUTER_RADIUS_MM) & ~disc(pad.SMALL_RING_INNER_RADIUS_MM),
        box((pad.SQUARE_CENTRE_X_MM, pad.SQUARE_CENTRE_Y_MM), square),
        box((pad.RECTANGLE_CENTRE_X_MM, pad.RECTANGLE_CENTRE_Y_MM), rectangle),
    )
    gray = GROUND_LEAST + (place // GROUND_BLOCK_PX ^ line // GROUND_BLOCK_PX) % GROUND_STEPS
    gray[box(paper_centre, paper)] = WHITE
    for shape in shapes:
        gray[shape] = BLACK
    return np.repeat(gray[..., None], 3, axis=2).astype(np.uint8)

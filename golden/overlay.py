# SPDX-License-Identifier: Apache-2.0
"""What the firmware found, drawn over the camera's picture; boxes equal `cv2.rectangle`."""

import re
from dataclasses import dataclass
from functools import cache
from pathlib import Path

import numpy as np
import numpy.typing as npt

FONT_FILE = Path(__file__).resolve().parent.parent / "rtl/overlay/font.txt"
COLUMNS, LINES, CELL = 64, 2, 16
"""Characters a line, lines of text, pixels of a character each way."""
BOX_COLOURS = (0xFFE000, 0x00FF40, 0x00E0FF, 0xFF40FF)
PAD_COLOUR, CROSSHAIR_COLOUR, TEXT_COLOUR = 0xFF4040, 0xC0C0C0, 0xFFFFFF
BOX_LINE, PAD_ARM, CROSSHAIR_ARM = 2, 12, 40
"""Pixels."""


@dataclass(frozen=True)
class Drawing:
    """What is to be drawn; coordinates are pixels, -8192 to 8191, and may lie outside the frame."""

    boxes: tuple[tuple[int, int, int, int] | None, ...] = (None,) * 4
    """Left, top, right, bottom of a class each, ends included; None = not shown."""
    centre: tuple[int, int] | None = None
    tip: tuple[int, int] = (0, 0)
    """Where the direction of the pad points; counts where there is a centre."""
    crosshair: bool = False
    tint: bool = False
    """Bright pixels (red 128 or more) have the colour of the last box around them."""
    text: tuple[str, ...] | None = None
    """`LINES` lines of at most `COLUMNS` characters; those below the space are not drawn, from 96 on as 32 less."""


@cache
def read_font() -> npt.NDArray[np.bool_]:
    """The letters: bool array (64, 8, 8), glyph 0 is the space of ASCII.

    Raises:
        ValueError: the file holds another number of rows, rows of another length, or another letter than `.` and `#`.
    """
    rows = [line.split() for line in FONT_FILE.read_text(encoding="ascii").splitlines() if line.startswith(".")]
    cells = [cell for row in rows for cell in row]
    if [len(row) for row in rows] != [8] * 64 or not all(re.fullmatch("[.#]{8}", cell) for cell in cells):
        raise ValueError(f"{FONT_FILE.name} must hold 64 rows of 8 cells of 8 pixels each.")
    pixels = np.array([[[pixel == "#" for pixel in cell] for cell in row] for row in rows])
    return pixels.reshape(8, 8, 8, 8).swapaxes(1, 2).reshape(64, 8, 8)


def _text(picture: npt.NDArray[np.int64], text: tuple[str, ...]) -> None:
    font = read_font()
    height, width = picture.shape
    for line, words in enumerate(text):
        for column, char in enumerate(words):
            code = ord(char) if ord(char) < 96 else ord(char) - 32
            top, left = line * CELL, column * CELL
            if code < 32 or top >= height or left >= width:
                continue
            cell = picture[top : top + CELL, left : left + CELL]
            ink = font[code - 32].repeat(2, axis=0).repeat(2, axis=1)[: cell.shape[0], : cell.shape[1]]
            dimmed = sum(((cell >> shift & 255) >> 2) << shift for shift in (0, 8, 16))
            cell[:] = np.where(ink, TEXT_COLOUR, dimmed)


def overlay(rgb: npt.NDArray[np.int64], drawing: Drawing) -> npt.NDArray[np.int64]:
    """Return the picture with the drawing over it.

    Args:
        rgb: integer array (height, width) of 0xRRGGBB.
        drawing: what the frame shows.

    Returns:
        The same shape. Of what covers a pixel the text counts first, then the pad's mark, the boxes from the first on,
        the crosshair.
    """
    picture = rgb.astype(np.int64)
    height, width = picture.shape
    y, x = np.mgrid[0:height, 0:width].astype(np.int64)
    if drawing.tint:
        bright = (picture >> 23 & 1).astype(bool)
        for box, colour in zip(drawing.boxes, BOX_COLOURS, strict=True):
            if box is not None:
                picture[bright & (x >= box[0]) & (x <= box[2]) & (y >= box[1]) & (y <= box[3])] = colour
    if drawing.crosshair:
        right, below = x - width // 2, y - height // 2
        level, upright = (below == 0) & (abs(right) <= CROSSHAIR_ARM), (right == 0) & (abs(below) <= CROSSHAIR_ARM)
        picture[level | upright] = CROSSHAIR_COLOUR
    for box, colour in reversed(list(zip(drawing.boxes, BOX_COLOURS, strict=True))):
        if box is not None:
            left, top, right_end, bottom = box
            inside = np.minimum.reduce([x - left, y - top, right_end - x, bottom - y])
            picture[(inside >= 0) & (inside < BOX_LINE)] = colour
    if drawing.centre is not None:
        picture[_pad(x, y, drawing.centre, drawing.tip)] = PAD_COLOUR
    if drawing.text is not None:
        _text(picture, drawing.text)
    return picture


def _pad(
    x: npt.NDArray[np.int64], y: npt.NDArray[np.int64], centre: tuple[int, int], tip: tuple[int, int]
) -> npt.NDArray[np.bool_]:
    """Whether each pixel is on the cross at the centre or on the line from it to the tip."""
    right, below = x - centre[0], y - centre[1]
    dx, dy = tip[0] - centre[0], tip[1] - centre[1]
    near = abs(right * dy - below * dx) <= max(abs(dx), abs(dy))
    within = (x >= min(centre[0], tip[0]) - 1) & (x <= max(centre[0], tip[0]) + 1)
    within &= (y >= min(centre[1], tip[1]) - 1) & (y <= max(centre[1], tip[1]) + 1)
    cross = (abs(right) <= PAD_ARM) & (abs(below) <= 1) | (abs(right) <= 1) & (abs(below) <= PAD_ARM)
    return near & within | cross

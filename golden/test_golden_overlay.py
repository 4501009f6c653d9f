# SPDX-License-Identifier: Apache-2.0
"""The drawing: boxes as OpenCV draws them, lines and marks where they belong, letters of the font, in the RTL too."""

import cv2
import numpy as np
import pytest

from golden.overlay import (
    BOX_COLOURS,
    CROSSHAIR_COLOUR,
    PAD_COLOUR,
    TEXT_COLOUR,
    Drawing,
    overlay,
    read_font,
)
from scripts.font import HEADER, verilog

GRAY = 0x808080


def plain(width: int, height: int) -> np.ndarray:
    return np.full((height, width), GRAY, np.int64)


@pytest.mark.parametrize("seed", range(20))
def test_boxes_equal_opencv(seed: int) -> None:
    rng = np.random.default_rng(seed)
    left, top = rng.integers(-20, 60, 2).tolist()
    right, bottom = left + int(rng.integers(4, 60)), top + int(rng.integers(4, 60))
    picture = np.zeros((50, 70), np.uint8)
    for step in range(2):
        cv2.rectangle(picture, (left + step, top + step), (right - step, bottom - step), 255, 1)
    got = overlay(plain(70, 50), Drawing(boxes=(None, (left, top, right, bottom), None, None)))
    assert np.array_equal(got == BOX_COLOURS[1], picture == 255)
    assert np.all((got == BOX_COLOURS[1]) | (got == GRAY))


def test_a_box_whose_ends_are_crossed_is_not_drawn() -> None:
    assert np.array_equal(overlay(plain(9, 9), Drawing(boxes=((5, 2, 4, 8), None, None, None))), plain(9, 9))


@pytest.mark.parametrize("seed", range(40))
def test_direction_is_the_line_between_its_ends(seed: int) -> None:
    """As OpenCV's thin line, thickened by a pixel each way along the axis that changes less."""
    rng = np.random.default_rng(seed)
    centre, tip = rng.integers(-10, 90, 2), rng.integers(-10, 90, 2)
    got = overlay(plain(80, 80), Drawing(centre=tuple(centre.tolist()), tip=tuple(tip.tolist()))) == PAD_COLOUR
    y, x = np.mgrid[0:80, 0:80]
    cross = (abs(x - centre[0]) <= 12) & (abs(y - centre[1]) <= 12)
    steps = max(abs(tip - centre).max(), 1)
    places = centre + np.outer(np.arange(steps + 1) / steps, tip - centre)
    away = np.min(np.hypot(x[..., None] - places[:, 0], y[..., None] - places[:, 1]), axis=-1)
    assert np.all(got[(away <= 0.6) & ~cross])
    assert not np.any(got[(away > 1.8) & ~cross])


def test_marks_and_what_covers_what() -> None:
    drawing = Drawing(boxes=((40, 30, 60, 50),) * 4, centre=(50, 40), tip=(50, 40), crosshair=True, text=("a", "A"))
    got = overlay(plain(100, 80), drawing)
    assert got[40, 50] == got[40, 38] == got[52, 50] == PAD_COLOUR
    assert got[40, 37] == CROSSHAIR_COLOUR
    assert got[30, 45] == BOX_COLOURS[0]
    assert got[40, 10] == got[0, 50] == CROSSHAIR_COLOUR
    assert got[40, 9] == got[40, 91] == GRAY
    # The same letter in both lines, one of them small.
    assert np.array_equal(got[:16, :16], got[16:32, :16])
    assert set(np.unique(got[:16, :16])) == {TEXT_COLOUR, 0x202020}
    assert got[0, 16] == GRAY


def test_letters_are_those_of_the_font() -> None:
    font = read_font()
    got = overlay(plain(64 * 16, 32), Drawing(text=("".join(chr(code) for code in range(32, 96)), "\x1f")))
    cells = (got[:16] == TEXT_COLOUR).reshape(8, 2, 64, 8, 2)
    assert np.array_equal(cells[:, 0, :, :, 0].swapaxes(0, 1), font)
    assert np.array_equal(cells, cells[:, :1, :, :, :1].repeat(2, axis=1).repeat(2, axis=4))
    assert np.all(got[16:] == GRAY)
    # No two letters look alike, and none touches its neighbour.
    assert len({letter.tobytes() for letter in font}) == 64
    assert not font[:, 7].any()
    assert not font[:, :, 0].any()


def test_the_font_of_the_rtl_is_made_of_the_text_file() -> None:
    stale = "rtl/generated/overlay_font.vh is stale; run `python -m scripts.font`"
    assert HEADER.read_text(encoding="ascii") == verilog(read_font()), stale

# SPDX-License-Identifier: Apache-2.0
"""Drawings that are no pad: pictures on a sheet, and decoys that resemble the pad but for one proportion.

Each decoy differs from the pad by more than blur, noise or the tilt of a plane can make of it: the ratio that is wrong
is one that a tilt leaves nearly alone (lengths along one direction, areas against each other), and off by 25 % or more.
"""

import functools
from collections.abc import Callable

import cv2
import numpy as np

from sim.world.decal import SIDE_MM, SIDE_PX, Decal, fill, stroke
from sim.world.pad import PAPER, RECTANGLE, RING, SMALL_RING, SQUARE, Box, Ring, Sheet

_WORDS = ("LAND", "PAD", "EXIT", "STOP", "TAXI", "H 12", "NORTH", "No. 8", "0815", "PRIVATE", "OOO", "QOD")
_FONTS = (cv2.FONT_HERSHEY_SIMPLEX, cv2.FONT_HERSHEY_DUPLEX, cv2.FONT_HERSHEY_COMPLEX, cv2.FONT_HERSHEY_TRIPLEX)
_HALF_MM = SIDE_MM / 2
_SHEET_MM = 560.0

_Canvas = tuple[np.ndarray, np.ndarray]
# From a place to outlines to fill there in order, and whether with black.
_Drawer = Callable[[np.random.Generator, tuple[float, float]], list[tuple[np.ndarray, bool]]]


def _sheet(random: np.random.Generator, white: int) -> _Canvas:
    """A paper of random size on nothing: ink picture (one channel) and mask."""
    width, height = random.uniform(0.62, 1.0, 2) * _SHEET_MM / 2
    outline = np.array([[-width, -height], [width, -height], [width, height], [-width, height]])
    ink, mask = (np.zeros((SIDE_PX, SIDE_PX), np.uint8) for _ in range(2))
    fill(mask, outline, 255)
    ink[:] = white
    return ink, mask


def _circle(radius: float, x: float = 0.0, y: float = 0.0) -> np.ndarray:
    turn = np.linspace(0, 2 * np.pi, 360, endpoint=False)
    return np.column_stack([x + radius * np.cos(turn), y + radius * np.sin(turn)])


def _box(x: float, y: float, width: float, height: float, turn_rad: float = 0.0) -> np.ndarray:
    corners = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]]) * (width / 2, height / 2)
    cosine, sine = np.cos(turn_rad), np.sin(turn_rad)
    return corners @ np.array([[cosine, sine], [-sine, cosine]]) + (x, y)


def _text(ink: np.ndarray, text: str, font: int, *, height_px: float, line_px: float, black: int) -> None:
    (_, unit), _ = cv2.getTextSize(text, font, 1.0, 1)
    scale = height_px / unit
    thickness = max(2, round(height_px * 0.14))
    (width, height), _ = cv2.getTextSize(text, font, scale, thickness)
    origin = (round((SIDE_PX - width) / 2), round(line_px + height / 2))
    cv2.putText(ink, text, origin, font, scale, black, thickness, cv2.LINE_AA)


def _letters(random: np.random.Generator, black: int, white: int) -> _Canvas:
    ink, mask = _sheet(random, white)
    letter, font = "HOXTADBQ80&R"[random.integers(12)], _FONTS[random.integers(4)]
    _text(ink, letter, font, height_px=random.uniform(220, 430), line_px=512, black=black)
    if random.random() < 0.4:
        radius = random.uniform(190, 230)
        stroke(ink, np.vstack([_circle(radius), _circle(radius)[:1]]), black, random.uniform(10, 24))
    return ink, mask


def _words(random: np.random.Generator, black: int, white: int) -> _Canvas:
    ink, mask = _sheet(random, white)
    lines = int(random.integers(2, 6))
    for line in range(lines):
        word = _WORDS[random.integers(len(_WORDS))]
        line_px = 512 + 125 * (line - (lines - 1) / 2)
        _text(ink, word, _FONTS[random.integers(4)], height_px=random.uniform(45, 90), line_px=line_px, black=black)
    return ink, mask


def _checkerboard(random: np.random.Generator, black: int, white: int) -> _Canvas:
    ink, mask = _sheet(random, white)
    side, columns, lines = random.uniform(22, 60), *random.integers(4, 9, 2)
    for line in range(lines):
        for column in range(columns):
            if (line + column) % 2 == 0:
                fill(ink, _box((column - (columns - 1) / 2) * side, (line - (lines - 1) / 2) * side, side, side), black)
    return ink, mask


def _qr(random: np.random.Generator, black: int, white: int) -> _Canvas:
    ink, mask = _sheet(random, white)
    count, side = int(random.integers(21, 34)), random.uniform(240, 320)
    modules = random.random((count, count)) < 0.5
    for line, column in ((0, 0), (0, count - 8), (count - 8, 0)):
        modules[line : line + 8, column : column + 8] = False
        line_finder, column_finder = line + (line > 0), column + (column > 0)
        modules[line_finder : line_finder + 7, column_finder : column_finder + 7] = True
        modules[line_finder + 1 : line_finder + 6, column_finder + 1 : column_finder + 6] = False
        modules[line_finder + 2 : line_finder + 5, column_finder + 2 : column_finder + 5] = True
    size = round(side / SIDE_MM * SIDE_PX)
    picture = np.where(modules, black, white).astype(np.uint8)
    start = (SIDE_PX - size) // 2
    part = np.s_[start : start + size, start : start + size]
    ink[part] = cv2.resize(picture, (size, size), interpolation=cv2.INTER_NEAREST)
    return ink, mask


def _scattered(
    random: np.random.Generator,
    black: int,
    white: int,
    draw: _Drawer,
) -> _Canvas:
    """Up to nine shapes in the cells of a grid, so that they do not touch."""
    ink, mask = _sheet(random, white)
    for line in (-1, 0, 1):
        for column in (-1, 0, 1):
            if random.random() < 0.65:
                x, y = 105.0 * column + random.uniform(-8, 8), 105.0 * line + random.uniform(-8, 8)
                for outline, dark in draw(random, (x, y)):
                    fill(ink, outline, black if dark else white)
    return ink, mask


def _one_circle(random: np.random.Generator, middle: tuple[float, float]) -> list[tuple[np.ndarray, bool]]:
    radius = random.uniform(14, 44)
    outlines = [(_circle(radius, *middle), True)]
    if random.random() < 0.6:
        outlines.append((_circle(radius * random.uniform(0.3, 0.85), *middle), False))
    return outlines


def _one_box(random: np.random.Generator, middle: tuple[float, float]) -> list[tuple[np.ndarray, bool]]:
    width, ratio, turn = random.uniform(22, 62), random.choice((1.0, 1.0, 2.0, 1.5, 3.0)), random.uniform(0, np.pi)
    outlines = [(_box(*middle, width, width / ratio, turn), True)]
    if random.random() < 0.25:
        outlines.append((_box(*middle, width * 0.6, width / ratio * 0.6, turn), False))
    return outlines


def _circles(random: np.random.Generator, black: int, white: int) -> _Canvas:
    return _scattered(random, black, white, _one_circle)


def _squares(random: np.random.Generator, black: int, white: int) -> _Canvas:
    return _scattered(random, black, white, _one_box)


def _concentric(random: np.random.Generator, black: int, white: int) -> _Canvas:
    ink, mask = _sheet(random, white)
    count, outer = int(random.integers(2, 6)), random.uniform(110, 170)
    for index, radius in enumerate(np.linspace(outer, 0, 2 * count, endpoint=False)):
        fill(ink, _circle(float(radius)), black if index % 2 == 0 else white)
    return ink, mask


def _road(random: np.random.Generator, black: int, white: int) -> _Canvas:
    """Paint on the ground itself: bars, an arrow, a zebra crossing; no paper."""
    mask = np.zeros((SIDE_PX, SIDE_PX), np.uint8)
    if random.random() < 0.4:
        for bar in range(-3, 4):
            fill(mask, _box(bar * 90.0, 0.0, 45.0, 2 * _HALF_MM), 255)
    elif random.random() < 0.5:
        fill(mask, _box(0, 60, 50, 400), 255)
        fill(mask, np.array([[-110.0, -130], [0, -310], [110, -130]]), 255)
    else:
        fill(mask, _box(0, 0, random.uniform(50, 90), random.uniform(220, 600)), 255)
        fill(mask, _circle(random.uniform(30, 70), 190, random.uniform(-150, 150)), 255)
    return np.full((SIDE_PX, SIDE_PX), white, np.uint8), mask


_PICTURES: dict[str, Callable[[np.random.Generator, int, int], _Canvas]] = {
    "letters": _letters,
    "words": _words,
    "checkerboard": _checkerboard,
    "qr": _qr,
    "circles": _circles,
    "squares": _squares,
    "concentric": _concentric,
    "road": _road,
}


def _scaled(size: float, *boxes: Box) -> tuple[Box, ...]:
    """Boxes of another size in the same places."""
    return tuple(Box(box.x, box.y, box.width * size, box.height * size) for box in boxes)


def _decoy(kind: str, random: np.random.Generator) -> Sheet:
    bar, half, small = random.uniform(24, 40), random.uniform(62, 78), random.uniform(0.45, 0.65)
    aside = random.choice((-1.0, 1.0)) * random.uniform(42, 48)
    shapes: dict[str, tuple[Box | Ring, ...]] = {
        "empty": (RING,),
        "disc": (Ring(random.uniform(95, 125), 0),),
        "cross": (RING, Box(0, 0, 2 * half, bar), Box(0, 0, bar, 2 * half)),
        "diagonal_cross": (RING, Box(0, 0, 2 * half, bar, 45.0), Box(0, 0, bar, 2 * half, 45.0)),
        "h": (RING, Box(-half / 1.6, 0, bar, 1.7 * half), Box(half / 1.6, 0, bar, 1.7 * half), Box(0, 0, half, bar)),
        "two_squares": (RING, SMALL_RING, SQUARE, Box(0, -SQUARE.y, SQUARE.width, SQUARE.height)),
        "two_rectangles": (RING, SMALL_RING, RECTANGLE, Box(0, -RECTANGLE.y, RECTANGLE.width, RECTANGLE.height)),
        # Each about as large as the other should be.
        "swapped": (RING, SMALL_RING, Box(0, -54.0, 64.0, 64.0), Box(0, 46.0, 70.7, 35.4)),
        "turned": (RING, SMALL_RING, SQUARE, Box(0, 58.0, 37.0, 74.0)),
        "apart": (RING, SMALL_RING, *_scaled(0.7, Box(0, -70.0, 50.0, 50.0), Box(0, 69.0, 100.0, 50.0))),
        "aside": (RING, SMALL_RING, *_scaled(0.8, Box(aside, -40.0, 50.0, 50.0), RECTANGLE)),
        "small_shapes": (
            RING,
            Ring(SMALL_RING.outer * small, SMALL_RING.inner * small),
            *(Box(0, box.y * small, box.width * small, box.height * small) for box in (SQUARE, RECTANGLE)),
        ),
        "thin_ring": (
            Ring(RING.outer, RING.outer - random.uniform(4, 9)),
            SMALL_RING,
            *_scaled(0.7, Box(0, -80.0, 50.0, 50.0), RECTANGLE),
        ),
        "long_rectangle": (RING, SMALL_RING, SQUARE, Box(0, 50.8, 128.0, 38.0)),
    }
    return Sheet(PAPER, shapes[kind])


DECOYS = (
    "empty",
    "cross",
    "diagonal_cross",
    "h",
    "two_squares",
    "two_rectangles",
    "swapped",
    "turned",
    "apart",
    "aside",
    "small_shapes",
    "thin_ring",
    "disc",
    "long_rectangle",
)
DRAWINGS = (*_PICTURES, *(f"decoy_{kind}" for kind in DECOYS))


@functools.lru_cache(maxsize=4)
def drawing(name: str, seed: int, black: int, white: int) -> Decal | Sheet:
    """What is drawn: one of `DRAWINGS`; pictures in these levels, decoys as shapes without colour."""
    random = np.random.default_rng([seed, 23])
    if name.startswith("decoy_"):
        return _decoy(name.removeprefix("decoy_"), random)
    ink, mask = _PICTURES[name](random, black, white)
    return Decal.of(cv2.merge([ink, ink, ink]), mask)

# SPDX-License-Identifier: Apache-2.0
"""Pictures of ground that repeat in both directions, drawn from random numbers: no file, no photograph."""

from collections.abc import Callable

import cv2
import numpy as np

SIZE_PX = 1024

_SUB = 16
_SUB_BITS = 4
# Where the shadow of a stone falls, in its own sizes.
_SHADE = np.array([0.12, 0.15])


def _noise(random: np.random.Generator, across_px: float, down_px: float) -> np.ndarray:
    """(n, n) noise that repeats, with features of this size; mean 0, standard deviation 1."""
    across, down = np.meshgrid(np.fft.rfftfreq(SIZE_PX), np.fft.fftfreq(SIZE_PX))
    band = np.exp(-((across * across_px) ** 2 + (down * down_px) ** 2))
    smooth = np.fft.irfft2(np.fft.rfft2(random.standard_normal((SIZE_PX, SIZE_PX))) * band)
    return (smooth - smooth.mean()) / smooth.std()


def _coloured(level: np.ndarray, tint: tuple[float, float, float]) -> np.ndarray:
    return np.clip(level[..., None] * np.array(tint), 0, 255).astype(np.uint8)


def _shifted(points: np.ndarray, margin: float) -> list[np.ndarray]:
    """The points, and their copies that reach into the picture from beyond its borders."""
    low, high = points.min(axis=0) - margin, points.max(axis=0) + margin
    shifts = [[0] + [SIZE_PX] * bool(low[axis] < 0) + [-SIZE_PX] * bool(high[axis] >= SIZE_PX) for axis in (0, 1)]
    return [np.rint((points + np.array([x, y])) * _SUB).astype(np.int32) for x in shifts[0] for y in shifts[1]]


def _polygon(picture: np.ndarray, points: np.ndarray, colour: np.ndarray) -> None:
    for copy in _shifted(points, 2):
        cv2.fillPoly(picture, [copy], colour.tolist(), cv2.LINE_AA, _SUB_BITS)


def _line(picture: np.ndarray, points: np.ndarray, colour: np.ndarray, width: int) -> None:
    for copy in _shifted(points, width + 2):
        cv2.polylines(picture, [copy], False, colour.tolist(), width, cv2.LINE_AA, _SUB_BITS)


def _grass(random: np.random.Generator) -> np.ndarray:
    blades = 26000
    picture = np.empty((SIZE_PX, SIZE_PX, 3), np.uint8)
    picture[:] = (30, 29, 22)
    starts = random.uniform(0, SIZE_PX, (blades, 2))
    # Blades lie in tufts: the direction follows a slow field, with scatter.
    field = 2.2 * np.sin(starts[:, 0] * (2 * np.pi / SIZE_PX)) + 1.7 * np.cos(starts[:, 1] * (4 * np.pi / SIZE_PX))
    angles = field + random.normal(0, 0.8, blades)
    lengths = random.gamma(4.0, 11.0, blades)
    ends = starts + lengths[:, None] * np.column_stack([np.cos(angles), np.sin(angles)])
    kinds = np.array([(168.0, 152.0, 116.0), (128.0, 120.0, 84.0), (88.0, 98.0, 56.0)])
    # Later blades lie on top and catch more light.
    light = np.linspace(0.35, 1.0, blades) * random.uniform(0.55, 1.25, blades)
    colours = np.clip(kinds[random.choice(3, blades, p=(0.42, 0.36, 0.22))] * light[:, None], 0, 255)
    widths = random.choice((1, 2, 3), blades, p=(0.45, 0.4, 0.15))
    for start, end, colour, width in zip(starts, ends, colours, widths, strict=True):
        _line(picture, np.array([start, end]), colour, int(width))
    return picture


def _asphalt(random: np.random.Generator) -> np.ndarray:
    level = 68 + 16 * _noise(random, 2.5, 2.5) + 7 * random.standard_normal((SIZE_PX, SIZE_PX))
    picture = _coloured(level, (1.0, 0.99, 0.97))
    for _ in range(2500):
        centre, size = random.uniform(0, SIZE_PX, 2), random.uniform(1.0, 4.0)
        _polygon(picture, _pebble(random, centre, size), random.uniform(70, 165) * np.array([1.0, 0.98, 0.94]))
    return picture


def _pebble(random: np.random.Generator, centre: np.ndarray, size: float) -> np.ndarray:
    turn = np.linspace(0, 2 * np.pi, 9, endpoint=False)
    radius = size * random.uniform(0.75, 1.15, 9)
    squeeze, tilt = random.uniform(0.6, 1.0), random.uniform(0, np.pi)
    along, across = radius * np.cos(turn), squeeze * radius * np.sin(turn)
    return centre + np.column_stack(
        [np.cos(tilt) * along - np.sin(tilt) * across, np.sin(tilt) * along + np.cos(tilt) * across]
    )


def _gravel(random: np.random.Generator) -> np.ndarray:
    picture = np.full((SIZE_PX, SIZE_PX, 3), 34, np.uint8)
    tints = np.array([(1.0, 0.97, 0.92), (1.0, 0.93, 0.83), (0.93, 0.97, 1.0)])
    for size in np.sort(random.gamma(4.0, 3.2, 4200) + 3)[::-1]:
        colour = random.uniform(50, 190) * tints[random.integers(3)]
        outline = _pebble(random, random.uniform(0, SIZE_PX, 2), size)
        _polygon(picture, outline + size * _SHADE, 0.45 * colour)
        _polygon(picture, outline, colour)
    return picture


def _tiles(random: np.random.Generator) -> np.ndarray:
    count, joint = 4, 5
    side = SIZE_PX // count
    level = 40 + 6 * _noise(random, 3, 3)
    tones = random.uniform(95, 175) + random.uniform(-16, 16, (count, count))
    face = 4 * _noise(random, 6, 6) + 6 * _noise(random, 60, 60)
    for line in range(count):
        for column in range(count):
            part = np.s_[
                line * side + joint : (line + 1) * side - joint, column * side + joint : (column + 1) * side - joint
            ]
            level[part] = tones[line, column] + face[part]
    return _coloured(level, (1.0, 0.96, 0.90))


def _sand(random: np.random.Generator) -> np.ndarray:
    lines = np.arange(SIZE_PX)[:, None] * (2 * np.pi * 14 / SIZE_PX)
    ripples = np.sin(lines + 1.6 * _noise(random, 140, 140))
    level = 142 + 9 * ripples + 10 * _noise(random, 2, 2) + 8 * _noise(random, 30, 30)
    return _coloured(level, (1.0, 0.92, 0.76))


def _leaves(random: np.random.Generator) -> np.ndarray:
    picture = _coloured(38 + 9 * _noise(random, 4, 4), (1.0, 0.9, 0.75))
    tints = np.array([(178.0, 122, 58), (150, 92, 44), (196, 158, 70), (110, 74, 46), (128, 130, 60), (206, 178, 122)])
    for _ in range(900):
        centre, turn, length = random.uniform(0, SIZE_PX, 2), random.uniform(0, 2 * np.pi), random.uniform(26, 62)
        colour = tints[random.integers(len(tints))] * random.uniform(0.45, 1.15)
        outline = leaf_outline(centre, length, turn)
        _polygon(picture, outline + 3.0, 0.35 * colour)
        _polygon(picture, outline, np.minimum(colour, 255))
        tip = length * np.array([np.cos(turn), np.sin(turn)])
        _line(picture, np.array([centre - tip, centre + tip]), np.minimum(0.7 * colour, 255), 1)
    return picture


def leaf_outline(centre: np.ndarray, half_length: float, turn_rad: float) -> np.ndarray:
    """(n, 2) outline of a leaf, pointed at both ends, less than half as wide as long."""
    along = np.linspace(-1, 1, 13)
    across = 0.42 * (1 - along**2) * (1.0 - 0.25 * along)
    edge = half_length * np.concatenate([np.column_stack([along, across]), np.column_stack([along, -across])[-2:0:-1]])
    cosine, sine = np.cos(turn_rad), np.sin(turn_rad)
    return np.asarray(centre) + edge @ np.array([[cosine, sine], [-sine, cosine]])


def _concrete(random: np.random.Generator) -> np.ndarray:
    level = 150 + 5 * _noise(random, 1.5, 1.5) + 7 * _noise(random, 12, 12) + 8 * _noise(random, 120, 120)
    picture = _coloured(level, (1.0, 0.99, 0.96))
    for _ in range(7):
        direction = random.uniform(0, 2 * np.pi) + np.cumsum(random.normal(0, 0.35, 60))
        steps = random.uniform(4, 14, 60)[:, None] * np.column_stack([np.cos(direction), np.sin(direction)])
        path = random.uniform(0, SIZE_PX, 2) + np.cumsum(steps, axis=0)
        for piece in range(0, 60, 12):
            _line(picture, path[piece : piece + 13], random.uniform(35, 70, 1).repeat(3), int(random.integers(1, 4)))
    return picture


def _wood(random: np.random.Generator) -> np.ndarray:
    boards, gap = 8, 5
    side = SIZE_PX // boards
    bend = _noise(random, 220, 40)
    lines = np.arange(SIZE_PX)[:, None]
    grain = np.sin(lines * (2 * np.pi * 96 / SIZE_PX) + 5.0 * bend) * 7 + 8 * _noise(random, 120, 1.5)
    level = 128 + grain
    for board in range(boards):
        part = np.s_[board * side : (board + 1) * side]
        level[part] += random.uniform(-28, 28)
        level[board * side : board * side + gap] = 22
    picture = _coloured(level, (1.0, 0.80, 0.58))
    for _ in range(9):
        board, size = random.integers(boards), random.uniform(5, 14)
        centre = np.array([random.uniform(0, SIZE_PX), board * side + random.uniform(0.3, 0.75) * side])
        for share, tone in ((1.0, 70.0), (0.65, 45.0)):
            _polygon(picture, _pebble(random, centre, share * size), tone * np.array([1.0, 0.72, 0.5]))
    return picture


PICTURES: dict[str, Callable[[np.random.Generator], np.ndarray]] = {
    "grass": _grass,
    "asphalt": _asphalt,
    "gravel": _gravel,
    "tiles": _tiles,
    "sand": _sand,
    "leaves": _leaves,
    "concrete": _concrete,
    "wood": _wood,
}

# SPDX-License-Identifier: Apache-2.0
"""Dry grass without any file: seeded blades on a tile that repeats, with its smaller copies, and large patches."""

import functools

import cv2
import numpy as np

_TILE_PX = 1024
_TILE_MM = 700.0
_BLADES = 26000
_PATCH_PX = 256
_PATCH_MM = (2600.0, 640.0)
_PATCH_SHARE = (0.20, 0.13)
_SOIL_RGB = (30.0, 29.0, 22.0)
_BLADE_RGB = ((168.0, 152.0, 116.0), (128.0, 120.0, 84.0), (88.0, 98.0, 56.0))
_GAIN = np.float32(0.955)
_DARKER = np.float32(6.0)
_SECOND_TURN_RAD = 0.94
_SECOND_SCALE = 0.61


@functools.lru_cache(maxsize=2)
def _blade_pyramid(seed: int) -> tuple[np.ndarray, ...]:
    """The tile and its halvings, (n, n, 3) float32 RGB, down to 8 x 8."""
    random = np.random.default_rng([seed, 1])
    tile = np.empty((_TILE_PX, _TILE_PX, 3), np.uint8)
    tile[:] = _SOIL_RGB
    starts = random.uniform(0, _TILE_PX, (_BLADES, 2))
    # Blades lie in tufts: the direction follows a slow field, with scatter.
    field = 2.2 * np.sin(starts[:, 0] * (2 * np.pi / _TILE_PX)) + 1.7 * np.cos(starts[:, 1] * (4 * np.pi / _TILE_PX))
    angles = field + random.normal(0, 0.8, _BLADES)
    lengths = random.gamma(4.0, 11.0, _BLADES)
    ends = starts + (lengths[:, None] * np.column_stack([np.cos(angles), np.sin(angles)]))
    kinds = random.choice(len(_BLADE_RGB), _BLADES, p=(0.42, 0.36, 0.22))
    # Later blades lie on top and catch more light.
    light = np.linspace(0.35, 1.0, _BLADES) * random.uniform(0.55, 1.25, _BLADES)
    colours = np.clip(np.array(_BLADE_RGB)[kinds] * light[:, None], 0, 255)
    widths = random.choice((1, 2, 3), _BLADES, p=(0.45, 0.4, 0.15))
    for start, end, colour, width in zip(starts, ends, colours, widths, strict=True):
        low, high = np.minimum(start, end) - 4, np.maximum(start, end) + 4
        for shift_x in _wraps(low[0], high[0]):
            for shift_y in _wraps(low[1], high[1]):
                shift = np.array([shift_x, shift_y])
                ends_16 = [tuple(np.rint((point + shift) * 16).astype(int).tolist()) for point in (start, end)]
                cv2.line(tile, *ends_16, colour.tolist(), int(width), cv2.LINE_AA, 4)
    levels = [tile.astype(np.float32)]
    while len(levels[-1]) > 8:
        size = len(levels[-1]) // 2
        levels.append(cv2.resize(levels[-1], (size, size), interpolation=cv2.INTER_AREA))
    return tuple(levels)


def _wraps(low: float, high: float) -> list[int]:
    shifts = [0]
    if low < 0:
        shifts.append(_TILE_PX)
    if high >= _TILE_PX:
        shifts.append(-_TILE_PX)
    return shifts


@functools.lru_cache(maxsize=4)
def _patch_tile(seed: int) -> np.ndarray:
    """(n, n) float32 smooth noise that repeats, mean 0, standard deviation 1."""
    random = np.random.default_rng([seed, 2])
    noise = np.fft.fft2(random.normal(size=(_PATCH_PX, _PATCH_PX)))
    frequency = np.hypot(*np.meshgrid(np.fft.fftfreq(_PATCH_PX), np.fft.fftfreq(_PATCH_PX)))
    smooth = np.fft.ifft2(noise * np.exp(-((frequency * 28.0) ** 2))).real
    return ((smooth - smooth.mean()) / smooth.std()).astype(np.float32)


def _repeat(texture: np.ndarray, x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Bilinear sample of a repeating texture at x, y in periods."""
    size = len(texture)
    # Folding in here keeps the coordinates small, where cv2.remap is exact; one more row and column close the seam.
    padded = cv2.copyMakeBorder(texture, 0, 1, 0, 1, cv2.BORDER_WRAP)
    columns = (x - np.floor(x)) * np.float32(size)
    lines = (y - np.floor(y)) * np.float32(size)
    return cv2.remap(padded, columns, lines, cv2.INTER_LINEAR, borderMode=cv2.BORDER_REPLICATE)


def patches(x_mm: np.ndarray, y_mm: np.ndarray, seed: int, period_mm: float) -> np.ndarray:
    """Smooth noise fixed to the ground: (height, width) float32, mean about 0, standard deviation about 1."""
    scale = np.float32(1.0 / period_mm)
    return _repeat(_patch_tile(seed), x_mm * scale, y_mm * scale)


def _blades(x_mm: np.ndarray, y_mm: np.ndarray, footprint_mm: np.ndarray, seed: int) -> np.ndarray:
    levels = _blade_pyramid(seed)
    detail = np.log2(np.maximum(footprint_mm * (_TILE_PX / _TILE_MM), 1.0))
    detail = np.minimum(detail, len(levels) - 1.001).astype(np.float32)
    x, y = x_mm * np.float32(1.0 / _TILE_MM), y_mm * np.float32(1.0 / _TILE_MM)
    result = np.zeros((*x_mm.shape, 3), np.float32)
    for level in range(int(detail.min()), int(detail.max()) + 2):
        weight = np.maximum(1.0 - np.abs(detail - level), 0.0)
        if weight.any():
            result += weight[..., None] * _repeat(levels[level], x, y)
    return result


def ground(x_mm: np.ndarray, y_mm: np.ndarray, footprint_mm: np.ndarray, seed: int) -> np.ndarray:
    """Colour of the ground.

    Args:
        x_mm: (height, width) float32 position on the ground.
        y_mm: (height, width) float32 position on the ground.
        footprint_mm: (height, width) float32 size of a pixel on the ground; detail below it is averaged.
        seed: Another seed is another meadow.

    Returns:
        (height, width, 3) float32 RGB, about 0 to 255.
    """
    turn_x, turn_y = np.float32(np.cos(_SECOND_TURN_RAD)), np.float32(np.sin(_SECOND_TURN_RAD))
    x_second = (turn_x * x_mm - turn_y * y_mm) * np.float32(_SECOND_SCALE)
    y_second = (turn_y * x_mm + turn_x * y_mm) * np.float32(_SECOND_SCALE)
    # Two tilings that do not share a period hide each other's repetition; the brighter blade is the upper one.
    colour = np.maximum(
        _blades(x_mm, y_mm, footprint_mm, seed),
        _blades(x_second, y_second, footprint_mm * np.float32(_SECOND_SCALE), seed),
    )
    shade = np.float32(1.0)
    for index, (period, share) in enumerate(zip(_PATCH_MM, _PATCH_SHARE, strict=True)):
        shade = shade + np.float32(share) * patches(x_mm, y_mm, seed + 17 * index, period)
    return (_GAIN * colour * np.clip(shade, 0.3, 1.7)[..., None] - _DARKER).astype(np.float32)

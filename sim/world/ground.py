# SPDX-License-Identifier: Apache-2.0
"""The ground of the rendered world: a seeded picture that repeats, turned and shifted, with large patches of light."""

import functools
from dataclasses import dataclass

import cv2
import numpy as np

from sim.world.ground_pictures import PICTURES
from sim.world.texture import Texture, coarse

GROUNDS = tuple(PICTURES)

# Pictures take up to a second to draw, so there are only so many of a kind; place and turn differ by seed.
_PICTURES_A_KIND = 3
_PATCH_PICTURES = 8
_PATCH_PX = 256
_PATCH_MM = (2600.0, 640.0)
_PATCH_STEP_PX = 4
# Halving and interpolating blur more than a pixel does.
_SHARPER = np.float32(0.75)
_LIGHT = (0.4, 1.3)
_GRASS_GAIN = np.float32(0.955)
_GRASS_DARKER = np.float32(6.0)
_SECOND_TURN_RAD = 0.94
_SECOND_SCALE = 0.61


@dataclass(frozen=True)
class _Kind:
    """How large the picture is on the ground, and how much the two sizes of patches change its light."""

    side_mm: float
    patch_share: tuple[float, float]


_KINDS = {
    "grass": _Kind(700.0, (0.20, 0.13)),
    "asphalt": _Kind(600.0, (0.08, 0.06)),
    "gravel": _Kind(700.0, (0.12, 0.06)),
    "tiles": _Kind(1200.0, (0.06, 0.05)),
    "sand": _Kind(800.0, (0.10, 0.06)),
    "leaves": _Kind(900.0, (0.15, 0.10)),
    "concrete": _Kind(1500.0, (0.08, 0.06)),
    "wood": _Kind(1120.0, (0.06, 0.05)),
}


@functools.lru_cache(maxsize=_PICTURES_A_KIND * len(_KINDS))
def _texture(kind: str, number: int) -> Texture:
    return Texture(PICTURES[kind](np.random.default_rng([number, 1])), _KINDS[kind].side_mm, repeats=True)


@functools.lru_cache(maxsize=_PATCH_PICTURES)
def _patch_tile(number: int) -> np.ndarray:
    """Smooth noise that repeats, mean 0, standard deviation 1; one more row and column close the seam."""
    random = np.random.default_rng([number, 2])
    noise = np.fft.fft2(random.normal(size=(_PATCH_PX, _PATCH_PX)))
    frequency = np.hypot(*np.meshgrid(np.fft.fftfreq(_PATCH_PX), np.fft.fftfreq(_PATCH_PX)))
    smooth = np.fft.ifft2(noise * np.exp(-((frequency * 28.0) ** 2))).real
    tile = ((smooth - smooth.mean()) / smooth.std()).astype(np.float32)
    return cv2.copyMakeBorder(tile, 0, 1, 0, 1, cv2.BORDER_WRAP)


def patches(x_mm: np.ndarray, y_mm: np.ndarray, seed: int, period_mm: float) -> np.ndarray:
    """Smooth noise fixed to the ground: (height, width) float32, mean about 0, standard deviation about 1."""
    shift = np.random.default_rng([seed, 4]).random(2)
    scale = np.float32(1.0 / period_mm)
    # Folded, the coordinates stay small, where cv2.remap is exact.
    u = coarse(x_mm, _PATCH_STEP_PX) * scale + np.float32(shift[0])
    v = coarse(y_mm, _PATCH_STEP_PX) * scale + np.float32(shift[1])
    size = np.float32(_PATCH_PX)
    knots = cv2.remap(
        _patch_tile(seed % _PATCH_PICTURES),
        (u - np.floor(u)) * size,
        (v - np.floor(v)) * size,
        cv2.INTER_LINEAR,
        borderMode=cv2.BORDER_REPLICATE,
    )
    return cv2.resize(knots, x_mm.shape[::-1])


def _turned(x_mm: np.ndarray, y_mm: np.ndarray, turn_rad: float, scale: float) -> tuple[np.ndarray, np.ndarray]:
    cosine, sine = np.float32(scale * np.cos(turn_rad)), np.float32(scale * np.sin(turn_rad))
    return cosine * x_mm - sine * y_mm, sine * x_mm + cosine * y_mm


def ground(x_mm: np.ndarray, y_mm: np.ndarray, footprint_mm: np.ndarray, seed: int, kind: str = "grass") -> np.ndarray:
    """Colour of the ground.

    Args:
        x_mm: (height, width) float32 position on the ground.
        y_mm: (height, width) float32 position on the ground.
        footprint_mm: (height, width) float32 size of a pixel on the ground; detail below it is averaged.
        seed: Another seed is another place.
        kind: One of `GROUNDS`.

    Returns:
        (height, width, 3) float32 RGB, about 0 to 255.
    """
    texture = _texture(kind, seed % _PICTURES_A_KIND)
    random = np.random.default_rng([seed, 6])
    turn = random.uniform(0, 2 * np.pi)
    x, y = _turned(x_mm, y_mm, turn, 1.0)
    x += np.float32(random.uniform(0, _KINDS[kind].side_mm))
    y += np.float32(random.uniform(0, _KINDS[kind].side_mm))
    sharp = footprint_mm * _SHARPER
    picture = texture.sample(x, y, sharp)
    shade = np.ones(x_mm.shape, np.float32)
    for index, (period, share) in enumerate(zip(_PATCH_MM, _KINDS[kind].patch_share, strict=True)):
        shade += np.float32(share) * patches(x_mm, y_mm, seed + 17 * index, period)
    shade = np.clip(shade, *_LIGHT)[..., None]
    if kind != "grass":
        return picture * shade
    # Two tilings that do not share a period hide each other's repetition; the brighter blade is the upper one.
    x, y = _turned(x, y, _SECOND_TURN_RAD, _SECOND_SCALE)
    picture = cv2.max(picture, texture.sample(x, y, sharp * np.float32(_SECOND_SCALE)))
    return picture * (_GRASS_GAIN * shade) - _GRASS_DARKER

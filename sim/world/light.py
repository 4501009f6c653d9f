# SPDX-License-Identifier: Apache-2.0
"""Light on the scene, and what lens and sensor make of too much of it."""

import math

import cv2
import numpy as np

from sim.world.disturbances import Disturbances
from sim.world.ground import patches
from sim.world.look import Look

_SKY = 250.0
_EDGE_WITHIN_MM = 60.0
_WET_WITHIN_MM = 60.0
_WET_RADIUS_MM = (90.0, 150.0)
_GLARE_GAIN = 0.35
_GLARE_VEIL = 40.0
_GLARE_SPREAD = 0.55
_SPREAD_SIGMA_OF_WIDTH = 0.03
_SPREAD_STEP = 8


def levels(look: Look, contrast_loss: float) -> tuple[float, float]:
    """Levels of print and paper, drawn together about their middle."""
    middle, half = (look.black + look.white) / 2, (look.white - look.black) / 2 * (1 - contrast_loss)
    return middle - half, middle + half


def illuminate(
    image: np.ndarray, points_mm: tuple[np.ndarray, np.ndarray], look: Look, bad: Disturbances, seed: int
) -> np.ndarray:
    """The image under the light of the scene.

    Args:
        image: (height, width, 3) float32, may be changed.
        points_mm: (height, width) pad x and y of the ground that each pixel shows.
        look: For gradient and the shadows of branches.
        bad: For shadow edge and wet patch.
        seed: Chooses where they are.
    """
    x_mm, y_mm = points_mm
    share = np.float32(1.0)
    if look.gradient:
        share = share * _gradient(image.shape[:2], look)
    if look.shadow:
        share = share * _branches(x_mm, y_mm, look.shadow, seed)
    if bad.shadow_edge:
        share = share * _shadow_edge(x_mm, y_mm, bad, seed)
    if np.ndim(share):
        image *= share[..., None]
    if bad.wet:
        reflected = _wet(x_mm, y_mm, bad.wet, seed)[..., None]
        image += reflected * (_SKY - image)
    return image


def expose(image: np.ndarray, bad: Disturbances) -> np.ndarray:
    """What exposure and glare make of the light, up to where the sensor is full."""
    if bad.exposure_ev:
        image = image * np.float32(2.0**bad.exposure_ev)
    if bad.glare:
        height, width = image.shape[:2]
        small = cv2.resize(image, (width // _SPREAD_STEP, height // _SPREAD_STEP), interpolation=cv2.INTER_AREA)
        sigma = _SPREAD_SIGMA_OF_WIDTH * width / _SPREAD_STEP
        spread = cv2.resize(cv2.GaussianBlur(small, (0, 0), sigma), (width, height))
        gain, veil, share = (np.float32(bad.glare * value) for value in (_GLARE_GAIN, _GLARE_VEIL, _GLARE_SPREAD))
        image = image * (1 + gain) + veil + share * spread
    return np.clip(image, 0, 255)


def motion_kernel(look: Look) -> np.ndarray:
    """A line of the given length, drawn as many bilinear points; it sums to 1 and is symmetric about its centre."""
    half = math.ceil(look.motion_px / 2) + 1
    kernel = np.zeros((2 * half + 1, 2 * half + 1), np.float32)
    turn = math.radians(look.motion_deg)
    for step in (np.arange(64) + 0.5) / 64 - 0.5:
        x, y = half + step * look.motion_px * math.cos(turn), half + step * look.motion_px * math.sin(turn)
        column, line = math.floor(x), math.floor(y)
        for dx, share_x in ((0, column + 1 - x), (1, x - column)):
            for dy, share_y in ((0, line + 1 - y), (1, y - line)):
                kernel[line + dy, column + dx] += share_x * share_y
    return kernel / kernel.sum()


def _gradient(size: tuple[int, int], look: Look) -> np.ndarray:
    turn = math.radians(look.gradient_deg)
    across = np.linspace(-0.5, 0.5, size[1], dtype=np.float32)[None, :]
    down = np.linspace(-0.5, 0.5, size[0], dtype=np.float32)[:, None]
    return 1 - np.float32(look.gradient) * (math.cos(turn) * across + math.sin(turn) * down)


def _branches(x_mm: np.ndarray, y_mm: np.ndarray, depth: float, seed: int) -> np.ndarray:
    """Soft bars with ragged edges, fixed to the ground."""
    ragged = 60 * patches(x_mm, y_mm, seed + 5, 900.0)
    bars = np.cos((0.8 * x_mm + 0.6 * y_mm + ragged) * np.float32(2 * np.pi / 520.0))
    return 1 - np.float32(depth) / (1 + cv2.exp(-6 * (bars - 0.4)))


def shadow_edge_line(seed: int) -> tuple[float, float, float]:
    """Unit normal x, y towards the dark side, and the distance in mm of the shadow's edge from the pad's centre."""
    random = np.random.default_rng([seed, 11])
    turn = random.uniform(0, 2 * np.pi)
    return math.cos(turn), math.sin(turn), float(random.uniform(-_EDGE_WITHIN_MM, _EDGE_WITHIN_MM))


def _shadow_edge(x_mm: np.ndarray, y_mm: np.ndarray, bad: Disturbances, seed: int) -> np.ndarray:
    across, down, off = (np.float32(value) for value in shadow_edge_line(seed))
    beyond = across * x_mm + down * y_mm - off
    dark = np.clip(beyond / np.float32(bad.penumbra_mm) + np.float32(0.5), 0, 1)
    # The part of a round sun that a straight edge leaves, nearly.
    return 1 - np.float32(bad.shadow_edge) * (dark * dark * (3 - 2 * dark))


def _wet(x_mm: np.ndarray, y_mm: np.ndarray, strength: float, seed: int) -> np.ndarray:
    """Share of the sky that each pixel reflects: a ragged patch, brightest in its middle."""
    random = np.random.default_rng([seed, 12])
    centre = random.uniform(-_WET_WITHIN_MM, _WET_WITHIN_MM, 2)
    radius = random.uniform(*_WET_RADIUS_MM)
    off = np.hypot(x_mm - np.float32(centre[0]), y_mm - np.float32(centre[1])) / np.float32(radius)
    ragged = off + np.float32(0.18) * patches(x_mm, y_mm, seed + 7, 420.0)
    return np.float32(strength) * np.clip((1 - ragged) / np.float32(0.6), 0, 1)

# SPDX-License-Identifier: Apache-2.0
"""Blur and sharpening that give an edge the width and the overshoot that were asked for."""

import functools
import math
from collections.abc import Callable

import cv2
import numpy as np

_SHARPEN_SIGMA = 1.2
_WIDEST_SIGMA = 4.0
_MOST_SHARPENING = 8.0
_REACH = 24
_POSITIONS = np.arange(-_REACH, _REACH + 1)


def blur(image: np.ndarray, edge_px: float, overshoot: float) -> np.ndarray:
    """The lens' part: blurs so that, sharpened after it, a straight edge ends up as asked.

    Args:
        image: (height, width, 3) float32 that already averages over each pixel.
        edge_px: 10-90 % width of an upright edge in the end; below what the pixel itself gives, there is no blur.
        overshoot: Overshoot beside an edge in the end, as a share of its height.

    Returns:
        An image of the same shape and type.
    """
    sigma, _ = settings(edge_px, overshoot)
    return _blur(image, sigma) if sigma > 0 else image


def sharpen(image: np.ndarray, edge_px: float, overshoot: float) -> np.ndarray:
    """The camera's part, after `blur` with the same arguments; levels may leave 0 to 255."""
    _, amount = settings(edge_px, overshoot)
    if amount > 0:
        image = image + np.float32(amount) * (image - _blur(image, _SHARPEN_SIGMA))
    return image


@functools.lru_cache(maxsize=256)
def settings(edge_px: float, overshoot: float) -> tuple[float, float]:
    """Sigma of the lens' blur and amount of unsharp masking for an edge of this width and overshoot."""

    def width(sigma: float) -> float:
        levels = _edge_levels(sigma, _amount(sigma, overshoot))
        # Between half pixels the edge is a straight line, and its middle is odd about 0; so twice 50-90 % is the width.
        above = int(np.argmax(levels >= 0.9))
        below = levels[above - 1]
        return 2.0 * (_POSITIONS[above] - 0.5 - (levels[above] - 0.9) / (levels[above] - below))

    if width(0.0) >= edge_px:
        return 0.0, _amount(0.0, overshoot)
    sigma = _bisect(width, edge_px, 0.0, _WIDEST_SIGMA)
    return sigma, _amount(sigma, overshoot)


def _amount(sigma: float, overshoot: float) -> float:
    if overshoot <= 0:
        return 0.0
    return _bisect(lambda amount: float(_edge_levels(sigma, amount).max()) - 1.0, overshoot, 0.0, _MOST_SHARPENING)


def _edge_levels(sigma: float, amount: float) -> np.ndarray:
    """Levels of pixels at `_POSITIONS - 0.5` px from an edge from 0 to 1, which are the knots of its profile."""
    blurred, detail = _profile(sigma)
    return blurred + amount * detail


@functools.lru_cache(maxsize=64)
def _profile(sigma: float) -> tuple[np.ndarray, np.ndarray]:
    """The edge blurred, and what sharpening adds to it."""
    step = (_POSITIONS > 0).astype(float)
    blurred = np.convolve(np.pad(step, _REACH, mode="edge"), _kernel(sigma), mode="same")
    wider = np.convolve(np.pad(blurred, _REACH, mode="edge"), _kernel(_SHARPEN_SIGMA), mode="same")[_REACH:-_REACH]
    return blurred[_REACH:-_REACH], (blurred - wider)[_REACH:-_REACH]


def _kernel(sigma: float) -> np.ndarray:
    """The discrete Gaussian, whose variance is right even far below one pixel, unlike that of a sampled one."""
    reach = 2 + math.ceil(4 * sigma)
    turns = 2.0 * np.pi * np.arange(2 * reach + 1) / (2 * reach + 1)
    return np.fft.fftshift(np.fft.ifft(np.exp(sigma**2 * (np.cos(turns) - 1.0))).real)


def _blur(image: np.ndarray, sigma: float) -> np.ndarray:
    kernel = _kernel(sigma).astype(np.float32)
    return cv2.sepFilter2D(image, -1, kernel, kernel, borderType=cv2.BORDER_REFLECT_101)


def _bisect(rising: Callable[[float], float], target: float, low: float, high: float) -> float:
    for _ in range(24):
        middle = (low + high) / 2
        low, high = (middle, high) if rising(middle) < target else (low, middle)
    return (low + high) / 2

# SPDX-License-Identifier: Apache-2.0
"""Paper that does not lie flat: a piece of a cylinder that touches the ground along a line through the pad's centre.

Sheet coordinates are those of the print (`golden/pad_geometry.py`), measured along the paper; pad coordinates are those
of the ground below it. Both have the same origin and axes.
"""

import math
from dataclasses import dataclass

import numpy as np

# Steeper than this the paper would hang over itself.
_STEEPEST_SINE = 0.95
_SHARPEST_PER_M = 3.0
_NEWTON_STEPS = 6


@dataclass(frozen=True)
class Curl:
    """How the paper is bent; the edges stand up.

    Attributes:
        per_m: 1 / radius of the cylinder; 0 is flat.
        deg: Direction in which the paper rises, clockwise from pad x.
    """

    per_m: float = 0.0
    deg: float = 0.0

    def __post_init__(self) -> None:
        if not 0 <= self.per_m <= _SHARPEST_PER_M:
            raise ValueError(f"per_m is {self.per_m}; it must be within 0 and {_SHARPEST_PER_M}")

    def raise_sheet(self, points_mm: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Where points (n, 2) of the sheet are: pad coordinates (n, 2) and height (n,), all in mm."""
        points = np.asarray(points_mm, dtype=np.float64)
        if self.per_m == 0:
            return points, np.zeros(len(points))
        along = points @ self._direction()
        radius = 1000.0 / self.per_m
        shift = radius * np.sin(along / radius) - along
        return points + shift[:, None] * self._direction(), radius * (1.0 - np.cos(along / radius))

    def sheet_seen_at(
        self, x_mm: np.ndarray, y_mm: np.ndarray, nadir_mm: np.ndarray, altitude_mm: float
    ) -> tuple[np.ndarray, np.ndarray]:
        """The point of the sheet that hides each point of the ground from the camera.

        Args:
            x_mm: Pad x of the points of the ground, float32.
            y_mm: Pad y.
            nadir_mm: (2,) pad coordinates of the point below the camera.
            altitude_mm: Height of the camera.

        Returns:
            Sheet coordinates x, y, float32.
        """
        if self.per_m == 0:
            return x_mm, y_mm
        radius = np.float32(1000.0 / self.per_m)
        direction = self._direction().astype(np.float32)
        ground = direction[0] * x_mm + direction[1] * y_mm
        lean = (np.float32(nadir_mm @ direction) - ground) / np.float32(altitude_mm)
        # The ray at height z is over ground + lean z; z = radius - sqrt(radius^2 - along^2).
        along = ground.copy()
        limit = radius * np.float32(_STEEPEST_SINE)
        for _ in range(_NEWTON_STEPS):
            along = np.clip(along, -limit, limit)
            root = np.sqrt(radius**2 - along**2)
            along = along - (along - ground - lean * (radius - root)) / (1 - lean * along / root)
        along = np.clip(along, -limit, limit)
        share = (radius - np.sqrt(radius**2 - along**2)) / np.float32(altitude_mm)
        x_over = x_mm + share * (np.float32(nadir_mm[0]) - x_mm)
        y_over = y_mm + share * (np.float32(nadir_mm[1]) - y_mm)
        unrolled = radius * np.arcsin(along / radius) - along
        return x_over + unrolled * direction[0], y_over + unrolled * direction[1]

    def _direction(self) -> np.ndarray:
        return np.array([math.cos(math.radians(self.deg)), math.sin(math.radians(self.deg))])


FLAT = Curl()

# SPDX-License-Identifier: Apache-2.0
"""Rendered frames of all kinds: views of the pad that have nothing to do with each other."""

from dataclasses import dataclass

import numpy as np

from sim.world.pose import Pose
from sim.world.renderer import Look, render

NEAREST_M = 0.3
FARTHEST_M = 2.0


@dataclass(frozen=True)
class View:
    """One frame before it is rendered."""

    pose: Pose
    look: Look
    seed: int

    def image(self) -> np.ndarray:
        """(720, 1280, 3) uint8 RGB."""
        return render(self.pose, self.look, seed=self.seed)[0]


def views(count: int, seed: int = 1) -> list[View]:
    """Views of the pad, the same ones for the same seed; each has its own meadow.

    Heights run from 0.3 to 2 m by equal factors, in no order; heading, tilt (15 degrees), offset (a quarter of the
    height each way), ink, paper, ground, light, shadow, blur, sharpening and noise are drawn for each.
    """
    random = np.random.default_rng(seed)
    heights = NEAREST_M * (FARTHEST_M / NEAREST_M) ** np.linspace(0, 1, count)
    return [_view(random, round(float(height), 3), index) for index, height in enumerate(random.permutation(heights))]


def _view(random: np.random.Generator, height_m: float, seed: int) -> View:
    def between(low: float, high: float) -> float:
        return round(float(random.uniform(low, high)), 3)

    black = between(20, 150)
    return View(
        Pose(
            altitude_m=height_m,
            right_m=height_m * between(-0.25, 0.25),
            forward_m=height_m * between(-0.25, 0.25),
            pad_yaw_deg=between(-180, 180),
            roll_deg=between(-15, 15),
            pitch_deg=between(-15, 15),
        ),
        Look(
            black=black,
            white=between(black + 60, 255),
            ground_gain=between(0.2, 1.8),
            edge_px=between(0.9, 1.5),
            overshoot=between(0.0, 0.15),
            motion_px=between(0.0, 5.4),
            motion_deg=between(0, 180),
            noise_sigma=between(0.3, 2.0),
            gradient=between(0.0, 0.6),
            gradient_deg=between(0, 360),
            shadow=between(0.0, 0.6),
        ),
        seed,
    )

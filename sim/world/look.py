# SPDX-License-Identifier: Apache-2.0
"""How scene and camera look."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Look:
    """How scene and camera look; the defaults are those of a fair day.

    Attributes:
        black: Level of the print, 0 to 255.
        white: Level of the paper.
        ground_gain: Brightness of the ground; 0 leaves it black.
        edge_px: 10-90 % width of a straight edge.
        overshoot: Overshoot beside an edge from the camera's sharpening; 0.12 is 12 % of the step.
        motion_px: Length of the motion blur.
        motion_deg: Its direction in the image, clockwise from the right.
        noise_sigma: Standard deviation of each pixel's noise.
        gradient: Light falls from 1 + gradient / 2 to 1 - gradient / 2 across the frame.
        gradient_deg: Direction towards the dark side, clockwise from the right.
        shadow: How dark the shadows of branches are, 0 (none) to 1.
    """

    black: float = 65.0
    white: float = 214.0
    ground_gain: float = 1.0
    edge_px: float = 1.2
    overshoot: float = 0.12
    motion_px: float = 0.0
    motion_deg: float = 0.0
    noise_sigma: float = 1.0
    gradient: float = 0.0
    gradient_deg: float = 0.0
    shadow: float = 0.0


CLEAN = Look(ground_gain=0.0, overshoot=0.0, noise_sigma=0.0)

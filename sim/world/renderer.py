# SPDX-License-Identifier: Apache-2.0
"""Renders what the camera sees: the pad on grass, with the faults of a real camera.

    image, truth = render(Pose(altitude_m=1.2, right_m=0.1, pad_yaw_deg=30.0))

The same arguments give the same bytes. `sim.world.scene` has everything else that may be in view.
"""

import numpy as np

from sim.world.camera import Camera
from sim.world.look import CLEAN, Look
from sim.world.pose import Pose, Truth
from sim.world.scene import Scene, render_scene

__all__ = ["CLEAN", "Look", "render"]


def render(
    pose: Pose, look: Look | None = None, camera: Camera | None = None, seed: int = 0
) -> tuple[np.ndarray, Truth]:
    """One frame and its truth.

    Args:
        pose: Where the drone is.
        look: How it looks; the default `Look()`.
        camera: The camera; the default `Camera()` is the 1280 x 720 one.
        seed: Chooses the meadow, the shadows and the noise.

    Returns:
        (height, width, 3) uint8 RGB, and the truth.
    """
    image, truth = render_scene(Scene(pose, look or Look(), seed, camera or Camera()))
    return image, truth.truth

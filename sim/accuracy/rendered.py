# SPDX-License-Identifier: Apache-2.0
"""Rendered sets by name."""

from functools import partial

import numpy as np

from scripts.errors import UserError
from sim.accuracy.rows import Reference
from sim.accuracy.shots import Shot, Unit
from sim.views import views
from sim.world.camera import Camera
from sim.world.pose import Pose, camera_from_level, truth_of
from sim.world.renderer import Look, render

DEFAULT_COUNT = 20
SETS = ("sharp", "typical", "negatives")


def rendered_units(name: str, count: int | None = None) -> list[Unit]:
    """The units of a rendered set.

    Args:
        name: One of `SETS`.
        count: Frames; default is the set's own number.

    Raises:
        UserError: there is no such set.
    """
    if name not in SETS:
        raise UserError(f"there is no rendered set '{name}'; choose from: {', '.join(SETS)}.")
    units = []
    for index, view in enumerate(views(count or DEFAULT_COUNT)):
        pose, look = view.pose, view.look
        if name == "sharp":
            look = Look(noise_sigma=0.5)
        if name == "negatives":
            pose = Pose(pose.altitude_m, forward_m=40.0)
        shot = Shot(f"{index:04d}", partial(_draw, pose, look, index), truth_of(Camera(), pose).lidar_m)
        units.append(Unit(name, (shot,)))
    return units


def _draw(pose: Pose, look: Look, seed: int) -> tuple[np.ndarray, Reference]:
    image, truth = render(pose, look, seed=seed)
    right, back, depth = camera_from_level(pose) @ (pose.right_m, -pose.forward_m, pose.altitude_m)
    return image, Reference(
        present=truth.visible,
        required=truth.visible,
        x_px=truth.x_px,
        y_px=truth.y_px,
        angle_deg=truth.angle_deg,
        right_m=float(right),
        forward_m=-float(back),
        altitude_m=float(depth),
    )

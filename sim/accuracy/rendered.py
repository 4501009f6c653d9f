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
        units.append(Unit(name, (_shot(f"{index:04d}", pose, look, index),)))
    return units


def _shot(name: str, pose: Pose, look: Look, seed: int) -> Shot:
    truth = truth_of(Camera(), pose)
    level = np.array([pose.right_m, -pose.forward_m, pose.altitude_m])
    body = camera_from_level(pose) @ level
    present = truth.visible
    reference = Reference(
        present, present, truth.x_px, truth.y_px, truth.angle_deg, float(body[0]), -float(body[1]), float(body[2])
    )
    return Shot(name, partial(_picture, pose, look, seed), truth.lidar_m, reference)


def _picture(pose: Pose, look: Look, seed: int) -> np.ndarray:
    return render(pose, look, seed=seed)[0]

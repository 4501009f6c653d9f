# SPDX-License-Identifier: Apache-2.0
"""Rendered sets: the corpora of `sim.world.corpus`, each with its exact truth."""

from collections.abc import Iterator
from functools import partial

import numpy as np

from scripts.errors import UserError
from sim.accuracy.rows import Reference
from sim.accuracy.shots import Shot, Unit
from sim.world.corpus import NAMES, corpus
from sim.world.pose import camera_from_level, truth_of
from sim.world.scene import Scene, render_scene

SWEEP = "sweep:"
CLIPS = {"descent", "light_step"}
COUNTS = {
    "sharp": 200,
    "typical": 300,
    "border": 200,
    "metric": 200,
    "negatives": 5000,
    "descent": 120,
    "light_step": 40,
}
SWEEP_COUNT = 20
SETS = NAMES


def rendered_units(name: str, count: int | None = None) -> list[Unit]:
    """The units of a rendered set.

    Args:
        name: One of `SETS`.
        count: Frames, in a sweep of each strength; default is the set's own number.

    Raises:
        UserError: there is no such set.
    """
    if name not in SETS:
        raise UserError(f"there is no rendered set '{name}'; choose from: {', '.join(SETS)}.")
    scenes = corpus(name, count or COUNTS.get(name, SWEEP_COUNT))
    if name in CLIPS:
        return [Unit(name, tuple(_shots(scenes)), clip=True)]
    return [Unit(name, (shot,)) for shot in _shots(scenes)]


def _shots(scenes: Iterator[Scene]) -> Iterator[Shot]:
    for index, scene in enumerate(scenes):
        yield Shot(
            name=f"{index:04d}",
            draw=partial(draw, scene),
            lidar_m=truth_of(scene.camera, scene.pose).lidar_m,
            strength=scene.strength if scene.corpus.startswith(SWEEP) else None,
        )


def draw(scene: Scene) -> tuple[np.ndarray, Reference]:
    """The picture of a scene, and what is true of it.

    What is in front of the camera lies in body axes, as the firmware gives it; an autopilot turns them level.
    """
    image, known = render_scene(scene)
    if not known.pad:
        return image, Reference(present=False)
    pose, truth = scene.pose, known.truth
    right, back, depth = camera_from_level(pose) @ (pose.right_m, -pose.forward_m, pose.altitude_m)
    return image, Reference(
        present=any(shape.share > 0 for shape in known.shapes.values()),
        required=known.visible_at_all,
        x_px=truth.x_px,
        y_px=truth.y_px,
        angle_deg=truth.angle_deg,
        right_m=float(right),
        forward_m=-float(back),
        altitude_m=float(depth),
    )

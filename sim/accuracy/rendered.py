# SPDX-License-Identifier: Apache-2.0
"""Rendered sets: the corpora of `sim.world.corpus`, each with its exact truth."""

import math
from collections.abc import Iterator
from dataclasses import replace
from functools import partial

import numpy as np

from scripts.errors import UserError
from sim.accuracy.rows import Reference
from sim.accuracy.shots import Shot, Unit
from sim.world.corpus import NAMES, corpus
from sim.world.pose import camera_from_level, truth_of
from sim.world.scene import Scene, render_scene

SWEEP = "sweep:"
BLINDED = "blinded"
CLIPS = {"descent", "light_step", BLINDED}
COUNTS = {
    "sharp": 100,
    "typical": 200,
    "border": 100,
    "metric": 100,
    "negatives": 5000,
    "descent": 84,
    "light_step": 40,
    BLINDED: 84,
}
SWEEP_COUNT = 10
SETS = (*NAMES, BLINDED)
ATTITUDE_SIGMA_DEG = 0.4
BLINDED_EVERY = 12
BLINDED_EV = 8.0


def rendered_units(name: str, count: int | None = None, seed: int = 1) -> list[Unit]:
    """The units of a rendered set.

    Args:
        name: One of `SETS`.
        count: Frames, in a sweep of each strength; default is the set's own number.
        seed: Another seed is another set of scenes.

    Raises:
        UserError: there is no such set.
    """
    if name not in SETS:
        raise UserError(f"there is no rendered set '{name}'; choose from: {', '.join(SETS)}.")
    source = "descent" if name == BLINDED else name
    scenes = corpus(source, count or COUNTS.get(name, SWEEP_COUNT), seed)
    if name == BLINDED:
        scenes = _blinded(scenes)
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
            attitude_rad=_attitude_rad(scene, index if scene.corpus in CLIPS else 0),
        )


def _blinded(scenes: Iterator[Scene]) -> Iterator[Scene]:
    """One frame in some is all white. The one after it has its thresholds, so that two in a row show nothing."""
    for index, scene in enumerate(scenes):
        blind = index % BLINDED_EVERY == BLINDED_EVERY - 1
        bad = replace(scene.disturbances, exposure_ev=BLINDED_EV) if blind else scene.disturbances
        yield replace(scene, disturbances=bad)


def _attitude_rad(scene: Scene, frame: int) -> tuple[float, float]:
    """Roll and pitch as an autopilot knows them, the same error at every strength of a sweep."""
    off_deg = np.random.default_rng([scene.seed, 40, frame]).normal(0.0, ATTITUDE_SIGMA_DEG, 2)
    roll_deg, pitch_deg = np.add((scene.pose.roll_deg, scene.pose.pitch_deg), off_deg)
    return math.radians(roll_deg), math.radians(pitch_deg)


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

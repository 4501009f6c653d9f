# SPDX-License-Identifier: Apache-2.0
"""Seeded corpora of scenes: what detector and firmware are measured with.

    for scene in corpus("typical", count=200, seed=1):
        image, truth = render_scene(scene)

The same name, count and seed give the same scenes. `docs/world.md` shows them.
"""

import dataclasses
import math
from collections.abc import Callable, Iterator

import numpy as np

from sim.world.camera import Camera
from sim.world.curl import FLAT
from sim.world.decal import OCCLUDERS
from sim.world.disturbances import UNDISTURBED, Disturbances
from sim.world.drawings import DRAWINGS
from sim.world.ground import GROUNDS
from sim.world.look import Look
from sim.world.pose import Pose, camera_from_level, project_pad, truth_of
from sim.world.scene import Scene
from sim.world.visibility import shapes_of

FRAMES_A_SECOND = 60.0

_SHARP_M = (0.3, 2.0)
_METRIC_M = (0.15, 3.0)
_TYPICAL_M = (0.24, 1.8)
_OFF_AXIS_DEG = 42.0
_BORDER_M = (0.3, 1.2)
_DESCENT_M = (1.5, 0.1)
_DESCENT_SWAY_MM = 15.0
_MOST_TRIES = 400
_BORDER_RING_SHARE = (0.3, 0.97)
# Black and white level of the campaigns (docs/world.md); glare makes those of the third from those of the first.
_LEVELS = ((65.0, 214.0), (70.0, 225.0), (65.0, 214.0))
_LIGHT_STEP_EVERY = 5
_LIGHT_STEPS_EV = (0.0, -2.0, 0.0, 1.0, -1.0, 1.0, 0.0, -1.5)

# What each sweep changes and the values it takes.
SWEEPS: dict[str, tuple[float, ...]] = {
    "shadow_edge": (0.0, 0.2, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9),
    "occlusion": (0.0, 0.02, 0.05, 0.1, 0.15, 0.2, 0.3, 0.4, 0.5),
    "tilt": (0.0, 5.0, 10.0, 15.0, 20.0, 25.0, 30.0, 35.0, 40.0, 45.0),
    "motion": (0.0, 2.0, 4.0, 6.0, 8.0, 10.0, 12.0, 14.0, 16.0, 18.0, 20.0),
    "contrast_loss": (0.0, 0.2, 0.4, 0.5, 0.6, 0.7, 0.8, 0.85, 0.9),
    "noise": (0.0, 1.0, 2.0, 4.0, 6.0, 8.0, 12.0, 16.0),
    "dirt": (0.0, 0.05, 0.1, 0.15, 0.2, 0.3, 0.4, 0.6),
    "wet": (0.0, 0.2, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0),
    "glare": (0.0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.8),
    "exposure": (-3.0, -2.5, -2.0, -1.5, -1.0, -0.5, 0.0, 0.5, 1.0, 1.5),
    "gradient": (0.0, 0.2, 0.4, 0.6, 0.8, 1.0, 1.2),
    "curl": (0.0, 0.25, 0.5, 0.75, 1.0, 1.5, 2.0),
    "sharpening": (0.0, 0.1, 0.2, 0.3, 0.4, 0.5),
    "blur": (1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 6.0),
}


def corpus(name: str, count: int, seed: int = 1, camera: Camera | None = None) -> Iterator[Scene]:
    """Scenes one after the other.

    Args:
        name: One of `NAMES`.
        count: Scenes; of a sweep, scenes for each of its values; of a clip, its frames.
        seed: Another seed is another corpus.
        camera: The camera; the default is that of the firmware.

    Raises:
        ValueError: There is no such corpus, or `count` is below 1.
    """
    if name not in NAMES:
        raise ValueError(f"there is no corpus {name}; there are {', '.join(NAMES)}")
    if count < 1:
        raise ValueError(f"count is {count}; it must be 1 or more")
    camera = camera or Camera()
    kind, _, disturbance = name.partition(":")
    if kind == "sweep":
        scenes = _sweep(disturbance, count, seed, camera)
    elif kind in _CLIPS:
        scenes = _CLIPS[kind](count, seed, camera)
    else:
        scenes = (_SINGLE[kind](_random(kind, seed, index), index, camera) for index in range(count))
    for scene in scenes:
        yield dataclasses.replace(scene, corpus=name)


def _random(name: str, seed: int, index: int) -> np.random.Generator:
    return np.random.default_rng([seed, index, *name.encode()])


def _scene_seed(random: np.random.Generator) -> int:
    return int(random.integers(1 << 31))


def _log_uniform(random: np.random.Generator, low: float, high: float) -> float:
    return float(low * (high / low) ** random.random())


def _tilt(random: np.random.Generator, tilt_deg: float) -> dict[str, float]:
    """Roll and pitch that lean the optical axis by this much, in any direction."""
    turn, tilt = random.uniform(0, 2 * np.pi), math.radians(tilt_deg)
    # The axis' horizontal part is sin(pitch) and cos(pitch) sin(roll), as `camera_from_level` has it.
    pitch = math.asin(math.sin(tilt) * math.cos(turn))
    roll = math.asin(math.sin(tilt) * math.sin(turn) / math.cos(pitch))
    return {"roll_deg": math.degrees(roll), "pitch_deg": math.degrees(pitch)}


def _pad_at(camera: Camera, pose: Pose, x_px: float, y_px: float) -> Pose:
    """The pose, moved so that the pad's centre is seen at a pixel."""
    at = np.array([pose.right_m, pose.forward_m])
    target, step = np.array([x_px, y_px]), 1e-5

    def seen(place: np.ndarray) -> np.ndarray:
        moved = dataclasses.replace(pose, right_m=float(place[0]), forward_m=float(place[1]))
        return project_pad(camera, moved, np.zeros((1, 2)))[0]

    for _ in range(12):
        here = seen(at)
        slope = np.column_stack([(seen(at + step * axis) - here) / step for axis in np.eye(2)])
        move = np.linalg.solve(slope, target - here)
        # Far from the axis the slope changes fast; a step is at most the altitude.
        at = at + move * min(1.0, pose.altitude_m / max(float(np.abs(move).max()), 1e-9))
    return dataclasses.replace(pose, right_m=float(at[0]), forward_m=float(at[1]))


def _in_frame(random: np.random.Generator, camera: Camera, pose: Pose, wanted: Callable[[Pose], bool]) -> Pose | None:
    """The pose with the pad somewhere in the frame where it is as wanted; None if there is no such place."""
    for _ in range(_MOST_TRIES):
        x, y = random.uniform(0, camera.width - 1), random.uniform(0, camera.height - 1)
        moved = _pad_at(camera, pose, x, y)
        if wanted(moved):
            return moved
    return None


def _near_axis(pose: Pose) -> bool:
    """The pad's centre is no farther off the optical axis than on any photograph."""
    place = camera_from_level(pose) @ (pose.right_m, -pose.forward_m, pose.altitude_m)
    return bool(place[2] >= math.cos(math.radians(_OFF_AXIS_DEG)) * np.linalg.norm(place))


def _wholly(camera: Camera) -> Callable[[Pose], bool]:
    """The ring's outer edge is inside the frame, and the pad near the axis."""
    return lambda pose: _near_axis(pose) and truth_of(camera, pose).visible


def _placed(
    random: np.random.Generator, camera: Camera, altitudes: tuple[float, float], tilts: Callable[[], float]
) -> Pose:
    """A pose from which the whole ring is in the frame."""
    while True:
        altitude = _log_uniform(random, *altitudes)
        pose = Pose(altitude, pad_yaw_deg=random.uniform(-180, 180), **_tilt(random, tilts()))
        found = _in_frame(random, camera, pose, _wholly(camera))
        if found:
            return found


def _sharp(random: np.random.Generator, index: int, camera: Camera) -> Scene:
    pose = _placed(random, camera, _SHARP_M, lambda: random.uniform(0, 10))
    look = Look(
        black=random.uniform(40, 80),
        white=random.uniform(200, 235),
        ground_gain=random.uniform(0.7, 1.1),
        edge_px=1.0,
        overshoot=0.0,
        noise_sigma=0.3,
    )
    return Scene(pose, look, _scene_seed(random), camera, ground=GROUNDS[index % len(GROUNDS)])


def _measured_tilt(random: np.random.Generator) -> float:
    """Median 8, 90 % below 12, at most 15 degrees."""
    return float(np.interp(random.random(), (0.0, 0.5, 0.9, 1.0), (0.0, 8.0, 12.0, 15.0)))


def _measured_look(random: np.random.Generator) -> tuple[Look, float]:
    """Levels, blur and noise as in the photographs of one of the three campaigns, and the glare."""
    campaign = int(random.choice(3, p=(0.5, 0.25, 0.25)))
    black, white = _LEVELS[campaign]
    look = Look(
        black=black + random.normal(0, 8),
        white=min(white + random.normal(0, 8), 250.0),
        ground_gain=random.uniform(0.85, 1.15) if campaign != 1 else random.uniform(0.7, 1.0),
        edge_px=random.uniform(0.9, 1.5),
        overshoot=random.uniform(0.10, 0.15),
        motion_px=min(5.4, random.gamma(1.2, 1.2)),
        motion_deg=random.uniform(0, 180),
        noise_sigma=random.uniform(0.3, 2.0),
        gradient=random.uniform(0.0, 0.25),
        gradient_deg=random.uniform(0, 360),
        shadow=random.choice((0.0, random.uniform(0.05, 0.35))),
    )
    return look, random.uniform(0.2, 0.5) if campaign == 2 else 0.0


def _typical(random: np.random.Generator, index: int, camera: Camera) -> Scene:
    pose = _placed(random, camera, _TYPICAL_M, lambda: _measured_tilt(random))
    look, glare = _measured_look(random)
    disturbances = Disturbances(
        glare=glare,
        curl_per_m=min(random.uniform(0.0, 0.5), pose.altitude_m),
        legs=random.choice((0.0, random.uniform(0.55, 0.75))) if not glare else 0.0,
        occlusion=random.choice((0.0, 0.0, 0.0, random.uniform(0.002, 0.02))),
    )
    # The photographs are all of grass, and the glaring ones of nothing brighter.
    ground = "grass" if glare or random.random() < 0.6 else GROUNDS[int(random.integers(len(GROUNDS)))]
    return Scene(pose, look, _scene_seed(random), camera, ground=ground, disturbances=disturbances)


def _border(random: np.random.Generator, index: int, camera: Camera) -> Scene:
    def cut(pose: Pose) -> bool:
        shapes = shapes_of(camera, pose, FLAT, None, None)
        inner = all(shapes[name].share == 1.0 for name in ("square", "rectangle", "small_ring"))
        return inner and _BORDER_RING_SHARE[0] <= shapes["ring"].share <= _BORDER_RING_SHARE[1]

    while True:
        altitude = _log_uniform(random, *_BORDER_M)
        pose = Pose(altitude, pad_yaw_deg=random.uniform(-180, 180), **_tilt(random, _measured_tilt(random)))
        found = _in_frame(random, camera, pose, cut)
        if found:
            look, glare = _measured_look(random)
            ground, bad = GROUNDS[index % len(GROUNDS)], Disturbances(glare=glare)
            return Scene(found, look, _scene_seed(random), camera, ground=ground, disturbances=bad)


def _metric(random: np.random.Generator, index: int, camera: Camera) -> Scene:
    altitude = _log_uniform(random, *_METRIC_M)

    def seen(pose: Pose) -> bool:
        if not _near_axis(pose):
            return False
        shapes = shapes_of(camera, pose, FLAT, None, None)
        return all(shapes[name].share == 1.0 and shapes[name].area_px >= 40 for name in ("square", "rectangle"))

    yaw = random.uniform(-180, 180)
    for tilt in (_measured_tilt(random), 0.0):
        found = _in_frame(random, camera, Pose(altitude, pad_yaw_deg=yaw, **_tilt(random, tilt)), seen)
        if found:
            break
    look = Look(edge_px=random.uniform(0.9, 1.3), noise_sigma=random.uniform(0.3, 1.2))
    pose = found or Pose(altitude, pad_yaw_deg=yaw)
    return Scene(pose, look, _scene_seed(random), camera, ground=GROUNDS[index % len(GROUNDS)])


def _negative(random: np.random.Generator, index: int, camera: Camera) -> Scene:
    """Every third shows bare ground, the others one drawing after the other."""
    altitude = _log_uniform(random, 0.25, 2.5)
    pose = Pose(altitude, pad_yaw_deg=random.uniform(-180, 180), **_tilt(random, _measured_tilt(random)))
    x, y = random.uniform(0.2, 0.8, 2) * (camera.width, camera.height)
    look, glare = _measured_look(random)
    bare = index % 3 == 2
    disturbances = Disturbances(
        glare=glare,
        shadow_edge=random.choice((0.0, random.uniform(0.3, 0.8))),
        legs=random.choice((0.0, 0.65)),
        wet=random.choice((0.0, 0.0, 0.0, random.uniform(0.3, 0.9))),
    )
    if bare:
        look = dataclasses.replace(look, shadow=random.uniform(0, 0.8))
    drawing = "" if bare else DRAWINGS[(index - index // 3) % len(DRAWINGS)]
    ground = GROUNDS[int(random.integers(len(GROUNDS)))]
    placed = _pad_at(camera, pose, float(x), float(y))
    return Scene(placed, look, _scene_seed(random), camera, False, drawing, ground, disturbances)


def _sweep(disturbance: str, count: int, seed: int, camera: Camera) -> Iterator[Scene]:
    """Each value on the same scenes, so that nothing else differs between two values."""
    for value in SWEEPS[disturbance]:
        for index in range(count):
            random = _random(f"sweep:{disturbance}", seed, index)
            base = _sweep_base(random, index, disturbance, camera)
            yield dataclasses.replace(_disturbed(base, disturbance, value, random), strength=value)


def _sweep_base(random: np.random.Generator, index: int, disturbance: str, camera: Camera) -> Scene:
    altitude = _log_uniform(random, 0.45, 1.5)
    pose = Pose(altitude, pad_yaw_deg=random.uniform(-180, 180))
    if disturbance != "tilt":
        pose = dataclasses.replace(pose, **_tilt(random, random.uniform(0, 8)))
    x, y = random.uniform(0.38, 0.62, 2) * (camera.width, camera.height)
    look = Look(
        black=random.uniform(55, 75),
        white=random.uniform(205, 225),
        edge_px=random.uniform(1.0, 1.4),
        noise_sigma=0.0 if disturbance == "noise" else random.uniform(0.5, 1.5),
        motion_deg=random.uniform(0, 180),
        gradient_deg=random.uniform(0, 360),
    )
    seed = _scene_seed(random)
    return Scene(_pad_at(camera, pose, float(x), float(y)), look, seed, camera, ground=GROUNDS[index % len(GROUNDS)])


def _disturbed(scene: Scene, disturbance: str, value: float, random: np.random.Generator) -> Scene:
    occluder = OCCLUDERS[int(random.integers(len(OCCLUDERS)))]
    if disturbance == "tilt":
        # The drone leans and the pad stays where it is in the picture.
        x, y = project_pad(scene.camera, scene.pose, np.zeros((1, 2)))[0]
        leaned = dataclasses.replace(scene.pose, **_tilt(random, value))
        return dataclasses.replace(scene, pose=_pad_at(scene.camera, leaned, float(x), float(y)))
    looks = {"motion": "motion_px", "noise": "noise_sigma", "gradient": "gradient"}
    looks |= {"blur": "edge_px", "sharpening": "overshoot"}
    if disturbance in looks:
        return dataclasses.replace(scene, look=dataclasses.replace(scene.look, **{looks[disturbance]: value}))
    name = {"exposure": "exposure_ev", "curl": "curl_per_m"}.get(disturbance, disturbance)
    bad = dataclasses.replace(UNDISTURBED, occluder=occluder, **{name: value})
    return dataclasses.replace(scene, disturbances=bad)


def _descent(count: int, seed: int, camera: Camera) -> Iterator[Scene]:
    """From 1.5 to 0.1 m over the pad, slower near the ground, swaying and turning a little as a drone does."""
    random = _random("descent", seed, 0)
    phases, yaw = random.uniform(0, 2 * np.pi, 5), random.uniform(-180, 180)
    sway, scene_seed = random.uniform(0.5, 1.0, 4), _scene_seed(random)
    top, bottom = _DESCENT_M
    look = Look(edge_px=1.2, noise_sigma=1.0, shadow=0.1, gradient=0.1)
    for index in range(count):
        share, seconds = index / max(count - 1, 1), index / FRAMES_A_SECOND
        altitude = top * (bottom / top) ** share
        swing = np.sin(2 * np.pi * 0.4 * seconds * sway + phases[:4])
        # The sway shrinks with the altitude, and more than it: a controller that has the pad closes in on it.
        reach_m = 1e-3 * _DESCENT_SWAY_MM * (0.2 + altitude / top * 4.0)
        pose = Pose(
            altitude_m=altitude,
            right_m=reach_m * float(swing[0]),
            forward_m=reach_m * float(swing[1]),
            pad_yaw_deg=yaw + 8.0 * math.sin(2 * np.pi * 0.1 * seconds + phases[4]),
            roll_deg=2.0 * float(swing[2]),
            pitch_deg=2.0 * float(swing[3]),
        )
        yield Scene(pose, look, scene_seed, camera)


def _light_step(count: int, seed: int, camera: Camera) -> Iterator[Scene]:
    """A drone that stands still while the exposure jumps every few frames."""
    random = _random("light_step", seed, 0)
    altitude = _log_uniform(random, 0.6, 1.2)
    pose = Pose(altitude, 0.1 * altitude, -0.05 * altitude, random.uniform(-180, 180), **_tilt(random, 4.0))
    scene_seed = _scene_seed(random)
    for index in range(count):
        step = _LIGHT_STEPS_EV[index // _LIGHT_STEP_EVERY % len(_LIGHT_STEPS_EV)]
        # A micrometre a frame, so that each has its own noise.
        moved = dataclasses.replace(pose, right_m=pose.right_m + 1e-6 * index)
        bad = Disturbances(exposure_ev=step)
        yield Scene(moved, Look(), scene_seed, camera, disturbances=bad, strength=step)


_SINGLE: dict[str, Callable[[np.random.Generator, int, Camera], Scene]] = {
    "sharp": _sharp,
    "typical": _typical,
    "border": _border,
    "metric": _metric,
    "negatives": _negative,
}
_CLIPS: dict[str, Callable[[int, int, Camera], Iterator[Scene]]] = {"descent": _descent, "light_step": _light_step}
NAMES = (*_SINGLE, *_CLIPS, *(f"sweep:{name}" for name in SWEEPS))

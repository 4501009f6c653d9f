# SPDX-License-Identifier: Apache-2.0
"""Corpora are repeatable and are what their names say."""

import dataclasses
import itertools
import math
from collections import Counter

import cv2
import numpy as np
import pytest

from golden import pad_geometry as pad
from sim.world.camera import Camera
from sim.world.corpus import NAMES, SWEEPS, corpus
from sim.world.drawings import DECOYS, DRAWINGS, drawing
from sim.world.ground import GROUNDS
from sim.world.look import CLEAN
from sim.world.pad import PAD, Sheet, coverage
from sim.world.pose import Pose, camera_from_level, truth_of
from sim.world.scene import Scene, SceneTruth, render_scene
from sim.world.visibility import shapes_of

SMALL = Camera().scaled(8)


def truth_in_small(scene: Scene) -> SceneTruth:
    """The truth without the time that a full picture takes: of the same view with fewer pixels."""
    small = dataclasses.replace(scene, camera=scene.camera.scaled(8), look=CLEAN)
    return render_scene(small)[1]


def tilt_deg(pose: Pose) -> float:
    return math.degrees(math.acos(camera_from_level(pose)[2, 2]))


@pytest.mark.parametrize("name", NAMES)
def test_the_same_name_count_and_seed_give_the_same_scenes(name: str) -> None:
    first, again, other = (list(corpus(name, 3, seed)) for seed in (1, 1, 2))
    assert first == again
    assert len(first) == 3 * (len(SWEEPS[name.partition(":")[2]]) if ":" in name else 1)
    assert all(scene != another for scene, another in zip(first, other, strict=True))
    assert {scene.corpus for scene in first} == {name}
    assert {scene.camera for scene in corpus(name, 1, camera=SMALL)} == {SMALL}


def test_more_scenes_begin_like_fewer() -> None:
    for name in ("sharp", "typical", "border", "metric", "negatives"):
        assert list(corpus(name, 2)) == list(itertools.islice(corpus(name, 5), 2))


def test_sharp_frames_are_clean_and_moderate() -> None:
    scenes = list(corpus("sharp", 60))
    assert all(0.3 <= scene.pose.altitude_m <= 2.0 and tilt_deg(scene.pose) <= 10.001 for scene in scenes)
    assert all(scene.look.overshoot == 0 and scene.look.motion_px == 0 for scene in scenes)
    quarters = Counter(int((scene.pose.pad_yaw_deg + 180) // 90) for scene in scenes)
    assert min(quarters[quarter] for quarter in range(4)) >= 5
    assert {scene.ground for scene in scenes} == set(GROUNDS)
    for scene in scenes[:8]:
        truth = truth_in_small(scene)
        assert truth.truth.visible
        assert {shape.share for shape in truth.shapes.values()} == {1.0}


def test_typical_frames_have_the_measured_distribution() -> None:
    scenes = list(corpus("typical", 300))
    tilts = np.array([tilt_deg(scene.pose) for scene in scenes])
    assert np.median(tilts) == pytest.approx(8, abs=1.2)
    assert np.quantile(tilts, 0.9) == pytest.approx(12, abs=1.0)
    assert tilts.max() <= 15.001
    assert all(0.24 <= scene.pose.altitude_m <= 1.8 for scene in scenes)
    assert all(0.9 <= scene.look.edge_px <= 1.5 and scene.look.motion_px <= 5.4 for scene in scenes)
    legs = np.mean([scene.disturbances.legs > 0 for scene in scenes])
    glare = np.mean([scene.disturbances.glare > 0 for scene in scenes])
    assert 0.2 < legs < 0.6
    assert 0.15 < glare < 0.35


@pytest.mark.parametrize("name", ["sharp", "typical", "metric"])
def test_the_pad_is_no_farther_off_axis_than_on_photographs(name: str) -> None:
    off = []
    for scene in corpus(name, 100):
        truth = truth_of(scene.camera, scene.pose)
        radius = math.hypot(truth.x_px - 640, truth.y_px - 360)
        off.append(2 * math.degrees(math.atan(radius / (2 * 552))))
    assert 35 < max(off) <= 42.001


def test_at_the_border_the_ring_is_cut_and_the_inner_shapes_are_whole() -> None:
    for scene in corpus("border", 40):
        shapes = shapes_of(scene.camera, scene.pose, scene.curl, None, None)
        assert 0.3 <= shapes["ring"].share <= 0.97
        assert min(shapes[name].share for name in ("square", "rectangle")) == 1.0


def test_metric_altitudes_are_spread_by_equal_factors() -> None:
    scenes = list(corpus("metric", 200))
    logs = np.log([scene.pose.altitude_m for scene in scenes])
    assert math.log(0.15) <= logs.min() < math.log(0.17)
    assert math.log(2.7) < logs.max() <= math.log(3.0)
    assert np.exp(np.median(logs)) == pytest.approx(math.sqrt(0.15 * 3.0), rel=0.2)


@pytest.mark.parametrize("name", SWEEPS)
def test_a_sweep_changes_one_thing(name: str) -> None:
    scenes = list(corpus(f"sweep:{name}", 4))
    assert [scene.strength for scene in scenes] == [value for value in SWEEPS[name] for _ in range(4)]
    for index in range(4):
        changed = set()
        for scene, following in itertools.pairwise(scenes[index::4]):
            for part in ("pose", "look", "disturbances"):
                before, after = (dataclasses.asdict(getattr(one, part)) for one in (scene, following))
                changed |= {(part, key) for key in before if before[key] != after[key]}
            assert (scene.seed, scene.ground, scene.camera) == (following.seed, following.ground, following.camera)
        if name == "tilt":
            assert {part for part, _ in changed} == {"pose"}
            assert not changed & {("pose", "altitude_m"), ("pose", "pad_yaw_deg")}
        else:
            assert len(changed) == 1


def test_a_tilt_sweep_leans_by_its_strength_and_keeps_the_pad_in_place() -> None:
    scenes = list(corpus("sweep:tilt", 3))
    for index in range(3):
        centres = [truth_in_small(scene).truth for scene in scenes[index::3]]
        assert np.ptp([(truth.x_px, truth.y_px) for truth in centres], axis=0).max() < 0.01
    assert [tilt_deg(scene.pose) for scene in scenes] == pytest.approx([scene.strength for scene in scenes], abs=1e-3)


def test_the_descent_goes_down_to_ten_centimetres_without_a_jump() -> None:
    scenes = list(corpus("descent", 300))
    altitudes = [scene.pose.altitude_m for scene in scenes]
    assert (altitudes[0], altitudes[-1]) == (pytest.approx(1.5), pytest.approx(0.1))
    assert all(above > below for above, below in itertools.pairwise(altitudes))
    truths = [truth_in_small(scene).truth for scene in scenes[::20]]
    assert all(0 <= truth.x_px <= 159 and 0 <= truth.y_px <= 89 for truth in truths)
    for scene, following in itertools.pairwise(scenes):
        assert abs(scene.pose.right_m - following.pose.right_m) < 0.01
        assert abs(scene.pose.pad_yaw_deg - following.pose.pad_yaw_deg) < 0.2
        assert scene.seed == following.seed


def test_light_steps_jump_and_nothing_else_does() -> None:
    scenes = list(corpus("light_step", 40))
    steps = [abs(b.disturbances.exposure_ev - a.disturbances.exposure_ev) for a, b in itertools.pairwise(scenes)]
    assert 5 <= sum(step > 0 for step in steps) <= 8
    assert max(steps) == 2.0
    assert np.ptp([scene.pose.right_m for scene in scenes]) < 1e-4


def test_negatives_hold_every_drawing_and_bare_ground_and_no_pad() -> None:
    scenes = list(corpus("negatives", 3 * len(DRAWINGS)))
    assert not any(scene.pad for scene in scenes)
    drawn = Counter(scene.drawing for scene in scenes)
    assert drawn.pop("") == len(DRAWINGS)
    assert {name: drawn[name] for name in DRAWINGS} == dict.fromkeys(DRAWINGS, 2)


@pytest.mark.parametrize("name", DRAWINGS)
def test_each_drawing_is_seen(name: str) -> None:
    scene = Scene(Pose(0.6), CLEAN, 3, Camera().scaled(4), False, name)
    image, truth = render_scene(scene)
    bare, _ = render_scene(dataclasses.replace(scene, drawing=""))
    assert (image != bare).any(axis=2).mean() > 0.01
    assert not truth.visible_at_all
    other, _ = render_scene(dataclasses.replace(scene, seed=4))
    if not name.startswith("decoy_"):
        assert (image != other).any()


def features(sheet: Sheet) -> dict[str, list[float]]:
    """Areas, distances between the shapes inside the ring, and ratios of the sides of boxes; smallest shape first."""
    x, y = (grid.astype(np.float32) for grid in np.meshgrid(np.arange(-140, 141), np.arange(-140, 141)))
    black = (coverage(x, y, sheet)[1] > 0.5).astype(np.uint8)
    count, _, stats, centres = cv2.connectedComponentsWithStats(black)
    order = 1 + np.argsort(stats[1:count, cv2.CC_STAT_AREA])
    areas = stats[order, cv2.CC_STAT_AREA] / (np.pi * pad.RING_OUTER_RADIUS_MM**2)
    # The largest is the ring.
    distances = [float(np.hypot(*(centres[a] - centres[b]))) for a, b in itertools.combinations(order[:-1], 2)]
    sides = [float(max(stats[one, 2:4]) / min(stats[one, 2:4])) for one in order]
    return {"areas": areas.tolist(), "distances": distances, "sides": sides}


@pytest.mark.parametrize("kind", DECOYS)
@pytest.mark.parametrize("seed", range(5))
def test_each_decoy_is_out_of_proportion(kind: str, seed: int) -> None:
    true = features(PAD)
    assert len(true["areas"]) == 4
    sheet = drawing(f"decoy_{kind}", seed, 65, 214)
    assert isinstance(sheet, Sheet)
    found = features(sheet)
    if len(found["areas"]) != 4:
        # Shapes are missing, or there are others.
        return
    areas, true_areas = np.array(found["areas"]), np.array(true["areas"])
    ratios = [
        *(areas / true_areas),
        *(np.array(found["distances"]) / true["distances"]),
        *(np.array(found["sides"]) / true["sides"]),
    ]
    assert max(max(ratio, 1 / ratio) for ratio in ratios) > 1.25

# SPDX-License-Identifier: Apache-2.0
"""The chain against OpenCV's functions in a row, with thresholds interpolated in floating point."""

import cv2
import numpy as np
import pytest

from golden.chain import PAPER, Settings, Stages, run_chain, run_frames
from golden.generated.landing_regs import OBJECT_DTYPE
from sim.world.camera import Camera
from sim.world.clip import demo_clip
from sim.world.pose import Pose
from sim.world.renderer import render

SIZES = [(320, 180), (257, 129), (128, 130), (7, 5)]
BRIGHTEST = Settings(factor=256, dark_is_one=False, min_area=1)
KERNEL = np.ones((3, 3), np.uint8)


def picture(width: int, height: int, seed: int) -> np.ndarray:
    """Blotches and noise, RGB."""
    random = np.random.default_rng(seed)
    small = random.integers(0, 256, (height // 6 + 2, width // 6 + 2, 3), np.uint8)
    blotches = cv2.resize(small, (width, height), interpolation=cv2.INTER_CUBIC).astype(int)
    return np.clip(blotches + random.normal(0, 6, blotches.shape), 0, 255).astype(np.uint8)


def opencv_stages(rgb: np.ndarray, before: np.ndarray, settings: Settings) -> dict[str, np.ndarray]:
    """The pictures of every stage; `before` is the smooth picture of the frame before."""
    gray = cv2.cvtColor(rgb, cv2.COLOR_RGB2GRAY)
    smooth = cv2.GaussianBlur(gray, (5, 5), 0.65)
    height, width = gray.shape
    nodes = _thresholds(before, settings)
    columns = np.array([np.interp(np.arange(width), 128 * np.arange(nodes.shape[1]) + 63.5, line) for line in nodes])
    levels = np.array([np.interp(np.arange(height), 128 * np.arange(len(nodes)) + 63.5, one) for one in columns.T]).T
    bright = smooth > levels
    binary = (bright != settings.dark_is_one).astype(np.uint8)
    eroded = cv2.erode(binary * 255, KERNEL)
    median = cv2.medianBlur(eroded, 5)
    dilated = cv2.dilate(median, KERNEL)
    pictures = {"gray": gray, "smooth": smooth, "binary": binary}
    return pictures | {"eroded": eroded // 255, "median": median // 255, "dilated": dilated // 255}


def _thresholds(image: np.ndarray, settings: Settings) -> np.ndarray:
    lines: list[list[float]] = []
    for top in range(0, image.shape[0], 128):
        passed_on = lines[-1][0] if lines else None
        lines.append([])
        for left in range(0, image.shape[1], 128):
            low, high, _, _ = cv2.minMaxLoc(image[top : top + 128, left : left + 128])
            if passed_on is None or high - low >= settings.flat_limit:
                passed_on = low + settings.factor / 256 * (high - low)
            lines[-1].append(passed_on)
    return np.array(lines)


def opencv_objects(dilated: np.ndarray, settings: Settings) -> list[tuple[int, ...]]:
    """Area, box and sums of x and y of each component, sorted."""
    labelled = (dilated != settings.label_zeros).astype(np.uint8)
    count, _, stats, centroids = cv2.connectedComponentsWithStats(labelled, connectivity=8)
    found = []
    for index in range(1, count):
        left, top, width, height, area = (int(value) for value in stats[index])
        if area >= settings.min_area:
            sums = (round(centroids[index][0] * area), round(centroids[index][1] * area))
            found.append((area, left, top, left + width - 1, top + height - 1, *sums))
    return sorted(found)


CLOSE_VIEWS = [Pose(0.08, right, right, yaw) for right, yaw in ((0.0, 90), (0.01, 100), (0.0, 270), (-0.01, 85))]
"""Poses that see only the pad: two arcs of its ring, square, rectangle, small ring; many windows see one colour."""


@pytest.mark.parametrize("pose", CLOSE_VIEWS)
def test_flat_windows_show_no_noise(pose: Pose) -> None:
    """Without the limit the noise of windows within paper or within a shape is taken for shapes; with it, none is."""
    rgb, _ = render(pose)
    both = [list(run_frames([rgb, rgb], Settings(flat_limit=limit, min_area=1)))[-1] for limit in (0, 16)]
    without, with_limit = (len(stages.objects) for stages in both)
    print(f"{pose}: {without} objects without the limit, {with_limit} with it")
    assert without > 50
    assert with_limit == 5


def chain_objects(stages: Stages) -> list[tuple[int, ...]]:
    """The same of the chain's objects."""
    names = ("area", "box_min_x", "box_min_y", "box_max_x", "box_max_y", "sum_x", "sum_y")
    return sorted(tuple(int(item[name]) for name in names) for item in stages.objects)


@pytest.mark.parametrize("settings", [Settings(min_area=20), PAPER, BRIGHTEST])
@pytest.mark.parametrize("size", SIZES)
def test_every_stage_equals_opencv(size: tuple[int, int], settings: Settings) -> None:
    frames = [picture(*size, seed) for seed in (1, 2, 3)]
    results = list(run_frames(frames, settings))
    for before, rgb, stages in zip(results, frames[1:], results[1:], strict=False):
        expected = opencv_stages(rgb, before.smooth, settings)
        for name, image in expected.items():
            assert np.array_equal(getattr(stages, name), image), name
        assert chain_objects(stages) == opencv_objects(expected["dilated"], settings)
        assert stages.objects.dtype == OBJECT_DTYPE
        assert stages.stats_before is before.stats


def test_without_thresholds_all_is_background() -> None:
    for settings in (Settings(), PAPER):
        stages = run_chain(picture(64, 48, 1), None, settings)
        assert (stages.binary == (not settings.dark_is_one)).all()
        assert len(stages.objects) == 0


def test_the_pad_of_the_clip_has_its_shapes() -> None:
    scene = demo_clip(3)[-1]
    assert scene.camera == Camera()
    rgb = scene.image()
    _, stages = run_frames([rgb, rgb])
    centroids = np.column_stack([stages.objects["sum_x"], stages.objects["sum_y"]]) / stages.objects["area"][:, None]
    distances = np.hypot(*(centroids - (scene.truth.x_px, scene.truth.y_px)).T)
    # Ring and small ring share their centre but for the perspective of the larger one; the ground lies further off.
    small_ring, ring = np.argsort(distances)[:2]
    assert distances[small_ring] < 0.3
    assert distances[ring] < 3.0
    assert 15 < stages.objects["area"][ring] / stages.objects["area"][small_ring] < 25

# SPDX-License-Identifier: Apache-2.0
"""landing_core as a whole, stage by stage, against the golden models; and proof that the comparison can fail."""

from functools import partial
from pathlib import Path
from random import Random

import cv2
import numpy as np
import pytest

from golden.chain import PAPER, Settings
from golden.generated.landing_regs import HEADER_DTYPE
from sim.compare_stages import Memory, StageMismatchError, check_run, compare, full_hd, verilated
from sim.cosim.frame_list import FrameList
from sim.cosim.result import read_result
from sim.world.clip import demo_clip, images

CLK_NS = 10

FIRMWARE = Settings()
ALL_OBJECTS = Settings(min_area=0)
BRIGHT = Settings(factor=150, dark_is_one=False, min_area=1)
DARK_ZEROS = Settings(factor=0, flat_limit=245, dark_is_one=True, label_zeros=True, min_area=2)


def textured(seed: int, width: int, height: int) -> np.ndarray:
    """Smooth noise over the whole range with sharp rectangles on it: many shapes of all sizes."""
    rng = np.random.default_rng(seed)
    noise = cv2.GaussianBlur(rng.normal(size=(height, width, 3)), (0, 0), 2.0)
    frame = np.clip(128 + 90 * noise / noise.std(), 0, 255).astype(np.uint8)
    for _ in range(width * height // 2000):
        x, y = int(rng.integers(width)), int(rng.integers(height))
        frame[y : y + rng.integers(3, 30), x : x + rng.integers(3, 30)] = rng.integers(0, 256, 3)
    return frame


@pytest.mark.parametrize(
    ("width", "height", "settings", "memory"),
    [
        pytest.param(64, 48, FIRMWARE, Memory(), id="64x48"),
        pytest.param(16, 16, ALL_OBJECTS, Memory(random=True, seed=2), id="16x16-smallest"),
        pytest.param(131, 129, PAPER, Memory(random=True, seed=3), id="131x129-paper-cut-windows"),
        pytest.param(255, 33, BRIGHT, Memory(random=True, seed=4), id="255x33-bright"),
        pytest.param(300, 140, DARK_ZEROS, Memory(), id="300x140-zeros-flat-windows"),
    ],
)
def test_small_frames(width: int, height: int, settings: Settings, memory: Memory, tmp_path: Path) -> None:
    frames = [textured(seed, width, height) for seed in range(5)]
    print(compare(frames, tmp_path, settings, partial(verilated, memory=memory)))


def test_720p_back_to_back(tmp_path: Path) -> None:
    """Two views of the pad and a texture with more objects than a record holds."""
    frames = [*images(demo_clip(2)), textured(7, 1280, 720)]
    report = compare(frames, tmp_path, Settings(min_area=1))
    print(report)
    assert report.objects > 512
    for frame in read_result(tmp_path, 0).frames[:2]:
        latency_ns = frame.record_ns - frame.last_pixel_ns
        assert 6 * 1280 * CLK_NS < latency_ns < 80_000, (
            f"frame {frame.index}: {latency_ns} ns from last pixel to record"
        )


@pytest.mark.full
def test_1080p_back_to_back(tmp_path: Path) -> None:
    """At 148.5 MHz and 60 frames a second, landing_core at 150 MHz: a view of the pad and textures."""
    view = cv2.resize(next(iter(images(demo_clip(2)))), (1920, 1080), interpolation=cv2.INTER_CUBIC)
    report = full_hd([view, *(textured(seed, 1920, 1080) for seed in range(2))], tmp_path, Settings(min_area=1))
    print(report)
    assert report.pixels == 3 * 1920 * 1080
    assert report.objects > 512
    first, second = (frame.first_pixel_ns for frame in read_result(tmp_path, 0).frames[:2])
    assert abs(second - first - 1e9 / 60) < 100, f"a frame every {second - first} ns"


@pytest.mark.full
def test_720p_at_length(tmp_path: Path) -> None:
    frames = (textured(seed, 1280, 720) for seed in range(20))
    print(compare(frames, tmp_path, PAPER, partial(verilated, memory=Memory(random=True, seed=5))))


@pytest.fixture(scope="module")
def finished_run(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Folder of a run without a difference."""
    folder = tmp_path_factory.mktemp("run")
    compare([textured(seed, 48, 40) for seed in range(3)], folder, ALL_OBJECTS)
    return folder


@pytest.mark.parametrize(
    ("stage", "entry_bytes"),
    [("rgb", 4), ("gray", 2), ("smooth", 2), ("stats", 5), ("binary", 2), ("median", 2), ("dilated", 2)],
)
def test_one_wrong_value_is_found(finished_run: Path, stage: str, entry_bytes: int) -> None:
    path = finished_run / f"{stage}.bin"
    good = path.read_bytes()
    entry = Random(stage).randrange(len(good) // entry_bytes)
    bad = bytearray(good)
    bad[entry * entry_bytes] ^= 1
    path.write_bytes(bad)
    try:
        with pytest.raises(
            StageMismatchError, match=f"stage {stage}, frame {entry // (len(good) // entry_bytes // 3)}"
        ):
            check_run(_frame_list(finished_run), finished_run, ALL_OBJECTS)
    finally:
        path.write_bytes(good)


@pytest.mark.parametrize("change", ["lost beat", "extra beat", "marker"])
def test_a_wrong_stream_is_found(finished_run: Path, change: str) -> None:
    path = finished_run / "eroded.bin"
    good = path.read_bytes()
    bad = {"lost beat": good[:-2], "extra beat": good + b"\1\0", "marker": good[:101] + b"\3" + good[102:]}
    path.write_bytes(bad[change])
    try:
        with pytest.raises(StageMismatchError, match="stage eroded"):
            check_run(_frame_list(finished_run), finished_run, ALL_OBJECTS)
    finally:
        path.write_bytes(good)


@pytest.mark.parametrize("place", [4, 16, 60, 64, 80], ids=["flags", "scan", "number", "area", "sum_x"])
def test_a_wrong_record_is_found(finished_run: Path, place: int) -> None:
    path = finished_run / "records.bin"
    good = path.read_bytes()
    bad = bytearray(good)
    bad[len(good) // 3 + place + 1] ^= 0x40
    path.write_bytes(bad)
    try:
        with pytest.raises(StageMismatchError, match=r"record, frame [12]"):
            check_run(_frame_list(finished_run), finished_run, ALL_OBJECTS)
    finally:
        path.write_bytes(good)


def test_a_reading_younger_than_the_camera_is_found(finished_run: Path) -> None:
    """The LiDAR's first reading comes before the camera's first pixel, the next one long after the first frame."""
    path = finished_run / "records.bin"
    good = path.read_bytes()
    bad = bytearray(good)
    start = HEADER_DTYPE.fields["altitude_age_us"][1]
    bad[start : start + 4] = bytes(4)
    path.write_bytes(bad)
    try:
        with pytest.raises(StageMismatchError, match=r"record, frame 0: altitude_age_us is 0, expected"):
            check_run(_frame_list(finished_run), finished_run, ALL_OBJECTS)
    finally:
        path.write_bytes(good)


def _frame_list(folder: Path) -> FrameList:
    return FrameList(folder / "frames.tdf", 48, 40, 3, 1)

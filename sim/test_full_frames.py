# SPDX-License-Identifier: Apache-2.0
"""The check of whole frames: what it shows, what it leaves, and that it fails where it must.

The environment variable PHOTOS names folders of photos for the whole check, with spaces between them.
"""

import os
from pathlib import Path

import cv2
import numpy as np
import pytest

from golden.chain import Settings
from scripts.errors import UserError
from sim import frames_result, full_frames
from sim.compare_stages import Simulate, StageMismatchError, verilated
from sim.cosim.frame_list import FrameList
from sim.frames_result import CORES, LEAST_IN_ICARUS, LEAST_RENDERED, Mismatch, Tally, keep
from sim.full_frames import BATCH, Shot, batches, check, explain, photo_shots, rendered_shots
from sim.test_stages import textured
from sim.views import FARTHEST_M, NEAREST_M, views
from sim.world.camera import Camera
from sim.world.pose import truth_of


@pytest.mark.full
def test_whole_frames() -> None:
    """20 rendered frames and the photos that are given in Verilator, three of them in Icarus."""
    photos = photo_shots(os.environ.get("PHOTOS", "").split())
    assert check(rendered_shots(LEAST_RENDERED), photos, LEAST_IN_ICARUS) == []


def small(count: int, scale: int = 3, photo: bool = False) -> list[Shot]:
    """Small frames, which stand for whole ones; their shapes exceed the least area of the firmware."""
    frames = [textured(seed, 48, 40).repeat(scale, 0).repeat(scale, 1) for seed in range(count)]
    return [Shot(f"texture {index}", lambda frame=frame: frame, photo) for index, frame in enumerate(frames)]


def with_a_wrong_bit(file: str, share: float) -> Simulate:
    """The verilated model with one bit of one file flipped, at a share of its length."""

    def simulate(frames: FrameList, settings: Settings, out_dir: Path) -> tuple[int, float]:
        outcome = verilated(frames, settings, out_dir)
        data = bytearray((out_dir / file).read_bytes())
        data[int(share * len(data))] ^= 1
        (out_dir / file).write_bytes(data)
        return outcome

    return simulate


@pytest.fixture
def left(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> dict[str, tuple[str, str]]:
    """What `check` leaves, which then goes nowhere else: core -> state, figure."""
    results = {}

    def leave(core: str, check_name: str, passed: bool, figure: str, _: dict[str, object], *, incomplete: bool) -> None:
        assert check_name == "frames"
        results[core] = ("ok" if passed else "incomplete" if incomplete else "failed", figure)

    monkeypatch.setattr(frames_result, "leave", leave)
    monkeypatch.setattr(full_frames, "OUTPUT", tmp_path)
    return results


def test_equal_frames_pass(left: dict[str, tuple[str, str]], capsys: pytest.CaptureFixture[str]) -> None:
    """In Verilator, in two runs; sim/icarus/test_landing_bench.py does it in Icarus."""
    assert check(small(2), small(BATCH, photo=True), 0) == []
    assert f"Verilator: {BATCH + 2} frames equal" in capsys.readouterr().out
    assert set(left) == set(CORES)


@pytest.mark.parametrize(
    ("counts", "needs"),
    [
        ((20, 20, 3), ""),
        ((19, 20, 3), "; needs 20 rendered and 3 in Icarus"),
        ((20, 20, 2), "; needs 20 rendered and 3 in Icarus"),
        ((20, 19, 3), '; needs 20 photos: make test-full PHOTOS="folder ..."'),
        ((0, 0, 3), '; needs 20 photos: make test-full PHOTOS="folder ..."'),
    ],
)
def test_enough_frames_pass(
    counts: tuple[int, int, int], needs: str, left: dict[str, tuple[str, str]], tmp_path: Path
) -> None:
    rendered, photos, in_icarus = counts
    for simulator, tally in (("verilator", Tally(rendered, photos, 1)), ("icarus", Tally(in_icarus, 0, 1))):
        keep(simulator, tally, frames_result.digest_of_sources(), tmp_path)
    assert frames_result.sum_up(tmp_path) == []
    figure = f"{rendered} rendered + {photos} photos, {in_icarus} in Icarus{needs}"
    assert left == dict.fromkeys(CORES, ("incomplete" if needs else "ok", figure))


def test_absent_photos_are_told(left: dict[str, tuple[str, str]], capsys: pytest.CaptureFixture[str]) -> None:
    assert check(small(2), [], 0) == []
    assert "0 are photos: photos were not given" in capsys.readouterr().out
    ((state, figure),) = set(left.values())
    assert state == "incomplete"
    assert figure == '2 rendered + 0 photos, 0 in Icarus; needs 20 photos: make test-full PHOTOS="folder ..."'


@pytest.mark.parametrize(
    ("simulator", "file", "core"),
    [
        ("verilated", "rgb.bin", "video_in"),
        ("verilated", "stats.bin", "threshold_stats"),
        ("verilated", "records.bin", "result_writer"),
        ("icarus", "dilated.bin", "dilate3x3"),
    ],
)
def test_one_wrong_bit_fails(
    simulator: str, file: str, core: str, left: dict[str, tuple[str, str]], monkeypatch: pytest.MonkeyPatch
) -> None:
    """In either simulator; the verilated model stands for Icarus here."""
    monkeypatch.setattr(full_frames, "icarus", verilated)
    monkeypatch.setattr(full_frames, simulator, with_a_wrong_bit(file, 0.4))
    (mismatch,) = check(small(3), [], 3)
    assert mismatch.core == core
    assert "texture" in mismatch.says
    assert set(left) == set(CORES)
    for name, (state, figure) in left.items():
        assert state == "failed"
        assert figure == (mismatch.says if name == core else f"not compared to the end: {core} differs")


def test_frames_without_an_object_fail(left: dict[str, tuple[str, str]]) -> None:
    dots = np.full((40, 48, 3), 200, np.uint8)
    dots[8::16, 8::16] = 0
    shot = Shot("dots, smaller than the least area", lambda: dots)
    (mismatch,) = check([shot, shot], [], 0)
    assert "no frame showed an object" in mismatch.says
    assert {state for state, _ in left.values()} == {"failed"}


def test_a_source_that_changes_meanwhile_fails(
    left: dict[str, tuple[str, str]], monkeypatch: pytest.MonkeyPatch
) -> None:
    states = iter(("before", "after"))
    monkeypatch.setattr(full_frames, "digest_of_sources", lambda: next(states))
    with pytest.raises(UserError, match="changed during the run"):
        check(small(2), [], 0)
    assert not left


def test_simulators_one_after_the_other(left: dict[str, tuple[str, str]], monkeypatch: pytest.MonkeyPatch) -> None:
    """Each keeps what the other gave, Icarus alone finds nothing wrong, and other sources are another story."""

    def figures() -> set[str]:
        return {figure.partition(";")[0] for _, figure in left.values()}

    monkeypatch.setattr(full_frames, "icarus", verilated)
    assert check(small(2), [], 2, only="icarus") == []
    assert figures() == {"0 rendered + 0 photos, 2 in Icarus"}
    assert check(small(4), [], 2, only="verilator") == []
    assert figures() == {"4 rendered + 0 photos, 2 in Icarus"}
    for module in (full_frames, frames_result):
        monkeypatch.setattr(module, "digest_of_sources", lambda: "changed")
    assert check(small(3), [], 2, only="verilator") == []
    assert figures() == {"3 rendered + 0 photos, 0 in Icarus"}


@pytest.mark.parametrize(("rendered", "in_icarus"), [(0, 0), (2, 3), (2, -1)])
def test_frames_that_are_not_there(rendered: int, in_icarus: int) -> None:
    with pytest.raises(UserError, match="cannot be shown"):
        check(small(rendered), [], in_icarus)


def test_every_frame_counts_once_and_follows_another() -> None:
    shots = small(2 * BATCH + 1)
    runs = list(batches(shots))
    assert [shot for shown, _ in runs for shot in shown[1:]] == shots
    assert [counted for _, counted in runs] == [shots[:BATCH], shots[BATCH:-1], shots[-1:]]
    assert [shown[0] for shown, _ in runs] == [shots[-1], shots[BATCH - 1], shots[2 * BATCH - 1]]


@pytest.mark.parametrize(
    ("message", "core"),
    [
        ("stage checked, frame 1: first of 2", "threshold_stats"),
        ("record, frame 1: none was written", "result_writer"),
        ("in Icarus, stage objects: unknown bits", "ccl"),
        ("in Icarus, landing_core does not answer", "landing_core"),
    ],
)
def test_a_difference_names_its_core(message: str, core: str) -> None:
    mismatch = explain(StageMismatchError(message), small(2))
    told = " (frame 1 is texture 1)" if "frame 1" in message else ""
    assert mismatch == Mismatch(core, message + told)


def test_photos(tmp_path: Path) -> None:
    cv2.imwrite(str(tmp_path / "a.png"), np.full((720, 1280, 3), (1, 2, 3), np.uint8))
    (shot,) = photo_shots([str(tmp_path)])
    assert tuple(shot.image()[0, 0]) == (3, 2, 1)
    with pytest.raises(UserError, match="is not a folder"):
        photo_shots([str(tmp_path / "a.png")])


def test_views_are_of_all_kinds() -> None:
    some = views(20)
    assert some == views(20)
    assert some != views(20, seed=2)
    heights = sorted(view.pose.altitude_m for view in some)
    assert (heights[0], heights[-1]) == (NEAREST_M, FARTHEST_M)
    assert len({view.seed for view in some}) == 20
    assert max(abs(view.pose.roll_deg) for view in some) > 10
    assert max(abs(view.pose.pad_yaw_deg) for view in some) > 150
    assert sum(truth_of(Camera(), view.pose).visible for view in some) >= 15

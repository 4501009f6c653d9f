# SPDX-License-Identifier: Apache-2.0
"""Tests of the test equipment: it must see what is wrong and say where."""

from pathlib import Path

import numpy as np
import pytest

from scripts.errors import UserError
from tb.common.compare import check_frame
from tb.common.contract import SizeLimits, sent_frames
from tb.common.cores import ROOT, Core, load_core
from tb.common.runner import SIMULATORS, run_config, run_core
from tb.common.stream import Beat, Taken, frame_beats, split_frames

LIMITS = SizeLimits(2, 1, 8, 8)


def taken(frame: np.ndarray) -> list[Taken]:
    """Return the frame as a core would have sent it."""
    return [Taken(beat.data, beat.user, beat.last, cycle) for cycle, beat in enumerate(frame_beats(frame))]


def test_compare_names_the_first_bad_pixel() -> None:
    frame = np.arange(12).reshape(3, 4)
    beats = taken(frame)
    check_frame(beats, frame, "frame")
    wrong = frame.copy()
    wrong[1, 2], wrong[2, 0] = 99, 98
    with pytest.raises(AssertionError, match="x 2, y 1: expected 99, got 6; 2 of 12 pixels differ, 1 of them"):
        check_frame(beats, wrong, "frame", border=1)


@pytest.mark.parametrize("field", ["user", "last"])
def test_compare_sees_a_wrong_marker(field: str) -> None:
    frame = np.zeros((3, 4), np.int64)
    beats = taken(frame)
    beats[6] = Taken(0, int(field == "user"), int(field == "last"), 6)
    with pytest.raises(AssertionError, match="at x 2, y 1"):
        check_frame(beats, frame, "frame")


@pytest.mark.parametrize("change", [-1, 1])
def test_compare_sees_missing_and_surplus_pixels(change: int) -> None:
    frame = np.zeros((3, 4), np.int64)
    beats = taken(np.zeros((3 + change, 4), np.int64))
    with pytest.raises(AssertionError, match=r"pixels came, expected 12|tlast"):
        check_frame(beats, frame, "frame")


def test_split_refuses_beats_before_a_start() -> None:
    with pytest.raises(AssertionError, match="before any start"):
        split_frames([Taken(0, 0, 0, 0)])


@pytest.mark.parametrize(
    ("name", "edit", "complete", "errors"),
    [
        ("good", lambda beats: beats, [True], 0),
        ("cut", lambda beats: beats[:5] + beats, [False, True], 1),
        ("short line", lambda beats: [*beats[:2], beats[2]._replace(last=1), *beats[3:]], [False], 1),
        ("long line", lambda beats: [*beats[:3], beats[3]._replace(last=0), *beats[4:]], [False], 1),
        ("surplus", lambda beats: [*beats, Beat(0), Beat(0)], [True], 1),
        ("before", lambda beats: [Beat(0), Beat(0, 0, 1), *beats], [True], 0),
        ("too wide", lambda beats: [beats[0]._replace(size=(9, 3)), *beats[1:]], [], 1),
        ("fault in the first beat", lambda beats: [beats[0]._replace(last=1), *beats[1:]], [], 1),
        ("early start that is faulty itself", lambda beats: [*beats[:5], beats[0]._replace(last=1)], [False], 1),
    ],
)
def test_contract(name: str, edit: object, complete: list[bool], errors: int) -> None:
    frames, count = sent_frames(edit(frame_beats(np.arange(12).reshape(3, 4))), LIMITS)
    assert ([frame.complete for frame in frames], count) == (complete, errors), name


def test_protocol_checker_fails_every_broken_stream() -> None:
    source = ROOT / "tb/faulty_stream/faulty_stream.v"
    result = run_config(Core("faulty_stream", (source,), "faulty_stream", ({},)), "icarus", 0, seed=1)
    assert result.passed, result.summary
    assert result.summary == "7 tests passed"


@pytest.mark.parametrize("sim", SIMULATORS)
def test_waves_are_left(sim: str, tmp_path: Path) -> None:
    result = run_config(load_core("rgb2gray"), sim, 0, seed=1, waves=True, testcase="latency", output=tmp_path)
    assert result.passed, result.summary
    waves = list(result.log.parent.glob("*.fst"))
    assert waves
    assert all(wave.stat().st_size > 0 for wave in waves)


def test_unknown_names_are_told_in_one_sentence() -> None:
    with pytest.raises(UserError, match=r"unknown core .nonsense.; choose one of: .*rgb2gray"):
        run_core("nonsense", "icarus")
    with pytest.raises(UserError, match="unknown simulator 'nonsense'; choose one of: icarus, verilator"):
        run_core("rgb2gray", "nonsense")
    with pytest.raises(UserError, match="has no config 9"):
        run_core("rgb2gray", "icarus", 9)


def test_missing_simulator_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("shutil.which", lambda tool: None)
    with pytest.raises(UserError, match="icarus needs 'iverilog', which is not on the PATH"):
        run_core("rgb2gray", "icarus")

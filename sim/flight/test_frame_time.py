# SPDX-License-Identifier: Apache-2.0
"""How many instructions a frame and an interrupt take on the board, at worst, counted on QEMU."""

import random
from pathlib import Path

import cv2
import numpy as np
import pytest

from firmware.library import AUTOPILOT, GROUND
from golden.ccl import ccl
from golden.generated.landing_regs import OBJECT_DTYPE, RECORD_MAX_OBJECTS
from scripts.errors import UserError
from sim.flight import frame_time
from sim.flight.board import SIZE, ZynqBoard
from sim.flight.frame_time import SPANS, main
from sim.flight.sight import objects_of
from sim.world.camera import Camera
from sim.world.pose import Pose
from sim.world.renderer import render

FRAME_LIMIT = 300_000
"""From the copy of a record to a LANDING_TARGET that waits to be sent, be the pad where it was or anywhere."""
VAIN_LIMIT = 2_500_000
"""A frame without a pad and full of what looks like one, to the end of it all: 5 ms, a third of a frame."""
INTERRUPT_LIMIT = 1_000
INTERRUPT = {"interrupt": ("interrupt_entry", "interrupt_return")}
_FRAME_US = 70_000


def clutter(count: int, seed: int, around: np.ndarray) -> np.ndarray:
    """Objects of a picture full of shapes as grass and gravel have them, none within the circle x, y, radius."""
    chance = random.Random(seed)
    picture = np.zeros((SIZE[1], SIZE[0]), np.uint8)
    x, y, radius = around
    while True:
        for _ in range(200):
            centre = (chance.randrange(SIZE[0]), chance.randrange(SIZE[1]))
            axes = (chance.randrange(6, 22), chance.randrange(6, 22))
            if np.hypot(centre[0] - x, centre[1] - y) > radius + 25:
                cv2.ellipse(picture, centre, axes, chance.randrange(180), 0, 360, 1, -1)
                cv2.rectangle(picture, centre, (centre[0] + axes[0], centre[1] + axes[1]), 0, 2)
        objects = ccl(picture, 160)
        if len(objects) >= count:
            return objects[:count]
        cv2.rectangle(picture, (0, 0), SIZE, 0, 8)


def frame(board: ZynqBoard, now_us: int, objects: np.ndarray) -> int:
    """Show one frame with talk on both wires; returns the time after it."""
    board.show(objects)
    chance = random.Random(now_us)
    end_us = now_us + _FRAME_US
    while now_us < end_us:
        now_us += 5_000
        for link in (AUTOPILOT, GROUND):
            board.say(link, chance.randbytes(20))
        board.run_to(now_us, 1000)
    return now_us


@pytest.fixture(scope="module")
def scene() -> np.ndarray:
    """The pad from 1 m among as many other shapes as a record holds, with some that look like its square."""
    camera = Camera()
    pad = objects_of(camera, Pose(altitude_m=1.0, right_m=0.05, forward_m=-0.05, pad_yaw_deg=30.0), 160)
    ring = pad[np.argmax(pad["area"])]
    around = np.array([ring["sum_x"] / ring["area"], ring["sum_y"] / ring["area"], 180.0])
    objects = np.concatenate([clutter(RECORD_MAX_OBJECTS - len(pad), 5, around), pad])
    assert objects.dtype == OBJECT_DTYPE
    assert len(objects) == RECORD_MAX_OBJECTS
    return objects


def test_instructions_of_a_frame_and_an_interrupt(scene: np.ndarray) -> None:
    board = ZynqBoard(SPANS | INTERRUPT)
    try:
        now_us = 100_000
        board.run_to(now_us, 1000)
        for _ in range(6):
            now_us = frame(board, now_us, scene)
        frames = board.passes("target")
        interrupts = board.passes("interrupt")
    finally:
        board.close()
    print(f"frames: {frames}; interrupts: at most {max(interrupts)} of {len(interrupts)}")
    assert len(frames) == 6
    assert max(frames) <= FRAME_LIMIT
    assert len(interrupts) > 100
    assert max(interrupts) <= INTERRUPT_LIMIT


def decoys(camera: Camera) -> np.ndarray:
    """Squares and rectangles as a pad has them, each in a ring that is too large; clutter fills the record."""
    chance = random.Random(3)
    parts = []
    for right_m in (-0.9, -0.54, -0.18, 0.18, 0.54, 0.9):
        for forward_m in (-0.36, 0.0, 0.36):
            pad = Pose(altitude_m=2.0, right_m=right_m, forward_m=forward_m, pad_yaw_deg=chance.uniform(0.0, 360.0))
            near = Pose(altitude_m=2.0 / 1.18, right_m=right_m / 1.18 + 0.01, forward_m=forward_m / 1.18)
            inner, outer = (np.sort(objects_of(camera, pose, 30), order="area") for pose in (pad, near))
            if len(inner) == len(outer) == 4:
                parts += [inner[1:3], outer[[0, 3]]]
    objects = np.concatenate(parts)
    return np.concatenate([objects, clutter(RECORD_MAX_OBJECTS - len(objects), 5, np.zeros(3))])


def test_instructions_of_a_search_in_vain() -> None:
    objects = decoys(Camera())
    board = ZynqBoard(SPANS)
    try:
        now_us = 100_000
        board.run_to(now_us, 2000)
        for _ in range(14):
            now_us = frame(board, now_us, objects)
        found, frames = board.passes("target"), board.passes("record")
    finally:
        board.close()
    print(f"frames: {frames}")
    assert not found
    assert len(frames) == 14
    assert min(frames) > FRAME_LIMIT
    assert max(frames) <= VAIN_LIMIT


def test_photographs(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    image, _ = render(Pose(altitude_m=1.0))
    cv2.imwrite(str(tmp_path / "pad.png"), image[..., ::-1])
    assert main([str(tmp_path), "--altitude", "1.0"]) == 0
    row, searched, tracked = capsys.readouterr().out.splitlines()[1:]
    counts = [int(word) for word in row.split()[1:]]
    assert counts[0] >= 4
    assert FRAME_LIMIT > counts[1] > counts[2] > 30_000
    assert f"at most {counts[1]} of 1 photographs" in searched
    assert f"at most {counts[2]} of 1 photographs" in tracked


def test_photographs_without_a_pad(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    """And the library that looks at them is built first."""
    built: list[str] = []
    monkeypatch.setattr(frame_time, "build", built.append)
    cv2.imwrite(str(tmp_path / "none.png"), np.full((SIZE[1], SIZE[0], 3), 128, np.uint8))
    assert main([str(tmp_path), "--altitude", "1.0"]) == 0
    assert built == ["golden"]
    row, total = capsys.readouterr().out.splitlines()[1:]
    assert "no pad in" in row
    assert total.startswith("without a pad: ")
    with pytest.raises(UserError, match="is not a folder"):
        main([str(tmp_path / "absent")])
    with pytest.raises(UserError, match="give FRAMES=folder"):
        main([""])

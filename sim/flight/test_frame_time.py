# SPDX-License-Identifier: Apache-2.0
"""How many instructions a frame and an interrupt take on the board, at worst, counted on QEMU."""

import random
from collections.abc import Callable
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
"""From the copy of a record to a LANDING_TARGET that waits to be sent, or to the end of it all where there is none."""
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


def decoys() -> np.ndarray:
    """Squares and rectangles as a pad has them, each in a ring that is too large; clutter fills the record."""
    chance = random.Random(3)
    camera = Camera()
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


def over(altitude_m: float, aside_m: float, others: np.ndarray | None = None) -> np.ndarray:
    """The pad, and as many of the others as a record has room for, wherever they lie."""
    pose = Pose(altitude_m=altitude_m, right_m=aside_m, forward_m=-0.8 * aside_m, pad_yaw_deg=30.0)
    pad = objects_of(Camera(), pose, 60)
    return pad if others is None else np.concatenate([others[: RECORD_MAX_OBJECTS - len(pad)], pad])


def pattern(step: tuple[int, int], shapes: list[tuple[int, int]]) -> np.ndarray:
    """A floor of boxes around the middle of the picture, one size after the other."""
    picture = np.zeros((SIZE[1], SIZE[0]), np.uint8)
    cells = [(x, y) for y in range(20, SIZE[1] - 20, step[1]) for x in range(20, SIZE[0] - 70, step[0])]
    cells.sort(key=lambda cell: (cell[0] - SIZE[0] / 2) ** 2 + (cell[1] - SIZE[1] / 2) ** 2)
    for number, (x, y) in enumerate(cells[:RECORD_MAX_OBJECTS]):
        width, height = shapes[number % len(shapes)]
        cv2.rectangle(picture, (x, y), (x + width - 1, y + height - 1), 1, -1)
    return ccl(picture, 30)


def rings(radius: int, width: int) -> np.ndarray:
    """As many circles as fit."""
    picture = np.zeros((SIZE[1], SIZE[0]), np.uint8)
    step = 2 * radius + width + 4
    for y in range(step // 2, SIZE[1] - step // 2, step):
        for x in range(step // 2, SIZE[0] - step // 2, step):
            cv2.circle(picture, (x, y), radius, 1, width)
    return ccl(picture, 30)[:RECORD_MAX_OBJECTS]


def floor_of_stripes(altitude_m: float, step: tuple[int, int], size: tuple[int, int]) -> np.ndarray:
    """Stripes that all lie inside the ring: each may be a piece of it."""
    return over(altitude_m, 0.0, pattern(step, [size]))


SCENES: dict[str, Callable[[], np.ndarray]] = {
    "decoys": decoys,
    "the pad among clutter that touches it, 1 m": lambda: over(1.0, 0.05, clutter(RECORD_MAX_OBJECTS, 5, np.zeros(3))),
    "the same, at the border, 0.5 m": lambda: over(0.5, 0.2, clutter(RECORD_MAX_OBJECTS, 5, np.zeros(3))),
    "the same, 0.3 m": lambda: over(0.3, 0.0, clutter(RECORD_MAX_OBJECTS, 5, np.zeros(3))),
    "cut by the border, 0.3 m": lambda: over(0.3, 0.1),
    "cut by the border, 0.2 m": lambda: over(0.2, 0.05),
    "cut by the border, 0.1 m": lambda: over(0.1, 0.02),
    "squares and rectangles": lambda: pattern((18, 16), [(15, 8), (9, 9)]),
    "squares and rectangles far apart": lambda: pattern((66, 50), [(25, 13), (13, 13)]),
    "rings": lambda: rings(20, 5),
    "small rings": lambda: rings(18, 12),
    "stripes, 0.3 m": lambda: floor_of_stripes(0.3, (48, 14), (43, 6)),
    "stripes, 0.6 m": lambda: floor_of_stripes(0.6, (30, 9), (27, 4)),
}


@pytest.mark.parametrize("name", SCENES)
def test_no_frame_takes_longer(name: str) -> None:
    """Whatever there is to be looked at: what has no time goes on in the next frame."""
    objects = SCENES[name]()
    board = ZynqBoard(SPANS)
    counts: list[int] = []
    found = 0
    try:
        now_us = 100_000
        board.run_to(now_us, 1000)
        for _ in range(12):
            now_us = frame(board, now_us, objects)
            targets = board.passes("target")
            # With a pad, all that follows is to wait until it is due.
            counts.append(targets[-1] if len(targets) > found else board.passes("record")[-1])
            found = len(targets)
    finally:
        board.close()
    print(f"{len(objects)} objects, in {found} of {len(counts)} frames a pad: {counts}")
    assert max(counts) <= FRAME_LIMIT


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

# SPDX-License-Identifier: Apache-2.0
"""The ELF on QEMU and the firmware's core in this process say the same of what they see."""

from pathlib import Path

import pytest

from firmware.library import AUTOPILOT, GROUND, make
from scripts.demo_decode import PAD_FIELDS
from scripts.errors import UserError
from sim.flight.autopilot import ARDUPILOT, Autopilot
from sim.flight.board import Board, HostBoard, ZynqBoard
from sim.flight.scenario import Flight
from sim.flight.vehicle import Vehicle


def targets(board: Board) -> list[tuple[float, ...]]:
    """What LANDING_TARGET says of a pad below a vehicle that stands still in the air; each value once."""
    flight = Flight(Autopilot(ARDUPILOT, Vehicle(north_m=-0.2, east_m=0.15, height_m=1.2, heading_rad=0.7)), board)
    flight.run(2.0)
    messages = [sent.message for sent in flight.sent[AUTOPILOT] if sent.message.get_type() == "LANDING_TARGET"]
    assert len(messages) > 30
    return sorted({(m.angle_x, m.angle_y, m.x, m.y, m.z, m.distance, m.size_x) for m in messages[5:]})


def test_the_elf_says_of_a_frame_what_the_core_says_here() -> None:
    make("host")
    with_core = targets(HostBoard())
    board = ZynqBoard()
    try:
        with_elf = targets(board)
    finally:
        board.close()
    assert len(with_core) == len(with_elf) == 1
    # exp and log of two libraries differ in their last bit.
    assert with_elf[0] == pytest.approx(with_core[0], rel=1e-6)


def pads(flight: Flight, field: str) -> set[float]:
    """Values of a field of the ground's PAD array in the last second."""
    arrays = [s for s in flight.sent[GROUND] if s.message.get_type() == "DEBUG_FLOAT_ARRAY" and s.message.name == "PAD"]
    return {s.message.data[PAD_FIELDS.index(field)] for s in arrays if s.time_s > flight.time_s - 1.0}


def test_shapes_come_through_the_stand_ins_and_none_when_there_is_none() -> None:
    board = ZynqBoard()
    try:
        flight = Flight(Autopilot(ARDUPILOT, Vehicle(height_m=1.0)), board)
        flight.run(2.0)
        shown = pads(flight, "object_count")
        numbers = pads(flight, "frame_number")
        flight.pad_hidden = True
        flight.run(4.0)
        hidden = pads(flight, "object_count")
        flight.camera_broken = True
        flight.run(4.5)
        last = max(pads(flight, "frame_number"))
        flight.camera_broken = False
        flight.run(5.0)
    finally:
        board.close()
    # Ring, square, rectangle, small ring.
    assert shown == {4.0}
    assert hidden == {0.0}
    assert len(numbers) > 20
    # Malformed frames have numbers and no records.
    assert 10 < min(number for number in pads(flight, "frame_number") if number > last) - last < 20


def test_a_qemu_that_ends_is_one_sentence() -> None:
    board = ZynqBoard()
    try:
        board.run_to(5_000, 1000)
        with pytest.raises(UserError, match="QEMU ended: the world goes back in time"):
            board.run_to(4_000, 1000)
            board.run_to(9_000, 1000)
    finally:
        board.close()


def test_a_qemu_that_does_not_come_up_is_one_sentence(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    def command(*_: object, **__: object) -> list[str]:
        return ["sh", "-c", "echo 'touchdown: no such luck.' >&2; exit 1"]

    monkeypatch.setattr("sim.flight.board.qemu_command", command)
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    with pytest.raises(UserError, match="QEMU ended: no such luck"):
        ZynqBoard()
    assert list(tmp_path.iterdir()) == []

# SPDX-License-Identifier: Apache-2.0
"""What outlasts a restart, on QEMU's Zynq: the record of a crash, and parameters that the ground has set."""

from collections.abc import Iterator
from pathlib import Path

import pytest
from pymavlink.dialects.v20 import common as mavlink

from firmware.qemu_board import Board, running


@pytest.fixture
def board(tmp_path: Path) -> Iterator[Board]:
    with running(tmp_path) as one:
        yield one


def test_a_crash_is_told_at_once_and_at_the_next_start_alone(board: Board) -> None:
    board.wait_for("HEARTBEAT", "")
    board.jump(0x0000_0040)
    board.wait_for("STATUSTEXT", "Touchdown: prefetch abort at 00000040")
    board.restart()
    message = board.wait_for("STATUSTEXT", "restarted: prefetch abort at 00000040")
    assert message.severity == mavlink.MAV_SEVERITY_CRITICAL
    board.restart()
    board.wait_for("STATUSTEXT", "Touchdown: started")
    board.wait_for("HEARTBEAT", "")
    board.wait_for("HEARTBEAT", "")
    assert not [message for message in board.said if "restarted" in str(message)]


def test_parameters_outlast_a_restart_and_not_power(board: Board, tmp_path: Path) -> None:
    name = b"TD_SPEED"
    read = mavlink.MAVLink_param_request_read_message(1, 191, name, -1)
    board.wait_for("HEARTBEAT", "")
    board.send(mavlink.MAVLink_param_set_message(1, 191, name, 0.25, mavlink.MAV_PARAM_TYPE_REAL32))
    assert board.wait_for("PARAM_VALUE", "TD_SPEED").param_value == 0.25
    board.restart()
    board.wait_for("STATUSTEXT", "Touchdown: started")
    board.send(read)
    assert board.wait_for("PARAM_VALUE", "TD_SPEED").param_value == 0.25
    other = tmp_path / "power"
    other.mkdir()
    with running(other) as fresh:
        fresh.wait_for("HEARTBEAT", "")
        fresh.send(read)
        assert fresh.wait_for("PARAM_VALUE", "TD_SPEED").param_value == 0.5

# SPDX-License-Identifier: Apache-2.0
"""Runs tb/top/board_smoke.py: the whole of the board but the vendor's cells, in Verilator."""

from scripts.board import load_board
from tb.common.cores import Core
from tb.common.runner import check_simulator, default_seed, run_config

SMALL = {
    "MAX_WIDTH": 64,
    "MAX_HEIGHT": 40,
    "CAMERA_FIFO": 64,
    "DELAY": 1100,
    "MONITOR_FIFO": 2048,
    "WIDTH": 64,
    "H_FRONT": 4,
    "H_SYNC": 4,
    "H_TOTAL": 90,
    "HEIGHT": 40,
    "V_FRONT": 2,
    "V_SYNC": 2,
    "V_TOTAL": 60,
    "CLK_PER_US": 10,
    "QUIET_US": 5,
    "HOLD_US": 20,
}


class Board(Core):
    """The board as the runner wants it; it is no core, since rtl/top has no core.toml."""

    @property
    def test_module(self) -> str:
        """Dotted name of the cocotb test module."""
        return "tb.top.board_smoke"


def test_the_board_joined() -> None:
    check_simulator("verilator")
    sources = tuple(path for path in load_board().sources if path.stem != "arty_z7_top")
    result = run_config(Board("board_video", sources, "board_video", (SMALL,)), "verilator", 0, seed=default_seed())
    assert result.passed, f"{result.summary}\nlog: {result.log}"

# SPDX-License-Identifier: Apache-2.0
"""Runs tb/top/video_tests.py: the board without its vendor's cells, small in both simulators, and at 720p."""

import pytest

from scripts.board import load_board
from tb.common.cores import Core
from tb.common.runner import SIMULATORS, check_simulator, default_seed, run_config

SMALL = {
    "MAX_WIDTH": 48, "MAX_HEIGHT": 40, "CAMERA_FIFO": 64, "DELAY": 900, "MONITOR_FIFO": 1024,
    "WIDTH": 48, "H_FRONT": 4, "H_SYNC": 3, "H_TOTAL": 62, "HEIGHT": 40, "V_FRONT": 5, "V_SYNC": 3, "V_TOTAL": 60,
    "CLK_PER_US": 10, "QUIET_US": 3, "HOLD_US": 12,
}  # fmt: skip
CONFIGS = (SMALL, {"CLK_PER_US": 100, "QUIET_US": 3, "HOLD_US": 12})


class BoardBench(Core):
    """The board as the runner wants it; it is no core, since rtl/top has no core.toml."""

    @property
    def test_module(self) -> str:
        """Dotted name of the cocotb test module."""
        return "tb.top.video_tests"


def run(sim: str, config: int) -> None:
    """Build and run one config."""
    check_simulator(sim)
    sources = tuple(path for path in load_board().sources if path.stem != "arty_z7_top")
    bench = BoardBench("board_video", sources, "board_video", CONFIGS)
    result = run_config(bench, sim, config, seed=default_seed())
    assert result.passed, f"{result.summary}\nlog: {result.log}"


@pytest.mark.parametrize(
    "sim", [pytest.param(sim, marks=pytest.mark.full if sim == "icarus" else ()) for sim in SIMULATORS]
)
def test_small_frames(sim: str) -> None:
    run(sim, 0)


@pytest.mark.full
def test_720p() -> None:
    run("verilator", 1)

# SPDX-License-Identifier: Apache-2.0
"""Runs tb/top/test_top.py in both simulators; elaboration refuses times that make no sense."""

import subprocess
from pathlib import Path

import pytest

from scripts.lint_run import need
from tb.common.cores import ROOT, Core
from tb.common.runner import SIMULATORS, check_simulator, default_seed, run_config

SHARED = tuple(ROOT / f"rtl/video_in/{name}.v" for name in ("sync_bits", "reset_sync"))
FILES = (*SHARED, *(ROOT / f"rtl/top/source_{name}.v" for name in ("switch", "mux")))
CONFIGS = ({"CLK_PER_US": 10, "QUIET_US": 3, "HOLD_US": 12},)


class SwitchBench(Core):
    """The bench as the runner wants it; it is no core, since rtl/top has no core.toml."""

    @property
    def test_module(self) -> str:
        """Dotted name of the cocotb test module."""
        return "tb.top.test_top"


@pytest.mark.parametrize("sim", SIMULATORS)
def test_source_switch(sim: str) -> None:
    check_simulator(sim)
    bench = SwitchBench("source_switch", (*FILES, ROOT / "tb/top/switch_bench.v"), "switch_bench", CONFIGS)
    result = run_config(bench, sim, 0, seed=default_seed())
    assert result.passed, f"{result.summary}\nlog: {result.log}"


@pytest.mark.parametrize(
    ("times", "good"),
    [
        ("1,1,1", True),
        ("1,1,1000000", True),
        ("0,1,1", False),
        ("1,0,1", False),
        ("1,2,1", False),
        ("1,1,1000001", False),
    ],
)
def test_limits_of_the_times(times: str, good: bool, tmp_path: Path) -> None:
    names = ("CLK_PER_US", "QUIET_US", "HOLD_US")
    sets = [f"-Psource_switch.{name}={value}" for name, value in zip(names, times.split(","), strict=True)]
    command = [need("iverilog"), "-g2005", *sets, "-s", "source_switch", "-o", str(tmp_path / "out"), *map(str, FILES)]
    run = subprocess.run(command, capture_output=True, text=True, check=False)
    assert (run.returncode == 0) == good, run.stderr
    assert good or "ERROR_quiet_us_must_be" in run.stderr

# SPDX-License-Identifier: Apache-2.0
"""`make lint` is clean, and its yosys check finds what it is for."""

import subprocess
import sys
from pathlib import Path

import pytest

from scripts import lint, lint_firmware

FAULTS = {
    "latch": "always @* if (en) q = a;",
    "loop": "wire n; assign n = ~(n & a); always @* q = n & en;",
    "two_drivers": "wire n; assign n = a; assign n = en; always @* q = n;",
}


def test_lint_is_clean() -> None:
    run = subprocess.run(
        [sys.executable, "-m", "scripts.lint"], cwd=lint.ROOT, capture_output=True, text=True, check=False
    )
    assert run.returncode == 0, run.stdout + run.stderr
    for core in lint.cores():
        assert f"ok   yosys {core}\n" in run.stdout
    for tool in (*lint_firmware.TOOLS.values(), "c rules", "ruff check", "tclint"):
        assert f"ok   {tool}\n" in run.stdout


def test_tclint_refuses(tmp_path: Path) -> None:
    source = tmp_path / "spoilt.tcl"
    source.write_text("expr $argc+1\n")
    command = [lint.need("tclint"), "-c", lint.TCL_RULES, source]
    run = subprocess.run(command, cwd=lint.ROOT, capture_output=True, text=True, check=False)
    assert run.returncode != 0
    assert "spoilt.tcl" in run.stdout


@pytest.mark.parametrize("fault", FAULTS)
def test_yosys_refuses(tmp_path: Path, fault: str) -> None:
    source = tmp_path / "dut.v"
    source.write_text(f"module dut(input wire a, input wire en, output reg q);\n{FAULTS[fault]}\nendmodule\n")
    command = [sys.executable, "-c", lint.YOSYS, lint.yosys_script("dut", [str(source)])]
    run = subprocess.run(command, cwd=lint.ROOT, capture_output=True, text=True, check=False)
    assert run.returncode != 0


def test_yosys_accepts_a_register(tmp_path: Path) -> None:
    source = tmp_path / "dut.v"
    source.write_text(
        "module dut(input wire a, input wire en, output reg q);\nalways @(posedge en) q <= a;\nendmodule\n"
    )
    command = [sys.executable, "-c", lint.YOSYS, lint.yosys_script("dut", [str(source)])]
    subprocess.run(command, cwd=lint.ROOT, capture_output=True, check=True)

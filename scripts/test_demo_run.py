# SPDX-License-Identifier: Apache-2.0
"""The demo as a user starts it: rendered frames through the verilated cores and the firmware."""

import re
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parent.parent
FRAMES = 2


def run(*arguments: str) -> subprocess.CompletedProcess[str]:
    command = [sys.executable, "-m", "scripts.demo", *arguments]
    return subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)


@pytest.mark.parametrize("firmware", ["host", "qemu"])
def test_rendered_descent_is_found_where_it_is(firmware: str, tmp_path: Path) -> None:
    done = run("--firmware", firmware, "--limit", str(FRAMES), "--out", str(tmp_path))
    assert done.returncode == 0, done.stderr
    lines = [line for line in done.stdout.splitlines() if re.match(r"\d{4} ", line)]
    assert len(lines) == FRAMES
    for line in lines:
        error_px, error_deg, error_m = (float(value) for value in line.split()[-5::2])
        assert error_px < 0.5, line
        assert error_deg < 1.0, line
        assert error_m < 0.02, line
        latency_us = float(line.split()[-6])
        # LANDING_TARGET takes 0.78 ms on the wire at 921600 baud.
        assert 700 < latency_us < 5_000, line
        assert "LANDING_TARGET #" in line
    assert f"Pad found in {FRAMES} of {FRAMES} frames; {FRAMES + 1} frames shown" in done.stdout
    assert (tmp_path / "report.html").stat().st_size > 100_000
    assert sorted(path.name for path in tmp_path.glob("*.png")) == ["0000.png", "0001.png"]


@pytest.mark.parametrize(
    "arguments", [["--frames", "nowhere"], ["--altitude", "-3"], ["--limit", "0"], ["--altitude", "nowhere.csv"]]
)
def test_a_mistake_is_one_sentence_and_a_failure(arguments: list[str], tmp_path: Path) -> None:
    done = run(*arguments, "--firmware", "host", "--out", str(tmp_path))
    assert done.returncode == 1
    assert done.stderr.startswith("touchdown: ")
    assert done.stderr.count("\n") == 1
    assert done.stderr.endswith(".\n")

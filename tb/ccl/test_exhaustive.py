# SPDX-License-Identifier: Apache-2.0
"""Builds the C++ bench of tb/ccl/exhaustive around a verilated ccl: every small image, then hard large ones.

The bench also checks what docs/cores/ccl.md promises of stalls and latency; see its main.cpp for the command line.
"""

import os
import re
import subprocess
from pathlib import Path

import pytest

from scripts.signoff import combine, leave_part
from tb.ccl import tb_ccl
from tb.common.cores import ROOT, Core, load_core
from tb.common.lock import locked
from tb.common.runner import OUTPUT, check_simulator

GAPS = [(0, 0), (30, 0), (0, 60), (25, 40)]
"""Idle input and stalled output cycles, per cent each: none, then random ones."""
BACK_TO_BACK_AND_GAPS = [GAPS[0], GAPS[-1]]
NARROW = [(1, 12), (12, 1), (2, 8), (8, 2), (3, 5), (5, 3)]
WHOLE = [(1280, 720), (1279, 719)]
EXHAUSTIVE = [
    *(f"--idle {idle} --stall {stall} all 4 4" for idle, stall in GAPS),
    *(f"all {width} {height}" for width, height in NARROW),
    *(f"--idle {idle} --stall {stall} all 5 5" for idle, stall in BACK_TO_BACK_AND_GAPS),
]
"""Runs of every image of a size: what sign-off wants to see."""


def build(width: int, height: int, core: Core | None = None, output: Path = OUTPUT) -> Path:
    """Return the bench for these MAX_WIDTH and MAX_HEIGHT; `core` is ccl, with other sources if wanted."""
    check_simulator("verilator")
    core = core or load_core("ccl")
    names = ("REPORT_CLOCKS", "REPORT_AT_EDGE_CLOCKS", "LAST_LINE_CLOCKS", "NEXT_CLOCKS")
    clocks = {name: getattr(tb_ccl, name) for name in names}
    # make does not see a change of flags: each build has its folder.
    folder = output / "ccl/exhaustive" / "-".join(map(str, [f"{width}x{height}", *clocks.values()]))
    command = ["verilator", "--cc", "--exe", "--build", "-O3", "--top-module", core.toplevel]
    command += [f"-GMAX_WIDTH={width}", f"-GMAX_HEIGHT={height}", f"-I{ROOT / 'rtl/generated'}"]
    command += ["-CFLAGS", f"-O2 -std=c++17 -Wall -Wextra -Werror -I{ROOT / 'tb/ccl/exhaustive'}"]
    command += ["-CFLAGS", " ".join(f"-D{name}={value}" for name, value in clocks.items())]
    command += ["--Mdir", str(folder), "-o", "ccl_exhaustive"]
    command += [*map(str, core.sources), str(ROOT / "tb/ccl/exhaustive/main.cpp")]
    environment = {"OBJCACHE": "ccache", **os.environ}
    with locked(folder):
        result = subprocess.run(command, capture_output=True, text=True, check=False, env=environment)
    assert result.returncode == 0, result.stdout + result.stderr
    return folder / "ccl_exhaustive"


def run(bench: Path, *arguments: object) -> None:
    """Run the bench; its last line says what it did, a failure shows the image and the command."""
    command = [str(bench), *map(str, arguments)]
    result = subprocess.run(command, capture_output=True, text=True, check=False)
    name = " ".join(command[1:])
    print(f"{name}: {result.stdout.strip()}")
    if name in EXHAUSTIVE:
        frames = re.match(r"ok: (\d+) frames", result.stdout)
        leave_part("ccl", "exhaustive", name, result.returncode == 0, int(frames[1]) if frames else 0)
        combine("ccl", "exhaustive", EXHAUSTIVE, "{count} frames: every image of 8 sizes up to 5x5 and 12x1")
    assert result.returncode == 0, f"{result.stderr}replay: {' '.join(command)}"


@pytest.fixture(scope="module")
def small() -> Path:
    """Bench for images of up to 12x12."""
    return build(12, 12)


@pytest.fixture(scope="module")
def large() -> Path:
    """Bench for images of up to 1280x720."""
    return build(1280, 720)


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        (["--stal", 40, "all", 2, 2], "the options are --seed, --idle and --stall"),
        (["--idle", 100, "all", 2, 2], "give 0 to 99 per cent"),
        (["--seed", "x", "all", 2, 2], "give whole numbers"),
        (["all", 2], "give all WIDTH HEIGHT [FIRST LAST], random COUNT LEAST GREATEST or structured WIDTH HEIGHT"),
    ],
)
def test_a_wrong_command_is_refused(small: Path, arguments: list[object], sentence: str) -> None:
    result = subprocess.run([small, *map(str, arguments)], capture_output=True, text=True, check=False)
    assert (result.returncode, result.stderr) == (2, f"touchdown: {sentence}.\n")


@pytest.mark.parametrize(("idle", "stall"), GAPS)
def test_every_4x4_image(small: Path, idle: int, stall: int) -> None:
    run(small, "--idle", idle, "--stall", stall, "all", 4, 4)


@pytest.mark.parametrize("size", NARROW)
def test_every_narrow_image(small: Path, size: tuple[int, int]) -> None:
    run(small, "all", *size)


@pytest.mark.parametrize("idle_stall", list(enumerate(GAPS)))
def test_random_images(small: Path, idle_stall: tuple[int, tuple[int, int]]) -> None:
    seed, (idle, stall) = idle_stall
    run(small, "--seed", seed, "--idle", idle, "--stall", stall, "random", 100000, 1, 12)


@pytest.mark.parametrize(("idle", "stall"), GAPS)
def test_random_images_through_the_full_size_core(large: Path, idle: int, stall: int) -> None:
    run(large, "--idle", idle, "--stall", stall, "random", 5000, 1, 60)


@pytest.mark.parametrize("size", WHOLE)
def test_hard_whole_frames(large: Path, size: tuple[int, int]) -> None:
    run(large, "structured", *size)


def test_hard_whole_frames_with_gaps(large: Path) -> None:
    run(large, "--idle", 20, "--stall", 70, "structured", 1280, 720)


@pytest.mark.full
@pytest.mark.parametrize(("idle", "stall"), BACK_TO_BACK_AND_GAPS)
def test_every_5x5_image(small: Path, idle: int, stall: int) -> None:
    run(small, "--idle", idle, "--stall", stall, "all", 5, 5)

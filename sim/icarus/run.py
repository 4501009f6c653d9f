# SPDX-License-Identifier: Apache-2.0
"""Shows a frame list to landing_core in Icarus; leaves streams and records as the verilated model does."""

import re
import subprocess
import time
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from pathlib import Path

from golden.chain import Settings
from golden.generated.landing_regs import (
    CTRL_OFFSET,
    FRAME_SIZE_HEIGHT_SHIFT,
    FRAME_SIZE_OFFSET,
    LIDAR_CTRL_ENABLE_MASK,
    LIDAR_CTRL_OFFSET,
    MIN_AREA_OFFSET,
    RING_BASE_OFFSET,
    THRESHOLD_OFFSET,
)
from sim.compare_stages import StageMismatchError, ctrl_value
from sim.cosim.build import ROOT, need
from sim.cosim.frame_list import FrameList
from tb.common.cores import load_core

BENCH = "landing_bench"
BENCH_SOURCES = tuple(ROOT / "sim/icarus" / f"{name}.v" for name in ("stage_tap", "camera", "ring_memory", BENCH))
RING_ADDRESS = 0x10000000


@dataclass(frozen=True)
class Timing:
    """Parameters of the bench: clocks of `clk` a microsecond, horizontal blanking in pixel clocks, the LiDAR's delay.

    The defaults are the board's clocks. Lines follow each other after 40 pixel clocks, where 720p60 has 370: that is
    harder for landing_core and takes a quarter less time here. Vertical blanking is that of 720p60.
    """

    clk_per_us: int = 100
    h_front: int = 10
    h_sync: int = 10
    h_back: int = 20
    lidar_acquisition_us: int = 100


SMALL = Timing(clk_per_us=20)
"""For small frames: times stay right to the microsecond, and the LiDAR takes a fifth of the clocks."""


def registers(frames: FrameList, settings: Settings) -> list[tuple[int, int]]:
    """What a CPU writes before the first frame: offset and value, in order."""
    return [
        (RING_BASE_OFFSET, RING_ADDRESS),
        (FRAME_SIZE_OFFSET, frames.height << FRAME_SIZE_HEIGHT_SHIFT | frames.width),
        (THRESHOLD_OFFSET, settings.threshold_register),
        (MIN_AREA_OFFSET, settings.min_area),
        (LIDAR_CTRL_OFFSET, LIDAR_CTRL_ENABLE_MASK),
        (CTRL_OFFSET, ctrl_value(settings)),
    ]


def landing_core_sources() -> tuple[Path, ...]:
    """The Verilog of landing_core."""
    return load_core("landing_core").sources


def build(program: Path, timing: Timing, sources: Sequence[Path]) -> None:
    """Compile the bench around landing_core.

    Raises:
        StageMismatchError: Icarus does not take it, or warns.
    """
    parameters = [f"-P{BENCH}.{name.upper()}={value}" for name, value in asdict(timing).items()]
    command = [
        *(need("iverilog"), "-g2005", "-Wall", "-Wno-timescale", f"-I{ROOT / 'rtl/generated'}"),
        *("-s", BENCH, *parameters, "-o", str(program)),
        *map(str, [*BENCH_SOURCES, *sources]),
    ]
    run = subprocess.run(command, capture_output=True, text=True, check=False)
    if run.returncode != 0 or run.stderr.strip():
        raise StageMismatchError(
            f"Icarus does not build it: {(run.stderr.strip() or 'no reason given').splitlines()[0]}"
        )


def simulate(
    frames: FrameList,
    settings: Settings,
    out_dir: Path,
    timing: Timing | None = None,
    sources: Sequence[Path] | None = None,
) -> tuple[int, float]:
    """Run frames; `out_dir` then holds what `check_run` compares.

    Args:
        frames: in `out_dir`, named frames.tdf; each shown once.
        settings: registers.
        out_dir: folder of the frame list and of all that the run leaves.
        timing: default that of whole frames.
        sources: Verilog of landing_core; default the project's.

    Returns:
        Clocks of `clk` and seconds.

    Raises:
        StageMismatchError: landing_core showed an unknown bit, broke a protocol or did not answer.
    """
    program = out_dir / "bench.vvp"
    build(program, timing or Timing(), sources or landing_core_sources())
    lines = [f"{offset:x} {value:x}" for offset, value in registers(frames, settings)]
    (out_dir / "registers.txt").write_text("\n".join(lines) + "\n", encoding="ascii")
    start = time.monotonic()
    run = subprocess.run([need("vvp"), "-n", program.name], cwd=out_dir, capture_output=True, text=True, check=False)
    seconds = time.monotonic() - start
    (out_dir / "run.log").write_text(run.stdout + run.stderr)
    end = re.fullmatch(r"clocks (\d+)\n", run.stdout)
    if run.returncode != 0 or run.stderr or end is None:
        said = (run.stdout + run.stderr).strip() or "nothing"
        raise StageMismatchError(f"in Icarus, {said.splitlines()[0].removeprefix('fault: ')}")
    return int(end[1]), seconds

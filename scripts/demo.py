# SPDX-License-Identifier: Apache-2.0
"""Pixels in, MAVLink bytes out: frames through the verilated cores and the firmware, and what came of it.

    python -m scripts.demo [--frames FOLDER|PICTURE|VIDEO] [--altitude CSV|METRES] [--firmware qemu|host]

Leaves a table on the terminal and, in build/demo, one annotated picture a frame
and report.html, which holds everything in one file.
"""

import time
from collections.abc import Callable, Iterator
from itertools import chain, islice
from pathlib import Path

import cv2
import numpy as np

from scripts.demo_decode import decode
from scripts.demo_draw import annotate
from scripts.demo_results import Row, collect, showings
from scripts.demo_table import table
from scripts.errors import ArgumentParser, UserError, run_main
from scripts.frames import FrameSet, how_many, open_frames
from scripts.frames_altitude import altitudes_m
from scripts.report import Facts, write_report
from sim.cosim.result import CosimResult
from sim.cosim.run import FIRMWARES, run_cosim

DEFAULT_OUT = Path("build/demo")
GROUND_BAUD = 115200
"""At 57600 the ground gets PAD with every second frame alone; here it is asked what became of each."""
Runner = Callable[..., CosimResult]


def demo(
    frames: FrameSet, altitudes: list[float], firmware: str, out_dir: Path, runner: Runner = run_cosim
) -> list[Row]:
    """Run the frames, print the table, write pictures and report.

    Args:
        frames: The frames.
        altitudes: What the LiDAR measures in each, metres.
        firmware: "qemu" or "host".
        out_dir: Where pictures, report and the files of the run go.
        runner: What runs them; tests give another.

    Raises:
        UserError: the run failed.
    """
    repeat, counted = showings(frames)
    millimetres = [round(1000 * altitude) for altitude in altitudes]
    images = frames.open()
    if frames.sequential:
        # Primes the thresholds: the first showing has none yet.
        images, millimetres = chain(islice(frames.open(), 1), images), [millimetres[0], *millimetres]
    _make_folder(out_dir)
    result = runner(
        images, millimetres, firmware=firmware, repeat=repeat, out_dir=out_dir / "run", ground_baud=GROUND_BAUD
    )
    autopilot = decode(result.uart0.data, result.uart0.done_ns)
    ground = decode(result.uart1.data, result.uart1.done_ns)
    rows = collect(frames, counted, result.frames, autopilot, ground)
    facts = Facts(
        source=frames.title,
        sequential=frames.sequential,
        firmware=firmware,
        shown=len(result.frames),
        simulated_ns=result.simulated_ns,
        wall_s=result.wall_s,
        autopilot=autopilot,
        ground=ground,
    )
    print(f"demo: drawing {how_many(len(rows), 'picture')}", flush=True)
    report = write_report(out_dir / "report.html", rows, _annotated(frames, rows, out_dir), facts)
    print(f"\n{table(rows)}\n\n{facts.sentence(rows)}\nReport: {report}\nPictures: {out_dir}/*.png")
    return rows


def _annotated(frames: FrameSet, rows: list[Row], out_dir: Path) -> Iterator[np.ndarray]:
    """Annotated frames, each also written as a PNG."""
    for image, row, label in zip(frames.open(), rows, frames.labels, strict=True):
        picture = annotate(image, row)
        path = out_dir / f"{label}.png"
        if not cv2.imwrite(str(path), cv2.cvtColor(picture, cv2.COLOR_RGB2BGR)):
            raise UserError(f"{path} cannot be written; check the folder and the space left on the disk.")
        yield picture


def _make_folder(out_dir: Path) -> None:
    try:
        out_dir.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise UserError(f"{out_dir} cannot be made: {error.strerror}; choose another folder.") from error
    # Pictures of an earlier run with other frames would look like this one's.
    for old in out_dir.glob("*.png"):
        old.unlink()


def main(arguments: list[str] | None = None) -> None:
    """Entry point."""
    parser = ArgumentParser(description="Frames through RTL and firmware to MAVLink bytes.")
    parser.add_argument(
        "--frames", help="folder of PNG or JPEG files, one such file, or a video (default: a rendered descent)"
    )
    parser.add_argument("--altitude", help="metres, or a CSV file with the columns frame and altitude_m")
    parser.add_argument(
        "--firmware", choices=FIRMWARES, default="qemu", help="the ELF on QEMU's Zynq, or the host build"
    )
    parser.add_argument("--out", type=Path, default=DEFAULT_OUT, help="folder for pictures and report")
    parser.add_argument("--limit", type=int, help="take at most this many frames")
    options = parser.parse_args(arguments)
    start = time.monotonic()
    frames = open_frames(options.frames, options.limit)
    altitudes = altitudes_m(frames, options.altitude)
    print(f"demo: {frames.title}, {how_many(len(frames.names), 'frame')}", flush=True)
    demo(frames, altitudes, options.firmware, options.out)
    print(f"Took {time.monotonic() - start:.0f} s.")


if __name__ == "__main__":
    run_main(main)

# SPDX-License-Identifier: Apache-2.0
"""How fast the parts are, as ratios: `python -m scripts.bench [--rounds 5]`.

Both sides of a ratio run in turns in the same minute on the same frame of 1280x720, and the median over the rounds
counts, so that a busy machine slows both. A second alone means nothing on another machine and is not printed.
"""

import time
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from statistics import median
from tempfile import TemporaryDirectory

import cv2
import numpy as np

from firmware.library import Firmware, make
from golden.chain import Settings, Stages, run_chain, run_frames
from golden.result_writer import record
from scripts.errors import ArgumentParser, UserError, run_main
from sim.cosim.run import run_cosim
from sim.world.clip import demo_clip

ROUNDS = 5
FRAMES = 4
"""Of a run of the co-simulation; a run of one is taken off, which has the same start and end."""
RECORDS = 200
PERIOD_US = 16_667
Seconds = Callable[[], float]


@dataclass(frozen=True)
class Pair:
    """Two ways whose times are compared; each function says how many seconds one frame took it."""

    what: str
    than: str
    one: Seconds
    other: Seconds


def ratios(pair: Pair, rounds: int) -> list[float]:
    """How many times as long as the other the one takes, once a round. Who begins changes with each round."""
    found = []
    for index in range(rounds):
        if index % 2:
            other = pair.other()
            one = pair.one()
        else:
            one = pair.one()
            other = pair.other()
        found.append(one / other)
    return found


def line(pair: Pair, found: list[float]) -> str:
    """A pair's line of the table."""
    return f"{pair.what:<52} {median(found):8.2f} x  {pair.than:<44} {min(found):.2f} to {max(found):.2f}"


def timed(work: Callable[[], object], timer: Callable[[], float] = time.perf_counter) -> Seconds:
    """A function that does the work once and says how long that took."""

    def seconds() -> float:
        start = timer()
        work()
        return timer() - start

    return seconds


def opencv(rgb: np.ndarray) -> None:
    """The operations of the chain that OpenCV has, and a threshold of its own."""
    smooth = cv2.GaussianBlur(cv2.cvtColor(rgb, cv2.COLOR_RGB2GRAY), (5, 5), 0.65)
    _, binary = cv2.threshold(smooth, 0, 1, cv2.THRESH_BINARY_INV | cv2.THRESH_OTSU)
    square = np.ones((3, 3), np.uint8)
    cv2.connectedComponentsWithStats(cv2.dilate(cv2.medianBlur(cv2.erode(binary, square), 5), square))


def cosim_seconds(rgb: np.ndarray, altitude_mm: int, firmware: str, folder: Path) -> float:
    """One frame in the verilated core with the firmware beside it, without what starting and ending take."""

    def run(count: int) -> float:
        frames, altitudes = [rgb] * count, [altitude_mm] * count
        out_dir = folder / firmware
        return run_cosim(frames, altitudes, firmware=firmware, out_dir=out_dir, progress=lambda _: None).wall_s

    return (run(1 + FRAMES) - run(1)) / FRAMES


def records(stages: Stages, altitude_mm: int) -> list[bytes]:
    """The frame's record again and again, as if the camera stood still."""
    height, width = stages.gray.shape
    values = {"altitude_mm": altitude_mm, "altitude_valid": 1, "frame_size_width": width, "frame_size_height": height}
    start = {"scan_time_us": 16_072, "threshold_factor": Settings().factor, "min_area": Settings().min_area}
    return [
        record({**values, **start, "frame_number": number, "start_time_us": PERIOD_US * number}, stages.objects)
        for number in range(1, RECORDS + 1)
    ]


def firmware_seconds(given: list[bytes], searching: bool) -> float:
    """A record in the firmware's core: `searching` with a core that has just started, else following the pad.

    Raises:
        UserError: the core refuses a record.
    """
    total = 0.0
    firmware = Firmware()
    for index, data in enumerate(given):
        if searching:
            firmware = Firmware()
        start = time.perf_counter()
        error = firmware.on_record(data, PERIOD_US * (index + 2))
        total += time.perf_counter() - start
        if error != 0:
            raise UserError(f"the firmware refuses a record of the bench with {error}; run make test.")
    return total / len(given)


def pairs(rgb: np.ndarray, altitude_mm: int, folder: Path) -> list[Pair]:
    """What is compared, all of it on one frame."""
    *_, stages = run_frames([rgb, rgb])
    given = records(stages, altitude_mm)
    golden = timed(lambda: run_chain(rgb, stages.stats))
    verilated = partial(cosim_seconds, rgb, altitude_mm, "host", folder)
    return [
        Pair("golden chain", "OpenCV's filters and components", golden, timed(lambda: opencv(rgb))),
        Pair("verilated landing_core, firmware of this machine", "golden chain", verilated, golden),
        Pair(
            "verilated landing_core, board's ELF on QEMU",
            "the same with the firmware of this machine",
            partial(cosim_seconds, rgb, altitude_mm, "qemu", folder),
            verilated,
        ),
        Pair(
            "firmware/core, first look for the pad",
            "following it",
            partial(firmware_seconds, given, True),
            partial(firmware_seconds, given, False),
        ),
    ]


def bench(compared: list[Pair], rounds: int) -> None:
    """Print a line a pair as it is measured."""
    for pair in compared:
        print(line(pair, ratios(pair, rounds)), flush=True)


def main(arguments: list[str] | None = None) -> None:
    """Entry point."""
    parser = ArgumentParser(description="How fast the parts are, as ratios measured side by side.")
    parser.add_argument("--rounds", type=int, default=ROUNDS, help=f"how often each pair runs (default: {ROUNDS})")
    options = parser.parse_args(arguments)
    if options.rounds < 1:
        raise UserError(f"{options.rounds} rounds are none; give 1 or more.")
    make("host")
    frame = demo_clip()[3]
    print(
        f"bench: median of {options.rounds} rounds, time of the first by time of the second; least to most", flush=True
    )
    with TemporaryDirectory() as folder:
        bench(pairs(frame.image(), round(1000 * frame.truth.lidar_m), Path(folder)), options.rounds)


if __name__ == "__main__":
    run_main(main)

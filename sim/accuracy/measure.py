# SPDX-License-Identifier: Apache-2.0
"""Runs units over several processes; the rows come in the order of the units, whatever the number of processes."""

import multiprocessing
import tempfile
import time
from collections.abc import Callable, Sequence
from pathlib import Path

import cv2

from golden.chain import Settings
from scripts.demo_results import Row as Seen
from sim.accuracy.paths import golden, rtl
from sim.accuracy.rows import Row
from sim.accuracy.shots import Shot, Unit

RUNS = ("golden", "rtl")
SAY_EVERY_S = 10.0
Measure = Callable[[Unit], list[Row]]


def rows_of(unit: Unit, seen: Sequence[Seen]) -> list[Row]:
    """What was seen of each shot, beside what is true of it."""
    return [_row(unit, shot, one) for shot, one in zip(unit.shots, seen, strict=True)]


def _row(unit: Unit, shot: Shot, seen: Seen) -> Row:
    header = seen.record["header"]
    return Row(
        set=unit.set,
        name=shot.name,
        difficulty=shot.difficulty,
        strength=shot.strength,
        reference=shot.reference,
        pad=seen.pad,
        altitude_m=seen.altitude_m,
        objects=int(header["object_count"]),
        dropped=int(header["objects_dropped"]),
        min_area_px=int(header["min_area"]),
    )


def measure_golden(unit: Unit, settings: Settings | None = None, options: int | None = None) -> list[Row]:
    """Rows of a unit on the golden path."""
    return rows_of(unit, golden(unit, settings, options).seen)


def measure_rtl(unit: Unit) -> list[Row]:
    """Rows of a unit on the verilated RTL."""
    with tempfile.TemporaryDirectory() as folder:
        return rows_of(unit, rtl(unit, Path(folder)).seen)


def measure(units: Sequence[Unit], how: Measure, jobs: int, say: Callable[[str], None]) -> list[Row]:
    """Rows of all units, in their order.

    Args:
        units: What is measured.
        how: What makes rows of a unit; goes to the other processes.
        jobs: Processes.
        say: Is told now and then how far it is.
    """
    rows: list[Row] = []
    said = time.monotonic()
    with multiprocessing.get_context("spawn").Pool(jobs, _start) as pool:
        for done, part in enumerate(pool.imap(how, units), start=1):
            rows += part
            if time.monotonic() - said > SAY_EVERY_S or done == len(units):
                said = time.monotonic()
                say(f"accuracy: {done} of {len(units)} done, {sum(row.missed for row in rows)} missed")
    return rows


def _start() -> None:
    # As many processes as there are processors: more threads would only get in each other's way.
    cv2.setNumThreads(1)

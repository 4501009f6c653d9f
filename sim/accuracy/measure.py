# SPDX-License-Identifier: Apache-2.0
"""Runs units over several processes; the rows come in the order of the units, whatever the number of processes."""

import multiprocessing
import tempfile
import time
from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from pathlib import Path
from typing import TypeVar

import cv2

from sim.accuracy.causes import shapes_seen
from sim.accuracy.paths import Answer, golden, rtl, settled
from sim.accuracy.rows import Row
from sim.accuracy.shots import Film, Unit, develop

RUNS = ("golden", "rtl")
SAY_EVERY_S = 10.0
Given = TypeVar("Given")
Result = TypeVar("Result")


def rows_of(film: Film, answer: Answer) -> list[Row]:
    """What was seen of each shot, beside what is true of it."""
    rows = []
    for shot, reference, one in zip(film.unit.shots, film.references, answer.seen, strict=True):
        header = one.record["header"]
        row = Row(
            set=film.unit.set,
            name=shot.name,
            difficulty=shot.difficulty,
            strength=shot.strength,
            reference=reference,
            pad=one.pad,
            altitude_m=one.altitude_m,
            objects=int(header["object_count"]),
            dropped=int(header["objects_dropped"]),
            min_area_px=int(header["min_area"]),
        )
        if not film.unit.clip:
            row = replace(row, strays=sum(replace(row, pad=earlier.pad).false for earlier in answer.before))
        if row.missed:
            row = replace(row, shapes=shapes_seen(one.objects, reference, shot.lidar_m, row.min_area_px))
        rows.append(row)
    return rows


def measure_golden(unit: Unit) -> list[Row]:
    """Rows of a unit on the golden path."""
    film = develop(unit)
    return rows_of(film, golden(film))


def measure_rtl(unit: Unit) -> list[Row]:
    """Rows of a unit on the verilated RTL."""
    film = develop(unit)
    if not unit.clip:
        film = settled(film)
    with tempfile.TemporaryDirectory() as folder:
        return rows_of(film, rtl(film, Path(folder)))


class Workers:
    """Several processes. What they give comes in the order of the tasks, whatever their number.

    Args:
        jobs: Processes.
        say: Is told now and then how far it is.
    """

    def __init__(self, jobs: int, say: Callable[[str], None]) -> None:
        self._pool = multiprocessing.get_context("spawn").Pool(jobs, _start)
        self._say = say

    def __enter__(self) -> "Workers":
        return self

    def __exit__(self, *_error: object) -> None:
        self._pool.terminate()
        self._pool.join()

    def map(self, what: str, task: Callable[[Given], Result], given: Sequence[Given]) -> Iterator[Result]:
        """The task done with each of `given`, which go to the processes as the task does; `what` names it."""
        said = time.monotonic()
        for done, result in enumerate(self._pool.imap(task, given), start=1):
            yield result
            if time.monotonic() - said > SAY_EVERY_S or done == len(given):
                said = time.monotonic()
                self._say(f"accuracy: {what}, {done} of {len(given)}")


def _start() -> None:
    # As many processes as there are processors: more threads would only get in each other's way.
    cv2.setNumThreads(1)

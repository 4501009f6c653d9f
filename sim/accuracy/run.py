# SPDX-License-Identifier: Apache-2.0
"""How well the pad is found: photographs and rendered sets through the whole chain, compared with what is true.

    python -m sim.accuracy.run [--frames FOLDER] [--run golden|rtl] [--count N] [--sets NAME ...]

Prints a table and the goals, and leaves in build/accuracy the rows, pictures and report.html. Fails if a goal is not
met.
"""

import time
from collections.abc import Sequence
from pathlib import Path

from firmware.library import make
from scripts.errors import ArgumentParser, UserError, run_main
from sim.accuracy.goals import NOT_MET, judge, load_goals
from sim.accuracy.measure import RUNS, Measure, measure, measure_golden, measure_rtl
from sim.accuracy.photos import PREFIX, photo_units
from sim.accuracy.rendered import SETS, rendered_units
from sim.accuracy.rows import Row, write_rows
from sim.accuracy.shots import Unit
from sim.accuracy.tables import CURVE_HEAD, END_HEAD, HEAD, as_text, curve_lines, end_lines, set_lines
from sim.cosim.build import build_host

OUT = Path("build/accuracy")
PHOTOS = "photos"
ROWS = "rows.jsonl"


def choose(sets: Sequence[str] | None, frames: str | None, altitude: str | None, count: int | None) -> list[Unit]:
    """The units of the sets that are asked for.

    Raises:
        UserError: a set does not exist, or the folder of photographs cannot be used.
    """
    if count is not None and count < 1:
        raise UserError(f"COUNT is {count}; give 1 or more.")
    names = list(sets) if sets else [*([PHOTOS] if frames else []), *SETS]
    units: list[Unit] = []
    for name in names:
        if name != PHOTOS:
            units += rendered_units(name, count)
        elif frames is None:
            raise UserError("the set photos needs a folder of pictures; give FRAMES=folder.")
        else:
            units += photo_units(frames, altitude)
    return units


def prepare(run: str) -> Measure:
    """Build what is missing, and say how a unit is measured.

    Raises:
        UserError: it cannot be built.
    """
    if run == "rtl":
        build_host()
        return measure_rtl
    try:
        make("host")
    except AssertionError as error:
        raise UserError("the firmware's library does not build; `make -C firmware host` says why.") from error
    return measure_golden


def tables(rows: Sequence[Row]) -> str:
    """All tables as text."""
    parts = [as_text(HEAD, set_lines(rows, PREFIX))]
    if curve := curve_lines(rows):
        parts += [as_text(CURVE_HEAD, curve), as_text(END_HEAD, end_lines(rows))]
    return "\n\n".join(parts)


def main(arguments: list[str] | None = None) -> int:
    """Entry point; 1 if a goal is not met."""
    parser = ArgumentParser(description="How well the pad is found, on photographs and on rendered frames.")
    parser.add_argument("--frames", help="folder with a folder of pictures a set, and reference.csv")
    parser.add_argument("--altitude", help="metres, or a CSV file (default: altitude.csv of each set)")
    parser.add_argument("--sets", nargs="+", help=f"what to measure (default: all): {PHOTOS} {' '.join(SETS)}")
    parser.add_argument("--count", type=int, help="frames a rendered set (default: the set's own number)")
    parser.add_argument("--run", choices=RUNS, default=RUNS[0], help="the golden models, or the verilated RTL")
    parser.add_argument("--jobs", type=int, default=2, help="processes")
    parser.add_argument("--no-goals", action="store_true", help="do not compare with the goals")
    parser.add_argument("--out", type=Path, default=OUT, help="folder for rows, pictures and report")
    options = parser.parse_args(arguments)
    start = time.monotonic()
    units = choose(options.sets, options.frames, options.altitude, options.count)
    rows = measure(units, prepare(options.run), options.jobs, lambda text: print(text, flush=True))
    write_rows(options.out / ROWS, rows)
    print(f"\n{tables(rows)}\n")
    verdicts = [] if options.no_goals else judge(load_goals(), rows)
    for verdict in verdicts:
        print(verdict.sentence)
    print(f"\n{len(rows)} frames ({options.run}) in {time.monotonic() - start:.0f} s; rows: {options.out / ROWS}")
    return int(any(verdict.state == NOT_MET for verdict in verdicts))


if __name__ == "__main__":
    run_main(main)

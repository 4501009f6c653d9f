# SPDX-License-Identifier: Apache-2.0
"""How well the pad is found: photographs and rendered sets through the whole chain, compared with what is true.

    python -m sim.accuracy.run [--frames FOLDER] [--run golden|rtl] [--count N] [--seed N] [--sets NAME ...] [--options]

Prints tables and goals, and leaves rows, contact sheets and report.html in build/accuracy. Fails if a goal is not met.
"""

import time
from argparse import Namespace
from collections.abc import Sequence
from functools import partial
from pathlib import Path

from firmware.library import make
from scripts.errors import ArgumentParser, UserError, run_main
from sim.accuracy.goals import GOAL_HEAD, NOT_MET, goal_lines, judge, load_goals
from sim.accuracy.measure import Workers, measure_golden, measure_rtl
from sim.accuracy.options import compare, lines, load_variants
from sim.accuracy.page import write_blocks, write_measured
from sim.accuracy.photos import PREFIX, photo_units
from sim.accuracy.rendered import SETS, rendered_units
from sim.accuracy.report import write_report
from sim.accuracy.rows import Row, read_rows, write_rows
from sim.accuracy.sheets import write_sheets
from sim.accuracy.shots import Unit
from sim.accuracy.tables import (
    CURVE_HEAD,
    END_HEAD,
    HEAD,
    MISS_HEAD,
    as_markdown,
    as_text,
    curve_lines,
    end_lines,
    miss_lines,
    set_lines,
)
from sim.cosim.build import build_host

OUT = Path("build/accuracy")
PHOTOS = "photos"
ROWS = "rows.jsonl"
OPTION_ROWS = "options"
RUNS = {"golden": measure_golden, "rtl": measure_rtl}


def choose(
    sets: Sequence[str] | None, frames: str | None, altitude: str | None, count: int | None, seed: int = 1
) -> list[Unit]:
    """The units of the sets that are asked for.

    Raises:
        UserError: a set does not exist, or the folder of photographs cannot be used.
    """
    if count is not None and count < 1:
        raise UserError(f"COUNT is {count}; give 1 or more.")
    if seed < 0:
        raise UserError(f"SEED is {seed}; give 0 or more.")
    names = list(dict.fromkeys(sets)) if sets else [*([PHOTOS] if frames else []), *SETS]
    units: list[Unit] = []
    for name in names:
        if name != PHOTOS:
            units += rendered_units(name, count, seed)
        elif frames is None:
            raise UserError("the set photos needs a folder of pictures; give FRAMES=folder.")
        else:
            units += photo_units(frames, altitude)
    return units


def build(run: str) -> None:
    """Build what a run needs.

    Raises:
        UserError: it cannot be built.
    """
    try:
        make("host")
    except AssertionError as error:
        raise UserError("the firmware's library does not build; `make -C firmware host` says why.") from error
    if run == "rtl":
        build_host()


def tables(rows: Sequence[Row]) -> str:
    """All tables as text."""
    parts = [as_text(HEAD, set_lines(rows, PREFIX))]
    if misses := miss_lines(rows):
        parts.append(as_text(MISS_HEAD, misses))
    if curve := curve_lines(rows):
        parts += [as_text(CURVE_HEAD, curve), as_text(END_HEAD, end_lines(rows))]
    return "\n\n".join(parts)


def measure(units: Sequence[Unit], workers: Workers, options: Namespace) -> int:
    """Measure, print and write everything; 1 if a goal is not met."""
    if options.again:
        rows = read_rows(options.out / ROWS)
    else:
        rows = [row for part in workers.map("frames and clips", RUNS[options.run], units) for row in part]
        write_rows(options.out / ROWS, rows)
    if {row.set for row in rows} - {unit.set for unit in units}:
        raise UserError(f"{options.out / ROWS} holds other sets; give the options with which it was made.")
    verdicts = [] if options.no_goals else judge(load_goals(), rows)
    sheets = write_sheets(rows, units, options.out, workers)
    report = options.out / "report.html"
    write_report(report, rows, verdicts, sheets, options.run)
    print(f"\n{tables(rows)}\n")
    if verdicts:
        print(as_text(GOAL_HEAD, goal_lines(verdicts)))
    if options.write:
        write_measured(rows, judge(load_goals(), rows), units, workers)
    print(f"\n{len(rows)} frames, path: {options.run}. Report: {report}. Rows: {options.out / ROWS}.")
    return int(any(verdict.state == NOT_MET for verdict in verdicts))


def measure_options(units: Sequence[Unit], workers: Workers, options: Namespace) -> None:
    """Measure every variant of `options.toml`, print and keep the table."""
    variants = load_variants()
    task = partial(compare, variants=variants)
    by_unit = list(workers.map("frames and clips, every variant", task, units))
    results = []
    for index, variant in enumerate(variants):
        rows = [row for parts in by_unit for row in parts[index]]
        write_rows(options.out / OPTION_ROWS / f"{index:02d}.jsonl", rows)
        results.append((variant.name, rows))
    head, table = lines(results)
    print(f"\n{as_text(head, table)}\n\nRows: {options.out / OPTION_ROWS}.")
    if options.write:
        write_blocks({"options": as_markdown(head, table)})


def main(arguments: list[str] | None = None) -> int:
    """Entry point; 1 if a goal is not met."""
    parser = ArgumentParser(description="How well the pad is found, on photographs and on rendered frames.")
    parser.add_argument("--frames", help="folder with a folder of pictures a set, and reference.csv")
    parser.add_argument("--altitude", help="metres, or a CSV file (default: altitude.csv of each set)")
    parser.add_argument("--sets", nargs="+", help=f"what to measure (default: all): {PHOTOS} {' '.join(SETS)}")
    parser.add_argument("--count", type=int, help="frames a rendered set (default: the set's own number)")
    parser.add_argument("--seed", type=int, default=1, help="another seed, other rendered scenes (default: 1)")
    parser.add_argument("--run", choices=RUNS, default="golden", help="the golden models, or the verilated RTL")
    parser.add_argument("--options", action="store_true", help="compare the variants of options.toml instead")
    parser.add_argument("--write", action="store_true", help="write tables and pictures into docs/accuracy.md")
    parser.add_argument("--again", action="store_true", help="tables and report anew, from the rows of the last run")
    parser.add_argument("--jobs", type=int, default=2, help="processes")
    parser.add_argument("--no-goals", action="store_true", help="do not compare with the goals")
    parser.add_argument("--out", type=Path, default=OUT, help="folder for rows, pictures and report")
    options = parser.parse_args(arguments)
    start = time.monotonic()
    units = choose(options.sets, options.frames, options.altitude, options.count, options.seed)
    build(options.run)
    with Workers(options.jobs, lambda text: print(text, flush=True)) as workers:
        if options.options:
            measure_options(units, workers, options)
            code = 0
        else:
            code = measure(units, workers, options)
    print(f"Took {time.monotonic() - start:.0f} s.")
    return code


if __name__ == "__main__":
    run_main(main)

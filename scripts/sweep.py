# SPDX-License-Identifier: Apache-2.0
"""What each feature and size costs: `python -m scripts.sweep [--core X] [--write]`.

Maps the builds of `constraints/sweeps.toml` as `make synth` does and prints a table a core. With --write these go into
docs/area.md, and with them what the pages of all cores say of area and clock.
"""

import tomllib
from collections.abc import Sequence
from dataclasses import dataclass

from scripts.corepage import block_of, read_page
from scripts.errors import ArgumentParser, UserError, run_main
from scripts.page_block import with_block
from scripts.synth import Area, synthesise
from tb.common.cores import ROOT, core_names, load_core

SWEEPS = ROOT / "constraints/sweeps.toml"
PAGE = ROOT / "docs/area.md"
HEAD = ("build", "LUT", "of these SRL", "of these LUTRAM", "FF", "BRAM36", "BRAM18", "DSP")


@dataclass(frozen=True)
class Build:
    """A core with parameters of its own."""

    core: str
    what: str
    parameters: dict[str, int]


def builds(core: str = "") -> list[Build]:
    """All builds, or those of one core.

    Raises:
        UserError: the core has none, or a build names a parameter that is no whole number.
    """
    table = tomllib.loads(SWEEPS.read_text(encoding="utf-8"))["build"]
    found = [Build(one["core"], one["what"], one["parameters"]) for one in table if core in ("", one["core"])]
    if not found:
        known = ", ".join(sorted({one["core"] for one in table}))
        raise UserError(f"constraints/sweeps.toml has no build of '{core}'; choose one of: {known}.")
    return found


def area(build: Build) -> Area:
    """Map a build.

    Raises:
        UserError: yosys refuses it.
    """
    core = load_core(build.core)
    try:
        return synthesise(core.toplevel, [str(source.relative_to(ROOT)) for source in core.sources], build.parameters)
    except ValueError as error:
        raise UserError(f"{build.core}, {build.what}: {error}.") from error


def row(what: str, taken: Area) -> str:
    """One line of a table."""
    cells = (taken.lut, taken.srl, taken.lutram, taken.ff, taken.bram36, taken.bram18, taken.dsp)
    return f"| {what} | {' | '.join(map(str, cells))} |"


def table(rows: Sequence[str]) -> str:
    """A whole table."""
    return "\n".join([f"| {' | '.join(HEAD)} |", "|" + "---|" * len(HEAD), *rows])


def cores_table() -> str:
    """Area and clock of every core with its defaults, as their pages have them.

    Raises:
        UserError: a page lacks one of the two.
    """
    rows = []
    for name in core_names():
        page = read_page(name)
        lut, _, _, _, ff, *memories = block_of(name, page, "resources")[0].splitlines()[2].strip("| ").split(" | ")
        clocks = [line.strip("| ").split(" | ") for line in block_of(name, page, "fmax")[0].splitlines()[2:]]
        mhz = ", ".join(figure if clock == "`clk`" else f"{clock} {figure}" for clock, figure, _ in clocks)
        rows.append(f"| [{name}](cores/{name}.md) | {' | '.join((lut, ff, *memories, mhz))} |")
    head = ("core", "LUT", "FF", "BRAM36", "BRAM18", "DSP", "MHz")
    return "\n".join([f"| {' | '.join(head)} |", "|" + "---|" * len(head), *rows])


def main() -> int:
    """Entry point of `make sweep`."""
    parser = ArgumentParser(prog="make sweep", description=__doc__)
    parser.add_argument("--core", default="", help="one core; all when left out")
    parser.add_argument("--write", action="store_true", help="put the tables into docs/area.md")
    arguments = parser.parse_args()
    rows: dict[str, list[str]] = {}
    for build in builds(arguments.core):
        rows.setdefault(build.core, []).append(row(build.what, area(build)))
        print(f"{build.core} {rows[build.core][-1]}", flush=True)
    if arguments.write:
        text = with_block(PAGE.read_text(encoding="utf-8"), "cores", cores_table(), "docs/area.md")
        for core, lines in rows.items():
            text = with_block(text, core, table(lines), "docs/area.md")
        PAGE.write_text(text, encoding="utf-8")
    print("Figures of yosys for xc7, not of Vivado.")
    return 0


if __name__ == "__main__":
    run_main(main)

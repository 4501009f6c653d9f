# SPDX-License-Identifier: Apache-2.0
"""The table of what was proven of each core: `python -m scripts.signoff [--write]`.

Each check leaves `build/signoff/<check>/<core>.json` through `leave`; this prints them as a table core x check. A check
that was not run is 'missing'. Whatever failed or is missing makes the exit code 1.
"""

import json
import sys
from dataclasses import dataclass
from pathlib import Path

from scripts.errors import ArgumentParser, UserError, run_main
from tb.common.cores import ROOT, core_names, load_core
from tb.testplan import load_plan

FOLDER = ROOT / "build/signoff"
PAGE = ROOT / "docs/signoff.md"
SHORT = {"passed": "ok", "failed": "FAILED", "stale": "stale", "missing": "missing", "exempt": "-"}
CHECKS = ("matrix", "exhaustive", "frames", "formal", "mutation", "coverage", "lint", "area")


def leave(core: str, check: str, passed: bool, figure: str, detail: dict[str, object]) -> Path:
    """Leave the result of one check of one core, in one step, so that a reader never finds half of it.

    Raises:
        ValueError: The table has no such check.
    """
    if check not in CHECKS:
        raise ValueError(f"unknown check '{check}'; choose one of: {', '.join(CHECKS)}")
    path = FOLDER / check / f"{core}.json"
    path.parent.mkdir(parents=True, exist_ok=True)
    result = {"core": core, "check": check, "passed": passed, "figure": figure, "detail": detail}
    partial = path.with_suffix(".partial")
    partial.write_text(json.dumps(result, indent=2) + "\n", encoding="utf-8")
    partial.replace(path)
    return path


def sources_of(core: str) -> list[Path]:
    """Files that make a core, and the table that names them; of a module that cores share, its one file."""
    if core not in core_names():
        return sorted((ROOT / "rtl").glob(f"*/{core}.v"))
    return [ROOT / "rtl" / core / "core.toml", *load_core(core).sources]


def is_stale(result: Path, core: str) -> bool:
    """True if a source of the core has changed since the result was left."""
    left = result.stat().st_mtime
    return any(source.stat().st_mtime > left for source in sources_of(core))


def leave_part(core: str, check: str, part: str, passed: bool, count: int) -> None:
    """Leave one run of a check that has several, perhaps in several processes; `combine` sums them up."""
    path = FOLDER / "parts" / check / core / f"{part}.json"
    path.parent.mkdir(parents=True, exist_ok=True)
    partial = path.with_suffix(".partial")
    partial.write_text(json.dumps({"passed": passed, "count": count}) + "\n", encoding="utf-8")
    partial.replace(path)


def combine(core: str, check: str, expected: list[str], what: str) -> Path:
    """Leave the result of a check made of parts: passed once every expected part is there, fresh, and passed.

    Args:
        core: Name of the core.
        check: Name of the check.
        expected: Names of all its parts.
        what: Figure, with `{count}` for the sum of all counts.
    """
    parts = {}
    for name in expected:
        path = FOLDER / "parts" / check / core / f"{name}.json"
        if path.is_file() and not is_stale(path, core):
            parts[name] = json.loads(path.read_text(encoding="utf-8"))
    failed = [name for name, part in parts.items() if not part["passed"]]
    figure = what.format(count=f"{sum(part['count'] for part in parts.values()):,}")
    if len(parts) < len(expected):
        figure += f" ({len(parts)} of {len(expected)} runs)"
    complete = len(parts) == len(expected)
    detail = {"failed": failed, "runs": parts, "incomplete": not complete}
    return leave(core, check, not failed and complete, figure, detail)


@dataclass(frozen=True)
class Cell:
    """One cell of the table: state is passed, failed, stale, missing or exempt; text is what is printed."""

    state: str
    text: str


def read_cell(core: str, check: str, exempt: dict[str, str]) -> Cell:
    """The result of one check of one core.

    Raises:
        UserError: The result is not what `leave` writes.
    """
    path = FOLDER / check / f"{core}.json"
    if not path.is_file():
        return Cell("exempt", "-") if check in exempt else Cell("missing", "missing")
    try:
        result = json.loads(path.read_text(encoding="utf-8"))
        named = (result["core"], result["check"])
        passed, figure = result["passed"], result["figure"]
        incomplete = bool(result["detail"].get("incomplete")) and not result["detail"]["failed"]
    except (ValueError, KeyError, TypeError, AttributeError) as error:
        raise UserError(f"{path.relative_to(ROOT)} is no result ({error!r}); run its check again.") from error
    if named != (core, check) or not isinstance(passed, bool):
        raise UserError(f"{path.relative_to(ROOT)} is the result of something else; run its check again.")
    if is_stale(path, core):
        return Cell("stale", f"stale: {figure}")
    if passed:
        return Cell("passed", figure)
    return Cell("missing", f"incomplete: {figure}") if incomplete else Cell("failed", f"FAILED: {figure}")


def read_table() -> dict[str, dict[str, Cell]]:
    """All cells: core, check. Modules that cores share have a row if a check left a result for them."""
    exempt = {core: plan.get("exempt", {}) for core, plan in load_plan().items()}
    shared = {path.stem for check in CHECKS for path in (FOLDER / check).glob("*.json")} - set(core_names())
    unneeded = dict.fromkeys(CHECKS, "checked within the cores that use it")
    exempt |= dict.fromkeys(shared, unneeded)
    rows = [*core_names(), *sorted(shared)]
    return {core: {check: read_cell(core, check, exempt.get(core, {})) for check in CHECKS} for core in rows}


def render(cells: dict[str, dict[str, Cell]]) -> str:
    """The table as Markdown: one row a core."""
    rows = [["core", *CHECKS], ["---"] * (len(CHECKS) + 1)]
    rows += [[core, *(cell.text for cell in line.values())] for core, line in cells.items()]
    return "\n".join(f"| {' | '.join(row)} |" for row in rows)


def reasons() -> str:
    """Why some checks do not apply to some cores, as a Markdown list."""
    lines = []
    for core, plan in load_plan().items():
        exempt = plan.get("exempt", {})
        lines += [f"- `{core}`, {check}: {exempt[check]}" for check in CHECKS if check in exempt]
    return "\n".join(lines)


PAGE_TEXT = """# Sign-off

What was run on each core, and the figure it left. Made by `python -m scripts.signoff --write` from the results in
`build/signoff/`; `make test-full` leaves all of them. Area is yosys' figure for xc7 with default parameters, not
Vivado's.

{table}

`-` means that the check does not apply:

{reasons}
"""


def main() -> int:
    """Entry point of `make signoff`."""
    parser = ArgumentParser(prog="python -m scripts.signoff", description=__doc__)
    parser.add_argument("--write", action="store_true", help="make docs/signoff.md from the results")
    arguments = parser.parse_args()
    cells = read_table()
    print(f"{'':<16}{''.join(f'{check:<12}' for check in CHECKS)}".rstrip())
    for core, line in cells.items():
        print(f"{core:<16}{''.join(f'{SHORT[cell.state]:<12}' for cell in line.values())}".rstrip())
    for core, line in cells.items():
        print(f"\n{core}")
        for check, cell in line.items():
            print(f"  {check:<10} {cell.text}")
    print()
    states = [cell.state for line in cells.values() for cell in line.values()]
    counts = {state: states.count(state) for state in ("passed", "failed", "stale", "missing", "exempt")}
    print(", ".join(f"{count} {state}" for state, count in counts.items()))
    if arguments.write:
        PAGE.write_text(PAGE_TEXT.format(table=render(cells), reasons=reasons()), encoding="utf-8")
    if counts["failed"] + counts["stale"] + counts["missing"]:
        print("touchdown: not signed off; run `make test-full`, mend what it finds, and look again.", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    run_main(main)

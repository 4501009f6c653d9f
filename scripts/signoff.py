# SPDX-License-Identifier: Apache-2.0
"""The table of what was proven of each core: `python -m scripts.signoff [--write]`.

Each check leaves `build/signoff/<check>/<core>.json` through `leave`; this prints them as a table core x check. A check
that was not run is 'missing', one whose files have changed since is 'stale'. Either, and whatever failed, makes the
exit code 1.
"""

import json
import sys
from dataclasses import dataclass
from pathlib import Path

from formal.tasks import core_names as proven
from scripts.errors import ArgumentParser, UserError, run_main
from scripts.signoff_inputs import digest, hash_of
from tb.common.cores import ROOT, core_names
from tb.common.lock import locked
from tb.testplan import load_plan

FOLDER = ROOT / "build/signoff"
PAGE = ROOT / "docs/signoff.md"
SHORT = {"passed": "ok", "failed": "FAILED", "stale": "stale", "missing": "missing", "exempt": "-"}
CHECKS = ("matrix", "exhaustive", "frames", "formal", "mutation", "coverage", "lint", "area")


def leave(
    core: str,
    check: str,
    passed: bool,
    figure: str,
    detail: dict[str, object],
    *,
    incomplete: bool = False,
    inputs: str | None = None,
) -> Path:
    """Leave the result of one check of one core, in one step, so that a reader never finds half of it.

    Args:
        core: Name of the core.
        check: Name of the check.
        passed: Whether it passed.
        figure: One line for the table.
        detail: More, for a person.
        incomplete: Nothing failed, but not everything was run.
        inputs: Hash of what the result is about, if that was taken before a long run; default the files as they are.

    Raises:
        ValueError: The table has no such check.
    """
    if check not in CHECKS:
        raise ValueError(f"unknown check '{check}'; choose one of: {', '.join(CHECKS)}")
    path = FOLDER / check / f"{core}.json"
    result = {"core": core, "check": check, "passed": passed, "incomplete": incomplete, "figure": figure}
    write(path, {**result, "inputs": inputs or digest(core, check), "detail": detail})
    return path


def write(path: Path, table: dict[str, object]) -> None:
    """Write a JSON file in one step."""
    path.parent.mkdir(parents=True, exist_ok=True)
    partial = path.with_suffix(".partial")
    partial.write_text(json.dumps(table, indent=2) + "\n", encoding="utf-8")
    partial.replace(path)


def leave_part(core: str, check: str, part: str, passed: bool, count: int) -> None:
    """Leave one run of a check that has several, perhaps in several processes; `combine` sums them up."""
    part_path = FOLDER / "parts" / check / core / f"{part}.json"
    write(part_path, {"passed": passed, "count": count, "inputs": digest(core, check)})


def combine(core: str, check: str, expected: list[str], what: str) -> Path:
    """Leave the result of a check made of parts: passed once every expected part is there, fresh, and passed.

    Args:
        core: Name of the core.
        check: Name of the check.
        expected: Names of all its parts.
        what: Figure, with `{count}` for the sum of all counts.
    """
    # In turns: of two processes that leave the last parts, the later one has to see both.
    with locked(FOLDER / "parts" / check / core) as folder:
        inputs, parts = digest(core, check), {}
        for name in expected:
            path = folder / f"{name}.json"
            part = json.loads(path.read_text(encoding="utf-8")) if path.is_file() else {}
            if part.get("inputs") == inputs:
                parts[name] = part
        failed = [name for name, part in parts.items() if not part["passed"]]
        figure = what.format(count=f"{sum(part['count'] for part in parts.values()):,}")
        complete = len(parts) == len(expected)
        if not complete:
            figure += f" ({len(parts)} of {len(expected)} runs)"
        detail = {"failed": failed, "runs": parts}
        incomplete = not complete and not failed
        return leave(core, check, complete and not failed, figure, detail, incomplete=incomplete, inputs=inputs)


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
    except (ValueError, KeyError, TypeError, AttributeError) as error:
        raise UserError(f"{path.relative_to(ROOT)} is no result ({error!r}); run its check again.") from error
    if named != (core, check) or not isinstance(passed, bool):
        raise UserError(f"{path.relative_to(ROOT)} is the result of something else; run its check again.")
    # A result without a hash is of a time when none was kept.
    if result.get("inputs") != digest(core, check):
        return Cell("stale", f"stale: {figure}")
    if passed:
        return Cell("passed", figure)
    incomplete = result.get("incomplete") is True
    return Cell("missing", f"incomplete: {figure}") if incomplete else Cell("failed", f"FAILED: {figure}")


def rows() -> dict[str, dict[str, str]]:
    """Rows of the table: cores, then modules that cores share and that are proven alone; each with what is exempt."""
    plan = load_plan()
    alone = {check: "checked within the cores that use it" for check in CHECKS if check != "formal"}
    shared = [name for name in proven() if name not in core_names()]
    return {core: plan.get(core, {}).get("exempt", {}) for core in core_names()} | dict.fromkeys(shared, alone)


def read_table() -> dict[str, dict[str, Cell]]:
    """All cells: core, check."""
    return {core: {check: read_cell(core, check, exempt) for check in CHECKS} for core, exempt in rows().items()}


def state_of_inputs(cells: dict[str, dict[str, Cell]]) -> str:
    """Hash of all files on which the table depends; a clone of the same revision has the same."""
    places = [(core, check) for core, line in cells.items() for check, cell in line.items() if cell.state != "exempt"]
    return hash_of(f"{core} {check} {digest(core, check)}" for core, check in places)[:12]


def render(cells: dict[str, dict[str, Cell]]) -> str:
    """The table as Markdown: one row a core."""
    lines = [["core", *CHECKS], ["---"] * (len(CHECKS) + 1)]
    lines += [[core, *(cell.text for cell in line.values())] for core, line in cells.items()]
    return "\n".join(f"| {' | '.join(line)} |" for line in lines)


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

The results are about files whose hash is `{state}`; `make signoff` prints the hash of the files as they are.

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
    inputs = state_of_inputs(cells)
    print(f"hash of the files: {inputs}")
    if arguments.write:
        text = PAGE_TEXT.format(state=inputs, table=render(cells), reasons=reasons())
        PAGE.write_text(text, encoding="utf-8")
    if counts["failed"] + counts["stale"] + counts["missing"]:
        print("touchdown: not signed off; run `make test-full`, mend what it finds, and look again.", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    run_main(main)

# SPDX-License-Identifier: Apache-2.0
"""Which lines and branches of `firmware/core` its C unit tests reach: `python -m scripts.c_coverage [--missing]`.

The unit tests are built by gcc with `--coverage`, not optimised, and run; gcov counts. A branch is one outcome of one
jump that gcc makes of a condition, so `if (a && b)` has four. Nothing is left out of the count. Headers of MAVLink and
the tests themselves do not count, but for code of the core that a test includes once more.
"""

import json
import subprocess
from collections import defaultdict
from dataclasses import dataclass, field
from pathlib import Path

from scripts.errors import ArgumentParser, UserError, run_main

ROOT = Path(__file__).resolve().parent.parent
OBJECTS = ROOT / "build" / "firmware" / "coverage" / "core"
LINE_GOAL, BRANCH_GOAL = 0.95, 0.90


@dataclass
class Counted:
    """What the tests reached of one file.

    Attributes:
        lines: runs of each line that has code, by number.
        branches: for each line with conditions, how often each outcome was taken.
    """

    lines: dict[int, int] = field(default_factory=dict)
    branches: dict[int, list[int]] = field(default_factory=dict)

    def figures(self) -> tuple[int, int, int, int]:
        """Lines reached, lines, branches taken, branches."""
        outcomes = [count for counts in self.branches.values() for count in counts]
        reached = sum(count > 0 for count in self.lines.values())
        return reached, len(self.lines), sum(count > 0 for count in outcomes), len(outcomes)

    def missing(self) -> dict[int, str]:
        """What was not reached, by line."""
        found = {number: "not reached" for number, count in self.lines.items() if count == 0}
        for number, counts in self.branches.items():
            if number not in found and 0 in counts:
                found[number] = f"{counts.count(0)} of {len(counts)} outcomes not taken"
        return dict(sorted(found.items()))


def counted_of(report: dict, name: str) -> Counted:
    """Read one report of `gcov --json-format -b`.

    Args:
        report: the parsed JSON of one object.
        name: path of the source in it.

    Raises:
        ValueError: the report says nothing of that source.
    """
    lines = [line for file in report["files"] if file["file"].removeprefix("./") == name for line in file["lines"]]
    if not lines:
        raise ValueError(f"gcov says nothing of {name}")
    counted = Counted()
    branches = defaultdict(list)
    # A static function of a header is told once for each caller; a line of several functions adds up.
    for line in lines:
        number = line["line_number"]
        counted.lines[number] = counted.lines.get(number, 0) + line["count"]
        branches[number] += [branch["count"] for branch in line["branches"]]
    counted.branches = {number: counts for number, counts in branches.items() if counts}
    return counted


def measure() -> dict[str, Counted]:
    """Build the unit tests to be counted, run them, and read what gcov says of each source of the core.

    Raises:
        UserError: the build, a test or gcov fails.
    """
    command = ["make", "--no-print-directory", "-s", "-C", str(ROOT / "firmware"), "coverage"]
    run = subprocess.run(command, capture_output=True, text=True, check=False)
    if run.returncode != 0:
        raise UserError(f"the unit tests do not run: {(run.stdout + run.stderr).strip().splitlines()[-1]}.")
    found = {}
    for source in sorted((ROOT / "firmware" / "core").glob("*.c")):
        command = ["gcov", "--stdout", "--json-format", "--branch-probabilities", f"{source.name}.gcda"]
        run = subprocess.run(command, cwd=OBJECTS, capture_output=True, text=True, check=False)
        if run.returncode != 0 or not run.stdout:
            raise UserError(f"gcov has no count of {source.name}: {run.stderr.strip()}.")
        found[source.name] = counted_of(json.loads(run.stdout), f"core/{source.name}")
    return found


def share(part: int, whole: int) -> float:
    """A share of 0 to 1; of nothing all is reached."""
    return part / whole if whole else 1.0


def totals(found: dict[str, Counted]) -> tuple[float, float]:
    """Shares of lines and of branches that were reached, over all files."""
    rows = [counted.figures() for counted in found.values()]
    lines, all_lines, branches, all_branches = (sum(column) for column in zip(*rows, strict=True))
    return share(lines, all_lines), share(branches, all_branches)


def table(found: dict[str, Counted]) -> str:
    """One row a file, and the sum."""
    rows = [(name, *counted.figures()) for name, counted in found.items()]
    rows.append(("all", *(sum(column) for column in zip(*(row[1:] for row in rows), strict=True))))
    text = [f"{'file':18} {'lines':>12} {'':>6} {'branches':>12}"]
    for name, lines, all_lines, branches, all_branches in rows:
        text.append(
            f"{name:18} {f'{lines}/{all_lines}':>12} {100 * share(lines, all_lines):5.1f}%"
            f" {f'{branches}/{all_branches}':>12} {100 * share(branches, all_branches):5.1f}%"
        )
    return "\n".join(text)


def missing(found: dict[str, Counted]) -> str:
    """One line for each line of the core of which something was not reached."""
    text = []
    for name, counted in found.items():
        source = (ROOT / "firmware" / "core" / name).read_text(encoding="utf-8").splitlines()
        text += [f"{name}:{line}: {what}: {source[line - 1].strip()}" for line, what in counted.missing().items()]
    return "\n".join(text)


def main() -> int:
    """Entry point of `python -m scripts.c_coverage`."""
    parser = ArgumentParser(prog="python -m scripts.c_coverage", description=__doc__)
    parser.add_argument("--missing", action="store_true", help="print each line of which something is not reached")
    arguments = parser.parse_args()
    found = measure()
    if arguments.missing:
        print(missing(found))
    print(table(found))
    lines, branches = totals(found)
    if lines < LINE_GOAL or branches < BRANCH_GOAL:
        raise UserError(
            f"{lines:.1%} of the lines and {branches:.1%} of the branches are reached,"
            f" {LINE_GOAL:.0%} and {BRANCH_GOAL:.0%} are wanted; add tests."
        )
    return 0


if __name__ == "__main__":
    run_main(main)

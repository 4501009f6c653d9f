# SPDX-License-Identifier: Apache-2.0
"""How much of the firmware's core its C unit tests reach."""

import pytest

from scripts import c_coverage
from scripts.c_coverage import Counted


def test_unit_tests_reach_the_core(capsys: pytest.CaptureFixture) -> None:
    """95 % of the lines, 90 % of the branches. Replay: python -m scripts.c_coverage --missing."""
    found = c_coverage.measure()
    lines, branches = c_coverage.totals(found)
    with capsys.disabled():
        print(f"\nfirmware/core: {lines:.1%} of the lines, {branches:.1%} of the branches")
    report = f"{c_coverage.missing(found)}\n{c_coverage.table(found)}"
    assert lines >= c_coverage.LINE_GOAL, report
    assert branches >= c_coverage.BRANCH_GOAL, report


def line(number: int, count: int, *branches: int) -> dict:
    """A line as gcov tells it."""
    return {"line_number": number, "count": count, "branches": [{"count": taken} for taken in branches]}


def test_what_gcov_says_is_counted() -> None:
    lines = [line(3, 1), line(4, 5, 5, 0), line(5, 0), line(6, 0, 0, 0)]
    counted = c_coverage.counted_of({"files": [{"file": "./core/a.c", "lines": lines}]}, "core/a.c")
    assert counted.figures() == (2, 4, 1, 4)
    assert counted.missing() == {4: "1 of 2 outcomes not taken", 5: "not reached", 6: "not reached"}
    with pytest.raises(ValueError, match=r"nothing of core/b\.c"):
        c_coverage.counted_of({"files": []}, "core/b.c")


def test_shares_are_over_all_files() -> None:
    found = {"a.c": Counted({1: 1, 2: 0}, {1: [1, 0]}), "b.c": Counted({1: 1, 2: 1}, {})}
    assert c_coverage.totals(found) == (0.75, 0.5)
    assert c_coverage.table(found).splitlines()[-1].split() == ["all", "3/4", "75.0%", "1/2", "50.0%"]

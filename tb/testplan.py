# SPDX-License-Identifier: Apache-2.0
"""Reads `tb/testplan.toml`: for each core its testpoints, each with the tests that show it, and what does not apply."""

import ast
import tomllib
from functools import cache
from typing import Any

from tb.common.cores import ROOT

PLAN = ROOT / "tb/testplan.toml"
POINTS = (
    "latency",
    "stalls",
    "reset",
    "back_to_back",
    "short_line",
    "long_line",
    "early_sof",
    "sizes",
    "idle_x",
    "protocol",
    "arithmetic",
)
"""Testpoints that every core has, or says why not."""

Plan = dict[str, dict[str, Any]]


def load_plan() -> Plan:
    """Core to `{"points": {testpoint: [test, ...]}, "exempt": {testpoint or column of signoff: reason}}`."""
    return tomllib.loads(PLAN.read_text(encoding="utf-8"))


@cache
def tests_in(file: str) -> set[str]:
    """Names of the pytest functions, or in a file of cocotb tests of these, in a file given from the project root."""
    path = ROOT / file
    if not path.is_file():
        return set()
    found = set()
    for node in ast.parse(path.read_text(encoding="utf-8")).body:
        marks = [ast.unparse(mark) for mark in getattr(node, "decorator_list", [])]
        cocotb_test = isinstance(node, ast.AsyncFunctionDef) and any(mark.startswith("cocotb.test") for mark in marks)
        if cocotb_test or (isinstance(node, ast.FunctionDef) and node.name.startswith("test_")):
            found.add(node.name)
    return found


def own_file(core: str) -> str:
    """The file of the cocotb tests of a core."""
    return f"tb/{core}/test_{core}.py"


def faults(plan: Plan, cores: list[str], checks: tuple[str, ...]) -> list[str]:
    """What is wrong with a plan: a core, point or test that is missing, a name that nothing has, an empty reason.

    Args:
        plan: What `load_plan` gives.
        cores: Names of the cores there are.
        checks: Columns of the sign-off table, for which a core may be exempt.
    """
    found = [f"{core}: no such core" for core in plan if core not in cores]
    for core in cores:
        points, exempt = plan.get(core, {}).get("points", {}), plan.get(core, {}).get("exempt", {})
        found += [f"{core}: nothing shows {point}" for point in POINTS if point not in {*points, *exempt}]
        found += [f"{core}: {point} has no test" for point, tests in points.items() if not tests]
        found += [f"{core}: {point} is exempt but has tests" for point in exempt if point in points]
        found += [f"{core}: no reason for {name}" for name, reason in exempt.items() if not reason.strip()]
        if "formal" in points and not (ROOT / "formal" / core / "tasks.toml").is_file():
            found.append(f"{core}: formal/{core}/tasks.toml does not exist")
        found += [f"{core}: {name} is no point" for name in exempt if name not in {*POINTS, *checks}]
        named = set()
        for test in (test for tests in points.values() for test in tests):
            file, _, function = test.rpartition("::")
            named.add(function if not file or file == own_file(core) else "")
            if function not in tests_in(file or own_file(core)):
                found.append(f"{core}: there is no test {test}")
        found += [f"{core}: no testpoint names {test}" for test in sorted(tests_in(own_file(core)) - named)]
    return found

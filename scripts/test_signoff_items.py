# SPDX-License-Identifier: Apache-2.0
"""`make test-full` fills the whole table: every result is left by an item that pytest collects, the long ones first."""

import os
import subprocess
import sys

import pytest

from formal.tasks import load
from scripts.signoff import CHECKS, ROOT, rows
from tb.ccl.test_exhaustive import EXHAUSTIVE
from tb.common.cores import core_names, load_core
from tb.common.runner import SIMULATORS
from tb.exhaustive.test_every_input import PARTS

EVERY_INPUT = "tb/exhaustive/test_every_input.py::test_every_"
EXHAUSTIVE_ITEMS = {
    "ccl": ("tb/ccl/test_exhaustive.py::test_every_",),
    "median5x5": (f"{EVERY_INPUT}small_image[median5x5-", f"{EVERY_INPUT}neighbourhood_of_the_median"),
    "rgb2gray": (f"{EVERY_INPUT}colour",),
    "threshold_stats": (f"{EVERY_INPUT}factor_and_spread", f"{EVERY_INPUT}flat_limit_and_spread"),
}
"""How the names of the items begin that leave one part each; of the other cores each small image does."""


@pytest.fixture(scope="module")
def collected() -> list[str]:
    """Items of `make test-full`, in the order in which one worker runs them."""
    command = [sys.executable, "-m", "pytest", "--collect-only", "-q", "-p", "no:cacheprovider"]
    # How this run shows its items is nothing to the one that is asked.
    environment = {name: value for name, value in os.environ.items() if name != "PYTEST_ADDOPTS"}
    run = subprocess.run(command, cwd=ROOT, env=environment, capture_output=True, text=True, check=False)
    assert run.returncode == 0, run.stdout + run.stderr
    return [line for line in run.stdout.splitlines() if "::" in line]


def leaving(core: str, check: str) -> list[str]:
    """Items without which the result of a check of a core is not complete."""
    if check == "matrix":
        runs = [(index, sim) for index in range(len(load_core(core).configs)) for sim in SIMULATORS]
        return [f"tb/test_cores.py::test_core[{core}-{index}-{sim}]" for index, sim in runs]
    if check == "formal":
        tasks, faults = load(core)
        proofs = [f"formal/test_formal.py::test_proof[{task.id}]" for task in tasks]
        return proofs + [f"formal/test_formal.py::test_fault_is_found[{fault.id}]" for fault in faults]
    item = {
        "frames": "sim/test_full_frames.py::test_whole_frames",
        "mutation": f"tb/mutation/test_run.py::test_tests_of_the_core_kill_its_mutants[{core}]",
        "coverage": f"tb/coverage/test_points.py::test_core_reaches_its_goal[{core}]",
        "lint": "scripts/test_lint.py::test_lint_is_clean",
        "area": f"scripts/test_synth.py::test_core_is_within_its_budget[{core}]",
    }
    return [item[check]]


def test_every_result_is_left_by_an_item(collected: list[str]) -> None:
    cells = [(core, check) for core, exempt in rows().items() for check in CHECKS if check not in exempt]
    expected = [item for core, check in cells if check != "exhaustive" for item in leaving(core, check)]
    assert sorted(set(expected) - set(collected)) == []


def test_every_part_of_an_exhaustive_check_is_left_by_an_item(collected: list[str]) -> None:
    parts = {core: len(names) for core, (names, _) in PARTS.items()} | {"ccl": len(EXHAUSTIVE)}
    assert set(parts) == {core for core, exempt in rows().items() if "exhaustive" not in exempt}
    for core, count in parts.items():
        starts = EXHAUSTIVE_ITEMS.get(core, (f"{EVERY_INPUT}small_image[{core}-",))
        assert len([item for item in collected if item.startswith(starts)]) == count, core


def test_the_longest_start_first(collected: list[str]) -> None:
    assert collected[0] == "sim/test_full_frames.py::test_whole_frames"
    mutation = [index for index, item in enumerate(collected) if "kill_its_mutants" in item]
    assert mutation == list(range(1, 1 + len(core_names())))

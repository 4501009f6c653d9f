# SPDX-License-Identifier: Apache-2.0
"""The hash of a check changes with each kind of file that the check depends on, and with nothing else."""

import os
import shutil
from pathlib import Path

import pytest

from scripts import signoff_inputs
from scripts.signoff import CHECKS, rows
from scripts.signoff_inputs import digest
from tb.common import cores

FOLDERS = ("rtl", "golden", "tb", "formal", "sim", "scripts", "constraints")
IN_CORE = {"matrix", "exhaustive", "mutation", "coverage"}
OF_RTL = {"formal", "lint", "area", "frames", *IN_CORE}


@pytest.fixture(scope="module")
def clone(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The sources of the project in another place, with other times."""
    root = tmp_path_factory.mktemp("clone")
    for folder in FOLDERS:
        shutil.copytree(cores.ROOT / folder, root / folder, ignore=shutil.ignore_patterns("__pycache__"))
    return root


@pytest.fixture
def there(clone: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """As if the project lay there."""
    monkeypatch.setattr(signoff_inputs, "ROOT", clone)
    monkeypatch.setattr(cores, "ROOT", clone)
    return clone


def digests(*names: str) -> dict[tuple[str, str], str]:
    """Of every cell of some cores that is not exempt."""
    table = rows()
    return {(core, check): digest(core, check) for core in names for check in CHECKS if check not in table[core]}


def test_a_clone_has_the_same_hashes_whatever_its_times(clone: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    here = digests(*rows())
    monkeypatch.setattr(signoff_inputs, "ROOT", clone)
    monkeypatch.setattr(cores, "ROOT", clone)
    for file in clone.rglob("*.v"):
        os.utime(file, (1_000_000_000, 1_000_000_000))
    assert digests(*rows()) == here


@pytest.mark.parametrize(
    ("file", "checks", "others"),
    [
        ("rtl/ccl/ccl_send.v", OF_RTL, {"frames"}),
        ("rtl/ccl/core.toml", OF_RTL - {"frames"}, set()),
        ("rtl/generated/result_record.vh", OF_RTL, {"frames"}),
        ("rtl/common/frame_tracker.v", OF_RTL, OF_RTL),
        ("rtl/median5x5/median5x5.v", {"frames"}, {"frames"}),
        ("golden/ccl.py", {*IN_CORE, "frames"}, {"frames"}),
        ("golden/generated/landing_regs.py", {*IN_CORE, "frames"}, {"frames"}),
        ("tb/ccl/test_ccl.py", IN_CORE, set()),
        ("tb/ccl/exhaustive/main.cpp", IN_CORE, set()),
        ("tb/common/stream.py", IN_CORE, IN_CORE),
        ("tb/exhaustive/player.cpp", {"exhaustive"}, {"exhaustive"}),
        ("tb/mutation/operators.py", {"mutation"}, {"mutation"}),
        ("tb/coverage/points.py", {"coverage"}, {"coverage"}),
        ("tb/mutation/test_run.py", set(), set()),
        ("formal/ccl/tasks.toml", {"formal"}, set()),
        ("formal/common/axis_rules.sv", {"formal"}, {"formal"}),
        ("sim/verilated/taps.vlt", {"frames"}, {"frames"}),
        ("sim/icarus/landing_bench.v", {"frames"}, {"frames"}),
        ("scripts/lint/verilator.vlt", {"lint"}, {"lint"}),
        ("scripts/synth.py", {"area"}, {"area"}),
        ("scripts/demo.py", set(), set()),
    ],
)
def test_a_change_counts_where_it_matters(there: Path, file: str, checks: set[str], others: set[str]) -> None:
    """In the checks of ccl and, `others`, in those of dilate3x3, which shares the frame tracker with it."""
    before = digests("ccl", "dilate3x3", "video_in")
    path = there / file
    text = path.read_bytes()
    path.write_bytes(text + b"\n")
    try:
        changed = {cell for cell, value in digests("ccl", "dilate3x3", "video_in").items() if value != before[cell]}
    finally:
        path.write_bytes(text)
    assert {check for core, check in changed if core == "ccl"} == checks
    assert {check for core, check in changed if core == "dilate3x3"} == others


@pytest.mark.parametrize(
    ("file", "old", "new", "cells"),
    [
        ("constraints/budgets.toml", "[ccl]\nlut = ", "[ccl]\nlut = 1", {("ccl", "area")}),
        ("tb/mutation/cores.toml", "[ccl]\nmutants = ", "[ccl]\nmutants = 1", {("ccl", "mutation")}),
        (
            "tb/coverage/waivers.toml",
            '[[waiver]]\ncores = ["ccl"]',
            '[[waiver]]\ncores = ["ccl", "video_in"]',
            {("ccl", "coverage"), ("video_in", "coverage")},
        ),
    ],
)
def test_of_a_shared_table_only_the_own_part_counts(
    there: Path, file: str, old: str, new: str, cells: set[tuple[str, str]]
) -> None:
    before = digests("ccl", "dilate3x3", "video_in")
    path = there / file
    text = path.read_text(encoding="utf-8")
    assert old in text
    path.write_text(text.replace(old, new, 1), encoding="utf-8")
    try:
        assert {
            cell for cell, value in digests("ccl", "dilate3x3", "video_in").items() if value != before[cell]
        } == cells
    finally:
        path.write_text(text, encoding="utf-8")

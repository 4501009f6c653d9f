# SPDX-License-Identifier: Apache-2.0
"""The count of killed mutants can fail: survivors, hangs, broken runs and stale entries are seen."""

import json
import sys
from itertools import pairwise
from pathlib import Path

import pytest

from scripts.errors import UserError
from tb.common.cores import ROOT, core_names, load_core
from tb.common.runner import check_simulator
from tb.mutation.operators import Mutant
from tb.mutation.plan import DEFAULT_SEED, Fault, chosen, plan
from tb.mutation.run import Entry, check_equivalents, equivalents, report, run
from tb.mutation.simulate import CPU_SECONDS, judge, simulate

COLOUR = ROOT / "rtl/rgb2gray/rgb2gray.v"


def entries(*verdicts: str) -> list[Entry]:
    """Return mutants that ended like this."""
    fault = Fault(COLOUR, Mutant("constant", 0, 0, "", 1, "before", "after"))
    return [Entry(fault, verdict, "", 0, 1.0) for verdict in verdicts]


def test_survivors_fail_the_core() -> None:
    core = load_core("rgb2gray")
    assert report(core, entries(*["killed"] * 18, "hang", "survived"), True)["passed"]
    assert not report(core, entries(*["killed"] * 18, "survived", "survived"), True)["passed"]
    assert not report(core, entries(*["killed"] * 18, "survived", "equivalent"), True)["passed"]
    assert not report(core, entries(*["killed"] * 50, "broken"), True)["passed"]
    assert not report(core, entries("killed"), False)["passed"]
    assert not report(core, entries("equivalent"), True)["passed"]


def test_verdicts() -> None:
    assert judge(0, ["3 tests passed"], 1, 400).verdict == "survived"
    assert judge(1, ["2 of 9 tests failed:", "tb.x.latency failed"], 1, 400).reason == "tb.x.latency failed"
    assert judge(1, ["the simulation crashed:"], 399.5, 400).verdict == "hang"
    assert judge(1, ["build failed:", "no such file"], 1, 400).verdict == "broken"
    assert judge(-9, [], 0, 400).verdict == "broken"


def test_simulations(tmp_path: Path) -> None:
    check_simulator("icarus")
    core = load_core("rgb2gray")
    assert simulate(core, core.sources, 0, tmp_path / "same").verdict == "survived"
    text = COLOUR.read_text(encoding="utf-8")
    for name, old, new, limit, verdict in [
        ("rounding", "23'd16384", "23'd16383", CPU_SECONDS, "killed"),
        (
            "loop",
            "wire             advance;",
            "wire advance; reg l; initial l = 0; always @(l) l = !l;\ninitial l = 1;",
            3,
            "hang",
        ),
        ("syntax", "endmodule", "end", CPU_SECONDS, "broken"),
    ]:
        assert text.count(old) == 1
        copy = tmp_path / name / COLOUR.name
        copy.parent.mkdir()
        copy.write_text(text.replace(old, new), encoding="utf-8")
        sources = tuple(copy if source == COLOUR else source for source in core.sources)
        assert simulate(core, sources, 0, copy.parent, limit).verdict == verdict, name


def test_the_choice_is_the_same_again() -> None:
    core = load_core("rgb2gray")
    first = [fault.key for fault in chosen(core, 6, 1)]
    assert first == [fault.key for fault in chosen(core, 6, 1)]
    assert first != [fault.key for fault in chosen(core, 6, 2)]
    with pytest.raises(UserError, match="only"):
        list(chosen(core, 10000, 1))


def test_a_fault_that_is_not_elaborated_is_passed_over() -> None:
    core = load_core("erode3x3")
    files = {fault.key[:2] for fault in chosen(core, 60, 1)}
    assert (
        "rtl/common/window_cols.v",
        "assign before_ok[1] = !first_reg[CENTRE] && !first_reg[CENTRE-1];",
    ) not in files


@pytest.mark.parametrize("name", core_names())
def test_every_entry_is_a_mutant(name: str) -> None:
    core = load_core(name)
    faults = list(chosen(core, plan(name)[0], DEFAULT_SEED))
    listed = equivalents(name)
    check_equivalents(name, listed, faults)
    with pytest.raises(UserError, match="no mutant of it"):
        check_equivalents(name, [*listed, ("rtl/x.v", "a", "b")], faults)


def test_entries_are_complete(tmp_path: Path) -> None:
    path = tmp_path / "equivalent.toml"
    path.write_text('[[equivalent]]\ncores = ["ccl"]\nfile = "f"\nbefore = "b"\nafter = "a"\nreason = ""\n')
    with pytest.raises(UserError, match="mend"):
        equivalents("ccl", path)


def test_what_earlier_tests_killed_is_signed_off_for_those(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A resumed run keeps the hash of the run before; a whole one has that of the files as they are."""
    module = sys.modules[run.__module__]
    abouts = []

    def leave(core: str, check: str, *result: object, inputs: str, **_: object) -> None:
        abouts.append(inputs)
        table = {"inputs": inputs, "detail": result[-1]}
        (tmp_path / f"{core}.json").write_text(json.dumps(table), encoding="utf-8")

    monkeypatch.setattr(module, "REPORTS", tmp_path)
    monkeypatch.setattr(module, "leave", leave)
    monkeypatch.setattr(module, "attempt", lambda core, fault, configs: Entry(fault, "killed", "", 0, 1.0))
    monkeypatch.setattr(module, "check_unchanged", lambda core, config: None)
    for state, resume in (("before", False), ("now", True), ("now", False)):
        monkeypatch.setattr(module, "digest_of_inputs", lambda core, check, state=state: state)
        assert run(load_core("rgb2gray"), DEFAULT_SEED, 1, resume)["passed"]
        abouts.append("end")
    assert [about for about, after in pairwise(abouts) if after == "end"] == ["before", "before", "now"]


@pytest.mark.full
@pytest.mark.parametrize("name", core_names())
def test_tests_of_the_core_kill_its_mutants(name: str) -> None:
    result = run(load_core(name), DEFAULT_SEED, jobs=1, resume=False)
    assert result["passed"], result["figure"]

# SPDX-License-Identifier: Apache-2.0
"""Missed points are seen, waivers stay honest; each core reaches its goal (full)."""

import sys
from pathlib import Path

import pytest

from scripts.errors import UserError
from tb.common.cores import core_names, load_core
from tb.common.runner import check_simulator
from tb.coverage.points import Point, Waiver, folded, load_waivers, merge, missed, read_points, waive
from tb.coverage.run import WAIVERS, passes, run


def record(line: int, what: str, count: int, kind: str = "toggle", instance: str = "top") -> str:
    """Return a line as Verilator writes it."""
    fields = {"f": "/p/rtl/a.v", "l": line, "n": 1, "t": kind, "page": f"v_{kind}/a__W8", "o": what, "h": instance}
    return "C '" + "".join(f"\x01{key}\x02{value}" for key, value in fields.items()) + f"' {count}\n"


BITS = record(3, "x[0]:0->1", 5) + record(3, "x[1]:0->1", 0) + record(3, "x[1]:1->0", 0) + record(4, "y:0->1", 0)
TEXTS = {("rtl/a.v", 3): "reg [1:0] x;", ("rtl/a.v", 4): "reg y;", ("rtl/a.v", 5): "if (y) begin"}


def test_instances_and_configs_are_merged() -> None:
    one = read_points("# SystemC::Coverage-3\n" + BITS + record(3, "x[1]:0->1", 2, instance="top.b"), Path("/p"))
    assert len(one) == 4
    assert [point.what for point in missed(one)] == ["x[1]:1->0", "y:0->1"]
    two = read_points(record(4, "y:0->1", 1), Path("/p"))
    assert [point.what for point in missed(merge([one, two]))] == ["x[1]:1->0"]


def test_missed_bits_are_shown_once() -> None:
    points = missed(read_points(BITS + record(5, "if", 0, "branch"), Path("/p")))
    assert folded(points) == {("rtl/a.v", 3): ["x[1]"], ("rtl/a.v", 4): ["y:0->1"], ("rtl/a.v", 5): ["branch if"]}


def test_waivers() -> None:
    points = missed(read_points(BITS + record(5, "if", 0, "branch"), Path("/p")))
    bit = Waiver(("ccl",), "rtl/a.v", r"x\[1\]", "", "because")
    branch = Waiver(("ccl",), "rtl/a.v", "", "if (y) begin", "because")
    stay, waived = waive("ccl", points, TEXTS, [bit, branch])
    assert [point.what for point in stay] == ["y:0->1"]
    assert len(waived) == 3
    assert waive("erode3x3", points, TEXTS, [bit, branch])[0] == points
    with pytest.raises(UserError, match="matches no missed point"):
        waive("ccl", stay, TEXTS, [bit])


def test_waivers_are_complete(tmp_path: Path) -> None:
    load_waivers(WAIVERS)
    path = tmp_path / "waivers.toml"
    path.write_text('[[waiver]]\ncores = ["ccl"]\nfile = "rtl/a.v"\nreason = "r"\n')
    with pytest.raises(UserError, match="mend"):
        load_waivers(path)


def test_the_goal_can_be_missed() -> None:
    assert passes(95, 100)
    assert not passes(94, 100)
    assert not passes(0, 0)


def test_points_are_ordered_by_place() -> None:
    assert Point("a.v", 2, 1, "toggle", "z") < Point("a.v", 10, 1, "branch", "a")


@pytest.mark.parametrize(("reuse", "leaves"), [(False, ["rgb2gray"]), (True, [])])
def test_records_of_an_earlier_run_are_not_left(
    monkeypatch: pytest.MonkeyPatch, reuse: bool, leaves: list[str]
) -> None:
    left = []
    module = sys.modules[run.__module__]
    monkeypatch.setattr(module, "measure", lambda core, reuse: {Point("rtl/a.v", 1, 1, "line", "x"): 1})
    monkeypatch.setattr(module, "load_waivers", lambda path: [])
    monkeypatch.setattr(module, "leave", lambda core, *_, **__: left.append(core))
    assert run(load_core("rgb2gray"), reuse)
    assert left == leaves


@pytest.mark.full
@pytest.mark.parametrize("name", core_names())
def test_core_reaches_its_goal(name: str) -> None:
    check_simulator("verilator")
    assert run(load_core(name), reuse=False)

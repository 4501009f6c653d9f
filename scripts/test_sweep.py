# SPDX-License-Identifier: Apache-2.0
"""Each build of constraints/sweeps.toml stands in docs/area.md, and parameters reach the RTL."""

import pytest

from scripts import sweep
from scripts.errors import UserError
from scripts.page_block import find_block
from scripts.sweep import Build, area, builds
from tb.common.cores import core_names


def test_the_page_has_every_build() -> None:
    text = sweep.PAGE.read_text(encoding="utf-8")
    for core in {build.core for build in builds()}:
        lines = find_block(text, core, "docs/area.md")[0].splitlines()[2:]
        assert [line.split(" | ")[0].removeprefix("| ") for line in lines] == [one.what for one in builds(core)]
        assert core in core_names()


def test_the_page_has_what_the_pages_of_the_cores_say() -> None:
    written = find_block(sweep.PAGE.read_text(encoding="utf-8"), "cores", "docs/area.md")[0]
    assert written == sweep.cores_table() + "\n", "run `python -m scripts.sweep --write`"
    assert written.count("\n") == len(core_names()) + 2


def test_the_comparison_with_another_core_has_the_figures_of_the_sweep() -> None:
    """Its row of ours is written by hand, since the other core is not here to be measured."""
    text = sweep.PAGE.read_text(encoding="utf-8")
    swept = find_block(text, "ccl", "docs/area.md")[0].splitlines()[2].strip("| ").split(" | ")
    (row,) = [line.strip("| ").split(" | ") for line in text.splitlines() if line.startswith("| `ccl` | ")]
    lut, srl, lutram, ff, bram36, bram18, _ = swept[1:]
    assert row[1:6] == [lut, srl, lutram, ff, str(int(bram36) + int(bram18) // 2)]


def test_parameters_count() -> None:
    """A wider line takes more flip-flops, and nothing else of the core changes."""
    narrow, wide = (area(Build("overlay", "", {"MAX_WIDTH": width})) for width in (64, 8191))
    assert narrow.ff < wide.ff
    assert (narrow.bram36, narrow.dsp) == (wide.bram36, wide.dsp)


@pytest.mark.parametrize(
    ("core", "sentence"), [("nothing", "no build of 'nothing'; choose one of: ccl"), ("lidar_pwm", "no build of")]
)
def test_a_core_without_builds_is_one_sentence(core: str, sentence: str) -> None:
    with pytest.raises(UserError, match=sentence):
        builds(core)


def test_what_yosys_refuses_is_one_sentence() -> None:
    with pytest.raises(UserError, match="overlay, too wide: yosys refuses"):
        area(Build("overlay", "too wide", {"MAX_WIDTH": 9000}))


@pytest.mark.full
@pytest.mark.parametrize("core", sorted({build.core for build in builds()}))
def test_figures_are_those_of_the_page(core: str) -> None:
    written = find_block(sweep.PAGE.read_text(encoding="utf-8"), core, "docs/area.md")[0]
    rows = [sweep.row(build.what, area(build)) for build in builds(core)]
    assert written == sweep.table(rows) + "\n", f"run `python -m scripts.sweep --core {core} --write`"

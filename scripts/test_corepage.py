# SPDX-License-Identifier: Apache-2.0
"""Every core's page has the agreed shape and says of ports, parameters and timing what the RTL does; drift is seen."""

import re
from dataclasses import replace
from pathlib import Path

import pytest

from scripts import corepage
from scripts import corepage_timing as timing
from scripts.corepage import header_faults, header_of, page_faults, put_block, read_page
from scripts.corepage_timing import drawn, driven
from scripts.errors import UserError
from tb.common.cores import ROOT, core_names, load_core


@pytest.mark.parametrize("core", core_names())
def test_page_agrees_with_the_rtl(core: str) -> None:
    assert page_faults(core, read_page(core)) == []


CHANGES = {
    "wrong width": ("| `s_axis_tdata` | in | 8 |", "| `s_axis_tdata` | in | 9 |", "the RTL has `s_axis_tdata` in 8"),
    "wrong direction": ("| `frame_error` | out |", "| `frame_error` | in |", "the page has `frame_error` in 1"),
    "missing port": ("| `rst` | in | 1 | reset, synchronous to `clk`, active high |\n", "", "the RTL has `rst` in 1"),
    "unknown port": ("| `rst` | in |", "| `enable` | in |", "the page has `enable` in 1"),
    "wrong default": ("| `MAX_WIDTH` | 1280 |", "| `MAX_WIDTH` | 1920 |", "the RTL has `MAX_WIDTH` 1280"),
    "missing section": ("## Rounding\n", "", "no section 'Rounding'"),
    "empty section": ("Half up, once, at the end; intermediate sums are exact.", "", "no section 'Rounding'"),
    "other latency": ("2 pixels and 14 cycles", "2 pixels and 13 cycles", "the latency of the header is not that"),
    "order": ("## Rounding\n", "## Overflow\nNone.\n\n## Rounding\n", "sections are not in the order"),
    "no purpose": ("Gaussian blur, bit-exact", "## Gaussian blur", "does not begin with its name and purpose"),
    "wrong wave": (
        '"name": "m_axis_tuser", "wave": "x.',
        '"name": "m_axis_tuser", "wave": "0.',
        "not those of the RTL",
    ),
    "other input": ('"10", "FF"', '"10", "0F"', "not those of the RTL"),
    "picture not shown": ("](../pictures/cores/gaussian5x5.svg)", "](../pictures/cores/ccl.svg)", "shows no picture"),
}


@pytest.mark.parametrize("change", CHANGES)
def test_drift_is_seen(change: str) -> None:
    before, after, sentence = CHANGES[change]
    text = read_page("gaussian5x5")
    assert before in text
    found = page_faults("gaussian5x5", text.replace(before, after, 1))
    assert any(sentence in fault for fault in found), found


@pytest.mark.parametrize(
    ("before", "after", "fault"),
    [
        ("14 cycles", "13 cycles", "gaussian5x5: the latency of the header is not that of the page"),
        ("2 lines", "two lines", ""),
        (
            "Latency     2 lines, 2 pixels and 14 cycles; with more pixels a beat, a beat in place of the pixels.",
            "Latency     short.",
            "gaussian5x5: the header gives no latency",
        ),
        ("Borders", "Edges", "gaussian5x5: the header says nothing of 'Border'"),
        ("overflow", "surprise", "gaussian5x5: the header says nothing of 'Overflow'"),
    ],
)
def test_drift_of_a_header_is_seen(before: str, after: str, fault: str) -> None:
    header = header_of("gaussian5x5")
    assert before in header
    found = header_faults("gaussian5x5", read_page("gaussian5x5"), header.replace(before, after, 1))
    assert found == ([fault] if fault else [])


def test_a_picture_of_something_else_is_seen(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(corepage, "PICTURES", tmp_path)
    text = read_page("gaussian5x5")
    stale = ["gaussian5x5: the picture is not that of its JSON; run `python -m scripts.corepage --write`"]
    assert page_faults("gaussian5x5", text) == stale
    (tmp_path / "gaussian5x5.svg").write_text((ROOT / "docs/pictures/cores/erode3x3.svg").read_text())
    assert page_faults("gaussian5x5", text) == stale


@pytest.mark.parametrize(
    ("before", "after", "sentence"),
    [
        ('"wave": "p', '"wave": p', "cannot be played"),
        ('"name": "s_axis_tdata"', '"name": "s_axis_data"', "is no port of the core"),
        ('"wave": "x1', '"wave": "|1', "cannot be played"),
        ('"MAX_WIDTH": 8', '"MAX_WIDTH": 1', "does not elaborate"),
        ('"name": "clk", "wave": "p..', '"name": "clk", "wave": "p.|', "cannot be played"),
        ('"set"', '"gaps": [3], "set"', "cannot be played"),
        ("```json", "```", "put WaveDrom JSON there"),
    ],
)
def test_unusable_timing_is_one_sentence(before: str, after: str, sentence: str) -> None:
    text = read_page("gaussian5x5")
    assert before in text
    with pytest.raises(UserError, match=sentence):
        page_faults("gaussian5x5", text.replace(before, after, 1))


def test_what_the_rtl_does_is_what_is_drawn(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A core that is one clock slower, with the page of the right one."""
    core = load_core("rgb2gray")
    slow = tmp_path / "rgb2gray.v"
    right = core.sources[-1].read_text()
    wrong = right.replace("m_axis_tvalid", "early_tvalid")
    delay = "reg late; always @(posedge clk) late <= early_tvalid; wire early_tvalid; assign m_axis_tvalid = late;\n"
    wrong = re.sub(r"(output wire +)early_tvalid", r"\1m_axis_tvalid", wrong)
    slow.write_text(wrong.replace(");\n", f");\n{delay}", 1))
    monkeypatch.setattr(timing, "load_core", lambda name: replace(core, sources=(*core.sources[:-1], slow)))
    assert any("not those of the RTL" in fault for fault in page_faults("rgb2gray", read_page("rgb2gray")))


def changed_prelude(folder: Path, monkeypatch: pytest.MonkeyPatch, before: str, after: str) -> list[str]:
    """Faults of the page of landing_core when its prelude says something else."""
    text = (timing.PAGES / "landing_core_frame.vh").read_text()
    assert text.count(before) == 1
    (folder / "landing_core_frame.vh").write_text(text.replace(before, after))
    monkeypatch.setattr(timing, "PAGES", folder)
    return page_faults("landing_core", read_page("landing_core"))


@pytest.mark.parametrize(
    ("before", "after"),
    [
        ("SQUARE_LEFT = 5", "SQUARE_LEFT = 4"),
        ("32'h80);  // THRESHOLD", "32'h81);  // THRESHOLD"),
        ("32'h1000);  // RING_BASE", "32'h2000);  // RING_BASE"),
        ("24'h101010", "24'h000000 + {24{y == SQUARE_TOP}}"),
    ],
)
def test_drift_of_a_prelude_is_seen(before: str, after: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    found = changed_prelude(tmp_path, monkeypatch, before, after)
    assert "landing_core: the waves are not those of the RTL; run `python -m scripts.corepage --write`" in found


@pytest.mark.parametrize(
    ("before", "after", "sentence"),
    [
        ("task prelude;", "task overture;", "does not elaborate"),
        ("    start_frame;\n", "    wait (0);\n", "landing_core.md does not end within 2000 clocks"),
        ("ANSWER_CLOCKS = 3", "ANSWER_CLOCKS = 5", "m_axi_bvalid changes in clock 2 of the gap in column 26; draw"),
        ("LAST_LINE - 1", "LAST_LINE", "m_axi_awaddr changes"),
    ],
)
def test_unusable_prelude_is_one_sentence(
    before: str, after: str, sentence: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(timing, "LIMIT_CLOCKS", 2000)
    with pytest.raises(UserError, match=sentence):
        changed_prelude(tmp_path, monkeypatch, before, after)


def test_waves_of_inputs_and_outputs() -> None:
    assert driven("x1.0=.", ["A5"], 8) == ["8'bx", "8'd1", "8'd1", "8'd0", "8'hA5", "8'hA5"]
    assert drawn(["x0", "0x", "01", "01", "11"]) == ("x.=.=", ["1", "3"])
    assert drawn(["0", "1", "1", "x", "0"]) == ("01.x0", [])
    assert drawn(["01", "01", "11", "11"], [1]) == ("=|=.", ["1", "3"])


def test_a_block_is_replaced_and_nothing_else(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(corepage, "PAGES", tmp_path)
    (tmp_path / "ccl.md").write_text("before\n<!-- resources -->\nold\n<!-- /resources -->\nafter\n")
    put_block("ccl", "resources", "new")
    assert read_page("ccl") == "before\n<!-- resources -->\nnew\n<!-- /resources -->\nafter\n"
    with pytest.raises(UserError, match="<!-- weather -->"):
        put_block("ccl", "weather", "fine")
    with pytest.raises(UserError, match="does not exist"):
        read_page("erode3x3")

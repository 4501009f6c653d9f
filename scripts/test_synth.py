# SPDX-License-Identifier: Apache-2.0
"""Every core stays within its budget, its page has the figures, and the check sees what it is for."""

from dataclasses import replace
from pathlib import Path

import pytest

from scripts import synth
from scripts.corepage import block_of, page_path
from tb.common.cores import core_names

PORTS = "module dut(input wire clk, input wire en, input wire [9:0] a, input wire [7:0] d, output reg [7:0] q);\n"
MEMORY = "reg [7:0] m [0:1023]; always @(posedge clk) begin if (en) m[a] <= d; q <= m[a]; end"
MEMORY_READ_AT_ONCE = "reg [7:0] m [0:1023]; always @(posedge clk) if (en) m[a] <= d; always @* q = m[a];"
FAULTS = {
    "latch": ("always @* if (en) q = d;", "yosys refuses dut"),
    "loop": ("wire [7:0] n; assign n = ~(n & d); always @* q = n;", "yosys refuses dut"),
    "two_drivers": ("wire n; assign n = en; assign n = d[0]; always @* q = n;", "yosys refuses dut"),
}


def cores() -> list[object]:
    """One pytest parameter a core; the whole landing_core takes too long for `make test`."""
    return [pytest.param(core, marks=pytest.mark.full if core == "landing_core" else ()) for core in core_names()]


@pytest.mark.parametrize("core", cores())
def test_core_is_within_its_budget(core: str) -> None:
    area, found = synth.measure(core)
    assert found == []
    text = page_path(core).read_text(encoding="utf-8")
    written = block_of(core, text, "resources")[0]
    stale = f"docs/cores/{core}.md is stale; run `python -m scripts.synth --core {core} --write`"
    assert written == synth.table(area, synth.budgets()[core]) + "\n", stale


@pytest.mark.parametrize("fault", FAULTS)
def test_yosys_refuses(fault: str, tmp_path: Path) -> None:
    body, sentence = FAULTS[fault]
    source = tmp_path / "dut.v"
    source.write_text(f"{PORTS}{body}\nendmodule\n")
    with pytest.raises(ValueError, match=sentence):
        synth.synthesise("dut", [str(source)])


def test_a_register_that_yosys_takes_from_its_readers_is_seen(tmp_path: Path) -> None:
    """It packs a difference and its register into a multiplier and leaves the other reader without a driver."""
    source = tmp_path / "dut.v"
    ports = "input wire clk, input wire signed [13:0] a, b, output reg signed [28:0] p, output reg [14:0] q"
    registers = "reg signed [13:0] a_reg, b_reg, c_reg; {keep} reg signed [14:0] d_reg;"
    body = "a_reg <= a; b_reg <= b; c_reg <= a_reg; d_reg <= b_reg - a_reg; p <= c_reg * d_reg; q <= d_reg;"
    text = f"module dut({ports}); {registers} always @(posedge clk) begin {body} end endmodule\n"
    source.write_text(text.format(keep="(* keep *)"))
    assert synth.synthesise("dut", [str(source)]).dsp == 1
    source.write_text(text.format(keep=""))
    with pytest.raises(ValueError, match="yosys refuses dut"):
        synth.synthesise("dut", [str(source)])


def test_a_memory_that_becomes_lutram_is_seen(tmp_path: Path) -> None:
    budget = {"lut": 1000, "ff": 1000, "bram36": 0, "bram18": 1, "dsp": 0}
    found = []
    for body in (MEMORY, MEMORY_READ_AT_ONCE):
        source = tmp_path / "dut.v"
        source.write_text(f"{PORTS}{body}\nendmodule\n")
        found.append(synth.faults(synth.synthesise("dut", [str(source)]), budget))
    assert found == [[], ["0 BRAM18, not 1"]]


@pytest.mark.parametrize("primitive", ["LDCE", "LDPE", "DSP48E2"])
def test_a_primitive_nobody_expects_is_seen(primitive: str) -> None:
    with pytest.raises(ValueError, match=primitive):
        synth.area_of({"LUT2": 3, primitive: 1})


def test_every_kind_of_lut_counts() -> None:
    area = synth.area_of({"LUT6": 5, "INV": 1, "SRL16E": 2, "RAM64M": 3, "FDRE": 7, "FDPE": 1, "CARRY4": 9})
    assert area == synth.Area(logic=6, srl=2, lutram=12, ff=8, bram36=0, bram18=0, dsp=0)
    assert area.lut == 20


def test_each_figure_beyond_its_budget_is_seen() -> None:
    area = synth.Area(logic=90, srl=5, lutram=5, ff=100, bram36=2, bram18=1, dsp=3)
    budget = {"lut": 100, "ff": 100, "bram36": 2, "bram18": 1, "dsp": 3}
    assert synth.faults(area, budget) == []
    for name in ("logic", "srl", "lutram", "ff", "bram36", "bram18", "dsp"):
        more = replace(area, **{name: getattr(area, name) + 1})
        assert len(synth.faults(more, budget)) == 1, name
    for name in ("bram36", "bram18", "dsp"):
        fewer = replace(area, **{name: getattr(area, name) - 1})
        assert len(synth.faults(fewer, budget)) == 1, name


def test_half_of_the_paper_is_the_limit() -> None:
    most = synth.Area(logic=7450, srl=0, lutram=0, ff=10680, bram36=20, bram18=8, dsp=12)
    assert synth.beyond_half_of_paper(most) == []
    for name in ("srl", "ff", "bram18", "dsp"):
        assert len(synth.beyond_half_of_paper(replace(most, **{name: getattr(most, name) + 1}))) == 1, name

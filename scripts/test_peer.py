# SPDX-License-Identifier: Apache-2.0
"""A core from elsewhere goes the way of ours, and what cannot is one sentence."""

from pathlib import Path

import pytest

from scripts import peer
from scripts.errors import UserError
from scripts.nextpnr import Nextpnr

COUNTER = """module counter #(parameter BITS = 4) (input wire clk, input wire go, output reg [BITS-1:0] count);
    always @(posedge clk) if (go) count <= count + 1'b1;
endmodule
"""


def call(monkeypatch: pytest.MonkeyPatch, *arguments: str) -> int:
    monkeypatch.setattr("sys.argv", ["peer", *arguments])
    return peer.main()


@pytest.fixture
def counter(tmp_path: Path) -> Path:
    path = tmp_path / "counter.v"
    path.write_text(COUNTER)
    return path


def test_area_and_the_slowest_clock(
    counter: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture
) -> None:
    """The parameter reaches both: 8 flip-flops are counted, and the netlist has them, twice 8 behind and one before."""
    program = tmp_path / "nextpnr"
    program.write_text(
        '#!/bin/sh\nwhile [ "$1" != --seed ]; do [ "$1" = --json ] && json=$2; shift; done\n'
        """[ $(grep -c '"type": "FDRE"' $json) = 25 ] || exit 1\n"""
        "echo \"Info: Max frequency for clock 'clk': $((400 - 10 * $2)).00 MHz (PASS at 150.00 MHz)\"\n"
    )
    program.chmod(0o755)
    monkeypatch.setattr(peer, "the_tool", lambda: Nextpnr((str(program),)))
    assert call(monkeypatch, "--top", "counter", "--set", "BITS=8", str(counter)) == 0
    out = capsys.readouterr().out
    assert ", 8 FF, " in out
    assert "counter: 370.0 MHz, the slowest of seeds with 390.0, 380.0, 370.0" in out


def test_without_nextpnr_the_area_is_still_there(
    counter: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture
) -> None:
    monkeypatch.setattr(peer, "the_tool", lambda: None)
    assert call(monkeypatch, "--top", "counter", str(counter)) == 0
    assert ", 4 FF, " in capsys.readouterr().out


def test_what_yosys_refuses_is_one_sentence(
    counter: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture
) -> None:
    assert call(monkeypatch, "--top", "other", str(counter)) == 1
    (line,) = capsys.readouterr().err.splitlines()
    assert line.startswith("touchdown: yosys refuses other")


def test_a_core_without_clk_is_one_sentence(counter: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    counter.write_text(COUNTER.replace("clk", "clock"))
    with pytest.raises(UserError, match="counter has no port `clk`"):
        call(monkeypatch, "--top", "counter", str(counter))


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        ([], "say --core and a core of this project, or --top"),
        (["--top", "counter"], "say --core"),
        (["--core", "ccl", "--top", "counter", "x.v"], "say --core"),
        (["--core", "ccl", "x.v"], "say --core"),
        (["--core", "nothing"], "'nothing'"),
        (["--top", "counter", "nowhere.v"], "there is no file 'nowhere.v'; name the Verilog sources of counter"),
        (["--core", "ccl", "--set", "AREA"], "--set takes NAME=VALUE with a whole number, not 'AREA'"),
        (["--core", "ccl", "--set", "AREA=x"], "not 'AREA=x'"),
        (["--core", "ccl", "--set", "=1"], "not '=1'"),
    ],
)
def test_bad_arguments_are_one_sentence(arguments: list[str], sentence: str, monkeypatch: pytest.MonkeyPatch) -> None:
    with pytest.raises(UserError, match=sentence):
        call(monkeypatch, *arguments)

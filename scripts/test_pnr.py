# SPDX-License-Identifier: Apache-2.0
"""The design around a core, reading nextpnr's figures, and what is said where nextpnr is not to be had."""

from pathlib import Path

import pytest

from scripts import nextpnr, pnr
from scripts.nextpnr import Nextpnr, NotRoutedError
from scripts.pnr_harness import constraints, harness, ports_of
from scripts.synth import budgets
from tb.common.cores import core_names, load_core

LOG = """Info: Max frequency for clock 'core.clk': 90.10 MHz (FAIL at 150.00 MHz)
Info: Max frequency for clock 'pix_clk$SRC_BUF': 300.00 MHz (PASS at 150.00 MHz)
Info: routed
Info: Max frequency for clock 'core.clk': 151.25 MHz (PASS at 150.00 MHz)
Info: Max frequency for clock 'pix_clk$SRC_BUF': 280.50 MHz (PASS at 150.00 MHz)
"""


def fake(folder: Path, script: str) -> Nextpnr:
    program = folder / "nextpnr"
    program.write_text(f"#!/bin/sh\n{script}\n")
    program.chmod(0o755)
    return Nextpnr((str(program),))


def test_every_core_has_a_goal() -> None:
    assert set(budgets()["fmax"]) == {*core_names(), "pix_clk"}


def test_every_path_begins_and_ends_at_a_flip_flop() -> None:
    core = load_core("video_in")
    ports = ports_of(core, {})
    text = harness(core, ports, {"MAX_WIDTH": 64})
    assert "video_in #(.MAX_WIDTH(64)) core" in text
    of_clk, of_pixels = text.split("reg [26:0] pixel_reg;")
    assert "wire [15:0] cfg_width = in_reg[" in of_clk
    assert "wire [23:0] vid_data = pixel_reg[" in of_pixels
    for port in ports:
        assert f".{port.name}({port.name})" in text
        if port.direction == "output":
            assert "out_reg <= {" in text and port.name in text.split("out_reg <= {")[1].split("}")[0]
    assert "get_ports pix_clk" in constraints(ports)
    assert "pix_clk" not in constraints(ports_of(load_core("rgb2gray"), {}))


def test_the_figure_is_that_after_routing(tmp_path: Path) -> None:
    tool = fake(tmp_path, f"cat <<'E'\n{LOG}E")
    assert tool.route(tmp_path, tmp_path, 150, 1) == {"core.clk": 151.25, "pix_clk$SRC_BUF": 280.5}


def test_a_design_that_is_not_routed_has_no_figure(tmp_path: Path) -> None:
    tool = fake(tmp_path, f"cat <<'E'\n{LOG}ERROR: no way out\nE\nexit 125")
    with pytest.raises(NotRoutedError, match="no way out"):
        tool.route(tmp_path, tmp_path, 150, 1)


def test_the_slowest_seed_counts() -> None:
    runs = [{"core.clk": 151.0, "pix_clk": 200.0}, {"core.clk": 149.0, "pix_clk": 300.0}]
    assert pnr.slowest(runs) == {"clk": 149.0, "pix_clk": 200.0}


@pytest.mark.parametrize(("mhz", "bad"), [(148.5, False), (148.4, True)])
def test_less_than_the_goal_is_bad(mhz: float, bad: bool, tmp_path: Path) -> None:
    tool = fake(tmp_path, f"echo \"Info: Max frequency for clock 'core.clk': {mhz} MHz (x)\"")
    worst, found = pnr.measure("rgb2gray", tool, [1, 2])
    assert worst == {"clk": mhz}
    assert bool(found) is bad


def test_without_debians_packages_it_is_skipped_with_a_sentence(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture
) -> None:
    monkeypatch.setenv("PATH", str(tmp_path))
    monkeypatch.setattr(pnr, "FOLDER", tmp_path / "nextpnr")
    assert nextpnr.find(tmp_path / "nextpnr") is None
    assert pnr.the_tool() is None
    (line,) = [line for line in capsys.readouterr().out.splitlines() if line.startswith("skipped: ")]
    assert "apt-get is not here; install nextpnr-himbaechel-xilinx yourself" in line

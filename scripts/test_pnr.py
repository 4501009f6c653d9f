# SPDX-License-Identifier: Apache-2.0
"""The design around a core, reading nextpnr's figures, and what is said where nextpnr is not to be had."""

import json
from pathlib import Path

import pytest

from scripts import nextpnr, pnr
from scripts.errors import UserError
from scripts.nextpnr import Nextpnr, NotRoutedError
from scripts.pnr_harness import Port, constraints, harness, ports_of
from scripts.synth import budgets
from tb.common.cores import core_names, load_core

CLOCKS = ("clk", "pix_clk")
LOG = """Info: Max frequency for clock           'core.clk': 90.10 MHz (FAIL at 150.00 MHz)
Info: Max frequency for clock 'core.fifo.rd_clk$SRC_BUF': 300.00 MHz (PASS at 150.00 MHz)
Info: routed
Info: Max frequency for clock 'core.clk': 151.25 MHz (PASS at 150.00 MHz)
Info: Max frequency for clock 'core.fifo.rd_clk$SRC_BUF': 280.50 MHz (PASS at 150.00 MHz)
"""


def design(folder: Path) -> Path:
    """A netlist of two clocks, one straight from its pin, one through buffers and known by a name deep inside."""
    cells = {
        "a": {"type": "IBUF", "connections": {"I": [3], "O": [4]}},
        "b": {"type": "BUFG", "connections": {"I": [4], "O": [5]}},
        "c": {"type": "FDRE", "connections": {"C": [5], "Q": [6]}},
    }
    nets = {"clk": [2], "core.clk": [2], "pix_clk": [3], "core.fifo.rd_clk": [5], "core.other": [6]}
    top = {
        "attributes": {"top": "1"},
        "ports": {"clk": {"bits": [2]}, "pix_clk": {"bits": [3]}},
        "cells": cells,
        "netnames": {name: {"bits": bits} for name, bits in nets.items()},
    }
    path = folder / "design.json"
    path.write_text(json.dumps({"modules": {"FDRE": {"ports": {"C": {"bits": [2]}}}, "harness": top}}))
    return path


def fake(folder: Path, script: str) -> Nextpnr:
    program = folder / "nextpnr"
    program.write_text(f"#!/bin/sh\n{script}\n")
    program.chmod(0o755)
    return Nextpnr((str(program),))


def test_every_core_has_a_goal() -> None:
    assert set(budgets()["fmax"]) == {*core_names(), "pix_clk"}


@pytest.mark.parametrize(
    ("name", "of_pixels"),
    [("video_in", "vid_data"), ("video_out", "vid_de"), ("pattern_source", "move"), ("rgb2gray", "")],
)
def test_every_path_begins_and_ends_at_a_flip_flop_of_its_clock(name: str, of_pixels: str) -> None:
    core = load_core(name)
    ports = ports_of(core, {})
    text = harness(core, ports, {"MAX_WIDTH": 64} if name == "video_in" else {})
    taken = {clock: text.partition(f" {clock}_out_reg <= {{")[2].partition("}")[0].split(", ") for clock in CLOCKS}
    for port in ports:
        assert f".{port.name}({port.name})" in text
        clock = "pix_clk" if name == "pattern_source" or port.name.startswith(("vid_", "out_")) else "clk"
        if port.direction == "output":
            assert port.name in taken[clock]
        elif port.name not in CLOCKS:
            assert f" {port.name} = {'pixel_reg' if clock == 'pix_clk' else 'in_reg'}[" in text
    assert ("always @(posedge pix_clk) pixel_reg" in text) == bool(of_pixels)
    assert ("get_ports pix_clk" in constraints(ports)) == bool(of_pixels)
    assert ("get_ports clk" in constraints(ports)) == ("input wire clk," in text) == (name != "pattern_source")
    if name == "video_in":
        assert "video_in #(.MAX_WIDTH(64)) core" in text


def test_the_figure_is_that_after_routing(tmp_path: Path) -> None:
    tool = fake(tmp_path, f"cat <<'E'\n{LOG}E")
    assert tool.route(design(tmp_path), tmp_path, 150, 1) == {"clk": 151.25, "pix_clk": 280.5}


def test_a_design_that_is_not_routed_has_no_figure(tmp_path: Path) -> None:
    tool = fake(tmp_path, f"cat <<'E'\n{LOG}ERROR: no way out\nE\nexit 125")
    with pytest.raises(NotRoutedError, match="no way out"):
        tool.route(tmp_path, tmp_path, 150, 1)


def test_the_slowest_seed_counts_and_each_must_tell_of_each_clock() -> None:
    runs = [{"clk": 151.0, "pix_clk": 200.0}, {"clk": 149.0, "pix_clk": 300.0}]
    assert pnr.slowest(runs, CLOCKS) == {"clk": 149.0, "pix_clk": 200.0}
    with pytest.raises(NotRoutedError, match="does not say how fast pix_clk is"):
        pnr.slowest([runs[0], {"clk": 149.0}], CLOCKS)


@pytest.mark.parametrize(
    ("core", "log", "fault"),
    [
        ("rgb2gray", "Info: Max frequency for clock 'core.clk': 148.5 MHz (x)", ""),
        ("rgb2gray", "Info: Max frequency for clock 'core.clk': 148.4 MHz (x)", "clk 148.4 MHz, less than 148.5"),
        ("rgb2gray", "Info: nothing is said", "does not say how fast clk is"),
        ("video_out", "Info: Max frequency for clock 'core.clk': 200 MHz (x)", "does not say how fast pix_clk is"),
        ("video_out", LOG.strip(), ""),
    ],
)
def test_what_is_bad(core: str, log: str, fault: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    clocks = CLOCKS if core == "video_out" else CLOCKS[:1]
    monkeypatch.setattr(pnr, "ports_of", lambda _core, _parameters: [Port(name, "input", 1) for name in clocks])
    monkeypatch.setattr(pnr, "netlist", lambda _core, _ports, _parameters, folder: (design(folder), folder))
    found = pnr.measure(core, fake(tmp_path, f"cat <<'E'\n{log}\nE"), [1, 2])[1]
    assert len(found) == bool(fault)
    assert fault in "".join(found)


@pytest.mark.parametrize(("tool", "machine"), [("apt-get is not here", "x86_64"), ("is riscv64", "riscv64")])
def test_where_debians_packages_are_of_no_use_it_is_skipped_with_a_sentence(
    tool: str, machine: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture
) -> None:
    monkeypatch.setenv("PATH", str(tmp_path))
    monkeypatch.setattr(nextpnr.platform, "machine", lambda: machine)
    monkeypatch.setattr(pnr, "FOLDER", tmp_path / "nextpnr")
    assert pnr.the_tool() is None
    (line,) = [line for line in capsys.readouterr().out.splitlines() if line.startswith("skipped: ")]
    assert tool in line
    assert "install nextpnr-himbaechel-xilinx yourself" in line


@pytest.mark.parametrize(
    ("file", "text"),
    [
        ("sources.list", "# deb x://old/debian sid main\ndeb x://host/debian bookworm main\n"),
        ("sources.list.d/debian.sources", "Types: deb\nURIs: x://host/debian/\nSuites: bookworm\n"),
    ],
)
def test_the_archive_is_that_of_the_machine(
    file: str, text: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(nextpnr, "SOURCES", tmp_path)
    with pytest.raises(UserError, match="name no archive of Debian"):
        nextpnr.archive()
    (tmp_path / file).parent.mkdir(exist_ok=True)
    (tmp_path / file).write_text(text)
    assert nextpnr.archive() == "x://host/debian"


@pytest.mark.parametrize("fault", ["update", "install", "unpack", "hollow", ""])
def test_it_is_laid_out_whole_or_not_at_all(fault: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """With stand-ins for apt-get and dpkg-deb, of which one fails."""
    loader = "#!/bin/sh\necho '(Version 0.1)'\n" if fault != "hollow" else ""
    paths = [f"usr/bin/{nextpnr.COMMAND}", nextpnr.CHIP, f"{nextpnr.LIBRARIES}/ld-linux-x86-64.so.2"]
    unpack = "".join(f'mkdir -p "$3/{Path(path).parent}"; cp "$0.loader" "$3/{path}"\n' for path in paths)
    tools = {
        "apt-get": 'for a in "$@"; do case "$a" in -oDir::Cache=*) cache="${a#*=}";; esac; done\n'
        f'case "$*" in *{fault or "never_said"}*) echo "E: no net" >&2; exit 100;; esac\n'
        'touch "$cache/archives/one.deb"\n',
        "dpkg-deb": unpack + ("echo no space left; exit 2\n" if fault == "unpack" else ""),
    }
    for name, script in tools.items():
        (tmp_path / name).write_text(f"#!/bin/sh\n{script}")
        (tmp_path / name).chmod(0o755)
    (tmp_path / "dpkg-deb.loader").write_text(loader)
    (tmp_path / "dpkg-deb.loader").chmod(0o755)
    monkeypatch.setenv("PATH", f"{tmp_path}:/usr/bin:/bin")
    monkeypatch.setattr(nextpnr, "archive", lambda: "x://host/debian")
    root = tmp_path / "build/nextpnr"
    if fault:
        with pytest.raises(UserError):
            nextpnr.fetch(root)
        assert list(root.parent.iterdir()) == []
        assert nextpnr.find_in(root) is None
    else:
        nextpnr.fetch(root)
        assert nextpnr.find_in(root).version() == "0.1"
        assert list(root.parent.iterdir()) == [root]

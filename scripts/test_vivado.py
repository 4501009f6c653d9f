# SPDX-License-Identifier: Apache-2.0
"""`make bitstream`, `make xsa`, `make ip`: packaging of every core, and what a user reads when something is amiss.

A stand-in for the `vivado` command lies on a PATH of its own.
"""

import re
import shutil
import sys
from pathlib import Path

import pytest

from scripts import vivado
from scripts.errors import UserError
from scripts.rtl_facts import Facts, bits_of
from scripts.vivado_standin import Outcome, run_standin, write_facts
from tb.common.cores import core_names, load_core

AXI = {
    "landing_core": {"s_axil", "m_axi"},
    "rgb2gray": {"s_axis", "m_axis"},
    "lidar_pwm": set(),
    "video_in": {"m_axis"},
}
"""Interfaces that some of the cores have."""


def package(name: str, folder: Path, edit: tuple[str, str] | None = None) -> Outcome:
    """Package a core in the stand-in, with its inputs spoilt if wanted."""
    core = load_core(name)
    inputs = vivado.package_inputs(core, folder)
    if edit:
        text = inputs.read_text()
        assert edit[0] in text
        inputs.write_text(text.replace(edit[0], edit[1], 1))
    ports = {port.name: (port.direction, port.width) for port in vivado.ports_of(core, {})}
    facts = Facts(
        core.toplevel, ports, [*ports, *(bit for port, (_, width) in ports.items() for bit in bits_of(port, width))]
    )
    known = write_facts(folder / f"{name}_facts.tcl", facts, core.sources)
    return run_standin(known, vivado.SCRIPTS / "package_ip.tcl", inputs)


@pytest.mark.parametrize("name", core_names())
def test_every_core_is_packaged_with_its_interfaces(name: str, tmp_path: Path) -> None:
    outcome = package(name, tmp_path)
    assert (outcome.code, outcome.sentence) == (0, "")
    inferred = [call for call in outcome.calls if call.startswith("ipx::infer_bus_interface")]
    joined = {call.split()[2] for call in outcome.calls if call.startswith("ipx::associate_bus_interfaces -busif")}
    assert len(inferred) >= len(joined) + 1
    if name in AXI:
        assert joined == AXI[name] | {found for found in joined if found.startswith("view_")}
    mapped = {call.split()[1] for call in outcome.calls if call.startswith("ipx::add_memory_map")}
    assert mapped == {found for found in joined if found.startswith("s_axil")}
    assert outcome.calls[-3].startswith("ipx::save_core")


@pytest.mark.parametrize(
    ("edit", "sentence"),
    [
        (("{s_axis_tdata}", "{s_axis_data}"), "there is no port named s_axis_data"),
        (("xilinx.com:interface:axis_rtl:1.0", "xilinx.com:interface:axis:1.0"), "there is no interface"),
        (("set clocks {{clk}}", "set clocks {{clock}}"), "there is no port named clock"),
        (("set registers {}", "set registers {{s_axis2}}"), "there is no bus named s_axis2"),
        (("set top rgb2gray", "set top rgb2grey"), "the top is rgb2grey, not rgb2gray"),
        (("rgb2gray.v}", "rgb2grey.v}"), "there is no file"),
        (("set wanted_version 2023.2", "set wanted_version 2022.1"), "the scripts are for 2022.1|for 2022.1"),
    ],
)
def test_a_fault_in_packaging_is_found(edit: tuple[str, str], sentence: str, tmp_path: Path) -> None:
    outcome = package("rgb2gray", tmp_path, edit)
    assert outcome.code != 0
    assert re.search(sentence, outcome.sentence), outcome.sentence


# ---- The command.


@pytest.fixture
def tools(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A PATH that has nothing; outputs go to a folder of the test; the board is what there is of it."""
    folder = tmp_path / "bin"
    folder.mkdir()
    monkeypatch.setenv("PATH", str(folder))
    monkeypatch.setattr(vivado, "OUTPUT", tmp_path / "out")
    monkeypatch.setattr(vivado, "PACKAGES", tmp_path / "ip")
    monkeypatch.setattr(vivado, "board_inputs", lambda goal, library: board_inputs(goal, library, tmp_path / "out"))
    monkeypatch.setattr(vivado, "package_inputs", lambda core: package_inputs(core, tmp_path / "ip"))
    return folder


board_inputs, package_inputs = vivado.board_inputs, vivado.package_inputs


def fake(folder: Path, body: str, version: str = "2023.2") -> None:
    """Put a `vivado` on the PATH."""
    tool = folder / "vivado"
    answer = f'[ "$1" = -version ] && echo "Vivado v{version} (64-bit)" && exit 0'
    tool.write_text(f"#!/bin/sh\n{answer}\n{body}\n")
    tool.chmod(0o755)


def library(tmp_path: Path) -> str:
    """A folder that looks like a clone of Digilent's library."""
    for name in vivado.IP_FILES:
        path = tmp_path / "library" / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text("")
    return str(tmp_path / "library")


def run(monkeypatch: pytest.MonkeyPatch, *arguments: str) -> int:
    monkeypatch.setattr(sys, "argv", ["vivado", *arguments])
    return vivado.main()


def test_without_vivado(tools: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    for goal in ("bitstream", "xsa", "ip"):
        with pytest.raises(UserError, match=r"vivado is not on PATH; source settings64\.sh of Vivado 2023\.2"):
            run(monkeypatch, goal)
    assert list(tools.iterdir()) == []


def test_another_version(tools: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    fake(tools, "exit 0", "2021.1")
    with pytest.raises(UserError, match=r"this is Vivado 2021\.1; the scripts are for 2023\.2"):
        run(monkeypatch, "bitstream")


def test_a_vivado_that_does_not_say_its_version(tools: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    fake(tools, "exit 0", "of today")
    with pytest.raises(UserError, match="of no known version"):
        run(monkeypatch, "ip")


def test_without_the_library(tools: Path, monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    fake(tools, "exit 0")
    with pytest.raises(UserError, match="give DIGILENT_IP= a clone"):
        run(monkeypatch, "bitstream")
    with pytest.raises(UserError, match=r"is no clone of Digilent's vivado-library: it has no ip/dvi2rgb/"):
        run(monkeypatch, "bitstream", "--digilent-ip", str(tmp_path))


def test_an_unknown_core(tools: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    with pytest.raises(UserError, match="unknown core 'nonsense'"):
        run(monkeypatch, "ip", "--core", "nonsense")


@pytest.mark.parametrize(
    ("body", "sentence"),
    [
        ("echo touchdown: timing is not met. >&2; exit 1", r"timing is not met; the log is .*vivado\.log\.$"),
        ("echo 'ERROR: [Synth 8-439] module x not found'; exit 1", r"Vivado stopped: ERROR: \[Synth 8-439\] module x"),
        ("exit 3", "Vivado stopped: it gave no reason"),
    ],
)
def test_a_build_that_stops(
    body: str, sentence: str, tools: Path, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    fake(tools, body)
    with pytest.raises(UserError, match=sentence):
        run(monkeypatch, "bitstream", "--digilent-ip", library(tmp_path))


def test_a_build_that_goes_well(
    tools: Path, monkeypatch: pytest.MonkeyPatch, tmp_path: Path, capsys: pytest.CaptureFixture
) -> None:
    fake(tools, f"printf '%s\\n' \"$@\" >{tmp_path}/arguments; echo touchdown: done.; echo noise")
    assert run(monkeypatch, "xsa", "--digilent-ip", library(tmp_path)) == 0
    assert capsys.readouterr().out.splitlines()[-1] == "done."
    arguments = (tmp_path / "arguments").read_text().splitlines()
    assert arguments[:3] == ["-mode", "batch", "-nojournal"]
    assert arguments[-2:] == ["-tclargs", str(tmp_path / "out/inputs.tcl")]
    inputs = (tmp_path / "out/inputs.tcl").read_text()
    assert "set goal xsa\n" in inputs
    assert "rtl/top/arty_z7_top.v" in inputs


def test_the_inputs_are_those_that_the_script_reads(
    tools: Path, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    fake(tools, "exit 0")
    assert run(monkeypatch, "xsa", "--digilent-ip", library(tmp_path)) == 0
    given = set(re.findall(r"^set (\w+) ", (tmp_path / "out/inputs.tcl").read_text(), re.MULTILINE))
    used = set(re.findall(r"\$(\w+)", (vivado.SCRIPTS / "build.tcl").read_text()))
    assert given == used - {"here", "script", "constraint", "argv"}


def test_a_path_that_tcl_would_take_apart() -> None:
    with pytest.raises(UserError, match="braces or backslashes"):
        vivado.quoted("a{b")


def test_ip_of_one_core(tools: Path, monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    fake(tools, "echo touchdown: packaged.")
    assert run(monkeypatch, "ip", "--core", "rgb2gray") == 0
    assert [path.name for path in (tmp_path / "ip/inputs").iterdir()] == ["rgb2gray.tcl"]
    assert shutil.which("vivado") is not None

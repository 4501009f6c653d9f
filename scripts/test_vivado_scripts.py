# SPDX-License-Identifier: Apache-2.0
"""The scripts for Vivado and the constraints, run against the stand-in; and each kind of fault that it is to find."""

import re
import shutil
from dataclasses import dataclass
from pathlib import Path

import pytest

from scripts.board import INCLUDES, TABLE, VENDOR, load_board, vendor_files
from scripts.rtl_facts import Facts, facts_of
from scripts.vivado import FALLBACK, SCRIPTS, VERSION, listed, quoted, register_bases, write_inputs
from scripts.vivado_standin import Outcome, run_standin, write_facts
from tb.common.cores import ROOT

CONSTRAINTS = ("arty_z7.xdc", "video_in.xdc")


@dataclass(frozen=True)
class Fault:
    """A text of a script or of the constraints, what takes its place, and what the stand-in says of it."""

    file: str
    before: str
    after: str
    sentence: str


FAULTS = {
    "command": Fault("build.tcl", "\nopt_design\n", "\noptimise_design\n", "there is no command optimise_design"),
    "hidden_by_catch": Fault("build.tcl", "\nopt_design\n", "\ncatch {opt_dsgn}\n", "there is no command opt_dsgn"),
    "option": Fault("reports.tcl", "-details", "-detailed", "report_cdc has no option -detailed"),
    "option_without_value": Fault("build.tcl", " -include_dirs $include_dirs", " -include_dirs", "has no value"),
    "too_many_arguments": Fault(
        "build.tcl", "\nopt_design\n", "\nopt_design now\n", "opt_design takes 0 to 0 arguments"
    ),
    "missing_script": Fault("build.tcl", "{common digilent", "{comon digilent", "no such file or directory"),
    "missing_file": Fault("build.tcl", "read_xdc $constraint", "read_xdc $constraint.old", "there is no file"),
    "unread_source": Fault(
        "build.tcl", "read_verilog $sources", "read_verilog [lrange $sources 1 end]", "was not read"
    ),
    "read_twice": Fault(
        "build.tcl", "read_verilog $sources", "read_verilog $sources\nread_verilog $sources", "read twice"
    ),
    "missing_folder": Fault("build.tcl", "-include_dirs $include_dirs", "-include_dirs no/such", "there is no folder"),
    "top": Fault("build.tcl", "-top $top", "-top arty_z7", "there is no module arty_z7 to build"),
    "part": Fault("build.tcl", "-in_memory -part $part", "-in_memory -part xc7z010clg400-1", "part is xc7z020clg400-1"),
    "order": Fault("build.tcl", "\nroute_design\n", "\n", "write_bitstream after 'placed'"),
    "no_ip": Fault("build.tcl", "make_digilent $digilent_ip", "set unused", "has no source"),
    "catalog": Fault(
        "digilent.tcl", "create_ip -vlnv digilentinc.com:ip:dvi2rgb:2.0", "create_ip -vlnv a:b:c:1", "a:b:c:1"
    ),
    "ip_property": Fault("digilent.tcl", "CONFIG.kAddBUFG", "CONFIG.kAddBufg", "has no property CONFIG.kAddBufg"),
    "ip_value": Fault("digilent.tcl", "CONFIG.kClkPrimitive {MMCM}", "CONFIG.kClkPrimitive {DCM}", "cannot be 'DCM'"),
    "ip_name": Fault("digilent.tcl", "[get_ips rgb2dvi_0]", "[get_ips rgb2dvi]", "there is no ip named rgb2dvi"),
    "file_property": Fault("digilent.tcl", "generate_synth_checkpoint", "synth_chk", "has no property synth_chk"),
    "ps7_property": Fault(
        "ps7_settings.tcl", "PCW_USE_M_AXI_GP0", "PCW_USE_M_AXI_GPO", "no property CONFIG.PCW_USE_M_AXI_GPO"
    ),
    "ps7_value": Fault("ps7_settings.tcl", "{16 Bit}", "{16 bits}", "cannot be '16 bits'"),
    "ps7_pin_is_off": Fault("ps7_settings.tcl", "PCW_EN_CLK1_PORT {1}", "PCW_EN_CLK1_PORT {0}", "no pin FCLK_CLK1"),
    "ps7_port_is_off": Fault(
        "ps7_settings.tcl", "PCW_USE_S_AXI_HP1 {1}", "PCW_USE_S_AXI_HP1 {0}", "no interface S_AXI_HP1"
    ),
    "bd_pin": Fault("zynq_ps.tcl", "resets/ext_reset_in", "resets/ext_reset", "resets has no pin ext_reset"),
    "bd_cell": Fault(
        "zynq_ps.tcl", "[get_bd_pins resets/slow", "[get_bd_pins reset/slow", "the design has no cell reset"
    ),
    "bd_open_clock": Fault("zynq_ps.tcl", "[list ACLK S00_ACLK]", "[list ACLK]", "S00_ACLK is not connected"),
    "bd_open_port": Fault(
        "zynq_ps.tcl", "    connect_bd_net [get_bd_ports irq] [get_bd_pins ps7/IRQ_F2P]\n", "", "not connected"
    ),
    "bd_port": Fault(
        "zynq_ps.tcl", "{LEVEL_HIGH} [get_bd_ports irq]", "{LEVEL_HIGH} [get_bd_ports int]", "no bd_port named int"
    ),
    "bd_port_twice": Fault(
        "zynq_ps.tcl", "make_port uart1_rxd I", "make_port uart0_rxd I", "there are two of uart0_rxd"
    ),
    "bd_net_of_interface": Fault(
        "zynq_ps.tcl", "connect_bd_net [get_bd_ports irq]", "connect_bd_intf_net [get_bd_ports irq]", "cannot be joined"
    ),
    "bd_address_overlap": Fault("zynq_ps.tcl", "-range 4K", "-range 1M", "overlaps another range"),
    "bd_address_segment": Fault("zynq_ps.tcl", "${hp}_DDR_LOWOCM", "${hp}_DDR", "there is no address segment"),
    "bd_address_space": Fault("zynq_ps.tcl", "ps7/Data", "ps7/data", "there is no address space ps7/data"),
    "port": Fault("arty_z7.xdc", "{led[3]}]", "{led[4]}]", "there is no port named led[4]"),
    "pin_of_the_package": Fault("arty_z7.xdc", "PACKAGE_PIN M14", "PACKAGE_PIN M41", "the board has no pin M41"),
    "pin_taken_twice": Fault(
        "arty_z7.xdc", "PACKAGE_PIN M14", "PACKAGE_PIN N16", "pin N16 is given to led[2] and to led[3]"
    ),
    "no_standard": Fault("arty_z7.xdc", "T14 IOSTANDARD LVCMOS33", "T14", "port lidar_mode has no IOSTANDARD"),
    "no_pin": Fault("arty_z7.xdc", "PACKAGE_PIN T14 ", "", "port lidar_mode has no PACKAGE_PIN"),
    "standard": Fault("arty_z7.xdc", "T14 IOSTANDARD LVCMOS33", "T14 IOSTANDARD LVCMOS3", "cannot be 'LVCMOS3'"),
    "port_property": Fault(
        "arty_z7.xdc", "PULLUP TRUE} [get_ports autopilot", "PULL UP} [get_ports autopilot", "no property PULL"
    ),
    "cell": Fault("arty_z7.xdc", "lock_sync/first_reg_reg", "lock_sync/first_reg", "there is no cell named"),
    "cell_in_a_filter": Fault("video_in.xdc", "sync_reg_reg[0]", "sync_reg[0]", "there is no cell named"),
    "pin": Fault("arty_z7.xdc", "pix_clk_switch/I0]", "pix_clk_switch/I]", "there is no pin named pix_clk_switch/I"),
    "clock": Fault(
        "video_in.xdc", "-to [get_clocks pix_clk]", "-to [get_clocks pixel_clk]", "there is no clock named pixel_clk"
    ),
    "clock_order": Fault(
        "arty_z7.xdc", "create_clock -name clk ", "create_clock -name clk_100 ", "clk is no object|no clock named clk"
    ),
    "no_tcl_in_constraints": Fault(
        "arty_z7.xdc", "set_input_jitter clk 0.300", "foreach x {1} {}", "there is no command foreach"
    ),
    "false_path_of_nothing": Fault(
        "arty_z7.xdc",
        "set_false_path -from [get_cells board/switch/hold_reg] -to",
        "set_false_path -from {} -to",
        "names nothing",
    ),
}


@dataclass(frozen=True)
class Ground:
    """A copy of the scripts and constraints that a test may spoil, and the facts of the RTL."""

    folder: Path
    facts: Facts

    def spoil(self, fault: Fault) -> None:
        """Plant a fault."""
        path = next(self.folder.glob(f"*/{fault.file}"))
        text = path.read_text()
        assert fault.before in text, f"{fault.file} has no '{fault.before}'"
        path.write_text(text.replace(fault.before, fault.after))

    def build(self, goal: str = "xsa", **facts: str) -> Outcome:
        """Run build.tcl."""
        out = self.folder / "out"
        known = write_facts(self.folder / "facts.tcl", self.facts, load_board().sources, facts)
        inputs = write_inputs(
            self.folder / "inputs.tcl",
            {
                "wanted_version": VERSION,
                "goal": goal,
                "out": quoted(out),
                "part": "xc7z020clg400-1",
                "top": "arty_z7_top",
                "digilent_ip": quoted(self.folder),
                "sources": listed(load_board().sources),
                "include_dirs": listed([INCLUDES]),
                "constraints": listed([self.folder / "constraints" / name for name in CONSTRAINTS]),
                "register_bases": listed([word for pair in register_bases().items() for word in pair]),
            },
        )
        return run_standin(known, self.folder / "vivado/build.tcl", inputs)


@pytest.fixture(scope="module")
def facts() -> Facts:
    return facts_of("arty_z7_top", [*load_board().sources, *vendor_files()])


@pytest.fixture
def ground(tmp_path: Path, facts: Facts) -> Ground:
    shutil.copytree(SCRIPTS, tmp_path / "vivado")
    (tmp_path / "constraints").mkdir()
    for name in CONSTRAINTS:
        shutil.copy(ROOT / "constraints" / name, tmp_path / "constraints")
    return Ground(tmp_path, facts)


def test_the_build_runs_through(ground: Ground) -> None:
    outcome = ground.build()
    assert (outcome.code, outcome.sentence) == (0, "")
    steps = ("synth_design", "opt_design", "place_design", "phys_opt_design", "route_design", "report_timing_summary")
    order = [call.split()[0] for call in outcome.calls]
    places = [order.index(step) for step in (*steps, "get_timing_paths", "write_bitstream", "write_hw_platform")]
    assert places == sorted(places)
    out = ground.folder / "out"
    reports = ("utilization", "timing", "cdc", "drc", "power", "methodology", "check_timing", "clock_interaction")
    for name in ("touchdown.bit", "touchdown.xsa", "routed.dcp", *(f"{report}.rpt" for report in reports)):
        assert (out / name).is_file(), name


def test_a_bitstream_alone_writes_no_platform(ground: Ground) -> None:
    assert ground.build("bitstream").code == 0
    assert (ground.folder / "out/touchdown.bit").is_file()
    assert not (ground.folder / "out/touchdown.xsa").exists()


@pytest.mark.parametrize("name", FAULTS)
def test_a_planted_fault_is_found(name: str, ground: Ground) -> None:
    ground.spoil(FAULTS[name])
    outcome = ground.build()
    assert outcome.code != 0
    assert re.search(FAULTS[name].sentence.replace("[", r"\["), outcome.sentence), outcome.sentence
    assert not (ground.folder / "out/touchdown.bit").exists()


@pytest.mark.parametrize(
    ("told", "sentence"),
    [
        ({"setup": "-0.012"}, r"timing is not met: worst setup slack -0\.012 ns, worst hold slack 0\.05 ns"),
        ({"hold": "-0.2"}, r"timing is not met: .*hold slack -0\.2 ns"),
        ({"setup": "{}"}, "no path is constrained"),
        ({"version": "2024.1"}, r"this is Vivado 2024\.1 and the scripts are for 2023\.2"),
        ({"no_ip": "digilentinc.com:ip:rgb2dvi:1.4"}, "has no digilentinc.com:ip:rgb2dvi:1.4; give DIGILENT_IP="),
    ],
)
def test_what_stops_a_build_is_one_sentence(told: dict[str, str], sentence: str, ground: Ground) -> None:
    # An older bitstream is not taken for this one.
    (ground.folder / "out").mkdir()
    (ground.folder / "out/touchdown.bit").write_text("old")
    outcome = ground.build(**told)
    assert outcome.code == 1
    assert outcome.sentence.startswith("touchdown: ")
    assert re.search(sentence, outcome.sentence), outcome.sentence
    assert "version" in told or not (ground.folder / "out/touchdown.bit").exists()


def test_the_block_design_has_the_ports_that_the_top_level_joins(ground: Ground) -> None:
    calls = [call.split() for call in ground.build().calls]
    made = {name: (way, int(width)) for kind, name, way, width in (call for call in calls if call[0] == "port")}
    text = (VENDOR / "zynq_ps.v").read_text()
    found = re.findall(r"(input|output|inout)\s+wire\s+(?:\[\s*(\d+):0\]\s*)?(\w+)", text)
    joined = {name: (way[0].upper(), int(high or 0) + 1) for way, high, name in found if way != "inout"}
    assert made == joined
    # What the processor's own automation makes external.
    assert {name.split("_")[0] for way, _, name in found if way == "inout"} == {"DDR", "FIXED"}


def test_addresses_are_those_of_the_firmware(ground: Ground) -> None:
    addresses = {call.split()[1]: call.split()[2:] for call in ground.build().calls if call.startswith("address ")}
    landing = int(register_bases()["m_axil_landing"], 0)
    assert [int(word, 0) for word in addresses["m_axil_landing/Reg"]] == [landing, landing + 0xFFF]
    display = int(register_bases()["m_axil_display"], 0)
    assert [int(word, 0) for word in addresses["m_axil_display/Reg"]] == [display, display + 0xFFF]
    assert display == int(FALLBACK["ZYNQ_DISPLAY_BASE"], 0)
    for hp in ("HP0", "HP1"):
        assert addresses[f"ps7/S_AXI_{hp}/{hp}_DDR_LOWOCM"] == ["0x00000000", "0x1FFFFFFF"]


SCHEMATIC = {
    "autopilot_txd": "JA2",
    "autopilot_rxd": "JA3",
    "ground_txd": "JB2",
    "ground_rxd": "JB3",
    "lidar_mode": "CK_IO0",
    "lidar_pull": "CK_IO1",
}
"""Name in the schematic of each port that does not have the same name there."""


def schematic(port: str) -> str:
    if port in SCHEMATIC:
        return SCHEMATIC[port]
    lane = re.fullmatch(r"hdmi_(rx|tx)_d_([pn])\[(\d)\]", port)
    return f"hdmi_{lane[1]}_d{lane[3]}_{lane[2]}".upper() if lane else re.sub(r"[\[\]]", "", port).upper()


def test_each_port_is_at_the_pin_of_the_schematic(ground: Ground, facts: Facts) -> None:
    pins = {call.split()[1]: call.split()[3] for call in ground.build().calls if call.startswith("pin ")}
    assert set(pins) == {name for name in facts.ports if not name.startswith(("DDR_", "FIXED_IO_"))}
    assert {name: schematic(name) for name in pins} == pins


def test_both_lists_of_what_the_page_says_are_the_same() -> None:
    assert [f"constraints/{name}" for name in CONSTRAINTS] == re.findall(r'"(constraints/[^"]+)"', TABLE.read_text())

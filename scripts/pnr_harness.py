# SPDX-License-Identifier: Apache-2.0
"""A design around one core that a chip with few pins can hold, so that place and route can time the core alone.

Inputs come out of a shift register, outputs go into registers that are folded into another: every path into, through
and out of the core starts and ends at a flip-flop of its clock, as between cores of a design.
"""

import json
import subprocess
import sys
import tempfile
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from scripts.lint import YOSYS, yosys_script
from tb.common.cores import ROOT, Core

TOP = "pnr_harness"
CLOCKS = ("clk", "pix_clk")
PINS = {"clk": "H16", "pix_clk": "K17", "serial_in": "D19", "serial_out": "R14"}
"""Pins of the Arty Z7-20; the clocks are at pins that can hold one."""
PIXEL_PORTS = tuple(f"{side}_{name}" for side in ("vid", "out") for name in ("data", "de", "hsync", "vsync"))
"""Ports that belong to `pix_clk` where a core has two clocks."""


@dataclass(frozen=True)
class Port:
    """A port of a core: name, direction as yosys says it, bits."""

    name: str
    direction: str
    width: int


def ports_of(core: Core, parameters: Mapping[str, int]) -> list[Port]:
    """The ports of a core with these parameters, as yosys elaborates them.

    Raises:
        ValueError: Yosys refuses the core.
    """
    sources = [str(source) for source in core.sources]
    sets = "".join(f" -chparam {name} {value}" for name, value in parameters.items())
    with tempfile.TemporaryDirectory() as folder:
        out = Path(folder) / "ports.json"
        script = yosys_script(core.toplevel + sets, sources)
        result = subprocess.run(
            [sys.executable, "-c", YOSYS, f"{script}; write_json {out}"],
            cwd=ROOT,
            capture_output=True,
            text=True,
            check=False,
        )
        if result.returncode != 0:
            raise ValueError(f"yosys refuses {core.name}: {(result.stdout + result.stderr).strip().splitlines()[-1]}")
        modules = json.loads(out.read_text())["modules"]
    (top,) = [module for module in modules.values() if module["attributes"].get("top")]
    return [Port(name, port["direction"], len(port["bits"])) for name, port in top["ports"].items()]


def _shift_register(clock: str, name: str, ports: list[Port], serial: str) -> list[str]:
    width = sum(port.width for port in ports)
    lines = [
        f"    reg [{width - 1}:0] {name};",
        f"    always @(posedge {clock}) {name} <= {{{name}[{width - 2}:0], {serial}}};",
    ]
    at = 0
    for port in ports:
        lines.append(f"    wire [{port.width - 1}:0] {port.name} = {name}[{at + port.width - 1}:{at}];")
        at += port.width
    return lines


def clocks_of(ports: list[Port]) -> list[str]:
    """Names of the clocks among the ports of a core."""
    return [clock for clock in CLOCKS if any(port.name == clock for port in ports)]


def harness(core: Core, ports: list[Port], parameters: Mapping[str, int]) -> str:
    """Verilog of the design around a core."""
    clocks = clocks_of(ports)
    inputs = [port for port in ports if port.direction == "input" and port.name not in clocks]
    outputs = [port for port in ports if port.direction == "output"]

    def of(clock: str, some: list[Port]) -> list[Port]:
        is_of_pixels = clock == "pix_clk"
        return [port for port in some if len(clocks) == 1 or (port.name in PIXEL_PORTS) == is_of_pixels]

    lines = [
        f"module {TOP} (",
        *(f"    input wire {clock}," for clock in clocks),
        "    input wire serial_in,",
        "    output wire serial_out",
        ");",
    ]
    for clock in clocks:
        # In flip-flops of its own clock before they go on.
        if of_clock := of(clock, inputs):
            lines += _shift_register(clock, "pixel_reg" if clock == "pix_clk" else "in_reg", of_clock, "serial_in")
    lines += [f"    wire [{port.width - 1}:0] {port.name};" for port in outputs]
    chosen = ", ".join(f".{name}({value})" for name, value in parameters.items())
    names = [*clocks, *(port.name for port in inputs), *(port.name for port in outputs)]
    lines += [
        f"    {core.toplevel} #({chosen}) core (" if chosen else f"    {core.toplevel} core (",
        *(f"        .{name}({name})," for name in names[:-1]),
        f"        .{names[-1]}({names[-1]})",
        "    );",
    ]
    folds = {clock: of(clock, outputs) for clock in clocks}
    for clock, ports_of_clock in folds.items():
        if ports_of_clock:
            lines += _fold(clock, ports_of_clock)
    ends = [f"{clock}_fold_reg[0]" for clock, ports_of_clock in folds.items() if ports_of_clock]
    lines += [f"    assign serial_out = {' ^ '.join(ends)};", "endmodule"]
    return "\n".join(lines) + "\n"


def _fold(clock: str, ports: list[Port]) -> list[str]:
    """Outputs into flip-flops, and these into a register that turns round: none can be left out as unused."""
    width = sum(port.width for port in ports)
    turned = f"{{{clock}_fold_reg[0], {clock}_fold_reg[{width - 1}:1]}}" if width > 1 else f"{clock}_fold_reg"
    return [
        f"    reg [{width - 1}:0] {clock}_out_reg;",
        f"    reg [{width - 1}:0] {clock}_fold_reg;",
        f"    always @(posedge {clock}) begin",
        f"        {clock}_out_reg <= {{{', '.join(port.name for port in ports)}}};",
        f"        {clock}_fold_reg <= {clock}_out_reg ^ {turned};",
        "    end",
    ]


def constraints(ports: list[Port]) -> str:
    """Where the pins of the design are."""
    used = [name for name in PINS if name in clocks_of(ports) or name not in CLOCKS]
    return "".join(
        f"set_property LOC {PINS[name]} [get_ports {name}]\nset_property IOSTANDARD LVCMOS33 [get_ports {name}]\n"
        for name in used
    )

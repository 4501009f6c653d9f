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
PINS = {"clk": "H16", "pix_clk": "K17", "serial_in": "D19", "serial_out": "R14"}
"""Pins of the Arty Z7-20; the clocks are at pins that can hold one."""
PIXEL_PORTS = tuple(f"{side}_{name}" for side in ("vid", "out") for name in ("data", "de", "hsync", "vsync"))
"""Ports that belong to `pix_clk` where a core has one."""


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
    sources = [str(source.relative_to(ROOT)) for source in core.sources]
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


def harness(core: Core, ports: list[Port], parameters: Mapping[str, int]) -> str:
    """Verilog of the design around a core."""
    has_pixel_clock = any(port.name == "pix_clk" for port in ports)
    inputs = [port for port in ports if port.direction == "input" and port.name not in ("clk", "pix_clk")]
    outputs = [port for port in ports if port.direction == "output"]
    of_pixels = [port for port in inputs if has_pixel_clock and port.name in PIXEL_PORTS]
    of_clk = [port for port in inputs if port not in of_pixels]
    lines = [
        f"module {TOP} (",
        "    input wire clk,",
        *(["    input wire pix_clk,"] if has_pixel_clock else []),
        "    input wire serial_in,",
        "    output wire serial_out",
        ");",
        *_shift_register("clk", "in_reg", of_clk, "serial_in"),
    ]
    if has_pixel_clock:
        # In flip-flops of its own clock before they go on.
        lines += _shift_register("pix_clk", "pixel_reg", of_pixels, "serial_in")
    lines += [f"    wire [{port.width - 1}:0] {port.name};" for port in outputs]
    chosen = ", ".join(f".{name}({value})" for name, value in parameters.items())
    clocks = ["clk", *(["pix_clk"] if has_pixel_clock else [])]
    names = [*clocks, *(port.name for port in inputs), *(port.name for port in outputs)]
    lines += [
        f"    {core.toplevel} #({chosen}) core (" if chosen else f"    {core.toplevel} core (",
        *(f"        .{name}({name})," for name in names[:-1]),
        f"        .{names[-1]}({names[-1]})",
        "    );",
    ]
    to_pixels = [port for port in outputs if has_pixel_clock and port.name in PIXEL_PORTS]
    folds = {"clk": [port for port in outputs if port not in to_pixels], "pix_clk": to_pixels}
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
    used = [name for name in PINS if name != "pix_clk" or any(port.name == "pix_clk" for port in ports)]
    return "".join(
        f"set_property LOC {PINS[name]} [get_ports {name}]\nset_property IOSTANDARD LVCMOS33 [get_ports {name}]\n"
        for name in used
    )

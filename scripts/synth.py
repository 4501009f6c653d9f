# SPDX-License-Identifier: Apache-2.0
"""Area of the cores, and no surprise in it: `python -m scripts.synth [--core X] [--write]`.

Yosys maps each core, with the defaults of its parameters, to the primitives of the Zynq-7020 (xc7). A latch, a loop of
logic, a net with two drivers, a primitive nobody expects, a memory or multiplier that maps elsewhere than
`constraints/budgets.toml` says, and more logic than it allows are errors. These are figures of yosys, not of Vivado.
"""

import json
import os
import subprocess
import sys
import tempfile
import tomllib
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from scripts.corepage import put_block
from scripts.errors import ArgumentParser, UserError, run_main
from scripts.lint import YOSYS, yosys_script
from scripts.signoff import leave
from tb.common.cores import ROOT, core_names, load_core

BUDGETS = ROOT / "constraints/budgets.toml"
MAP = "synth_xilinx -family xc7 -flatten -noiopad -noclkbuf -top {top}"
PACKED = "map_memory"
"""The step of `synth_xilinx` behind the one that packs multipliers, which may take a register that others read: then a
wire has no driver. The steps behind it would make a constant of that, so it is looked for in between."""

LOGIC = {"INV": 1, **{f"LUT{inputs}": 1 for inputs in range(1, 7)}}
SHIFT = {"SRL16E": 1, "SRLC32E": 1}
MEMORY = {"RAM32M": 4, "RAM64M": 4, "RAM32X1D": 2, "RAM64X1D": 2, "RAM128X1D": 4, "RAM128X1S": 2, "RAM256X1S": 4}
FLIP_FLOP = {"FDRE": 1, "FDSE": 1, "FDCE": 1, "FDPE": 1}
WITHOUT_AREA = {"CARRY4", "MUXF7", "MUXF8", "$scopeinfo"}
"""LUTs, or flip-flops, that a primitive takes."""


@dataclass(frozen=True)
class Area:
    """What one core takes: LUTs by use, flip-flops, block RAMs of 36 and 18 Kbit, DSP48E1."""

    logic: int
    srl: int
    lutram: int
    ff: int
    bram36: int
    bram18: int
    dsp: int

    @property
    def lut(self) -> int:
        """All LUTs, whatever they are used for."""
        return self.logic + self.srl + self.lutram

    def figure(self) -> str:
        """One line for the table of signoff."""
        memories = f"{self.bram36} BRAM36, {self.bram18} BRAM18"
        return f"{self.lut} LUT, {self.ff} FF, {memories}, {self.dsp} DSP"


def area_of(cells: dict[str, int]) -> Area:
    """Area of a netlist.

    Raises:
        ValueError: A primitive is neither logic, memory, flip-flop nor multiplier, such as a latch.
    """
    known = {*LOGIC, *SHIFT, *MEMORY, *FLIP_FLOP, *WITHOUT_AREA, "RAMB36E1", "RAMB18E1", "DSP48E1"}
    strange = sorted(set(cells) - known)
    if strange:
        raise ValueError(f"primitives that nobody expects: {', '.join(strange)}")

    def total(costs: dict[str, int]) -> int:
        return sum(cells.get(name, 0) * cost for name, cost in costs.items())

    blocks = (cells.get(name, 0) for name in ("RAMB36E1", "RAMB18E1", "DSP48E1"))
    return Area(total(LOGIC), total(SHIFT), total(MEMORY), total(FLIP_FLOP), *blocks)


def mapping_steps(command: str) -> list[str]:
    """A call of `synth_xilinx` in two, with a look for wires without a driver where they can be seen."""
    return [f"{command} -run begin:{PACKED}", "check -assert", f"{command} -run {PACKED}:"]


def synthesise(top: str, sources: list[str], parameters: Mapping[str, int] | None = None) -> Area:
    """Map one design, sources from the project root, with these parameters instead of their defaults.

    Raises:
        ValueError: Yosys refuses it (latch, loop, two drivers), or `area_of` does.
    """
    with tempfile.TemporaryDirectory() as folder:
        report = Path(folder) / "stat.json"
        quiet = f"tee -q -o {os.devnull}"
        mapping = [f"{quiet} {step}" for step in mapping_steps(MAP.format(top=top))]
        steps = [*mapping, f"{quiet} check -assert", f"tee -q -o {report} stat -json"]
        script = "; ".join([yosys_script(top, sources, parameters), *steps])
        command = [sys.executable, "-c", YOSYS, script]
        result = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
        if result.returncode != 0:
            last = [line for line in (result.stdout + result.stderr).splitlines() if "ERROR" in line or "rror:" in line]
            raise ValueError(f"yosys refuses {top}: {last[-1] if last else 'no reason given'}")
        return area_of(json.loads(report.read_text())["design"]["num_cells_by_type"])


def budgets() -> dict[str, dict[str, int]]:
    """Tables of `constraints/budgets.toml`."""
    return tomllib.loads(BUDGETS.read_text(encoding="utf-8"))


def faults(area: Area, budget: dict[str, int]) -> list[str]:
    """What is beyond a budget: LUT and FF at most as many, block RAM and DSP exactly as many."""
    found = [f"{area.dsp} DSP, not {budget['dsp']}"] if area.dsp != budget["dsp"] else []
    for name in ("bram36", "bram18"):
        if getattr(area, name) != budget[name]:
            found.append(f"{getattr(area, name)} {name.upper()}, not {budget[name]}")
    for name in ("lut", "ff"):
        if getattr(area, name) > budget[name]:
            found.append(f"{getattr(area, name)} {name.upper()}, more than {budget[name]}")
    return found


def beyond_half_of_paper(area: Area) -> list[str]:
    """What is more than half of the paper's whole programmable logic (for block RAM: than all of it)."""
    limit = budgets()["half_of_paper"]
    taken = {"lut": area.lut, "ff": area.ff, "dsp": area.dsp, "bram36": area.bram36 + (area.bram18 + 1) // 2}
    return [f"{taken[name]} {name.upper()}, more than {most}" for name, most in limit.items() if taken[name] > most]


def measure(core_name: str) -> tuple[Area | None, list[str]]:
    """Map one core, judge it, and leave the result for signoff; the area and what is wrong with it."""
    core = load_core(core_name)
    if core_name not in budgets():
        raise UserError(f"constraints/budgets.toml has no table [{core_name}]; add one.")
    try:
        area = synthesise(core.toplevel, [str(source.relative_to(ROOT)) for source in core.sources])
    except ValueError as error:
        leave(core_name, "area", False, "refused", {"faults": [str(error)]})
        return None, [str(error)]
    found = faults(area, budgets()[core_name])
    if core_name == "landing_core":
        found += beyond_half_of_paper(area)
    leave(core_name, "area", not found, area.figure(), {**vars(area), "faults": found})
    return area, found


def table(area: Area, budget: dict[str, int]) -> str:
    """The resource table of a core's page."""
    head = "| LUT | of these logic | SRL | LUTRAM | FF | BRAM36 | BRAM18 | DSP |"
    row = f"| {area.lut} | {area.logic} | {area.srl} | {area.lutram} | {area.ff} "
    row += f"| {area.bram36} | {area.bram18} | {area.dsp} |"
    most = f"| at most {budget['lut']} | | | | at most {budget['ff']} "
    most += f"| {budget['bram36']} | {budget['bram18']} | {budget['dsp']} |"
    return "\n".join([head, "|---|---|---|---|---|---|---|---|", row, most])


def main() -> int:
    """Entry point of `make synth`."""
    parser = ArgumentParser(prog="make synth", description=__doc__)
    parser.add_argument("--core", default="", help="one core; all when left out")
    parser.add_argument("--write", action="store_true", help="put the figures into docs/cores/<core>.md")
    arguments = parser.parse_args()
    failed = False
    for name in [arguments.core] if arguments.core else core_names():
        area, found = measure(name)
        failed |= bool(found)
        print(f"{'BAD ' if found else 'ok  '} {name}: {area.figure() if area else 'not mapped'}", flush=True)
        for fault in found:
            print(f"     {fault}")
        if arguments.write and area:
            put_block(name, "resources", table(area, budgets()[name]))
    print("Figures of yosys for xc7, not of Vivado.")
    if failed:
        print("touchdown: the area is not what constraints/budgets.toml says; see above.", file=sys.stderr)
    return int(failed)


if __name__ == "__main__":
    run_main(main)

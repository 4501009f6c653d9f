# SPDX-License-Identifier: Apache-2.0
"""How fast each core is on a Zynq-7020: `python -m scripts.pnr [--core X] [--seeds 1,2,3] [--write]`.

Yosys maps a core between flip-flops (scripts/pnr_harness.py), nextpnr places and routes it, once a seed; the slowest
counts, against the goals in `constraints/budgets.toml`. These are figures of yosys and nextpnr for the device, which
know no speed grade, and not of Vivado. Shift registers and small memories in LUTs are left out (-nosrl, -nolutram):
nextpnr puts two with different write enables into one slice and then cannot route it.
"""

import subprocess
import sys
import tempfile
from pathlib import Path

from scripts.corepage import put_block
from scripts.errors import ArgumentParser, UserError, run_main
from scripts.lint import YOSYS, include_flags
from scripts.nextpnr import Nextpnr, NotRoutedError, fetch, find
from scripts.pnr_harness import TOP, constraints, harness, ports_of
from scripts.synth import budgets
from tb.common.cores import ROOT, Core, core_names, load_core

FOLDER = ROOT / "build/nextpnr"
MAP = f"synth_xilinx -family xc7 -flatten -nosrl -nolutram -top {TOP}"


def netlist(core: Core, folder: Path) -> tuple[Path, Path]:
    """Netlist and pins of the design around a core, with the defaults of its parameters.

    Raises:
        ValueError: Yosys refuses it.
    """
    ports = ports_of(core, {})
    verilog, pins, out = folder / "harness.v", folder / "pins.xdc", folder / "netlist.json"
    verilog.write_text(harness(core, ports, {}))
    pins.write_text(constraints(ports))
    sources = " ".join(str(source) for source in (*core.sources, verilog))
    script = f"read_verilog {' '.join(include_flags())} {sources}; {MAP}; write_json {out}"
    run = subprocess.run([sys.executable, "-c", YOSYS, script], cwd=ROOT, capture_output=True, text=True, check=False)
    if run.returncode != 0:
        raise ValueError(f"yosys refuses {core.name}: {(run.stdout + run.stderr).strip().splitlines()[-1]}")
    return out, pins


def slowest(runs: list[dict[str, float]]) -> dict[str, float]:
    """The least of each clock over the seeds, by the name of the clock's port."""
    clocks = {net.rsplit(".", 1)[-1]: net for net in runs[0]}
    return {clock: min(run[net] for run in runs) for clock, net in clocks.items()}


def measure(name: str, tool: Nextpnr, seeds: list[int]) -> tuple[dict[str, float], list[str]]:
    """MHz of each clock of a core, and what is wrong with that."""
    goals = {"clk": budgets()["fmax"][name], "pix_clk": budgets()["fmax"]["pix_clk"]}
    found, worst = [], {}
    with tempfile.TemporaryDirectory() as folder:
        try:
            files = netlist(load_core(name), Path(folder))
            worst = slowest([tool.route(*files, 1.05 * goals["clk"], seed) for seed in seeds])
        except (NotRoutedError, ValueError) as error:
            found.append(str(error))
    found += [
        f"{clock} {mhz:.1f} MHz, less than {goals[clock]:g}" for clock, mhz in worst.items() if mhz < goals[clock]
    ]
    return worst, found


def table(worst: dict[str, float], seeds: list[int], name: str) -> str:
    """The timing table of a core's page."""
    goals = budgets()["fmax"]
    rows = [
        f"| `{clock}` | {mhz:.1f} | {goals[name] if clock == 'clk' else goals['pix_clk']:g} |"
        for clock, mhz in worst.items()
    ]
    return "\n".join([f"| clock | MHz, worst of {len(seeds)} seeds | goal |", "|---|---|---|", *rows])


def the_tool() -> Nextpnr | None:
    """Nextpnr, fetched if need be; None, and a sentence said, where it is not to be had."""
    tool = find(FOLDER)
    if tool is None:
        print("nextpnr is not here; loading it from Debian sid (24 MB) into build/nextpnr", flush=True)
        try:
            fetch(FOLDER)
        except UserError as error:
            print(f"skipped: {error}")
            return None
        tool = find(FOLDER)
    return tool


def main() -> int:
    """Entry point of `make pnr`."""
    parser = ArgumentParser(prog="make pnr", description=__doc__)
    parser.add_argument("--core", default="", help="one core; all when left out")
    parser.add_argument("--seeds", default="1,2,3", help="of the placement, with commas")
    parser.add_argument("--write", action="store_true", help="put the figures into docs/cores/<core>.md")
    arguments = parser.parse_args()
    try:
        seeds = [int(seed) for seed in arguments.seeds.split(",")]
    except ValueError:
        raise UserError(f"--seeds takes numbers with commas between them, not '{arguments.seeds}'.") from None
    names = [load_core(arguments.core).name] if arguments.core else core_names()
    tool = the_tool()
    if tool is None:
        return 0
    print(f"yosys and nextpnr {tool.version()} for the Zynq-7020; the slowest of seeds {arguments.seeds}", flush=True)
    failed = False
    for name in names:
        worst, found = measure(name, tool, seeds)
        failed |= bool(found)
        figures = ", ".join(f"{clock} {mhz:.1f} MHz" for clock, mhz in worst.items())
        print(f"{'BAD ' if found else 'ok  '} {name}: {figures or 'not routed'}", flush=True)
        for fault in found:
            print(f"     {fault}")
        if arguments.write and worst:
            put_block(name, "fmax", table(worst, seeds, name))
    if failed:
        print("touchdown: some core is slower than constraints/budgets.toml says; see above.", file=sys.stderr)
    return int(failed)


if __name__ == "__main__":
    run_main(main)

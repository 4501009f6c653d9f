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
from collections.abc import Iterable, Mapping
from pathlib import Path

from scripts.corepage import put_block, read_page
from scripts.errors import ArgumentParser, UserError, run_main
from scripts.lint import YOSYS, include_flags
from scripts.nextpnr import COMMAND, Nextpnr, NotRoutedError, fetch, find, why_not_here
from scripts.page_block import find_block
from scripts.pnr_harness import TOP, Port, constraints, harness, ports_of
from scripts.synth import budgets, mapping_steps
from tb.common.cores import ROOT, Core, core_names, load_core

FOLDER = ROOT / "build/nextpnr"
MAP = f"synth_xilinx -family xc7 -flatten -nosrl -nolutram -top {TOP}"
AIM = 1.05
"""What the placement is aimed at, times the goal."""


def netlist(core: Core, ports: list[Port], parameters: Mapping[str, int], folder: Path) -> tuple[Path, Path]:
    """Netlist and pins of the design around a core with these parameters.

    Raises:
        ValueError: Yosys refuses it.
    """
    verilog, pins, out = folder / "harness.v", folder / "pins.xdc", folder / "netlist.json"
    verilog.write_text(harness(core, ports, parameters))
    pins.write_text(constraints(ports))
    sources = " ".join(str(source) for source in (*core.sources, verilog))
    script = "; ".join(
        [f"read_verilog {' '.join(include_flags())} {sources}", *mapping_steps(MAP), f"write_json {out}"]
    )
    run = subprocess.run([sys.executable, "-c", YOSYS, script], cwd=ROOT, capture_output=True, text=True, check=False)
    if run.returncode != 0:
        raise ValueError(f"yosys refuses {core.name}: {(run.stdout + run.stderr).strip().splitlines()[-1]}")
    return out, pins


def slowest(runs: list[dict[str, float]], clocks: Iterable[str]) -> dict[str, float]:
    """The least of each clock over the seeds.

    Raises:
        NotRoutedError: Of one of the clocks a run tells nothing.
    """
    for clock in clocks:
        if any(clock not in run for run in runs):
            raise NotRoutedError(f"nextpnr does not say how fast {clock} is")
    return {clock: min(run[clock] for run in runs) for clock in clocks}


def goals_of(name: str) -> dict[str, float]:
    """MHz that each clock a core can have must reach."""
    fmax = budgets()["fmax"]
    return {"clk": fmax[name], "pix_clk": fmax["pix_clk"]}


def measure(name: str, tool: Nextpnr, seeds: list[int]) -> tuple[dict[str, float], list[str]]:
    """MHz of each clock of a core, and what is wrong with that."""
    with tempfile.TemporaryDirectory() as folder:
        try:
            core = load_core(name)
            ports = ports_of(core, {})
            names = {port.name for port in ports}
            goals = {clock: goal for clock, goal in goals_of(name).items() if clock in names}
            files = netlist(core, ports, {}, Path(folder))
            aim = AIM * max(goals.values())
            worst = slowest([tool.route(*files, aim, seed) for seed in seeds], goals)
        except (NotRoutedError, ValueError) as error:
            return {}, [str(error)]
    slow = [
        f"{clock} {worst[clock]:.1f} MHz, less than {goal:g}" for clock, goal in goals.items() if worst[clock] < goal
    ]
    return worst, slow


def table(worst: dict[str, float], seeds: list[int], name: str) -> str:
    """The timing table of a core's page."""
    goals = goals_of(name)
    rows = [f"| `{clock}` | {mhz:.1f} | {goals[clock]:g} |" for clock, mhz in worst.items()]
    return "\n".join([f"| clock | MHz, worst of {len(seeds)} seeds | goal |", "|---|---|---|", *rows])


def the_tool() -> Nextpnr | None:
    """Nextpnr, fetched if need be; None, and a sentence said, where it is not to be had.

    Raises:
        UserError: It could be had, but loading it failed.
    """
    tool = find(FOLDER)
    if tool is not None:
        return tool
    if why := why_not_here():
        print(f"skipped: nextpnr comes from Debian's packages, and {why}; install {COMMAND} yourself.")
        return None
    print("nextpnr is not here; loading it from Debian sid (24 MB) into build/nextpnr", flush=True)
    fetch(FOLDER)
    return find(FOLDER)


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
    if arguments.write:
        for name in names:
            find_block(read_page(name), "fmax", f"docs/cores/{name}.md")
    tool = the_tool()
    if tool is None:
        return 0
    print(f"yosys and nextpnr {tool.version()} for the Zynq-7020; the slowest of seeds {arguments.seeds}", flush=True)
    failed = False
    for name in names:
        worst, found = measure(name, tool, seeds)
        failed |= bool(found)
        figures = ", ".join(f"{clock} {mhz:.1f} MHz" for clock, mhz in worst.items())
        print(f"{'BAD ' if found else 'ok  '} {name}: {figures or 'no figure'}", flush=True)
        for fault in found:
            print(f"     {fault}")
        if arguments.write and worst:
            put_block(name, "fmax", table(worst, seeds, name))
    if failed:
        print("touchdown: some core is slower than constraints/budgets.toml says; see above.", file=sys.stderr)
    return int(failed)


if __name__ == "__main__":
    run_main(main)

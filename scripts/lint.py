# SPDX-License-Identifier: Apache-2.0
"""Checks of the RTL, of the firmware's C, of the Python code and of Vivado's Tcl."""

import os
import sys
import tomllib
from collections.abc import Mapping

from scripts.errors import ArgumentParser, run_main
from scripts.lint_firmware import lint_firmware
from scripts.lint_run import ROOT, need, run
from scripts.signoff import leave

WAIVERS = ROOT / "scripts" / "lint" / "verilator.vlt"
VERIBLE_RULES = ROOT / "scripts" / "lint" / "verible.rules"
TCL, TCL_RULES = ("scripts/**/*.tcl", "constraints/*.xdc"), ROOT / "scripts" / "lint" / "tclint.toml"


# pyosys has no command of its own; a process of its own keeps an error of one core from the next.
YOSYS = "import sys; from pyosys import libyosys as ys; ys.run_pass(sys.argv[1], ys.Design())"


def yosys_script(top: str, sources: list[str], parameters: Mapping[str, int] | None = None) -> str:
    """Elaborates a core; a latch, a combinational loop or a net with two drivers is an error."""
    steps = [
        f"read_verilog {' '.join(include_flags())} {' '.join(sources)}",
        *(f"chparam -set {name} {value} {top}" for name, value in (parameters or {}).items()),
        f"hierarchy -check -top {top}",
        "proc",
        "flatten",
        "opt_clean",
        "check -assert",
        "select -assert-none t:$dlatch t:$adlatch t:$dlatchsr",
    ]
    return "; ".join(f"tee -q -o {os.devnull} {step}" for step in steps)


def cores() -> dict[str, tuple[str, list[str]]]:
    """Each core's top level and its sources, from rtl/*/core.toml."""
    found = {}
    for path in sorted(ROOT.glob("rtl/*/core.toml")):
        table = tomllib.loads(path.read_text())
        found[path.parent.name] = (table.get("toplevel", path.parent.name), table["sources"])
    return found


def include_flags() -> list[str]:
    """Where generated Verilog headers lie, for both simulators."""
    return ["-Irtl/generated"]


def lint_verilog() -> bool:
    """Each core with the defaults of its parameters in verilator, Icarus and yosys; each file in verible."""
    verilator = [need("verilator"), "--lint-only", "--quiet", "-Wall", "--language", "1364-2005"]
    iverilog, verible = need("iverilog"), need("verible-verilog-lint")
    files = sorted(str(path.relative_to(ROOT)) for path in ROOT.glob("rtl/**/*.v"))
    styled = run("verible", [verible, f"--rules_config={VERIBLE_RULES}", *files])
    clean = styled
    for core, (top, sources) in cores().items():
        found = {"verible": styled}
        flags = [*include_flags(), "--top-module", top, str(WAIVERS), *sources]
        found["verilator"] = run(f"verilator {core}", [*verilator, *flags])
        flags = [*include_flags(), "-s", top, "-o", os.devnull, *sources]
        found["icarus"] = run(f"icarus {core}", [iverilog, "-g2005", "-Wall", *flags])
        script = yosys_script(top, sources)
        found["yosys"] = run(f"yosys {core}", [sys.executable, "-c", YOSYS, script], silent_is_clean=False)
        leave(core, "lint", all(found.values()), f"{sum(found.values())} of {len(found)} tools clean", found)
        clean &= all(found.values())
    return clean


def lint_python() -> bool:
    """Ruff's rules and format over everything."""
    ruff = need("ruff")
    clean = run("ruff check", [ruff, "check", "--quiet", "."])
    return run("ruff format", [ruff, "format", "--check", "--quiet", "."]) and clean


def lint_tcl() -> bool:
    """Style of the scripts for Vivado and the constraints."""
    files = sorted(str(path.relative_to(ROOT)) for place in TCL for path in ROOT.glob(place))
    return run("tclint", [need("tclint"), "-c", str(TCL_RULES), *files])


def main() -> int:
    """Entry point of `make lint`."""
    parser = ArgumentParser(prog="make lint", description=__doc__)
    parser.parse_args()
    results = [lint_verilog(), lint_firmware(), lint_python(), lint_tcl()]
    if not all(results):
        print("touchdown: lint found what is printed above; mend it or waive it with a reason.", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    run_main(main)

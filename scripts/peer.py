# SPDX-License-Identifier: Apache-2.0
"""Area and clock of a core of somebody else, or of a build of ours, in the flow of `make synth` and `make pnr`.

`python -m scripts.peer --top LinkRunCCA --set imwidth=1280 --set imheight=720 <folder>/src/*.v`, or
`python -m scripts.peer --core ccl --set AREA=0 --set MOMENTS=0`. The clock of the core must be called `clk`.
"""

import sys
import tempfile
from pathlib import Path

from scripts.errors import ArgumentParser, UserError, run_main
from scripts.nextpnr import NotRoutedError
from scripts.pnr import AIM, goals_of, netlist, slowest, the_tool
from scripts.pnr_harness import ports_of
from scripts.synth import synthesise
from tb.common.cores import Core, load_core

SEEDS = (1, 2, 3)


def parameters_of(sets: list[str]) -> dict[str, int]:
    """`NAME=VALUE` of the command line.

    Raises:
        UserError: one is not of that form, or its value is no whole number.
    """
    found = {}
    for one in sets:
        name, _, value = one.partition("=")
        if not (name.isidentifier() and value.removeprefix("-").isdecimal()):
            raise UserError(f"--set takes NAME=VALUE with a whole number, not '{one}'.")
        found[name] = int(value)
    return found


def core_of(name: str, top: str, files: list[str]) -> Core:
    """The core that is meant: one of ours by its name, or files and their top module.

    Raises:
        UserError: not just one of these is given, or a file is not there.
    """
    if (bool(name), bool(top), bool(files)) not in ((True, False, False), (False, True, True)):
        raise UserError("say --core and a core of this project, or --top, its module, and the Verilog files.")
    if name:
        return load_core(name)
    missing = [file for file in files if not Path(file).is_file()]
    if missing:
        raise UserError(f"there is no file '{missing[0]}'; name the Verilog sources of {top}.")
    return Core(top, tuple(Path(file).resolve() for file in files), top, ({},))


def main() -> int:
    """Entry point."""
    parser = ArgumentParser(prog="python -m scripts.peer", description=__doc__)
    parser.add_argument("--core", default="", help="a core of this project")
    parser.add_argument("--top", default="", help="top module of the files")
    parser.add_argument("--set", action="append", default=[], metavar="NAME=VALUE", help="a parameter of it")
    parser.add_argument("files", nargs="*", help="Verilog files")
    arguments = parser.parse_args()
    core = core_of(arguments.core, arguments.top, arguments.files)
    parameters = parameters_of(arguments.set)
    try:
        area = synthesise(core.toplevel, [str(source) for source in core.sources], parameters)
        print(f"{core.name}: {area.figure()}; of the LUTs {area.srl} SRL, {area.lutram} LUTRAM", flush=True)
        ports = ports_of(core, parameters)
        if "clk" not in [port.name for port in ports]:
            raise UserError(f"{core.name} has no port `clk`, which is the clock that can be timed.")
        tool = the_tool()
        if tool is None:
            return 0
        with tempfile.TemporaryDirectory() as folder:
            files = netlist(core, ports, parameters, Path(folder))
            # What all of ours but the whole are placed for, so that the figures compare.
            aim = AIM * goals_of("ccl")["clk"]
            runs = [tool.route(*files, aim, seed) for seed in SEEDS]
    except (NotRoutedError, ValueError) as error:
        print(f"touchdown: {error}", file=sys.stderr)
        return 1
    each = ", ".join(f"{run['clk']:.1f}" for run in runs)
    print(f"{core.name}: {slowest(runs, ['clk'])['clk']:.1f} MHz, the slowest of seeds with {each}")
    return 0


if __name__ == "__main__":
    run_main(main)

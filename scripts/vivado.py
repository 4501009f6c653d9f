# SPDX-License-Identifier: Apache-2.0
"""Runs Vivado: `make bitstream`, `make xsa`, `make ip`. The scripts are in scripts/vivado, docs/board.md tells the way.

    python -m scripts.vivado bitstream|xsa --digilent-ip <clone of vivado-library>
    python -m scripts.vivado ip [--core X]

Outputs are in build/vivado (touchdown.bit, touchdown.xsa, reports) and build/ip/<core>.
"""

import os
import re
import shutil
import subprocess
from collections.abc import Mapping
from pathlib import Path

from scripts.board import INCLUDES, headers_of, load_board, part
from scripts.errors import ArgumentParser, UserError, run_main
from scripts.pnr_harness import Port, ports_of
from tb.common.cores import ROOT, Core, core_names, load_core

VERSION = "2023.2"
SCRIPTS = ROOT / "scripts/vivado"
OUTPUT = ROOT / "build/vivado"
PACKAGES = ROOT / "build/ip"
BASES = {"m_axil_landing": "ZYNQ_LANDING_CORE_BASE", "m_axil_display": "ZYNQ_DISPLAY_BASE"}
"""Constants of firmware/board/zynq.h with the addresses of the registers."""
FALLBACK = {"ZYNQ_DISPLAY_BASE": "0x43C10000"}
IP_FILES = ("ip/dvi2rgb/component.xml", "ip/rgb2dvi/component.xml", "if/tmds_v1_0/tmds.xml")
"""What a clone of Digilent's library has."""


def quoted(value: object) -> str:
    """One word of Tcl.

    Raises:
        UserError: Tcl cannot have it in braces.
    """
    text = str(value)
    if re.search(r"[{}\\]", text):
        raise UserError(f"'{text}' has braces or backslashes, which Tcl would take apart; move the project elsewhere.")
    return f"{{{text}}}"


def listed(values: object) -> str:
    """A list of Tcl."""
    return quoted_list([quoted(value) for value in values])


def quoted_list(words: list[str]) -> str:
    """A list of Tcl of words that are quoted."""
    return "{" + " ".join(words) + "}"


def write_inputs(path: Path, values: Mapping[str, str]) -> Path:
    """A Tcl file that sets variables to words that are quoted."""
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text("".join(f"set {name} {value}\n" for name, value in values.items()), encoding="utf-8")
    return path


def register_bases() -> dict[str, str]:
    """Address of each set of registers, from where the firmware has it."""
    text = (ROOT / "firmware/board/zynq.h").read_text(encoding="utf-8")
    found = dict(re.findall(r"#define (\w+) (0x[0-9A-Fa-f]+)U\b", text))
    return {port: {**FALLBACK, **found}[name] for port, name in BASES.items()}


def check_library(path: str) -> Path:
    """The folder of Digilent's library.

    Raises:
        UserError: None was named, or the folder has no such library.
    """
    if not path:
        raise UserError("give DIGILENT_IP= a clone of Digilent's vivado-library; docs/board.md says how to get it.")
    folder = Path(path).resolve()
    for name in IP_FILES:
        if not (folder / name).is_file():
            raise UserError(f"{path} is no clone of Digilent's vivado-library: it has no {name}.")
    return folder


def board_inputs(goal: str, library: Path, out: Path = OUTPUT) -> Path:
    """What build.tcl reads."""
    board = load_board()
    bases = [word for port, base in register_bases().items() for word in (port, base)]
    return write_inputs(
        out / "inputs.tcl",
        {
            "wanted_version": VERSION,
            "goal": goal,
            "out": quoted(out),
            "part": board.part,
            "top": board.toplevel,
            "digilent_ip": quoted(library),
            "sources": listed(board.sources),
            "include_dirs": listed([INCLUDES]),
            "constraints": listed(board.constraints),
            "register_bases": listed(bases),
        },
    )


def interfaces_of(ports: list[Port]) -> dict[str, tuple[str, list[str]]]:
    """AXI interfaces among the ports: name -> kind and ports."""
    names = [port.name for port in ports]
    found = {}
    for name in names:
        for end, kind in (("_tvalid", "axis"), ("_awvalid", "aximm"), ("_arvalid", "aximm")):
            if name.endswith(end):
                prefix = name.removesuffix(end)
                members = [other for other in names if re.fullmatch(rf"{prefix}_[a-z]+", other)]
                found[prefix] = (f"xilinx.com:interface:{kind}_rtl:1.0", members)
    return found


def description_of(core: Core) -> str:
    """What the core's page says first, without what Tcl may take for its own; its name if it has no page."""
    page = ROOT / f"docs/cores/{core.name}.md"
    text = page.read_text(encoding="utf-8").splitlines()[2] if page.is_file() else core.name
    return re.sub(r"[^\w .,;:()/+-]", "", text)


def package_inputs(core: Core, out: Path = PACKAGES) -> Path:
    """What package_ip.tcl reads for one core."""
    ports = ports_of(core, {})
    names = [port.name for port in ports]
    words = []
    for name, (vlnv, members) in interfaces_of(ports).items():
        words += [name, vlnv, listed(members)]
    headers = headers_of(core.sources)
    return write_inputs(
        out / "inputs" / f"{core.name}.tcl",
        {
            "wanted_version": VERSION,
            "out": quoted(out / core.name),
            "part": part(),
            "top": core.toplevel,
            "description": quoted(description_of(core)),
            "sources": listed([*core.sources, *headers]),
            "headers": listed(headers),
            "include_dirs": listed([INCLUDES]),
            "interfaces": quoted_list(words),
            "registers": listed([name for name in interfaces_of(ports) if name.startswith("s_axil")]),
            "clocks": listed([name for name in ("clk", "pix_clk") if name in names]),
            "resets": listed([name for name in ("rst",) if name in names]),
        },
    )


def need_vivado() -> str:
    """Path of the Vivado that the scripts are written for.

    Raises:
        UserError: There is none on PATH, or another version.
    """
    tool = shutil.which("vivado")
    if tool is None:
        raise UserError(f"vivado is not on PATH; source settings64.sh of Vivado {VERSION}, see docs/board.md.")
    run = subprocess.run([tool, "-version"], capture_output=True, text=True, check=False)
    match = re.search(r"v(\d{4}\.\d)", run.stdout)
    if match is None or match[1] != VERSION:
        raise UserError(
            f"this is Vivado {match[1] if match else 'of no known version'}; the scripts are for {VERSION}."
        )
    return tool


def run_script(tool: str, script: str, inputs: Path, log: Path) -> None:
    """Run one Tcl script.

    Raises:
        UserError: Vivado stopped; its own sentence, or where to look.
    """
    log.parent.mkdir(parents=True, exist_ok=True)
    command = [tool, "-mode", "batch", "-nojournal", "-log", str(log), "-source", str(SCRIPTS / script)]
    print(f"vivado {script}: log in {os.path.relpath(log, ROOT)}", flush=True)
    run = subprocess.run(
        [*command, "-tclargs", str(inputs)], cwd=log.parent, capture_output=True, text=True, check=False
    )
    said = [line.removeprefix("touchdown: ") for line in run.stdout.splitlines() if line.startswith("touchdown: ")]
    if run.returncode == 0:
        print("\n".join(said))
        return
    given_up = [line for line in run.stderr.splitlines() if line.startswith("touchdown: ")]
    errors = [line for line in (run.stdout + run.stderr).splitlines() if line.startswith("ERROR")]
    vivado_said = errors[0] if errors else "it gave no reason"
    sentence = given_up[0].removeprefix("touchdown: ") if given_up else f"Vivado stopped: {vivado_said}"
    raise UserError(f"{sentence.rstrip('.')}; the log is {os.path.relpath(log, ROOT)}.")


def main() -> int:
    """Entry point."""
    parser = ArgumentParser(prog="python -m scripts.vivado", description=__doc__)
    parser.add_argument("goal", choices=("bitstream", "xsa", "ip"))
    parser.add_argument("--digilent-ip", default="", help="clone of Digilent's vivado-library")
    parser.add_argument("--core", default="", help="one core to package; all when left out")
    arguments = parser.parse_args()
    if arguments.goal == "ip":
        cores = [load_core(name) for name in ([arguments.core] if arguments.core else core_names())]
        tool = need_vivado()
        for core in cores:
            run_script(tool, "package_ip.tcl", package_inputs(core), PACKAGES / "logs" / f"{core.name}.log")
        return 0
    tool = need_vivado()
    library = check_library(arguments.digilent_ip)
    run_script(tool, "build.tcl", board_inputs(arguments.goal, library), OUTPUT / "vivado.log")
    return 0


if __name__ == "__main__":
    run_main(main)

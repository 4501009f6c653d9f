# SPDX-License-Identifier: Apache-2.0
"""`make flash`: bitstream and firmware into a board by its USB cable, until power is switched off.

The processor is reset and set up, then the logic is loaded (openFPGALoader), then the firmware starts. The first and
the last step are xsct's (Vitis), or OpenOCD's with `--tool openocd`.
"""

import struct
from pathlib import Path

from scripts.errors import UserError, run_main
from scripts.flash_steps import SCRIPTS, Step, files_parser, need_files, need_tool, run_steps, shown, take_ps7_init
from tb.common.cores import ROOT

FOLDER = ROOT / "build/flash"
BOARD = "arty_z7_20"
NO_BOARD = "connect USB socket J14, set jumper JP4 to JTAG, switch the board on, and close other users of the cable"
WHERE = {
    "openFPGALoader": "install Debian's openfpgaloader",
    "xsct": "source settings64.sh of Vitis 2023.2, or give TOOL=openocd",
    "openocd": "install Debian's openocd, or give TOOL=xsct",
}
OPENOCD = ("openocd", "-f", shown(SCRIPTS / "cable.tcl"), "-f", "target/zynq_7000.cfg")


def entry_of(elf: Path) -> int:
    """Where a 32-bit ARM program starts.

    Raises:
        UserError: The file is no such program.
    """
    head = elf.read_bytes()[:52]
    if len(head) < 52 or head[:7] != b"\x7fELF\x01\x01\x01" or struct.unpack_from("<H", head, 18)[0] != 40:
        raise UserError(f"{shown(elf)} is no program for a 32-bit ARM; run `make firmware`.")
    return struct.unpack_from("<I", head, 24)[0]


def steps(tool: str, bit: Path, elf: Path | None, ps7_init: Path, entry: int) -> list[Step]:
    """The commands, in their order; without a program the processor is left waiting."""
    load = Step(("openFPGALoader", "-b", BOARD, shown(bit)), NO_BOARD)
    if tool == "xsct":
        script = shown(SCRIPTS / "xsct.tcl")
        before = ("xsct", script, "init", shown(ps7_init))
        after = ("xsct", script, "run", shown(ps7_init), *([shown(elf)] if elf else []))
    else:
        script = shown(SCRIPTS / "openocd.tcl")
        before = (*OPENOCD, "-f", script, "-c", f"ps_init {{{shown(ps7_init)}}}")
        program = f" {{{shown(elf)}}} {entry:#010x}" if elf else ""
        after = (*OPENOCD, "-f", script, "-c", f"ps_run {{{shown(ps7_init)}}}{program}")
    return [Step(before, NO_BOARD), load, Step(after, NO_BOARD)]


def main() -> int:
    """Entry point of `make flash`."""
    parser = files_parser("make flash", __doc__)
    parser.add_argument("--tool", default="xsct", choices=("xsct", "openocd"), help="for the processor")
    parser.add_argument("--no-firmware", action="store_true", help="load and set up, but start no program")
    arguments = parser.parse_args()
    elf = None if arguments.no_firmware else arguments.elf
    ps7_init = FOLDER / "ps7_init.tcl"
    entry = 0x00100000
    if not arguments.dry_run:
        need_files(bit=(arguments.bit, "make bitstream"), xsa=(arguments.xsa, "make xsa"))
        if elf:
            need_files(elf=(elf, "make firmware"))
        for tool in ("openFPGALoader", arguments.tool):
            need_tool(tool, WHERE[tool])
        entry = entry_of(elf) if elf else 0
        ps7_init = take_ps7_init(arguments.xsa, FOLDER)
    run_steps(steps(arguments.tool, arguments.bit, elf, ps7_init, entry), dry=arguments.dry_run)
    if not arguments.dry_run:
        state = "The firmware runs" if elf else "The logic runs, the processor waits"
        print(f"{state}. docs/board.md says what is to be seen now.")
    return 0


if __name__ == "__main__":
    run_main(main)

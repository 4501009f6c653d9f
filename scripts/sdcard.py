# SPDX-License-Identifier: Apache-2.0
"""`make sdcard`: BOOT.BIN with boot loader, bitstream and firmware, for a card from which the board starts by itself.

The boot loader is made by xsct (Vitis) from the hardware description, unless one is named; bootgen joins the three.
With `--card` the result is copied to a mounted card.
"""

import shutil
from pathlib import Path

from scripts.errors import UserError, run_main
from scripts.flash_steps import SCRIPTS, Step, files_parser, need_files, need_tool, run_steps, shown
from tb.common.cores import ROOT

FOLDER = ROOT / "build/sdcard"
FSBL = "touchdown/export/touchdown/sw/touchdown/boot/fsbl.elf"
"""Where Vitis leaves the boot loader."""
VITIS = "source settings64.sh of Vitis 2023.2"


def image_list(fsbl: Path, bit: Path, elf: Path) -> str:
    """What bootgen reads: the parts in the order in which they are loaded."""
    lines = ["touchdown:", "{", f"    [bootloader] {shown(fsbl)}", f"    {shown(bit)}", f"    {shown(elf)}", "}"]
    return "\n".join(lines) + "\n"


def steps(folder: Path, xsa: Path, *, with_fsbl: bool) -> list[Step]:
    """The commands, in their order."""
    make = ("xsct", shown(SCRIPTS / "fsbl.tcl"), shown(xsa), shown(folder))
    join = (
        "bootgen",
        "-arch",
        "zynq",
        "-image",
        shown(folder / "boot.bif"),
        "-o",
        shown(folder / "BOOT.BIN"),
        "-w",
        "on",
    )
    first = [Step(make, f"see what {make[0]} printed in {shown(folder)}")] if with_fsbl else []
    return [*first, Step(join, "see whether the three files are of one build")]


def copy_to(card: Path, boot: Path) -> None:
    """Copy the result to a card.

    Raises:
        UserError: There is no such folder, or it cannot be written.
    """
    try:
        shutil.copyfile(boot, card / boot.name)
    except OSError as error:
        raise UserError(f"{card} takes no file ({error.strerror}); mount the card's FAT32 partition there.") from error


def main() -> int:
    """Entry point of `make sdcard`."""
    parser = files_parser("make sdcard", __doc__)
    parser.add_argument("--fsbl", type=Path, help="a first stage boot loader; made from the .xsa when left out")
    parser.add_argument("--card", type=Path, help="folder where the card is mounted")
    arguments = parser.parse_args()
    dry, fsbl, boot = arguments.dry_run, arguments.fsbl or FOLDER / FSBL, FOLDER / "BOOT.BIN"
    text = image_list(fsbl, arguments.bit, arguments.elf)
    if dry:
        print(text, end="")
    else:
        need_files(bit=(arguments.bit, "make bitstream"), elf=(arguments.elf, "make firmware"))
        if arguments.fsbl:
            need_files(fsbl=(arguments.fsbl, "make sdcard"))
        else:
            need_files(xsa=(arguments.xsa, "make xsa"))
            need_tool("xsct", VITIS)
            shutil.rmtree(FOLDER, ignore_errors=True)
        need_tool("bootgen", VITIS)
        FOLDER.mkdir(parents=True, exist_ok=True)
        boot.unlink(missing_ok=True)
        (FOLDER / "boot.bif").write_text(text, encoding="utf-8")
    run_steps(steps(FOLDER, arguments.xsa, with_fsbl=arguments.fsbl is None), dry=dry)
    if dry:
        return 0
    if not boot.is_file():
        raise UserError("bootgen left no BOOT.BIN; run its command above by hand and read what it says.")
    if arguments.card:
        copy_to(arguments.card, boot)
    where = arguments.card / boot.name if arguments.card else boot
    print(f"{shown(where)} is there. Card into the board, jumper JP4 to SD, power on.")
    return 0


if __name__ == "__main__":
    run_main(main)

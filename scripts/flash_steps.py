# SPDX-License-Identifier: Apache-2.0
"""What `make flash` and `make sdcard` share: files that must be there, tools, steps that are run or only printed."""

import os
import shlex
import shutil
import subprocess
import sys
import zipfile
from dataclasses import dataclass
from pathlib import Path

from scripts.errors import ArgumentParser, UserError
from tb.common.cores import ROOT

SCRIPTS = ROOT / "scripts/flash"
BIT = ROOT / "build/vivado/touchdown.bit"
XSA = ROOT / "build/vivado/touchdown.xsa"
ELF = ROOT / "build/firmware/touchdown.elf"


@dataclass(frozen=True)
class Step:
    """One command, and the sentence that says what to do when it fails."""

    command: tuple[str, ...]
    advice: str


def files_parser(prog: str, description: str | None) -> ArgumentParser:
    """Options that both commands have."""
    parser = ArgumentParser(prog=prog, description=description)
    parser.add_argument("--bit", type=Path, default=BIT, help="bitstream, from make bitstream")
    parser.add_argument("--xsa", type=Path, default=XSA, help="hardware description, from make xsa")
    parser.add_argument("--elf", type=Path, default=ELF, help="firmware, from make firmware")
    parser.add_argument("--dry-run", action="store_true", help="print the commands and do nothing")
    return parser


def shown(path: Path) -> str:
    """A path as a user would type it."""
    return os.path.relpath(path, ROOT) if path.is_relative_to(ROOT) else str(path)


def need_files(**makers: tuple[Path, str]) -> None:
    """Files that must be there, and the command that makes each.

    Raises:
        UserError: One is missing or empty.
    """
    for path, maker in makers.values():
        if not path.is_file() or path.stat().st_size == 0:
            raise UserError(f"{shown(path)} is not there; run `{maker}` first.")


def need_tool(name: str, advice: str) -> None:
    """A tool on PATH, or in the virtual environment.

    Raises:
        UserError: It is not there.
    """
    if shutil.which(name, path=search_path()) is None:
        raise UserError(f"{name} is not on PATH; {advice}.")


def search_path() -> str:
    """PATH, and behind it where the tools of the virtual environment are."""
    return os.environ.get("PATH", "") + os.pathsep + str(Path(sys.executable).parent)


def take_ps7_init(xsa: Path, folder: Path) -> Path:
    """The processor's settings out of a hardware description.

    Raises:
        UserError: It is none, or has no such file.
    """
    folder.mkdir(parents=True, exist_ok=True)
    try:
        with zipfile.ZipFile(xsa) as archive:
            text = archive.read("ps7_init.tcl")
    except (zipfile.BadZipFile, KeyError):
        raise UserError(f"{shown(xsa)} has no ps7_init.tcl; make it anew by `make xsa`.") from None
    path = folder / "ps7_init.tcl"
    path.write_bytes(text)
    return path


def run_steps(steps: list[Step], *, dry: bool) -> None:
    """Run the commands one after the other from the project root, or print them.

    Raises:
        UserError: One failed.
    """
    for step in steps:
        print(shlex.join(step.command), flush=True)
        if dry:
            continue
        tool = shutil.which(step.command[0], path=search_path())
        run = subprocess.run(
            [tool or step.command[0], *step.command[1:]], cwd=ROOT, capture_output=True, text=True, check=False
        )
        if run.returncode != 0:
            said = (run.stderr.strip() or run.stdout.strip() or "nothing").splitlines()[-1]
            raise UserError(f"{step.command[0]} failed ({said}); {step.advice}.")

# SPDX-License-Identifier: Apache-2.0
"""nextpnr for Xilinx 7 (himbaechel) with the chip database of the Zynq-7020: the machine's own, or one from Debian sid.

Debian's stable release has none, so the packages of sid are laid out in `build/nextpnr` and run with their own loader
and C library; nothing is installed. Sid moves on: what ran says its version.
"""

import re
import shutil
import subprocess
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from scripts.errors import UserError

COMMAND = "nextpnr-himbaechel-xilinx"
DEVICE = "xc7z020clg400-1"
CHIP = "usr/share/nextpnr/himbaechel/xilinx/chipdb-xc7z020.bin"
LIBRARIES = "usr/lib/x86_64-linux-gnu"
SID = "deb [signed-by=/usr/share/keyrings/debian-archive-keyring.gpg] http://deb.debian.org/debian sid main\n"
MHZ = re.compile(r"Max frequency for clock '([^']*)': ([0-9.]+) MHz")


class NotRoutedError(Exception):
    """Nextpnr ended without a routed design; the message is its last error."""


@dataclass(frozen=True)
class Nextpnr:
    """How to call it."""

    command: tuple[str, ...]

    def version(self) -> str:
        """What it calls itself."""
        run = subprocess.run([*self.command, "--version"], capture_output=True, text=True, check=False)
        found = re.search(r"Version ([^)\s]+)", run.stdout + run.stderr)
        return found[1] if found else "unknown"

    def route(self, netlist: Path, pins: Path, mhz: float, seed: int) -> dict[str, float]:
        """Place and route a netlist of yosys.

        Args:
            netlist: JSON.
            pins: XDC with the place of each pin.
            mhz: What each clock is aimed at.
            seed: Of the placement; the same gives the same.

        Returns:
            MHz of each clock after routing, by its net.

        Raises:
            NotRoutedError: It gave up.
        """
        inputs = ["--device", DEVICE, "--json", str(netlist), "-o", f"xdc={pins}"]
        goals = ["--freq", f"{mhz:g}", "--seed", str(seed), "--timing-allow-fail"]
        run = subprocess.run([*self.command, *inputs, *goals], capture_output=True, text=True, check=False)
        log = run.stdout + run.stderr
        if run.returncode != 0:
            errors = [line for line in log.splitlines() if line.startswith("ERROR")]
            raise NotRoutedError(errors[-1] if errors else f"nextpnr ended with {run.returncode}")
        # Each clock stands there once after placement and once after routing.
        return {net: float(figure) for net, figure in MHZ.findall(log)}


def find(root: Path) -> Nextpnr | None:
    """The machine's own, or the one that `fetch` laid out in this folder."""
    own = shutil.which(COMMAND)
    if own is not None:
        return Nextpnr((own,))
    libraries, program = root / LIBRARIES, root / "usr/bin" / COMMAND
    loader = libraries / "ld-linux-x86-64.so.2"
    if not (program.is_file() and loader.is_file() and (root / CHIP).is_file()):
        return None
    by_itself = (str(loader), "--library-path", str(libraries), str(program))
    return Nextpnr((*by_itself, "--chipdb", str(root / CHIP)))


def _run(command: Sequence[str], what: str) -> None:
    run = subprocess.run(command, capture_output=True, text=True, check=False)
    if run.returncode != 0:
        lines = (run.stderr or run.stdout).strip().splitlines()
        raise UserError(f"{what} failed: {lines[-1] if lines else 'no reason given'}")


def fetch(root: Path) -> None:
    """Lay the packages of Debian sid out in a folder (24 MB to load, 285 MB on disk).

    Raises:
        UserError: This is no Debian on x86-64, or its packages cannot be reached.
    """
    for tool in ("apt-get", "dpkg-deb", "tar"):
        if shutil.which(tool) is None:
            raise UserError(
                f"nextpnr comes from Debian's packages, and {tool} is not here; install {COMMAND} yourself."
            )
    apt = root.parent / "nextpnr-apt"
    shutil.rmtree(root, ignore_errors=True)
    shutil.rmtree(apt, ignore_errors=True)
    for folder in ("state/lists/partial", "cache/archives/partial", "none"):
        (apt / folder).mkdir(parents=True)
    (apt / "sources.list").write_text(SID)
    (apt / "status").touch()
    settings = {
        "Dir::State": apt / "state",
        "Dir::State::status": apt / "status",
        "Dir::Cache": apt / "cache",
        "Dir::Etc::sourcelist": apt / "sources.list",
        "Dir::Etc::sourceparts": apt / "none",
        "Dir::Etc::preferencesparts": apt / "none",
        "APT::Sandbox::User": "root",
        "APT::Architecture": "amd64",
        "APT::Install-Recommends": "false",
        "Acquire::Languages": "none",
    }
    options = [f"-o{name}={value}" for name, value in settings.items()]
    _run(["apt-get", *options, "update"], "apt-get update of Debian sid")
    _run(["apt-get", *options, "install", "-y", "--download-only", COMMAND], f"apt-get of {COMMAND}")
    root.mkdir(parents=True)
    for package in sorted((apt / "cache/archives").glob("*.deb")):
        _run(["dpkg-deb", "--extract", str(package), str(root)], f"unpacking {package.name}")
    shutil.rmtree(apt)

# SPDX-License-Identifier: Apache-2.0
"""nextpnr for Xilinx 7 (himbaechel) with the chip database of the Zynq-7020: the machine's own, or one from Debian sid.

Debian's stable release has none, so the packages of sid are laid out in `build/nextpnr` and run with their own loader
and C library; nothing is installed. Sid moves on: what ran says its version.
"""

import json
import platform
import re
import shutil
import subprocess
import tempfile
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from scripts.errors import UserError

COMMAND = "nextpnr-himbaechel-xilinx"
DEVICE = "xc7z020clg400-1"
CHIP = "usr/share/nextpnr/himbaechel/xilinx/chipdb-xc7z020.bin"
LIBRARIES = "usr/lib/x86_64-linux-gnu"
SOURCES = Path("/etc/apt")
SID = "deb [signed-by=/usr/share/keyrings/debian-archive-keyring.gpg] {archive} sid main\n"
BUFFERS = ("IBUF", "BUFG", "BUFGCTRL")
MHZ = re.compile(r"Max frequency for clock +'([^']*)': ([0-9.]+) MHz")


class NotRoutedError(Exception):
    """Nextpnr gave no figure; the message says why."""


@dataclass(frozen=True)
class Nextpnr:
    """How to call it."""

    command: tuple[str, ...]

    def version(self) -> str:
        """What it calls itself.

        Raises:
            UserError: It does not run.
        """
        found = re.search(r"Version ([^)\s]+)", _output([*self.command, "--version"])[1])
        if found is None:
            raise UserError(f"{COMMAND} does not run here; remove build/nextpnr, or what is on PATH, and try again.")
        return found[1]

    def route(self, netlist: Path, pins: Path, mhz: float, seed: int) -> dict[str, float]:
        """Place and route a netlist of yosys.

        Args:
            netlist: JSON.
            pins: XDC with the place of each pin.
            mhz: What each clock is aimed at.
            seed: Of the placement; the same gives the same.

        Returns:
            MHz of each clock after routing, by its name in the core.

        Raises:
            NotRoutedError: It gave up.
        """
        inputs = ["--device", DEVICE, "--json", str(netlist), "-o", f"xdc={pins}"]
        goals = ["--freq", f"{mhz:g}", "--seed", str(seed), "--timing-allow-fail"]
        code, log = _output([*self.command, *inputs, *goals])
        if code != 0:
            errors = [line for line in log.splitlines() if line.startswith("ERROR")]
            raise NotRoutedError(errors[-1] if errors else f"nextpnr ended with {code}")
        # Each clock stands there after placement and after routing, with a suffix where it begins at a buffer.
        ports = clock_ports(json.loads(netlist.read_text(encoding="utf-8")))
        return {ports.get(net.split("$")[0], net): float(figure) for net, figure in MHZ.findall(log)}


def clock_ports(design: dict) -> dict[str, str]:
    """Which port each net is: of all names of what a port drives, through its buffers.

    Args:
        design: what yosys writes.
    """
    top = next(module for module in design["modules"].values() if module.get("attributes", {}).get("top"))
    buffers = {
        cell["connections"]["I"][0]: cell["connections"]["O"][0]
        for cell in top["cells"].values()
        if cell["type"] in BUFFERS
    }
    ports = {}
    for name, port in top["ports"].items():
        bit = port["bits"][0]
        bits = {bit}
        while bit in buffers:
            bit = buffers[bit]
            bits.add(bit)
        ports |= {net: name for net, facts in top["netnames"].items() if bits & set(facts["bits"])}
    return ports


def _output(command: Sequence[str]) -> tuple[int, str]:
    """Exit code of a command and all that it prints.

    Raises:
        UserError: It cannot be started.
    """
    try:
        run = subprocess.run(command, capture_output=True, text=True, check=False)
    except OSError as error:
        raise UserError(f"{command[0]} cannot be started: {error.strerror}.") from error
    return run.returncode, run.stdout + run.stderr


def find(root: Path) -> Nextpnr | None:
    """The machine's own, or the one that `fetch` laid out in this folder."""
    own = shutil.which(COMMAND)
    return Nextpnr((own,)) if own is not None else find_in(root)


def find_in(root: Path) -> Nextpnr | None:
    """The one whose packages are laid out in a folder."""
    libraries, program = root / LIBRARIES, root / "usr/bin" / COMMAND
    loader = libraries / "ld-linux-x86-64.so.2"
    if not (program.is_file() and loader.is_file() and (root / CHIP).is_file()):
        return None
    by_itself = (str(loader), "--library-path", str(libraries), str(program))
    return Nextpnr((*by_itself, "--chipdb", str(root / CHIP)))


def why_not_here() -> str:
    """Why Debian's packages are of no use on this machine; empty where they are."""
    if platform.machine() != "x86_64":
        return f"this machine is {platform.machine()}, not x86_64"
    missing = [tool for tool in ("apt-get", "dpkg-deb") if shutil.which(tool) is None]
    return f"{missing[0]} is not here" if missing else ""


def archive() -> str:
    """Where this machine has its Debian packages from.

    Raises:
        UserError: Its sources of packages name no archive of Debian.
    """
    for path in [SOURCES / "sources.list", *sorted((SOURCES / "sources.list.d").glob("*"))]:
        text = path.read_text(encoding="utf-8") if path.is_file() else ""
        found = re.search(r"^[^#\n]*?(\w+://\S+/debian)/?\s", text, re.MULTILINE)
        if found:
            return found[1]
    raise UserError(f"the sources of packages in {SOURCES} name no archive of Debian; install {COMMAND} yourself.")


def fetch(root: Path) -> None:
    """Lay the packages of Debian sid out in a folder (24 MB to load, 285 MB on disk): all of it, or nothing.

    Raises:
        UserError: The packages cannot be loaded or laid out.
    """
    try:
        root.parent.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryDirectory(prefix="nextpnr-", dir=root.parent) as folder:
            new = Path(folder) / "root"
            _lay_out(Path(folder), new)
            tool = find_in(new)
            if tool is None:
                raise UserError(f"the packages of {COMMAND} do not hold what is needed; install it yourself.")
            tool.version()
            new.replace(root)
    except OSError as error:
        raise UserError(f"nextpnr cannot be laid out in {root}: {error.strerror}.") from error


def _lay_out(apt: Path, root: Path) -> None:
    """Load the packages, in a folder of apt's own, and unpack them."""
    for folder in ("state/lists/partial", "cache/archives/partial", "none"):
        (apt / folder).mkdir(parents=True)
    (apt / "sources.list").write_text(SID.format(archive=archive()))
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
        "APT::Update::Error-Mode": "any",
        "Acquire::Languages": "none",
    }
    options = [f"-o{name}={value}" for name, value in settings.items()]
    _do(["apt-get", *options, "update"], "apt-get update of Debian sid")
    _do(["apt-get", *options, "install", "-y", "--download-only", COMMAND], f"apt-get of {COMMAND}")
    root.mkdir()
    for package in sorted((apt / "cache/archives").glob("*.deb")):
        _do(["dpkg-deb", "--extract", str(package), str(root)], f"unpacking {package.name}")


def _do(command: Sequence[str], what: str) -> None:
    code, text = _output(command)
    if code != 0:
        lines = text.strip().splitlines()
        raise UserError(f"{what} failed: {lines[-1] if lines else 'no reason given'}")

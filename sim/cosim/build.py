# SPDX-License-Identifier: Apache-2.0
"""Builds what the co-simulation runs; make finds out what is out of date."""

import fcntl
import os
import shutil
import subprocess
from pathlib import Path

from scripts.errors import UserError
from tb.common.cores import load_core

ROOT = Path(__file__).resolve().parents[2]
BUILD = ROOT / "build" / "cosim"
PLUGIN = BUILD / "touchdown-plugin.so"
FLIGHT_PLUGIN = BUILD / "touchdown-flight-plugin.so"
METER_PLUGIN = BUILD / "touchdown-meter-plugin.so"
HOST = BUILD / "touchdown-host"
STAGES = BUILD / "landing-stages"
FULL_HD_STAGES = BUILD / "full-hd-landing-stages"
ELF = ROOT / "build" / "firmware" / "touchdown.elf"


def need(tool: str, advice: str = "run `make setup`") -> str:
    """Path of a tool.

    Raises:
        UserError: the tool is not on PATH.
    """
    path = shutil.which(tool, path=_path())
    if path is None:
        raise UserError(f"{tool} is not installed: {advice}.")
    return path


def _path() -> str:
    return f"{ROOT / '.venv' / 'bin'}{os.pathsep}{os.environ.get('PATH', '')}"


def _make(label: str, arguments: list[str]) -> None:
    """Run make from the project root; its output goes to build/cosim/<label>.log.

    Two processes that want the same thing take turns.

    Raises:
        UserError: make failed.
    """
    make = need("make")
    BUILD.mkdir(parents=True, exist_ok=True)
    log = BUILD / f"{label}.log"
    with (BUILD / "lock").open("w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        with log.open("w") as output:
            command = [make, "--no-print-directory", *arguments]
            environment = {**os.environ, "PATH": _path()}
            for variable in ("MAKEFLAGS", "MFLAGS", "MAKELEVEL"):
                environment.pop(variable, None)
            run = subprocess.run(
                command, cwd=ROOT, stdout=output, stderr=subprocess.STDOUT, env=environment, check=False
            )
    if run.returncode != 0:
        reason = f"{last_error(log.read_text())} (see {log.relative_to(ROOT)})"
        raise UserError(f"building the {label} of the co-simulation failed: {reason}.")


def last_error(output: str) -> str:
    """The line of a build's output that most likely says why it failed."""
    lines = [line.strip() for line in output.splitlines() if line.strip()]
    errors = [line for line in lines if "error" in line.lower() and not line.startswith("make")]
    return (errors or lines or ["it printed nothing"])[0].rstrip(".")


def _build(target: str) -> None:
    need("verilator")
    need("g++")
    sources = " ".join(str(path.relative_to(ROOT)) for path in load_core("landing_core").sources)
    _make(target, ["-f", "sim/cosim/cosim.mk", f"RTL={sources}", target])


def build_plugin() -> Path:
    """The QEMU plugin with landing_core inside."""
    _build("plugin")
    return PLUGIN


def build_flight_plugin() -> Path:
    """The QEMU plugin of a flight: landing_core fed with shapes instead of pixels."""
    _build("flight-plugin")
    return FLIGHT_PLUGIN


def build_meter_plugin() -> Path:
    """The QEMU plugin that counts instructions."""
    _build("meter-plugin")
    return METER_PLUGIN


def build_host() -> Path:
    """landing_core and the firmware's core in one host program."""
    _build("host")
    return HOST


def build_stages(full_hd: bool = False) -> Path:
    """The program that writes what passes between the stages of landing_core; built for 1920x1080 if wanted."""
    _build("full-hd-stages" if full_hd else "stages")
    return FULL_HD_STAGES if full_hd else STAGES


def build_firmware(ground_baud: int | None = None) -> Path:
    """The ELF that also runs on the board; in a folder of its own where the ground's wire has another rate."""
    need("arm-none-eabi-gcc")
    if ground_baud is None:
        _make("firmware", ["-C", "firmware", "elf"])
        return ELF
    out = ELF.parent.with_name(f"firmware-{ground_baud}")
    _make(out.name, ["-C", "firmware", f"OUT={out}", f"GROUND_BAUD={ground_baud}", "elf"])
    return out / ELF.name


def symbols(elf: Path) -> dict[str, int]:
    """Addresses of an ELF's symbols."""
    nm = need("arm-none-eabi-nm")
    lines = subprocess.run([nm, str(elf)], capture_output=True, text=True, check=True).stdout.splitlines()
    rows = [line.split() for line in lines]
    return {row[2]: int(row[0], 16) for row in rows if len(row) == 3}

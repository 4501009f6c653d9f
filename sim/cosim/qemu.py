# SPDX-License-Identifier: Apache-2.0
"""The one QEMU that the co-simulation's plugin works with."""

import re
import subprocess
from pathlib import Path

from scripts.errors import UserError
from sim.cosim.build import need

SERIES = "7.2"
PROGRAM = "qemu-system-arm"
ADVICE = f"install Debian 12's package {PROGRAM} ({SERIES}), or use FIRMWARE=host"


def find_qemu() -> str:
    """Path of QEMU.

    Raises:
        UserError: it is absent or of another series than the plugin knows.
    """
    path = need(PROGRAM, ADVICE)
    run = subprocess.run([path, "--version"], capture_output=True, text=True, check=False)
    match = re.search(r"version (\d+\.\d+)", run.stdout)
    if match is None:
        raise UserError(f"{path} does not say which version of QEMU it is: {ADVICE}.")
    if match[1] != SERIES:
        raise UserError(f"the co-simulation works with QEMU {SERIES} and {path} is {match[1]}: {ADVICE}.")
    return path


def qemu_command(
    qemu: str, elf: Path, plugin: Path, arguments: dict[str, object], out_dir: Path, *, log_uarts: bool = True
) -> list[str]:
    """Command line that runs `elf` on the Zynq with the plugin; UARTs go to files in `out_dir`, or to the plugin alone.

    `-icount shift=1,sleep=off` makes an instruction 2 ns and skips time in which the CPU sleeps; `-S` lets the plugin
    map its registers before the first instruction.
    """
    uarts = [f"file:{out_dir / name}" if log_uarts else "null" for name in ("uart0.bin", "uart1.bin")]
    options = "".join(f",{key}={value}" for key, value in arguments.items())
    return [
        *(qemu, "-M", "xilinx-zynq-a9", "-m", "512M", "-icount", "shift=1,sleep=off", "-S"),
        *("-display", "none", "-nodefaults", "-monitor", "none"),
        *("-serial", uarts[0], "-serial", uarts[1]),
        *("-kernel", str(elf), "-plugin", f"file={plugin}{options}"),
    ]


def last_sentence(log: Path) -> str:
    """What one of our plugins or programs said last before it ended; nothing if it said nothing."""
    lines = log.read_text(errors="replace").splitlines()
    return next((line.removeprefix("touchdown: ") for line in reversed(lines) if line.startswith("touchdown: ")), "")

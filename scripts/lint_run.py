# SPDX-License-Identifier: Apache-2.0
"""How `make lint` finds and runs a tool."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

from scripts.errors import UserError

ROOT = Path(__file__).resolve().parent.parent


def need(tool: str) -> str:
    """Path of a tool.

    Raises:
        UserError: The tool is not on PATH.
    """
    path = shutil.which(tool, path=f"{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}")
    if path is None:
        raise UserError(f"{tool} is not installed: run `make setup`.")
    return path


def run(label: str, command: list[str], silent_is_clean: bool = True) -> bool:
    """Run one check from the project root and print what it says; True when it is clean."""
    result = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
    output = (result.stdout + result.stderr).strip()
    clean = result.returncode == 0 and not (silent_is_clean and output)
    print(f"{'ok  ' if clean else 'BAD '} {label}", flush=True)
    if not clean:
        print(output)
    return clean

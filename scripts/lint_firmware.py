# SPDX-License-Identifier: Apache-2.0
"""Checks of the firmware's C; their flags stand in firmware/Makefile, beside those of the compiler."""

import sys
from pathlib import Path

from scripts.lint_run import need, run

TOOLS = {"clang": "clang", "tidy": "clang-tidy", "cppcheck": "cppcheck"}
"""Target of firmware/Makefile, and the tool that it runs."""


def command(target: str, source: Path | None = None) -> list[str]:
    """How to run one check, over one file in place of all if there is one.

    Raises:
        UserError: the tool is absent.
    """
    need(TOOLS[target])
    files = [] if source is None else [f"CHECKED={source}", "CHECKED_HOST="]
    return ["make", "--silent", "--no-print-directory", "-C", "firmware", target, f"PYTHON={sys.executable}", *files]


def lint_firmware() -> bool:
    """Warnings of clang, clang-tidy, cppcheck, and the rules of `scripts.c_rules`."""
    results = [run(TOOLS[target], command(target), silent_is_clean=False) for target in TOOLS]
    results.append(run("c rules", [sys.executable, "-m", "scripts.c_rules"], silent_is_clean=False))
    return all(results)

# SPDX-License-Identifier: Apache-2.0
"""Runs a script for Vivado against `scripts/vivado/standin.tcl`, with the names that the RTL really has."""

import subprocess
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path

from scripts.errors import UserError
from scripts.lint_run import need
from scripts.rtl_facts import Facts
from scripts.vivado import SCRIPTS, listed

STANDIN = SCRIPTS / "standin.tcl"
PRIMITIVES = ("BUFGCTRL", "IOBUF", "MMCME2_ADV", "OBUFT")
"""Black boxes of the vendor's own library, which need no source."""


@dataclass(frozen=True)
class Outcome:
    """What came of a run: its exit code, the calls, the sentence that ended it."""

    code: int
    calls: list[str]
    sentence: str


def write_facts(path: Path, facts: Facts, sources: Iterable[Path], more: Mapping[str, str] | None = None) -> Path:
    """What the stand-in is to know."""
    sources = list(sources)
    there = {*PRIMITIVES, *(source.stem for source in sources)}
    needed = [name for name in facts.blackboxes if name not in there]
    table = {
        "top": facts.top,
        "sources": listed(sources),
        "blackboxes": listed(needed),
        "ports": listed(facts.ports),
        "cells": listed(facts.cells),
        "pins": listed(facts.pins),
        "nets": listed(facts.nets),
        **(more or {}),
    }
    path.write_text("".join(f"set standin::facts({name}) {value}\n" for name, value in table.items()))
    return path


def run_standin(facts: Path, script: Path, *arguments: Path) -> Outcome:
    """Run a script.

    Raises:
        UserError: There is no tclsh.
    """
    command = [need("tclsh"), str(STANDIN), str(facts), str(script), *map(str, arguments)]
    try:
        run = subprocess.run(command, capture_output=True, text=True, check=False, timeout=120)
    except subprocess.TimeoutExpired as error:
        raise UserError(f"{script.name} does not end.") from error
    said = run.stderr.strip().splitlines()
    return Outcome(run.returncode, run.stdout.splitlines(), said[-1] if said else "")

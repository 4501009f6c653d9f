# SPDX-License-Identifier: Apache-2.0
"""The tests of a core outside of cocotb, for the mutants that survive those in it: the C++ bench of ccl."""

import time
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

from tb.ccl import test_exhaustive as bench
from tb.common.cores import Core
from tb.mutation.simulate import Outcome

# Of what tb/ccl/test_exhaustive.py runs on the core of full size: the quickest, and that which fills the queue.
RUNS = (
    ("--idle", 25, "--stall", 40, "random", 5000, 1, 60),
    ("--idle", 20, "--stall", 70, "structured", 1280, 720),
)


def ccl(core: Core, sources: tuple[Path, ...], folder: Path) -> Outcome:
    """Compare a mutant of ccl with flood fill on thousands of images."""
    start = time.monotonic()
    try:
        program = bench.build(1280, 720, replace(core, sources=sources), folder)
    except AssertionError as error:
        return Outcome("broken", str(error).splitlines()[0], round(time.monotonic() - start, 1))
    for arguments in RUNS:
        try:
            bench.run(program, *arguments)
        except AssertionError as error:
            return Outcome("killed", str(error).splitlines()[0], round(time.monotonic() - start, 1))
    return Outcome("survived", "", round(time.monotonic() - start, 1))


BENCHES: dict[str, Callable[[Core, tuple[Path, ...], Path], Outcome]] = {"ccl": ccl}

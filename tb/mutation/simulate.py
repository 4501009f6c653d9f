# SPDX-License-Identifier: Apache-2.0
"""Runs the tests of a core on other sources until the first fails, in a process of its own with limited CPU time."""

import json
import os
import resource
import subprocess
import sys
from dataclasses import dataclass, replace
from pathlib import Path

from tb.common.cores import ROOT, Core, load_core
from tb.common.runner import default_seed, run_config

CPU_SECONDS = 400
"""Several times what the longest config takes; a simulation that needs more hangs."""


@dataclass(frozen=True)
class Outcome:
    """`verdict` is survived, killed, hang, or broken (no verdict of the tests); `reason` names the test that failed."""

    verdict: str
    reason: str
    seconds: float


def simulate(core: Core, sources: tuple[Path, ...], index: int, folder: Path, limit: int = CPU_SECONDS) -> Outcome:
    """Run one config in Icarus; outputs go to folder."""
    request = {"core": core.name, "sources": list(map(str, sources)), "config": index, "folder": str(folder)}
    result = subprocess.run(
        [sys.executable, "-m", "tb.mutation.simulate", json.dumps(request)],
        cwd=ROOT,
        env={**os.environ, "PYTHONPATH": str(ROOT), "COCOTB_MAX_FAILURES": "1"},
        capture_output=True,
        text=True,
        check=False,
        preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_CPU, (limit, limit)),
    )
    *summary, seconds = result.stdout.splitlines() or ["no output", "0"]
    return judge(result.returncode, summary or result.stderr.splitlines(), float(seconds), limit)


def judge(code: int, lines: list[str], seconds: float, limit: int) -> Outcome:
    """Return the outcome from what the process said and how much CPU time it took."""
    if code == 0:
        return Outcome("survived", "", seconds)
    if lines and " tests failed:" in lines[0]:
        failed = [line.strip() for line in lines[1:] if line.endswith((" failed", "errored"))]
        return Outcome("killed", failed[0] if failed else lines[-1].strip(), seconds)
    if seconds >= limit - 2:
        return Outcome("hang", f"more than {limit} s of CPU time", seconds)
    return Outcome("broken", (lines or ["no output"])[-1].strip(), seconds)


def main() -> int:
    """Do what the request in the first argument says."""
    request = json.loads(sys.argv[1])
    core = replace(load_core(request["core"]), sources=tuple(map(Path, request["sources"])))
    result = run_config(core, "icarus", request["config"], seed=default_seed(), output=Path(request["folder"]))
    print(result.summary)
    usage = [resource.getrusage(who) for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)]
    print(round(sum(used.ru_utime + used.ru_stime for used in usage), 1))
    return 0 if result.passed else 1


if __name__ == "__main__":
    sys.exit(main())

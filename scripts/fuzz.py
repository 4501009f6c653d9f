# SPDX-License-Identifier: Apache-2.0
"""Hostile input for the firmware: `make fuzz [TARGET=name] [RUNS=n] [SECONDS=n] [KEEP=1]`.

Each target of `firmware/fuzz` is built by clang with libFuzzer and the sanitizers of addresses, undefined behaviour and
numbers that do not fit, and is given what libFuzzer makes of the corpus that is kept. A crash, a failed demand, a leak
and an input that takes longer than 60 s end it; the input is then left in `build/fuzz`. See `docs/fuzzing.md`.
"""

import re
import shutil
import subprocess
import sys
import time
from dataclasses import dataclass
from pathlib import Path

from scripts.errors import ArgumentParser, UserError, run_main
from scripts.fuzz_corpus import corpus_path, pack, unpack
from scripts.fuzz_seeds import seeds

ROOT = Path(__file__).resolve().parent.parent
WORK = ROOT / "build" / "fuzz"

TARGETS = {"mavlink_in": 400, "record": 400, "parameters": 400, "loop": 400}
"""Bytes that an input of each target may have: enough for several frames, records or steps."""

_HANG_S = 60  # by the clock, on a machine that may have other work
_USUAL_SECONDS = 60
_TELL_EVERY_S = 20.0


@dataclass(frozen=True)
class Outcome:
    """What a run of one target came to.

    Attributes:
        executions: inputs that were given.
        edges: edges of the control flow, and
        features: those with how often each was passed, that the corpus reaches.
        found: the inputs that ended the run.
    """

    executions: int
    edges: int
    features: int
    found: list[Path]


def build() -> None:
    """Build the targets.

    Raises:
        UserError: clang is not there, or the build fails.
    """
    if shutil.which("clang") is None:
        raise UserError("clang is not installed: run `make setup`.")
    command = ["make", "--no-print-directory", "-s", "-C", str(ROOT / "firmware"), "fuzz"]
    run = subprocess.run(command, capture_output=True, text=True, check=False)
    if run.returncode != 0:
        print(run.stdout + run.stderr, file=sys.stderr)
        raise UserError("the fuzz targets do not build; see above.")


def command_of(target: str, *options: str) -> list[str]:
    """How a target is run."""
    binary = ROOT / "build" / "firmware" / f"fuzz_{target}"
    length = f"-max_len={TARGETS[target]}"
    return [str(binary), length, f"-timeout={_HANG_S}", f"-report_slow_units={_HANG_S}", *options]


def numbers_of(log: str) -> tuple[int, int, int]:
    """Executions, edges and features from what libFuzzer said; 0 for what it did not say."""
    executions = re.findall(r"^stat::number_of_executed_units: (\d+)$|^#(\d+)\t", log, re.MULTILINE)
    reached = re.findall(r" cov: (\d+) ft: (\d+) ", log)
    edges, features = reached[-1] if reached else ("0", "0")
    return int(max(executions[-1], key=len)) if executions else 0, int(edges), int(features)


def run_target(target: str, runs: int, seconds: int) -> Outcome:
    """Fuzz one target from its kept corpus.

    Args:
        target: one of `TARGETS`.
        runs: executions, 0 = without an end.
        seconds: after which it ends, 0 = without an end.
    """
    folder = WORK / target
    inputs = folder / "corpus"
    inputs.mkdir(parents=True, exist_ok=True)
    unpack(corpus_path(target), inputs)
    for index, data in enumerate(seeds(target)):
        (inputs / f"seed{index}").write_bytes(data)
    options = [
        "-print_final_stats=1",
        "-entropic_scale_per_exec_time=1",
        "-len_control=20",
        f"-artifact_prefix={folder}/",
    ]
    options += [f"-runs={runs}"] if runs else []
    options += [f"-max_total_time={seconds}"] if seconds else []
    before = set(folder.iterdir())
    lines = []
    told = time.monotonic()
    process = subprocess.Popen(
        [*command_of(target, *options), str(inputs)], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True
    )
    for line in process.stderr:
        lines.append(line)
        if line.startswith("#") and time.monotonic() - told > _TELL_EVERY_S:
            told = time.monotonic()
            print(f"  {target}: {line[1:].split()[0]} executions", flush=True)
    failed = process.wait() != 0
    log = "".join(lines)
    (folder / "log").write_text(log, encoding="utf-8")
    found = sorted(set(folder.iterdir()) - before - {folder / "log"})
    if failed and not found:
        print(log, file=sys.stderr)
        raise UserError(f"the fuzzer of {target} ends without a finding; see above.")
    return Outcome(*numbers_of(log), found)


def keep(target: str) -> int:
    """Pack the fewest inputs of a run that reach all that it reached; how many they are."""
    least = WORK / target / "least"
    shutil.rmtree(least, ignore_errors=True)
    least.mkdir()
    command = command_of(target, "-merge=1", str(least), str(WORK / target / "corpus"))
    run = subprocess.run(command, capture_output=True, text=True, check=False)
    if run.returncode != 0:
        print(run.stderr, file=sys.stderr)
        raise UserError(f"the corpus of {target} cannot be merged; see above.")
    return pack(least, corpus_path(target))


def main() -> int:
    """Entry point of `make fuzz`."""
    parser = ArgumentParser(prog="make fuzz", description=__doc__)
    parser.add_argument("--target", default="", help=f"one of {', '.join(TARGETS)}; all when left out")
    parser.add_argument("--runs", type=int, default=0, help="executions of each target")
    parser.add_argument("--seconds", type=int, default=0, help=f"of each target; {_USUAL_SECONDS} without --runs")
    parser.add_argument("--keep", action="store_true", help="put what is new into firmware/fuzz/corpus")
    arguments = parser.parse_args()
    if arguments.target and arguments.target not in TARGETS:
        raise UserError(f"there is no fuzz target {arguments.target}; there are {', '.join(TARGETS)}.")
    if arguments.runs < 0 or arguments.seconds < 0:
        raise UserError("runs and seconds are numbers from 0 up.")
    seconds = arguments.seconds or (0 if arguments.runs else _USUAL_SECONDS)
    build()
    crashes = 0
    rows = [f"{'target':12} {'executions':>12} {'edges':>6} {'features':>8} {'crashes':>7}"]
    for target in [arguments.target] if arguments.target else list(TARGETS):
        outcome = run_target(target, arguments.runs, seconds)
        crashes += len(outcome.found)
        rows.append(
            f"{target:12} {outcome.executions:12} {outcome.edges:6} {outcome.features:8} {len(outcome.found):7}"
        )
        for path in outcome.found:
            print(f"  {target}: {path.relative_to(ROOT)}; again: build/firmware/fuzz_{target} <that file>")
        if arguments.keep and not outcome.found:
            print(f"  {target}: {keep(target)} inputs kept")
    print("\n".join(rows))
    if crashes:
        raise UserError(f"{crashes} inputs crash the firmware; they are named above.")
    return 0


if __name__ == "__main__":
    run_main(main)

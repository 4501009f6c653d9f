# SPDX-License-Identifier: Apache-2.0
"""Builds a core and runs its cocotb tests: `python -m tb.common.runner --core X --sim icarus|verilator`.

Every simulation of the project goes through `run_core`: `make sim`, pytest (`tb/test_cores.py`) and the replay
command that a failing test prints. Outputs are in `build/sim/<core>/<sim>/<config>/`.
"""

import json
import os
import shutil
import sys
from dataclasses import dataclass
from pathlib import Path

from cocotb_tools.check_results import get_results
from cocotb_tools.runner import VerilatorControlFile, get_runner

from scripts.errors import ArgumentParser, UserError, run_main
from tb.common.cores import ROOT, Core, load_core

SIMULATORS = {"icarus": ("iverilog", "vvp"), "verilator": ("verilator", "make", "c++")}
DEFAULT_SEED = 20260101
OUTPUT = ROOT / "build/sim"
LINT_WAIVERS = ROOT / "scripts/lint/verilator.vlt"


@dataclass(frozen=True)
class Result:
    """Outcome of one build and run of so many tests; `replay` is the command that repeats it."""

    passed: bool
    summary: str
    replay: str
    log: Path
    tests: int = 0


def replay_command(core: str, sim: str, seed: int) -> str:
    """Return the shell command that repeats a run."""
    return f"make sim CORE={core} SIM={sim} SEED={seed}"


def default_seed() -> int:
    """Return the seed of the environment variable SEED, or the fixed default."""
    text = os.environ.get("SEED") or str(DEFAULT_SEED)
    if not text.isdecimal():
        raise UserError(f"SEED is '{text}'; give a whole number from 0.")
    return int(text)


def check_simulator(sim: str) -> None:
    """Raise `UserError` if the simulator is unknown or not installed."""
    if sim not in SIMULATORS:
        raise UserError(f"unknown simulator '{sim}'; choose one of: {', '.join(SIMULATORS)}.")
    # The tools of the virtual environment are found although it was not activated.
    venv = str(Path(sys.executable).parent)
    if venv not in os.environ["PATH"].split(os.pathsep):
        os.environ["PATH"] = venv + os.pathsep + os.environ["PATH"]
    for tool in SIMULATORS[sim]:
        if shutil.which(tool) is None:
            raise UserError(f"{sim} needs '{tool}', which is not on the PATH; run scripts/setup.sh.")


def run_core(
    core_name: str,
    sim: str,
    config_index: int | None = None,
    *,
    seed: int | None = None,
    waves: bool = False,
    testcase: str | None = None,
) -> list[Result]:
    """Build and run one config of a core, or all of them (`config_index` None).

    Raises:
        UserError: the core, simulator or config is unknown, or a tool is missing.
    """
    check_simulator(sim)
    core = load_core(core_name)
    seed = default_seed() if seed is None else seed
    if config_index is None:
        indices = range(len(core.configs))
    elif config_index in range(len(core.configs)):
        indices = range(config_index, config_index + 1)
    else:
        raise UserError(f"{core.name} has no config {config_index}; choose 0 to {len(core.configs) - 1}.")
    return [run_config(core, sim, index, seed=seed, waves=waves, testcase=testcase) for index in indices]


def run_config(
    core: Core,
    sim: str,
    index: int,
    *,
    seed: int,
    waves: bool = False,
    testcase: str | None = None,
    output: Path = OUTPUT,
    build_args: tuple[str, ...] = (),
) -> Result:
    """Build and run one config of a core that was loaded, with more options of the simulator's compiler if wanted."""
    folder = output / core.name / sim / (core.config_name(index) + ("-waves" if waves else ""))
    folder.mkdir(parents=True, exist_ok=True)
    build_log, test_log, results = folder / "build.log", folder / "test.log", folder / "results.xml"
    replay = replay_command(core.name, sim, seed)
    if shutil.which("ccache"):
        os.environ.setdefault("OBJCACHE", "ccache")
    # The runner of cocotb lets WAVES override its argument; here the argument alone counts.
    os.environ.pop("WAVES", None)
    runner = get_runner(sim)
    runner.log.setLevel("WARNING")
    try:
        _build(runner, core, sim, index, waves=waves, log=build_log, more=build_args)
    except (RuntimeError, SystemExit):
        return Result(False, f"build failed:\n{_tail(build_log)}", replay, build_log)
    warnings = [line for line in build_log.read_text().splitlines() if sim == "icarus" and "warning" in line]
    if warnings:
        return Result(False, "Icarus warns:\n" + "\n".join(warnings), replay, build_log)
    environment = {
        "TOUCHDOWN_RUN": json.dumps(
            {"core": core.name, "sim": sim, "config": index, "parameters": core.configs[index], "seed": seed}
        ),
        "COCOTB_ANSI_OUTPUT": "0",
        "PYTHONWARNINGS": "ignore::DeprecationWarning",
    }
    try:
        runner.test(
            test_module=core.test_module,
            hdl_toplevel=core.toplevel,
            hdl_toplevel_lang="verilog",
            seed=seed,
            extra_env=environment,
            test_filter=_literal_regex(testcase) if testcase else None,
            waves=waves,
            build_dir=folder,
            test_dir=folder,
            results_xml=str(results),
            log_file=test_log,
            timescale=("1ns", "1ps"),
        )
        count, failures = get_results(results)
    except (RuntimeError, SystemExit):
        try:
            count, failures = get_results(results)
        except RuntimeError:
            return Result(False, f"the simulation crashed:\n{_tail(test_log)}", replay, test_log)
    if count == 0:
        return Result(False, f"no test matches '{testcase}'", replay, test_log)
    if failures:
        return Result(False, f"{failures} of {count} tests failed:\n{_failures(test_log)}", replay, test_log, count)
    return Result(True, f"{count} tests passed", replay, test_log, count)


def _build(runner: object, core: Core, sim: str, index: int, *, waves: bool, log: Path, more: tuple[str, ...]) -> None:
    sources: list[object] = [str(source) for source in core.sources]
    if sim == "icarus":
        # The module with which cocotb makes Icarus dump waves is SystemVerilog.
        arguments = ["-Wall", "-g2012" if waves else "-g2005"]
    else:
        arguments = ["-Wall"] + (["--trace-fst"] if waves else [])
        if LINT_WAIVERS.is_file():
            sources.insert(0, VerilatorControlFile(str(LINT_WAIVERS)))
    runner.build(
        sources=sources,
        includes=[ROOT / "rtl/generated"],
        parameters=core.configs[index],
        hdl_toplevel=core.toplevel,
        build_dir=log.parent,
        build_args=[*arguments, *more],
        always=True,
        timescale=("1ns", "1ps"),
        waves=waves,
        log_file=log,
    )


def _literal_regex(text: str) -> str:
    return "".join(character if character.isalnum() or character == "_" else f"\\{character}" for character in text)


def _tail(path: Path, lines: int = 30) -> str:
    return "\n".join(path.read_text(errors="replace").splitlines()[-lines:]) if path.is_file() else "(no log)"


def _failures(log: Path) -> str:
    """Return the names of the tests that failed, each with the sentence that says why."""
    lines = []
    for line in log.read_text(errors="replace").splitlines():
        if line.endswith(" failed") or " failed with " in line or line.endswith("errored"):
            lines.append(line.split("cocotb.regression")[-1].strip())
        elif "Error: " in line:
            lines.append("  " + line.strip())
    return "\n".join(lines[:12]) or _tail(log)


def main() -> int:
    """Entry point of the command line."""
    parser = ArgumentParser(description="Build a core and run its tests.")
    parser.add_argument("--core", required=True)
    parser.add_argument("--sim", default="verilator", help="icarus or verilator")
    parser.add_argument("--seed", type=int, default=None, help="seed of all random choices")
    parser.add_argument("--config", type=int, default=None, help="index of one [[configs]] table; all when left out")
    parser.add_argument("--testcase", default=None, help="run only tests whose name contains this")
    parser.add_argument("--waves", action="store_true", help="record waves as FST")
    arguments = parser.parse_args()
    waves = arguments.waves or os.environ.get("WAVES", "0") not in ("", "0")
    results = run_core(
        arguments.core,
        arguments.sim,
        arguments.config,
        seed=arguments.seed,
        waves=waves,
        testcase=arguments.testcase,
    )
    for result in results:
        verdict = "PASS" if result.passed else "FAIL"
        print(f"{verdict} {result.log.parent.relative_to(ROOT)}: {result.summary}")
        if waves:
            print("waves: " + ", ".join(str(path.relative_to(ROOT)) for path in result.log.parent.glob("*.fst")))
        print(
            f"{'log: ' + str(result.log.relative_to(ROOT)) + '  ' if not result.passed else ''}replay: {result.replay}"
        )
    return 0 if all(result.passed for result in results) else 1


if __name__ == "__main__":
    run_main(main)

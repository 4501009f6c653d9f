# SPDX-License-Identifier: Apache-2.0
"""Runs the proofs: `python -m formal.run [--core X] [--task T] [--faults]`. Logs and traces are in build/formal/."""

import sys

from formal import signoff
from formal.solve import Answer, complaint, solve
from formal.tasks import ROOT, Fault, Task, core_names, load
from scripts.errors import ArgumentParser, UserError, run_main


def run_task(task: Task) -> Answer:
    """Run one proof and keep its answer."""
    answer = solve(task)
    signoff.write(task, answer)
    return answer


def run_fault(fault: Fault) -> Answer:
    """Run one proof on a copy with a fault and keep its answer; `FAIL` is what it should be."""
    answer = solve(fault.task, fault)
    signoff.write(fault.task, answer, fault)
    return answer


def report(label: str, answer: Answer, wanted: str) -> bool:
    """Print one line, and what the solver said if it is not what was wanted."""
    good = answer.status == wanted
    print(f"{'ok  ' if good else 'BAD '} {label}: {answer.status}, {answer.seconds:.1f} s", flush=True)
    if not good:
        print(f"{complaint(answer.log)}\nlog: {answer.log.relative_to(ROOT)}", flush=True)
    return good


def main() -> int:
    """Entry point of the command line."""
    parser = ArgumentParser(prog="python -m formal.run", description=__doc__)
    parser.add_argument("--core", default="", help="only this one")
    parser.add_argument("--task", default="", help="only the proof of this name")
    parser.add_argument("--faults", action="store_true", help="also plant each fault and see it found")
    arguments = parser.parse_args()
    results = []
    for core in [arguments.core] if arguments.core else core_names():
        tasks, faults = load(core)
        for task in tasks:
            if arguments.task not in ("", task.name):
                continue
            answer = run_task(task)
            how = "induction" if task.mode == "prove" else f"depth {task.depth}"
            what = "states reached" if task.mode == "cover" else "assertions"
            results.append(report(f"{task.id} ({how}, {answer.assertions} {what})", answer, "PASS"))
            for fault in faults:
                if arguments.faults and fault.task is task:
                    results.append(report(f"  found: {fault.id}", run_fault(fault), "FAIL"))
    if not results:
        raise UserError(f"no proof is called '{arguments.task}'; `python -m formal.run` lists them all.")
    print(f"{sum(results)} of {len(results)} as they should be")
    if not all(results):
        print(
            "touchdown: a proof failed; the log named above says which assertion and where the trace is.",
            file=sys.stderr,
        )
        return 1
    return 0


if __name__ == "__main__":
    run_main(main)

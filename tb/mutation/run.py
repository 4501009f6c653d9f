# SPDX-License-Identifier: Apache-2.0
"""Plants faults into the cores and counts how many their own tests find: `make mutation [CORE=name]`.

The report of each core is build/signoff/mutation/<core>.json. A core passes when at least 95 per cent of its mutants
that are not equivalent are killed and no run was broken.
"""

import hashlib
import json
import shutil
import tomllib
from collections.abc import Iterable
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path
from threading import Lock
from typing import Any

from scripts.errors import ArgumentParser, UserError, run_main
from scripts.signoff import FOLDER, leave
from scripts.signoff_inputs import digest as digest_of_inputs
from tb.common.cores import ROOT, Core, core_names, load_core
from tb.common.runner import check_simulator
from tb.mutation.exhaustive import BENCHES
from tb.mutation.plan import DEFAULT_SEED, HERE, Fault, chosen, plan
from tb.mutation.simulate import Outcome, simulate

GOAL = 0.95
REPORTS = FOLDER / "mutation"
WORK = ROOT / "build/mutation"
KILLED = ("killed", "hang")


@dataclass(frozen=True)
class Entry:
    """A mutant with what became of it."""

    fault: Fault
    verdict: str
    reason: str
    config: int | None
    seconds: float

    def as_table(self) -> dict[str, object]:
        """Return it as the report has it."""
        file, before, after = self.fault.key
        place = {"file": file, "line": self.fault.mutant.line, "operator": self.fault.mutant.operator}
        end = {"verdict": self.verdict, "reason": self.reason, "config": self.config, "seconds": self.seconds}
        return {**place, "before": before, "after": after, **end}


def equivalents(core_name: str, path: Path = HERE / "equivalent.toml") -> dict[tuple[str, str, str], str]:
    """Return the reason for each mutant of a core that is listed as equivalent.

    Raises:
        UserError: an entry is not complete or names an unknown core.
    """
    found = {}
    for entry in tomllib.loads(path.read_text(encoding="utf-8")).get("equivalent", []):
        missing = {"cores", "file", "before", "after", "reason"} ^ set(entry)
        unknown = set(entry.get("cores", [])) - set(core_names())
        if missing or unknown or not entry["reason"].strip():
            raise UserError(f"{path.name}: mend cores, file, before, after and reason of {entry}.")
        if core_name in entry["cores"]:
            found[entry["file"], entry["before"], entry["after"]] = entry["reason"]
    return found


def check_equivalents(core_name: str, listed: Iterable[tuple[str, str, str]], faults: list[Fault]) -> None:
    """Raise `UserError` if an entry for this core matches none of its mutants."""
    for key in set(listed) - {fault.key for fault in faults}:
        raise UserError(f"equivalent.toml lists {key} for {core_name}, which is no mutant of it; delete the entry.")


def attempt(core: Core, fault: Fault, configs: list[int]) -> Entry:
    """Run the tests of each config on a mutant until one finds it; after them the bench of BENCHES."""
    folder = WORK / core.name / hashlib.sha256("\n".join(fault.key).encode()).hexdigest()[:12]
    sources = fault.sources(core, folder)
    seconds = 0.0
    for config in configs:
        outcome = simulate(core, sources, config, folder)
        seconds += outcome.seconds
        if outcome.verdict != "survived":
            shutil.rmtree(folder)
            return Entry(fault, outcome.verdict, outcome.reason, config, round(seconds, 1))
    if core.name in BENCHES:
        outcome = BENCHES[core.name](core, sources, folder)
        seconds += outcome.seconds
        if outcome.verdict != "survived":
            shutil.rmtree(folder)
            return Entry(fault, outcome.verdict, outcome.reason, None, round(seconds, 1))
    return Entry(fault, "survived", "", None, round(seconds, 1))


def check_unchanged(core: Core, config: int) -> None:
    """Raise `UserError` unless the tests pass on the core as it is: else they would kill every mutant."""
    outcome: Outcome = simulate(core, core.sources, config, WORK / core.name / "unchanged")
    if outcome.verdict != "survived":
        raise UserError(f"the tests of {core.name}, config {config}, fail without a mutant: {outcome.reason}.")


def report(core: Core, entries: list[Entry], complete: bool) -> dict[str, Any]:
    """Return the figures of a core for the sign-off table."""
    counts = {name: sum(entry.verdict == name for entry in entries) for name in ("killed", "hang", "equivalent")}
    killed = counts["killed"] + counts["hang"]
    real = len(entries) - counts["equivalent"]
    broken = [entry for entry in entries if entry.verdict == "broken"]
    unfinished = "" if complete else " so far, not all were tried"
    return {
        "passed": complete and not broken and real > 0 and killed >= GOAL * real,
        "figure": f"{killed} of {real} mutants killed, {counts['equivalent']} equivalent{unfinished}",
        "detail": {
            "killed": killed,
            "total": len(entries),
            "equivalent": counts["equivalent"],
            "hang": counts["hang"],
            "broken": len(broken),
            "survived": real - killed - len(broken),
            "sources": digest(core),
            "mutants": [entry.as_table() for entry in entries],
        },
    }


def digest(core: Core) -> str:
    """Return a hash of the core's sources."""
    return hashlib.sha256(b"".join(source.read_bytes() for source in core.sources)).hexdigest()


def kept(core: Core, path: Path) -> tuple[dict[tuple[str, str, str], dict[str, Any]], str]:
    """Return the mutants of an earlier report, if it is about the same RTL, and the hash of all it was about."""
    earlier = json.loads(path.read_text(encoding="utf-8")) if path.is_file() else {}
    if not earlier or earlier["detail"]["sources"] != digest(core):
        return {}, digest_of_inputs(core.name, "mutation")
    items = {(item["file"], item["before"], item["after"]): item for item in earlier["detail"]["mutants"]}
    return items, earlier.get("inputs", "none was kept")


def run(core: Core, seed: int, jobs: int, resume: bool) -> dict[str, Any]:
    """Try all mutants of a core, show each and write the report after each."""
    count, configs = plan(core.name)
    faults = list(chosen(core, count, seed))
    listed = equivalents(core.name)
    check_equivalents(core.name, listed, faults)
    path = REPORTS / f"{core.name}.json"
    inputs = digest_of_inputs(core.name, "mutation")
    earlier, tests_before = kept(core, path) if resume else ({}, inputs)
    entries: dict[tuple[str, str, str], Entry] = {}
    open_faults, reused = [], False
    for fault in faults:
        old = earlier.get(fault.key)
        if fault.key in listed:
            entries[fault.key] = Entry(fault, "equivalent", listed[fault.key], None, 0.0)
        elif old is not None and old["verdict"] in KILLED:
            entries[fault.key] = Entry(fault, old["verdict"], old["reason"], old["config"], old["seconds"])
            reused = True
        else:
            open_faults.append(fault)
    lock = Lock()

    def done(fault: Fault) -> None:
        entry = attempt(core, fault, configs)
        with lock:
            entries[fault.key] = entry
            print(show(core, entry), flush=True)
            save(complete=len(entries) == len(faults))

    def save(complete: bool) -> dict[str, Any]:
        ordered = [entries[fault.key] for fault in faults if fault.key in entries]
        result = report(core, ordered, complete)
        # What earlier tests killed is not signed off for the tests of now.
        about = tests_before if reused else inputs
        passed, figure, detail = result["passed"], result["figure"], result["detail"]
        leave(core.name, "mutation", passed, figure, detail, incomplete=not complete, inputs=about)
        return result

    with ThreadPoolExecutor(jobs) as pool:
        list(pool.map(done, open_faults))
    for config in sorted({entry.config for entry in entries.values() if entry.config is not None}):
        if open_faults:
            check_unchanged(core, config)
    return save(complete=True)


def show(core: Core, entry: Entry) -> str:
    """Return a mutant in one line, a survivor with its change."""
    place = f"{entry.fault.path.name}:{entry.fault.mutant.line}"
    text = f"{core.name:16} {entry.verdict:9} {entry.seconds:6.1f} s  {place} {entry.fault.mutant.operator}"
    if entry.verdict in KILLED:
        return f"{text}: {entry.reason}"
    return f"{text}\n    - {entry.fault.mutant.before}\n    + {entry.fault.mutant.after}\n    {entry.reason}".rstrip()


def main() -> int:
    """Entry point of `make mutation`."""
    parser = ArgumentParser(prog="make mutation", description=__doc__)
    parser.add_argument("--core", default="", help="one core; all when left out")
    parser.add_argument(
        "--seed", type=int, default=DEFAULT_SEED, help="chooses other mutants; equivalents are listed for the default"
    )
    parser.add_argument("--jobs", type=int, default=2, help="simulations at a time")
    parser.add_argument("--resume", action="store_true", help="keep what an earlier run killed, if the RTL is the same")
    arguments = parser.parse_args()
    check_simulator("icarus")
    failed = []
    for name in [arguments.core] if arguments.core else core_names():
        result = run(load_core(name), arguments.seed, arguments.jobs, arguments.resume)
        print(f"{name}: {result['figure']}", flush=True)
        if not result["passed"]:
            failed.append(name)
    if failed:
        raise UserError(
            f"too many mutants survive in {', '.join(failed)}; add tests, or list equivalents with a reason."
        )
    return 0


if __name__ == "__main__":
    run_main(main)

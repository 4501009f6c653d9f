# SPDX-License-Identifier: Apache-2.0
"""Keeps what the proofs of a core said in `build/signoff/formal/<core>.json`."""

import fcntl
import hashlib
import json
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from formal.solve import Answer
from formal.tasks import FOLDER, Fault, Task, load
from scripts.signoff import FOLDER as LEFT
from scripts.signoff import leave

RESULTS = LEFT / "formal"


def inputs(task: Task) -> str:
    """Digest of all that the answer depends on; an answer to an older state of the files does not count."""
    digest = hashlib.sha256(repr((task.top, task.mode, task.depth, task.parameters)).encode())
    for path in (*task.sources, *task.properties, FOLDER / task.core / "tasks.toml"):
        digest.update(path.read_bytes())
    return digest.hexdigest()


@contextmanager
def locked(core: str) -> Iterator[Path]:
    """The file of a core, for one writer at a time."""
    RESULTS.mkdir(parents=True, exist_ok=True)
    with (RESULTS / f".{core}.lock").open("w", encoding="utf-8") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        yield RESULTS / f"{core}.json"


def write(task: Task, answer: Answer, fault: Fault | None = None) -> None:
    """Add one answer to those of its core: of the proof, or of a fault that it had to find."""
    with locked(task.core) as path:
        detail = json.loads(path.read_text(encoding="utf-8"))["detail"] if path.is_file() else {}
        tasks, faults = load(task.core)
        marks = {entry.name: inputs(entry) for entry in tasks}
        detail = {name: entry for name, entry in detail.items() if marks.get(name) == entry["inputs"]}
        empty = {"inputs": marks[task.name], "status": "not run", "faults": {}}
        entry = detail.setdefault(task.name, empty)
        if fault is None:
            entry |= {
                "status": answer.status,
                "says": task.says,
                "mode": task.mode,
                "depth": task.depth,
                "assertions": answer.assertions,
                "seconds": round(answer.seconds, 1),
            }
        else:
            entry["faults"][fault.id] = answer.status
        leave(task.core, "formal", detail=detail, **summary(tasks, faults, detail))


def summary(tasks: list[Task], faults: list[Fault], detail: dict[str, dict]) -> dict[str, object]:
    """Whether all proofs of a core passed and all its faults were found, whether some are yet to run, and one line."""
    good = [task for task in tasks if detail.get(task.name, {}).get("status") == "PASS"]
    tried = [status for entry in detail.values() for status in entry["faults"].values()]
    found = tried.count("FAIL")
    induction = sum(task.mode == "prove" for task in good)
    depths = [task.depth for task in good if task.mode == "bmc"]
    parts = [f"{len(good)} of {len(tasks)} proofs", f"{induction} by induction"]
    if depths:
        parts.append(f"{len(depths)} to depth {max(depths)}")
    parts.append(f"{found} of {len(faults)} planted faults found")
    failed = found < len(tried) or any(entry["status"] not in ("PASS", "not run") for entry in detail.values())
    complete = len(good) == len(tasks) and found == len(faults)
    return {"passed": complete, "incomplete": not complete and not failed, "figure": ", ".join(parts)}

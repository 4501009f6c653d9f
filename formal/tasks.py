# SPDX-License-Identifier: Apache-2.0
"""What is proven: `formal/<core>/tasks.toml`, one `[[task]]` a proof, one `[[fault]]` a fault that must break it."""

import tomllib
from dataclasses import dataclass, field
from pathlib import Path

from scripts.errors import UserError

ROOT = Path(__file__).resolve().parent.parent
FOLDER = ROOT / "formal"
COMMON = FOLDER / "common"
WRAPPERS = COMMON / "wrappers"
MODES = ("prove", "bmc", "cover")
# Cycles in which a fault must show in a proof by induction.
FAULT_DEPTH = 24


@dataclass(frozen=True)
class Task:
    """One proof: by induction of length `depth` (`prove`), or for the first `depth` cycles after power-up (`bmc`).

    A `cover` shows that each `cover` statement is reached within `depth` cycles: that a proof is not about nothing.
    """

    core: str
    name: str
    top: str
    mode: str
    depth: int
    says: str
    sources: tuple[Path, ...]
    parameters: dict[str, int] = field(default_factory=dict)
    quick: bool = False
    clocks: int = 1

    @property
    def id(self) -> str:
        """Name in messages and folders, e.g. `axis_skid/order`."""
        return f"{self.core}/{self.name}"

    @property
    def properties(self) -> list[Path]:
        """What is read after the RTL: what all share, what the core has and, if `top` is one, the shared wrapper."""
        wrapper = WRAPPERS / f"{self.top}.sv"
        own = sorted((FOLDER / self.core).glob("*.sv"))
        return [*sorted(COMMON.glob("*.sv")), *own, *([wrapper] if wrapper.is_file() else [])]


@dataclass(frozen=True)
class Fault:
    """A change of one source that the proof `task` must find."""

    task: Task
    source: Path
    find: str
    replace: str
    quick: bool = False
    wanted_depth: int = 0
    parameters: dict[str, int] = field(default_factory=dict)

    @property
    def id(self) -> str:
        """Name in messages and folders."""
        return f"{self.task.id}: {' '.join(self.find.split())} -> {' '.join(self.replace.split()) or '(nothing)'}"

    @property
    def depth(self) -> int:
        """Cycles in which it must show."""
        return self.wanted_depth or (self.task.depth if self.task.mode == "bmc" else FAULT_DEPTH)

    def text(self) -> str:
        """The source with the fault.

        Raises:
            UserError: the text to change is not there exactly once.
        """
        text = self.source.read_text(encoding="utf-8")
        if text.count(self.find) != 1:
            where = self.source.relative_to(ROOT)
            raise UserError(
                f"'{self.find}' stands {text.count(self.find)} times in {where}; formal/{self.task.core}/tasks.toml "
                "must name a text that stands there once."
            )
        return text.replace(self.find, self.replace)


def core_names() -> list[str]:
    """Everything that has proofs, sorted."""
    return sorted(path.parent.name for path in FOLDER.glob("*/tasks.toml"))


def _sources(core: str, table: dict[str, object]) -> tuple[Path, ...]:
    """The RTL named by the task file or, without one, by the core's own list; then properties, shared ones first."""
    names = table.get("sources")
    if names is None:
        names = tomllib.loads((ROOT / "rtl" / core / "core.toml").read_text(encoding="utf-8"))["sources"]
    return tuple(ROOT / str(name) for name in names)


def load(core: str) -> tuple[list[Task], list[Fault]]:
    """Read the proofs and faults of one core.

    Raises:
        UserError: the file is missing or wrong.
    """
    path = FOLDER / core / "tasks.toml"
    if not path.is_file():
        raise UserError(f"there is no proof of '{core}'; choose one of: {', '.join(core_names())}.")
    try:
        table = tomllib.loads(path.read_text(encoding="utf-8"))
        sources = _sources(core, table)
        tasks = {
            entry["name"]: Task(
                core,
                entry["name"],
                entry.get("top", f"{core}_{entry['name']}"),
                entry["mode"],
                entry["depth"],
                entry["says"],
                sources,
                entry.get("parameters", {}),
                entry.get("quick", False),
                entry.get("clocks", 1),
            )
            for entry in table["task"]
        }
        faults = [
            Fault(
                tasks[entry["task"]],
                ROOT / entry["source"],
                entry["find"],
                entry["replace"],
                entry.get("quick", False),
                entry.get("depth", 0),
                entry.get("parameters", {}),
            )
            for entry in table["fault"]
        ]
    except (tomllib.TOMLDecodeError, KeyError, TypeError) as error:
        raise UserError(f"{path.relative_to(ROOT)} is wrong at {error}.") from error
    for task in tasks.values():
        if task.mode not in MODES:
            raise UserError(f"{task.id} has the mode '{task.mode}'; choose one of: {', '.join(MODES)}.")
    # What is not reached fails by itself; a proof that is broken by nothing would not.
    proofs = {task.name for task in tasks.values() if task.mode != "cover"}
    for name in sorted(proofs - {fault.task.name for fault in faults}):
        raise UserError(f"{core}/{name} has no fault that it must find; add a [[fault]] to {path.relative_to(ROOT)}.")
    return list(tasks.values()), faults


def all_tasks() -> list[Task]:
    """Every proof of every core."""
    return [task for core in core_names() for task in load(core)[0]]


def all_faults() -> list[Fault]:
    """Every fault of every core."""
    return [fault for core in core_names() for fault in load(core)[1]]

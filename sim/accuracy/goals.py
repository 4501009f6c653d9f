# SPDX-License-Identifier: Apache-2.0
"""Goals, each compared with a figure of the frames it speaks of."""

import tomllib
from collections.abc import Sequence
from dataclasses import dataclass, fields
from fnmatch import fnmatchcase
from pathlib import Path

from sim.accuracy.metrics import Summary, summarise
from sim.accuracy.rows import Row

GOALS = Path(__file__).with_name("goals.toml")
MET, NOT_MET, OPEN = "met", "NOT MET", "open"
_METRICS = {field.name for field in fields(Summary)} - {"missed"} | {"missing"}


@dataclass(frozen=True)
class Goal:
    """One goal; `goals.toml` says what the fields mean."""

    name: str
    sets: tuple[str, ...]
    metric: str
    most: float
    frames: int = 1

    def __post_init__(self) -> None:
        if self.metric not in _METRICS:
            raise ValueError(f"goal '{self.name}' asks for the figure {self.metric}, which does not exist")


@dataclass(frozen=True)
class Verdict:
    """A goal, the figure, and what that makes of it."""

    goal: Goal
    value: float | None
    frames: int
    state: str

    @property
    def figure(self) -> str:
        """The figure, beside what is asked for."""
        if self.value is None:
            return f"not measured (sets: {', '.join(self.goal.sets)})"
        few = f"; {self.goal.frames} are asked for" if self.frames < self.goal.frames else ""
        return f"{self.value:.4g}, at most {self.goal.most:g}, {self.frames} frames{few}"


def load_goals(path: Path = GOALS) -> list[Goal]:
    """The goals of a file."""
    tables = tomllib.loads(path.read_text(encoding="utf-8"))["goal"]
    return [Goal(**{**table, "sets": tuple(table["sets"])}) for table in tables]


def judge(goals: Sequence[Goal], rows: Sequence[Row]) -> list[Verdict]:
    """A verdict a goal."""
    verdicts = []
    for goal in goals:
        chosen = [row for row in rows if any(fnmatchcase(row.set, pattern) for pattern in goal.sets)]
        value = getattr(summarise(chosen), goal.metric) if chosen else None
        if value is None:
            state = OPEN
        elif value > goal.most:
            state = NOT_MET
        else:
            state = MET if len(chosen) >= goal.frames else OPEN
        verdicts.append(Verdict(goal, value, len(chosen), state))
    return verdicts


GOAL_HEAD = ("", "figure", "goal")


def goal_lines(verdicts: Sequence[Verdict]) -> list[tuple[str, ...]]:
    """A line a goal."""
    return [(verdict.state, verdict.figure, verdict.goal.name) for verdict in verdicts]

# SPDX-License-Identifier: Apache-2.0
"""`firmware/landing.toml`, read and checked."""

import tomllib
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from scripts.errors import UserError

SOURCE = "firmware/landing.toml"
MODES = ("none", "steer", "land", "hold")
STEERS = ("none", "stop", "search", "centre", "descend", "align", "climb")
SEVERITIES = ("INFO", "WARNING", "CRITICAL")
NAME_CHARS = 16
REASON_CHARS = 39
"""With "Touchdown: " in front it is one STATUSTEXT of 50 characters."""


@dataclass(frozen=True)
class Phase:
    """One phase.

    Attributes:
        name: In capitals.
        mode: What the autopilot is to be in, one of `MODES`.
        steer: How velocities are made, one of `STEERS`.
        limit_s: When TIME_OUT begins; 0 = never.
        does: What it does, in words.
    """

    name: str
    mode: str
    steer: str
    limit_s: int
    does: str


@dataclass(frozen=True)
class Fact:
    """What is known in a cycle."""

    name: str
    says: str


@dataclass(frozen=True)
class Rule:
    """What leads from phases to a phase; names as in the file."""

    sources: tuple[str, ...]
    when: tuple[str, ...]
    unless: tuple[str, ...]
    to: str
    reason: str
    severity: str


@dataclass(frozen=True)
class Parameter:
    """What the ground may set.

    Attributes:
        member: Of the C structure; ends with its unit.
        name: On the wire, at most 16 characters.
        least: Lower limit.
        most: Upper limit.
        usual: What holds until it is set.
        says: What it is.
    """

    member: str
    name: str
    least: float
    most: float
    usual: float
    says: str


@dataclass(frozen=True)
class Landing:
    """The whole table; the order of the rules counts."""

    phases: tuple[Phase, ...]
    facts: tuple[Fact, ...]
    rules: tuple[Rule, ...]
    parameters: tuple[Parameter, ...]

    def phase(self, name: str) -> Phase:
        """The phase of a name."""
        return next(phase for phase in self.phases if phase.name == name)

    def next(self, phase: str, facts: frozenset[str]) -> Rule | None:
        """The rule that counts in a phase with these facts."""
        return next(
            (
                rule
                for rule in self.rules
                if phase in rule.sources and facts.issuperset(rule.when) and facts.isdisjoint(rule.unless)
            ),
            None,
        )


def load(path: Path) -> Landing:
    """Read a table.

    Raises:
        UserError: it is not there, no TOML, or names what it does not define.
    """
    try:
        tables = tomllib.loads(path.read_text(encoding="utf-8"))
    except FileNotFoundError:
        raise UserError(f"{path} is not there; it holds the landing's phases.") from None
    except tomllib.TOMLDecodeError as error:
        raise UserError(f"{path} is no TOML: {error}.") from None
    try:
        landing = _landing(tables)
    except (KeyError, TypeError) as error:
        raise UserError(f"{path} lacks or misspells {error}.") from None
    wrong = next(_mistakes(landing), None)
    if wrong is not None:
        raise UserError(f"{path}: {wrong}.")
    return landing


def _landing(tables: dict[str, Any]) -> Landing:
    groups = {name: words.split() for name, words in tables.get("groups", {}).items()}

    def sources(words: str) -> tuple[str, ...]:
        return tuple(name for word in words.split() for name in (groups[word[1:]] if word.startswith("@") else [word]))

    return Landing(
        phases=tuple(Phase(**entry) for entry in tables["phases"]),
        facts=tuple(Fact(**entry) for entry in tables["facts"]),
        rules=tuple(
            Rule(
                sources=sources(entry["from"]),
                when=tuple(entry.get("when", "").split()),
                unless=tuple(entry.get("unless", "").split()),
                to=entry["to"],
                reason=entry["reason"],
                severity=entry.get("severity", "INFO"),
            )
            for entry in tables["rules"]
        ),
        parameters=tuple(Parameter(**entry) for entry in tables["parameters"]),
    )


def _mistakes(landing: Landing) -> Iterator[str]:
    phases = {phase.name for phase in landing.phases}
    facts = {fact.name for fact in landing.facts}
    if len(phases) != len(landing.phases) or len(facts) != len(landing.facts):
        yield "a phase or a fact is defined twice"
    if len(facts) > 32 or len(phases) > 32:
        yield "more than 32 phases or facts do not fit into the masks"
    for parameter in landing.parameters:
        if not parameter.least <= parameter.usual <= parameter.most or len(parameter.name) > NAME_CHARS:
            yield f"{parameter.name} is not within its limits, or its name is longer than {NAME_CHARS} characters"
    for phase in landing.phases:
        if phase.mode not in MODES or phase.steer not in STEERS or phase.limit_s < 0:
            yield f"{phase.name} has a mode, a steer or a limit_s that there is not"
        takes = {"steer": STEERS[1:], "none": ("none",)}.get(phase.mode, ("none", "stop"))
        if phase.steer in STEERS and phase.steer not in takes:
            yield f"{phase.name} sends velocities that its mode does not take, or none in a mode that needs them"
    for rule in landing.rules:
        unknown = ({*rule.sources, rule.to} - phases) | ({*rule.when, *rule.unless} - facts)
        if unknown:
            yield f"the rule '{rule.reason}' names {', '.join(sorted(unknown))}, which is not defined"
        if not rule.when and not rule.unless:
            yield f"the rule '{rule.reason}' has no condition"
        if rule.severity not in SEVERITIES:
            yield f"the rule '{rule.reason}' has a severity that there is not"
        if len(rule.reason) > REASON_CHARS:
            yield f"the reason '{rule.reason}' is longer than {REASON_CHARS} characters"

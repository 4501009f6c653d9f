# SPDX-License-Identifier: Apache-2.0
"""The table for readers: phases, facts, rules, the answer to each failure, and a diagram."""

from scripts.landing.model import Landing, Phase, Rule

FAILURES = (
    "PILOT",
    "ABORT",
    "AUTOPILOT_SILENT",
    "REFUSED",
    "BATTERY_LOW",
    "GROUND_LOST",
    "CAMERA_LOST",
    "LIDAR_STALE",
    "LIDAR_CONTRADICTS",
    "ATTITUDE_STALE",
    "PAD_LOST",
)
"""What can go wrong on the way."""
_CONTRARY = {"PAD_LOST": "PAD", "REFUSED": "IN_MODE"}
_MANY = 5


def blocks(landing: Landing) -> dict[str, str]:
    """The generated blocks of docs/landing.md by their names."""
    return {
        "diagram": _diagram(landing),
        "phases": _phases(landing),
        "failures": _failures(landing),
        "facts": _facts(landing),
        "rules": _rules(landing),
        "parameters": _parameters(landing),
    }


def _diagram(landing: Landing) -> str:
    arrows: dict[tuple[str, str], list[str]] = {}
    common = _left_anywhere(landing)
    for rule in landing.rules:
        for source in rule.sources:
            if source != rule.to and rule not in common:
                arrows.setdefault((source, rule.to), []).append(rule.reason)
    lines = ["```mermaid", "stateDiagram-v2", "    [*] --> STANDBY"]
    for (source, to), reasons in arrows.items():
        label = "<br/>".join(dict.fromkeys(reasons)).replace(":", "#58;")
        lines.append(f"    {source} --> {to}: {label}")
    lines += ["```", "", "Not drawn, since each leads out of many phases:", ""]
    lines += [f"- to {rule.to}: {rule.reason} (from {', '.join(rule.sources)})" for rule in common]
    return "\n".join(lines)


def _left_anywhere(landing: Landing) -> list[Rule]:
    """Rules that count in so many phases that they would hide the rest of a picture."""
    return [rule for rule in landing.rules if len(rule.sources) >= _MANY]


def _phases(landing: Landing) -> str:
    lines = ["| phase | what it does | autopilot's mode | velocities | limit [s] |", "|---|---|---|---|---|"]
    lines += [
        f"| {phase.name} | {phase.does} | {phase.mode} | {phase.steer} | {phase.limit_s or '-'} |"
        for phase in landing.phases
    ]
    return "\n".join(lines)


def _facts(landing: Landing) -> str:
    return "\n".join(["| fact | holds when |", "|---|---|", *(f"| {f.name} | {f.says} |" for f in landing.facts)])


def _rules(landing: Landing) -> str:
    lines = ["| | from | when | unless | to | reason, as the ground reads it |", "|---|---|---|---|---|---|"]
    lines += [
        f"| {number} | {' '.join(rule.sources)} | {' '.join(rule.when)} | {' '.join(rule.unless)} | {rule.to} "
        f"| {rule.reason} |"
        for number, rule in enumerate(landing.rules, 1)
    ]
    return "\n".join(lines)


def _parameters(landing: Landing) -> str:
    lines = ["| parameter | what it is | least | usual | most |", "|---|---|---|---|---|"]
    lines += [f"| {p.name} | {p.says} | {p.least:g} | {p.usual:g} | {p.most:g} |" for p in landing.parameters]
    return "\n".join(lines)


def answer(landing: Landing, phase: Phase, failure: str, also: frozenset[str] = frozenset()) -> str:
    """What a phase does when one thing goes wrong while all else is well."""
    well = frozenset({"ARMED", "IN_MODE", "PAD"} - {_CONTRARY.get(failure, "")})
    rule = landing.next(phase.name, well | {failure} | also)
    usual = landing.next(phase.name, well | also)
    if rule == usual:
        return "goes on"
    return "stays" if rule is None else rule.to


def _failures(landing: Landing) -> str:
    busy = [phase for phase in landing.phases if phase.mode != "none"]
    lines = [
        f"| | {' | '.join(phase.name for phase in busy)} | LAND, committed |",
        f"|---{'|---' * (len(busy) + 1)}|",
    ]
    land = landing.phase("LAND")
    for failure in FAILURES:
        cells = [answer(landing, phase, failure) for phase in busy]
        cells.append(answer(landing, land, failure, frozenset({"COMMITTED"})))
        lines.append(f"| {failure} | {' | '.join(cells)} |")
    return "\n".join(lines)

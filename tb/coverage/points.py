# SPDX-License-Identifier: Apache-2.0
"""Reads what Verilator recorded and merges it: one point for each place in the source, over instances and configs."""

import re
import tomllib
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

from scripts.errors import UserError
from tb.common.cores import core_names

RECORD = re.compile(r"^C '(.*)' (\d+)$")


@dataclass(frozen=True, order=True)
class Point:
    """One place: `what` is the bit and its edge (`x_reg[3]:0->1`) of a toggle, the way taken of a branch."""

    file: str
    line: int
    column: int
    kind: str
    what: str


@dataclass(frozen=True)
class Waiver:
    """Points that no test reaches, and why. `bits` is a regular expression of the bit, `source` the text of a line."""

    cores: tuple[str, ...]
    file: str
    bits: str
    source: str
    reason: str

    def covers(self, point: Point, text: str) -> bool:
        """Return whether the point is one of those; text is its line of source."""
        if self.file != point.file or (point.kind == "toggle") != bool(self.bits):
            return False
        if self.bits:
            return re.fullmatch(self.bits, point.what.rpartition(":")[0]) is not None
        return text == self.source


def read_points(text: str, root: Path) -> dict[Point, int]:
    """Return how often each point was hit, from the text of a coverage.dat."""
    counts: dict[Point, int] = {}
    for line in text.splitlines():
        match = RECORD.match(line)
        if match is None:
            continue
        fields = dict(part.split("\x02", 1) for part in match[1].split("\x01") if part)
        path = Path(fields["f"])
        file = str(path.relative_to(root)) if path.is_relative_to(root) else str(path)
        kind = fields.get("t") or fields["page"].partition("/")[0].removeprefix("v_")
        point = Point(file, int(fields["l"]), int(fields["n"]), kind, fields["o"])
        counts[point] = counts.get(point, 0) + int(match[2])
    return counts


def merge(parts: Iterable[dict[Point, int]]) -> dict[Point, int]:
    """Return the sum of what several runs recorded."""
    counts: dict[Point, int] = {}
    for part in parts:
        for point, count in part.items():
            counts[point] = counts.get(point, 0) + count
    return counts


def load_waivers(path: Path) -> list[Waiver]:
    """Read the waivers.

    Raises:
        UserError: an entry lacks something or names an unknown core.
    """
    waivers = []
    for entry in tomllib.loads(path.read_text(encoding="utf-8")).get("waiver", []):
        wrong = {"cores", "file", "reason"} - set(entry) or set(entry) - {"cores", "file", "reason", "bits", "source"}
        if wrong or ("bits" in entry) == ("source" in entry) or set(entry["cores"]) - set(core_names()):
            raise UserError(f"{path.name}: mend cores, file, reason and one of bits and source in {entry}.")
        waivers.append(
            Waiver(
                tuple(entry["cores"]), entry["file"], entry.get("bits", ""), entry.get("source", ""), entry["reason"]
            )
        )
    return waivers


def missed(counts: dict[Point, int]) -> list[Point]:
    """Return the points that were never hit, in the order of the source."""
    return sorted(point for point, count in counts.items() if count == 0)


def waive(
    core: str, points: list[Point], texts: dict[tuple[str, int], str], waivers: list[Waiver]
) -> tuple[list[Point], dict[Point, str]]:
    """Return the missed points that stay, and those that are waived with the reason.

    Raises:
        UserError: a waiver for this core matches no missed point; it is not needed any more.
    """
    reasons: dict[Point, str] = {}
    for waiver in waivers:
        if core not in waiver.cores:
            continue
        matched = [point for point in points if waiver.covers(point, texts[point.file, point.line])]
        if not matched:
            raise UserError(
                f"waivers.toml: {waiver.bits or waiver.source!r} of {waiver.file} matches no missed point of {core}; "
                "delete it."
            )
        reasons |= dict.fromkeys(matched, waiver.reason)
    return [point for point in points if point not in reasons], reasons


def folded(points: list[Point]) -> dict[tuple[str, int], list[str]]:
    """Return what was missed on each line: bits of toggles without their edges when both are missed."""
    lines: dict[tuple[str, int], list[str]] = {}
    present = set(points)
    for point in points:
        bit, _, edge = point.what.rpartition(":")
        if point.kind != "toggle":
            name = f"{point.kind} {point.what}"
        elif edge == "1->0" and Point(point.file, point.line, point.column, "toggle", f"{bit}:0->1") in present:
            continue
        elif edge == "0->1" and Point(point.file, point.line, point.column, "toggle", f"{bit}:1->0") in present:
            name = bit
        else:
            name = point.what
        lines.setdefault((point.file, point.line), []).append(name)
    return lines

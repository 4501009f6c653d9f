# SPDX-License-Identifier: Apache-2.0
"""What each option is worth: the paper's way, production, and production without one thing, on the same frames."""

import re
import tomllib
from collections.abc import Sequence
from dataclasses import dataclass, fields, replace
from itertools import pairwise
from pathlib import Path

from golden.chain import Settings
from scripts.demo_results import Pad
from scripts.errors import UserError
from sim.accuracy.measure import rows_of
from sim.accuracy.metrics import Summary, summarise
from sim.accuracy.paper_rules import find_pad
from sim.accuracy.paths import Objects, golden, shown
from sim.accuracy.rows import Row
from sim.accuracy.shots import Film, Unit, develop

OPTIONS = Path(__file__).with_name("options.toml")
DETECT = Path(__file__).resolve().parents[2] / "firmware" / "core" / "detect.h"
_REGISTERS = {field.name for field in fields(Settings)}


@dataclass(frozen=True)
class Variant:
    """One way to find the pad.

    Attributes:
        name: What it is, in words.
        paper: By the paper's rules, not the firmware's.
        settings: Registers.
        options: Mask for the firmware's detection; None = all it can do.
        attitude: The autopilot says how the drone lies.
    """

    name: str
    paper: bool
    settings: Settings
    options: int | None
    attitude: bool = True


def load_variants(path: Path = OPTIONS, header: Path = DETECT) -> list[Variant]:
    """The variants of a file, with the firmware's names of its options.

    Raises:
        UserError: a variant leaves out an option that the firmware does not have, or has a key that means nothing.
    """
    bits = {name: int(value) for name, value in re.findall(r"#define (DETECT_\w+) (\d+)U", header.read_text())}
    variants = []
    for table in tomllib.loads(path.read_text(encoding="utf-8"))["variant"]:
        known = {"name", "rules", "without", "attitude"}
        if unknown := set(table) - known - _REGISTERS:
            raise UserError(f"{path.name} has {min(unknown)}, which is no register of golden/chain.py; mend it.")
        without = table.get("without", [])
        if absent := set(without) - set(bits):
            raise UserError(
                f"{path.name} leaves out {min(absent)}, which firmware/core/detect.h does not have; mend it."
            )
        registers = {name: value for name, value in table.items() if name not in known}
        options = bits["DETECT_ALL"] & ~sum(bits[name] for name in without) if without else None
        paper, attitude = table.get("rules") == "paper", table.get("attitude", True)
        variants.append(Variant(table["name"], paper, Settings(**registers), options, attitude))
    return variants


def compare(unit: Unit, variants: Sequence[Variant]) -> list[list[Row]]:
    """Rows of a unit, by variant. It is drawn once, and labelled once for all variants with the same registers."""
    film = develop(unit)
    objects = {settings: Objects(film, settings) for settings in {_chain(one) for one in variants}}
    return [_rows(film, variant, objects[_chain(variant)]) for variant in variants]


def _chain(variant: Variant) -> Settings:
    """The registers that objects of every size depend on, with any factor."""
    return replace(variant.settings, min_area=0, factor=0)


def _rows(film: Film, variant: Variant, objects: Objects) -> list[Row]:
    if not variant.paper:
        return rows_of(film, golden(film, variant.settings, variant.options, objects, variant.attitude))
    # The last showings count, one a shot.
    order = shown(film)[-len(film.images) - 1 :]
    rows = []
    for before, now in pairwise(order):
        shot, reference = film.unit.shots[now], film.references[now]
        every = objects.of(now, before, variant.settings.factor)
        # No limit to their number: that is the hardware's, not the paper's.
        kept = every[every["area"] >= variant.settings.min_area]
        found = find_pad(kept, shot.lidar_m)
        rows.append(
            Row(
                set=film.unit.set,
                name=shot.name,
                difficulty=shot.difficulty,
                strength=shot.strength,
                reference=reference,
                pad=Pad(**found._asdict()) if found else None,
                altitude_m=shot.lidar_m,
                objects=len(kept),
                dropped=0,
                min_area_px=variant.settings.min_area,
            )
        )
    return rows


def lines(by_variant: Sequence[tuple[str, Sequence[Row]]]) -> tuple[tuple[str, ...], list[tuple[str, ...]]]:
    """Head and lines of the table: a line a variant, a column a group of sets."""
    groups = list(dict.fromkeys(_group(row.set) for _, rows in by_variant for row in rows))
    table = []
    for name, rows in by_variant:
        parts = ([row for row in rows if _group(row.set) == group] for group in groups)
        table.append((name, *(_cell(summarise(part)) for part in parts)))
    return ("found; false; centre x / y [px]", *groups), table


def _group(name: str) -> str:
    """`photos:set1` and `photos:set2` are photos, `sweep:tilt` and `sweep:wet` sweeps."""
    return name.split(":", maxsplit=1)[0]


def _cell(figures: Summary) -> str:
    parts = [f"{figures.found} of {figures.required}"] if figures.required else []
    parts.append(f"{figures.false} false")
    if figures.mean_x_px is not None:
        parts.append(f"{figures.mean_x_px:.2f} / {figures.mean_y_px:.2f}")
    return "; ".join(parts)

# SPDX-License-Identifier: Apache-2.0
"""Writes what was measured into docs/accuracy.md, with pictures of rendered frames: photographs stay outside."""

from collections.abc import Mapping, Sequence
from pathlib import Path

from scripts.page_block import with_block
from sim.accuracy.goals import GOAL_HEAD, Verdict, goal_lines
from sim.accuracy.measure import Workers
from sim.accuracy.photos import PREFIX
from sim.accuracy.plots import grid, rate_curve
from sim.accuracy.rows import Row
from sim.accuracy.sheets import write_sheets
from sim.accuracy.shots import Unit
from sim.accuracy.tables import (
    CURVE_HEAD,
    END_HEAD,
    HEAD,
    MISS_HEAD,
    as_markdown,
    curve_lines,
    curves,
    end_lines,
    miss_lines,
    set_lines,
)

ROOT = Path(__file__).resolve().parents[2]
PAGE = ROOT / "docs/accuracy.md"
PICTURES = ROOT / "docs/pictures/accuracy"
SHEETS = ("samples", "missed", "false")
SHEET_FRAMES = 8
MISSES_SHOWN = 30


def write_blocks(blocks: Mapping[str, str], page: Path = PAGE) -> None:
    """Replace blocks of the page by their names.

    Raises:
        UserError: the page has no such block.
    """
    text = page.read_text(encoding="utf-8")
    for name, content in blocks.items():
        text = with_block(text, name, content, str(page.relative_to(page.parents[1])))
    page.write_text(text, encoding="utf-8")


def write_measured(rows: Sequence[Row], verdicts: Sequence[Verdict], units: Sequence[Unit], workers: Workers) -> None:
    """Write goals, tables and pictures."""
    blocks = {
        "goals": as_markdown(GOAL_HEAD, goal_lines(verdicts)),
        "sets": as_markdown(HEAD, set_lines(rows, PREFIX)),
        "misses": as_markdown(MISS_HEAD, miss_lines(rows)[:MISSES_SHOWN]),
        "ends": as_markdown(END_HEAD, end_lines(rows)),
        "curves": as_markdown(CURVE_HEAD, curve_lines(rows)),
    }
    PICTURES.mkdir(parents=True, exist_ok=True)
    for old in PICTURES.iterdir():
        old.unlink()
    plots = [rate_curve(name, points) for name, points in curves(rows).items()]
    if plots:
        (PICTURES / "curves.svg").write_text(grid(plots), encoding="utf-8")
    rendered = [row for row in rows if not row.set.startswith(PREFIX)]
    written = write_sheets(rendered, units, PICTURES, workers, names=SHEETS, most=SHEET_FRAMES)
    shown = [f"![{name}](pictures/accuracy/{path.name})" for name, path in written.items()]
    blocks["pictures"] = "\n\n".join(([] if not plots else ["![curves](pictures/accuracy/curves.svg)"]) + shown)
    write_blocks(blocks)

# SPDX-License-Identifier: Apache-2.0
"""One HTML file with goals, tables, histograms, curves and contact sheets."""

import base64
import html
from collections.abc import Sequence
from pathlib import Path

from scripts.report import write_page
from sim.accuracy.goals import GOAL_HEAD, Verdict, goal_lines
from sim.accuracy.photos import PREFIX
from sim.accuracy.plots import error_curve, histogram, rate_curve
from sim.accuracy.rows import Row
from sim.accuracy.sheets import SHEETS
from sim.accuracy.tables import (
    CURVE_HEAD,
    END_HEAD,
    HEAD,
    MISS_HEAD,
    as_html,
    curve_lines,
    curves,
    end_lines,
    miss_lines,
    set_lines,
)

_NOTE = (
    "Found: within 5 px and 5 degrees of the truth; farther is false, as is any detection without a pad. Errors are of "
    "the found pads. With + : pads found though square or rectangle is cut, covered or tiny. Of allowed: greatest "
    "distance as a part of 1 % of the altitude and 5 mm."
)


def write_report(
    path: Path, rows: Sequence[Row], verdicts: Sequence[Verdict], sheets: dict[str, Path], run: str
) -> None:
    """Write the report.

    Args:
        path: Where to.
        rows: All rows.
        verdicts: The goals; may be empty.
        sheets: Contact sheets by name.
        run: How the rows were made.
    """
    sections = [f"<header><h1>Accuracy</h1><p>{len(rows)} frames, path: {html.escape(run)}.</p></header>"]
    if verdicts:
        sections.append(_section("Goals", as_html(GOAL_HEAD, goal_lines(verdicts))))
    sections.append(
        _section("Sets", as_html(HEAD, set_lines(rows, PREFIX)), f"<p class='note'>{html.escape(_NOTE)}</p>")
    )
    if misses := miss_lines(rows):
        sections.append(_section("Missed, and what the record shows of it", as_html(MISS_HEAD, misses)))
    sections.append(_section("Errors", f"<div class='charts'>{''.join(_histograms(rows))}</div>"))
    if plots := [plot(name, points) for name, points in curves(rows).items() for plot in (rate_curve, error_curve)]:
        ends = as_html(END_HEAD, end_lines(rows))
        table = as_html(CURVE_HEAD, curve_lines(rows))
        sections.append(_section("Where it ends", ends, f"<div class='charts'>{''.join(plots)}</div>", table))
    for name, title in SHEETS.items():
        if name in sheets:
            sections.append(_section(title, _sheet(title, sheets[name])))
    write_page(path, "accuracy", sections)


def _sheet(title: str, path: Path) -> str:
    data = base64.b64encode(path.read_bytes()).decode("ascii")
    return f"<figure><img alt='{html.escape(title, quote=True)}' src='data:image/jpeg;base64,{data}'></figure>"


def _section(title: str, *content: str) -> str:
    return f"<section><h2>{html.escape(title)}</h2>{''.join(content)}</section>"


def _histograms(rows: Sequence[Row]) -> list[str]:
    """Errors of photographs and of all rendered frames apart."""
    charts = []
    for title, photos in (("Photographs", True), ("Rendered", False)):
        good = [row for row in rows if row.found and row.set.startswith(PREFIX) == photos]
        for what, unit, values in (
            ("column", "px", [row.error_x_px for row in good if row.error_x_px is not None]),
            ("line", "px", [row.error_y_px for row in good if row.error_y_px is not None]),
            ("angle", "deg", [row.error_deg for row in good if row.error_deg is not None]),
        ):
            if values:
                charts.append(histogram(f"{title}: {what}", unit, values))
    return charts

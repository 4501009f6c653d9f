# SPDX-License-Identifier: Apache-2.0
"""Tables of figures, as text, Markdown and HTML from the same cells."""

import html
from collections.abc import Sequence

from sim.accuracy.metrics import Summary, curve, ends_at, summarise
from sim.accuracy.rows import Row

HEAD = (
    *("set", "frames", "with pad", "found", "false", "centre x / y [px]", "95 % [px]", "max [px]"),
    *("angle mean / max [deg]", "place mean / max [mm]", "of allowed", "missed"),
)
_NAMES_SHOWN = 4


def _number(value: float | None, form: str = ".3f", scale: float = 1.0) -> str:
    return "-" if value is None else f"{value * scale:{form}}"


def cells(name: str, figures: Summary) -> tuple[str, ...]:
    """One line of the table, in the order of `HEAD`."""
    names = " ".join(figures.missed[:_NAMES_SHOWN])
    more = f" +{figures.missing - _NAMES_SHOWN}" if figures.missing > _NAMES_SHOWN else ""
    return (
        name,
        str(figures.frames),
        str(figures.required),
        str(figures.found) + (f" +{figures.pads - figures.found}" if figures.pads > figures.found else ""),
        str(figures.false),
        "-" if figures.mean_x_px is None else f"{figures.mean_x_px:.3f} / {figures.mean_y_px:.3f}",
        _number(figures.p95_px),
        _number(figures.max_px),
        "-" if figures.mean_deg is None else f"{figures.mean_deg:.3f} / {figures.max_deg:.3f}",
        "-" if figures.mean_m is None else f"{1000 * figures.mean_m:.1f} / {1000 * figures.max_m:.1f}",
        _number(figures.max_share, ".2f"),
        names + more or "-",
    )


def set_lines(rows: Sequence[Row], total: str | None = None) -> list[tuple[str, ...]]:
    """A line a set.

    Args:
        rows: The frames.
        total: Sets whose names begin so are also summed up together, with a line a difficulty.
    """
    lines = [
        cells(name, summarise([row for row in rows if row.set == name]))
        for name in dict.fromkeys(row.set for row in rows)
    ]
    chosen = [row for row in rows if total and row.set.startswith(total)]
    if chosen:
        lines.append(cells(f"{total}* together", summarise(chosen)))
    for level in sorted({row.difficulty for row in chosen}):
        lines.append(cells(f"  difficulty {level}", summarise([row for row in chosen if row.difficulty == level])))
    return lines


MISS_HEAD = ("set", "frame", "objects", "MIN_AREA [px]", "what became of the shapes")


def miss_lines(rows: Sequence[Row]) -> list[tuple[str, ...]]:
    """A line a missed frame; sweeps go to where everything is missed and are left out."""
    return [
        (row.set, row.name, f"{row.objects}{f' +{row.dropped}' * bool(row.dropped)}", str(row.min_area_px), row.shapes)
        for row in rows
        if row.missed and row.strength is None
    ]


CURVE_HEAD = (
    "disturbance",
    "strength",
    "frames",
    "found",
    "95 % interval",
    "false",
    "centre error [px]",
    "95 % interval",
)
END_HEAD = ("disturbance", "below 95 % found from", "below 50 % found from")


def curve_lines(rows: Sequence[Row]) -> list[tuple[str, ...]]:
    """A line a strength."""
    lines = []
    for name, points in curves(rows).items():
        for point in points:
            error = "-" if point.error_px is None else f"{point.error_low:.3f} to {point.error_high:.3f}"
            lines.append(
                (
                    name,
                    f"{point.strength:g}",
                    str(point.frames),
                    f"{100 * point.rate:.0f} %",
                    f"{100 * point.rate_low:.0f} to {100 * point.rate_high:.0f} %",
                    str(point.false),
                    _number(point.error_px),
                    error,
                )
            )
    return lines


def end_lines(rows: Sequence[Row]) -> list[tuple[str, ...]]:
    """A line a disturbance, or two where it has two directions: where it ends, on the way from 0."""
    lines = []
    for name, points in curves(rows).items():
        sides = [("", [point for point in points if point.strength >= 0])]
        if points[0].strength < 0:
            sides = [(" up", sides[0][1]), (" down", [point for point in reversed(points) if point.strength <= 0])]
        for side, way in sides:
            ends = [ends_at(way, rate) for rate in (0.95, 0.5)]
            lines.append((name + side, *("not in this range" if end is None else f"{end:.3g}" for end in ends)))
    return lines


def curves(rows: Sequence[Row]) -> dict[str, list]:
    """A curve for each set that has strengths, by the name of its disturbance."""
    names = dict.fromkeys(row.set for row in rows if row.strength is not None)
    return {name.removeprefix("sweep:"): curve([row for row in rows if row.set == name]) for name in names}


def as_text(head: Sequence[str], lines: Sequence[Sequence[str]]) -> str:
    """Aligned columns; the first and the last to the left."""
    widths = [max(len(line[i]) for line in (head, *lines)) for i in range(len(head))]
    left = {0, len(head) - 1}

    def join(line: Sequence[str]) -> str:
        parts = [line[i].ljust(widths[i]) if i in left else line[i].rjust(widths[i]) for i in range(len(head))]
        return "  ".join(parts).rstrip()

    return "\n".join([join(head), "  ".join("-" * width for width in widths), *map(join, lines)])


def as_markdown(head: Sequence[str], lines: Sequence[Sequence[str]]) -> str:
    """A Markdown table."""
    return "\n".join(f"| {' | '.join(cell.strip() for cell in line)} |" for line in (head, ["---"] * len(head), *lines))


def as_html(head: Sequence[str], lines: Sequence[Sequence[str]]) -> str:
    """An HTML table, in the style of `scripts/report.css`."""
    top = "".join(f"<th>{html.escape(cell)}</th>" for cell in head)
    body = "".join("<tr>" + "".join(f"<td>{html.escape(cell)}</td>" for cell in line) + "</tr>" for line in lines)
    return f"<div class='scroll'><table class='words'><thead><tr>{top}</tr></thead><tbody>{body}</tbody></table></div>"

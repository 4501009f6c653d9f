# SPDX-License-Identifier: Apache-2.0
"""Small line charts as inline SVG."""

import html
import math
from dataclasses import dataclass

_WIDTH, _HEIGHT = 400, 220
_LEFT, _RIGHT, _TOP, _BOTTOM = 52, 14, 40, 30
_TICKS = 4


@dataclass(frozen=True)
class Series:
    """One line of a chart.

    Attributes:
        name: For the legend.
        values: One a frame; None leaves a gap.
        style: Class in `report.css`: primary, second or muted.
    """

    name: str
    values: list[float | None]
    style: str


def chart(title: str, unit: str, names: list[str], series: list[Series], joined: bool = True) -> str:
    """A chart over the frames as an SVG element.

    Args:
        title: What is shown.
        unit: Its unit.
        names: The frames.
        series: The lines, each with one value a frame.
        joined: Draw lines from frame to frame, not points alone.
    """
    values = [value for one in series for value in one.values if value is not None]
    parts = [
        f"<svg viewBox='0 0 {_WIDTH} {_HEIGHT}' role='img' aria-label='{html.escape(title, quote=True)}'>",
        f"<text class='title' x='{_LEFT}' y='18'>{html.escape(title)} ",
        f"<tspan class='unit'>{html.escape(unit)}</tspan></text>",
    ]
    if not values:
        parts.append(
            f"<text class='tick' x='{_WIDTH / 2}' y='{_HEIGHT / 2}' text-anchor='middle'>no value</text></svg>"
        )
        return "".join(parts)
    low, high, step = round_scale(min(values), max(values))

    def across(index: int) -> float:
        share = 0.5 if len(names) == 1 else index / (len(names) - 1)
        return _LEFT + 10 + share * (_WIDTH - _LEFT - _RIGHT - 20)

    def down(value: float) -> float:
        return _TOP + (high - value) / (high - low) * (_HEIGHT - _TOP - _BOTTOM)

    for index in range(round((high - low) / step) + 1):
        value = low + index * step
        y = down(value)
        parts.append(f"<line class='grid' x1='{_LEFT}' x2='{_WIDTH - _RIGHT}' y1='{y:.1f}' y2='{y:.1f}'/>")
        parts.append(
            f"<text class='tick' x='{_LEFT - 6}' y='{y + 4:.1f}' text-anchor='end'>{tick_text(value, step)}</text>"
        )
    for index in sorted({0, len(names) - 1}):
        anchor = "start" if index == 0 and len(names) > 1 else "end" if len(names) > 1 else "middle"
        text = html.escape(names[index])
        parts.append(
            f"<text class='tick' x='{across(index):.1f}' y='{_HEIGHT - 8}' text-anchor='{anchor}'>{text}</text>"
        )
    for one in series:
        for run in _runs(one.values) if joined else ():
            points = " ".join(f"{across(index):.1f},{down(one.values[index]):.1f}" for index in run)
            parts.append(f"<polyline class='{one.style}' points='{points}'/>")
        for index, value in enumerate(one.values):
            if value is not None:
                label = html.escape(f"{names[index]}: {one.name} {value:.4g} {unit}")
                parts.append(
                    f"<circle class='{one.style}' cx='{across(index):.1f}' cy='{down(value):.1f}' r='3'>"
                    f"<title>{label}</title></circle>"
                )
    if len(series) > 1:
        parts.append(_legend(series))
    return "".join([*parts, "</svg>"])


def _legend(series: list[Series]) -> str:
    parts = []
    right = _WIDTH - _RIGHT
    for one in reversed(series):
        parts.append(f"<text class='tick' x='{right}' y='18' text-anchor='end'>{html.escape(one.name)}</text>")
        right -= 7 * len(one.name) + 8
        parts.append(f"<circle class='{one.style}' cx='{right}' cy='14' r='4'/>")
        right -= 14
    return "".join(parts)


def _runs(values: list[float | None]) -> list[list[int]]:
    """Indices of values, split where one is missing."""
    runs: list[list[int]] = [[]]
    for index, value in enumerate(values):
        if value is None:
            runs.append([])
        else:
            runs[-1].append(index)
    return [run for run in runs if run]


def round_scale(least: float, greatest: float) -> tuple[float, float, float]:
    """Round limits around the values, and the step between them."""
    span = greatest - least or abs(greatest) * 0.1 or 1.0
    magnitude = 10.0 ** math.floor(math.log10(span / _TICKS))
    step = next(factor * magnitude for factor in (1, 2, 2.5, 5, 10) if factor * magnitude * _TICKS >= span)
    low = math.floor(least / step) * step
    high = math.ceil(greatest / step) * step
    if low == high:
        low, high = low - step, high + step
    return low, high, step


def tick_text(value: float, step: float) -> str:
    """A value on an axis, with as many digits as the step needs."""
    digits = max(0, -math.floor(math.log10(step) + 1e-9))
    if round(step * 10**digits, 6) % 1:
        digits += 1
    return f"{value:.{digits}f}" if abs(value) > step / 2 else f"{0:.{digits}f}"

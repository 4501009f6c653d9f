# SPDX-License-Identifier: Apache-2.0
"""Histograms and curves with their intervals as inline SVG, in the style of the demo's charts."""

import html
from collections.abc import Sequence

import numpy as np

from scripts.report_chart import round_scale, tick_text
from sim.accuracy.metrics import Point

_WIDTH, _HEIGHT = 400, 220
_LEFT, _RIGHT, _TOP, _BOTTOM = 52, 14, 34, 32
_BINS = 24


class _Frame:
    """The axes of a plot, and where its values lie."""

    def __init__(self, title: str, unit: str, x: tuple[float, float], y: tuple[float, float], across: str = "") -> None:
        self._x_low, self._x_high, x_step = round_scale(*x)
        self._y_low, self._y_high, y_step = round_scale(*y)
        self.parts = [
            f"<svg viewBox='0 0 {_WIDTH} {_HEIGHT}' role='img' aria-label='{html.escape(title, quote=True)}'>",
            f"<text class='title' x='{_LEFT}' y='18'>{html.escape(title)} ",
            f"<tspan class='unit'>{html.escape(unit)}</tspan></text>",
        ]
        for value in np.arange(self._y_low, self._y_high + y_step / 2, y_step):
            y = self.down(value)
            self.parts.append(f"<line class='grid' x1='{_LEFT}' x2='{_WIDTH - _RIGHT}' y1='{y:.1f}' y2='{y:.1f}'/>")
            self._tick(_LEFT - 6, y + 4, "end", tick_text(value, y_step))
        for value in np.arange(self._x_low, self._x_high + x_step / 2, x_step):
            self._tick(self.across(value), _HEIGHT - 16, "middle", tick_text(value, x_step))
        self._tick(_WIDTH - _RIGHT, _HEIGHT - 4, "end", across)

    def across(self, value: float) -> float:
        """Column of a value."""
        return _LEFT + (value - self._x_low) / (self._x_high - self._x_low) * (_WIDTH - _LEFT - _RIGHT)

    def down(self, value: float) -> float:
        """Line of a value."""
        return _TOP + (self._y_high - value) / (self._y_high - self._y_low) * (_HEIGHT - _TOP - _BOTTOM)

    def _tick(self, x: float, y: float, anchor: str, text: str) -> None:
        self.parts.append(
            f"<text class='tick' x='{x:.1f}' y='{y:.1f}' text-anchor='{anchor}'>{html.escape(text)}</text>"
        )

    def svg(self) -> str:
        """The whole element."""
        return "".join([*self.parts, "</svg>"])


def histogram(title: str, unit: str, values: Sequence[float]) -> str:
    """How often each value occurs.

    Args:
        title: What is counted.
        unit: Of the values.
        values: At least one.
    """
    low, high, _ = round_scale(min(0.0, *values), max(0.0, *values))
    counts, edges = np.histogram(values, bins=_BINS, range=(low, high))
    frame = _Frame(title, f"{len(values)} frames", (low, high), (0, max(1, int(counts.max()))), unit)
    for count, left, right in zip(counts, edges[:-1], edges[1:], strict=True):
        if count:
            x, y = frame.across(left), frame.down(count)
            width, height = frame.across(right) - x - 1, frame.down(0) - y
            label = f"{left:.3g} to {right:.3g} {unit}: {count}"
            frame.parts.append(
                f"<rect class='primary' x='{x:.1f}' y='{y:.1f}' width='{width:.1f}' height='{height:.1f}'>"
                f"<title>{html.escape(label)}</title></rect>"
            )
    return frame.svg()


def rate_curve(name: str, points: Sequence[Point]) -> str:
    """Detection rate over the strength of a disturbance, with its 95 % interval."""
    ends = points[0].strength, points[-1].strength
    frame = _Frame(f"{name}: found", "%", ends, (0, 100), "strength")
    _curve(
        frame,
        [(point.strength, 100 * point.rate, 100 * point.rate_low, 100 * point.rate_high) for point in points],
        "%",
    )
    return frame.svg()


def error_curve(name: str, points: Sequence[Point]) -> str:
    """Mean error of the centre over the strength of a disturbance, with its 95 % interval; "" if nothing was found."""
    known = [point for point in points if point.error_px is not None]
    if not known:
        return ""
    ends = points[0].strength, points[-1].strength
    frame = _Frame(
        f"{name}: error of the centre", "px", ends, (0, max(point.error_high for point in known)), "strength"
    )
    _curve(frame, [(point.strength, point.error_px, point.error_low, point.error_high) for point in known], "px")
    return frame.svg()


def _curve(frame: _Frame, points: Sequence[tuple[float, float, float, float]], unit: str) -> None:
    """Values (x, y, low, high) as a line in a band."""

    def path(places: Sequence[tuple[float, float]]) -> str:
        return " ".join(f"{frame.across(x):.1f},{frame.down(y):.1f}" for x, y in places)

    lower = [(x, low) for x, _, low, _ in points]
    upper = [(x, high) for x, _, _, high in reversed(points)]
    frame.parts.append(f"<polygon class='band' points='{path(lower + upper)}'/>")
    frame.parts.append(f"<polyline class='primary' points='{path([(x, y) for x, y, _, _ in points])}'/>")
    for x, y, low, high in points:
        label = html.escape(f"{x:g}: {y:.3g} {unit}, {low:.3g} to {high:.3g}")
        frame.parts.append(
            f"<circle class='primary' cx='{frame.across(x):.1f}' cy='{frame.down(y):.1f}' r='3'>"
            f"<title>{label}</title></circle>"
        )


_COLUMNS = 3
_STYLE = (
    "svg{background:#fff}text{fill:#17212b;font:12px sans-serif}.title{font-size:14px;font-weight:600}"
    ".unit,.tick{fill:#5a6a78;font-weight:400}.grid{stroke:#dfe5ea}polyline{fill:none;stroke:#0b7fc1;stroke-width:2}"
    "circle,polygon{fill:#0b7fc1}polygon{opacity:.18}"
)


def grid(plots: Sequence[str]) -> str:
    """Plots side by side in one SVG that needs no style sheet."""
    lines = -(-len(plots) // _COLUMNS)
    width, height = _COLUMNS * _WIDTH, lines * _HEIGHT
    placed = []
    for index, plot in enumerate(plots):
        x, y = index % _COLUMNS * _WIDTH, index // _COLUMNS * _HEIGHT
        place = f"<svg x='{x}' y='{y}' width='{_WIDTH}' height='{_HEIGHT}'"
        placed.append(plot.replace("<svg", place, 1))
    head = f"<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 {width} {height}' width='{width}'>"
    return f"{head}<style>{_STYLE}</style>{''.join(placed)}</svg>\n"

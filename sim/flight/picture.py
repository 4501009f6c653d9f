# SPDX-License-Identifier: Apache-2.0
"""A landing as a picture: height, distance from the pad and turn over time, with the phases behind."""

import html
import math
from collections.abc import Callable, Sequence

from scripts.report_chart import round_scale, tick_text

_WIDTH, _PANEL, _LEFT, _RIGHT, _TOP, _GAP = 900, 170, 70, 20, 64, 34
_STYLE = (
    "text{font:12px sans-serif;fill:#333}.title{font-weight:600}.grid{stroke:#ddd}"
    ".line{fill:none;stroke:#1f5fa8;stroke-width:2}.band{fill:#eef3f9}.other{fill:#fff}.phase{font-size:11px;fill:#555}"
)
_LEVELS = 3


def landing_svg(
    title: str, track: Sequence[tuple[float, float, float, float, float]], steps: Sequence[tuple[float, str]]
) -> str:
    """The picture.

    Args:
        title: What was flown.
        track: Time in s, north, east, height in m, heading in rad; the pad is the origin, its top to the north.
        steps: When each phase began, and its name; the first begins with the track.
    """
    times = [row[0] for row in track]
    panels = (
        ("height [m]", [row[3] for row in track]),
        ("distance from the pad [m]", [math.hypot(row[1], row[2]) for row in track]),
        ("turn from the pad [degrees]", [math.degrees(row[4]) for row in track]),
    )
    height = _TOP + len(panels) * (_PANEL + _GAP)
    start, end = times[0], times[-1]

    def across(time: float) -> float:
        return _LEFT + (time - start) / (end - start) * (_WIDTH - _LEFT - _RIGHT)

    parts = [
        f"<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 {_WIDTH} {height}' role='img'>",
        f"<style>{_STYLE}</style><rect width='{_WIDTH}' height='{height}' fill='#fff'/>",
        f"<text class='title' x='{_LEFT}' y='20'>{html.escape(title)}</text>",
    ]
    ends = [time for time, _ in steps[1:]] + [end]
    for index, ((time, name), until) in enumerate(zip(steps, ends, strict=True)):
        x, width = across(time), across(until) - across(time)
        kind = "band" if index % 2 else "other"
        parts.append(f"<rect class='{kind}' x='{x:.1f}' y='{_TOP - 8}' width='{width:.1f}' height='{height - _TOP}'/>")
        # Phases that are over at once have no room side by side.
        row = 34 + 14 * (index % 2)
        parts.append(f"<text class='phase' x='{x:.1f}' y='{row}'>{html.escape(name)}</text>")
    for number, (name, values) in enumerate(panels):
        parts += _panel(name, times, values, _TOP + number * (_PANEL + _GAP), across)
    for time in range(math.ceil(start), math.floor(end) + 1, 2):
        parts.append(f"<text x='{across(time):.1f}' y='{height - 12}' text-anchor='middle'>{time}</text>")
    parts.append(f"<text x='{_WIDTH - _RIGHT}' y='{height}' text-anchor='end'>time [s]</text></svg>")
    return "\n".join(parts) + "\n"


def _panel(
    name: str, times: Sequence[float], values: Sequence[float], top: float, across: Callable[[float], float]
) -> list[str]:
    low, high, step = round_scale(min(values), max(values))

    def down(value: float) -> float:
        return top + 18 + (high - value) / (high - low) * (_PANEL - 18)

    parts = [f"<text class='title' x='{_LEFT}' y='{top + 8}'>{html.escape(name)}</text>"]
    for index in range(round((high - low) / step) + 1):
        value = low + index * step
        parts.append(
            f"<line class='grid' x1='{_LEFT}' x2='{_WIDTH - _RIGHT}' y1='{down(value):.1f}' y2='{down(value):.1f}'/>"
            f"<text x='{_LEFT - 6}' y='{down(value) + 4:.1f}' text-anchor='end'>{tick_text(value, step)}</text>"
        )
    points = " ".join(f"{across(time):.1f},{down(value):.1f}" for time, value in zip(times, values, strict=True))
    return [*parts, f"<polyline class='line' points='{points}'/>"]

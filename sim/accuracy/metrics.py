# SPDX-License-Identifier: Apache-2.0
"""Figures of a set of rows, and how far they can be trusted."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import groupby

import numpy as np

from sim.accuracy.rows import Row

Z_95 = 1.959963984540054
RESAMPLES = 1000


@dataclass(frozen=True)
class Summary:
    """Figures of some frames; errors are those of pads that were found, None where none has a reference.

    Attributes:
        frames: All frames.
        required: Frames whose pad is plain to see.
        found: Required frames whose pad was found.
        pads: Frames with a pad that was found, required or not.
        false: False detections.
        missed: Names of the required frames whose pad was not found.
        mean_x_px: Mean absolute error of the column.
        mean_y_px: The same of the line.
        p95_px: 95 % of the centres lie no farther than this from the true one.
        max_px: The farthest.
        mean_deg: Mean absolute error of the angle.
        max_deg: The greatest.
        mean_m: Mean distance from the true place.
        max_m: The greatest.
        max_share: The greatest distance as a part of what is allowed (1 % of altitude + 5 mm).
        longest_gap: Most required frames in a row that were missed; says something of a clip alone.
    """

    frames: int
    required: int
    found: int
    pads: int
    false: int
    missed: tuple[str, ...]
    mean_x_px: float | None
    mean_y_px: float | None
    p95_px: float | None
    max_px: float | None
    mean_deg: float | None
    max_deg: float | None
    mean_m: float | None
    max_m: float | None
    max_share: float | None
    longest_gap: int

    @property
    def missing(self) -> int:
        """How many were missed."""
        return len(self.missed)


def summarise(rows: Sequence[Row]) -> Summary:
    """Figures of these rows."""
    good = [row for row in rows if row.found]
    centre = _known(row.error_px for row in good)
    angle = _known(row.error_deg for row in good)
    place = _known(row.error_m for row in good)
    return Summary(
        frames=len(rows),
        required=sum(row.reference.required for row in rows),
        found=sum(row.reference.required and row.found for row in rows),
        pads=len(good),
        false=sum(row.false for row in rows),
        missed=tuple(row.name for row in rows if row.missed),
        mean_x_px=_mean(np.abs(_known(row.error_x_px for row in good))),
        mean_y_px=_mean(np.abs(_known(row.error_y_px for row in good))),
        p95_px=float(np.percentile(centre, 95)) if centre.size else None,
        max_px=_max(centre),
        mean_deg=_mean(angle),
        max_deg=_max(angle),
        mean_m=_mean(place),
        max_m=_max(place),
        max_share=_max(_known(row.position_share for row in good)),
        longest_gap=max((len(list(run)) for missed, run in groupby(rows, lambda row: row.missed) if missed), default=0),
    )


def _known(values) -> np.ndarray:  # noqa: ANN001
    return np.array([value for value in values if value is not None], np.float64)


def _mean(values: np.ndarray) -> float | None:
    return float(values.mean()) if values.size else None


def _max(values: np.ndarray) -> float | None:
    return float(values.max()) if values.size else None


def wilson(successes: int, trials: int) -> tuple[float, float]:
    """95 % interval of a rate (Wilson's score interval).

    Raises:
        ValueError: there was no trial.
    """
    if not 0 <= successes <= trials or trials == 0:
        raise ValueError(f"{successes} of {trials} is no rate")
    rate, square = successes / trials, Z_95**2
    middle = (rate + square / (2 * trials)) / (1 + square / trials)
    half = Z_95 / (1 + square / trials) * math.sqrt(rate * (1 - rate) / trials + square / (4 * trials**2))
    # At the ends rounding would leave the rate itself outside.
    return max(0.0, min(rate, middle - half)), min(1.0, max(rate, middle + half))


def bootstrap_mean(values: Sequence[float], seed: int = 1) -> tuple[float, float]:
    """95 % interval of a mean, by drawing again from the values.

    Raises:
        ValueError: there is no value.
    """
    sample = np.asarray(values, np.float64)
    if sample.size == 0:
        raise ValueError("no value, no mean")
    draws = np.random.default_rng(seed).integers(0, sample.size, (RESAMPLES, sample.size))
    low, high = np.percentile(sample[draws].mean(axis=1), [2.5, 97.5])
    return float(low), float(high)


@dataclass(frozen=True)
class Point:
    """One strength of a disturbance: rate of detection and mean error of the centre, each with a 95 % interval."""

    strength: float
    frames: int
    rate: float
    rate_low: float
    rate_high: float
    false: int
    error_px: float | None
    error_low: float | None
    error_high: float | None


def curve(rows: Sequence[Row]) -> list[Point]:
    """The rows by strength, weakest first. A frame counts as detected if the pad in it was found."""
    points = []
    for strength in sorted({row.strength for row in rows if row.strength is not None}):
        here = [row for row in rows if row.strength == strength]
        found = sum(row.found for row in here)
        errors = [row.error_px for row in here if row.found and row.error_px is not None]
        low, high = wilson(found, len(here))
        error_low, error_high = bootstrap_mean(errors) if errors else (None, None)
        points.append(
            Point(
                strength=strength,
                frames=len(here),
                rate=found / len(here),
                rate_low=low,
                rate_high=high,
                false=sum(row.false for row in here),
                error_px=float(np.mean(errors)) if errors else None,
                error_low=error_low,
                error_high=error_high,
            )
        )
    return points


def ends_at(points: Sequence[Point], rate: float) -> float | None:
    """Strength at which the rate of detection first falls below `rate`, on straight lines between the points.

    Args:
        points: A curve, or a part of it, from the weakest disturbance on.
        rate: 0 to 1.

    Returns:
        The strength; None where the rate never falls so low.
    """
    before = None
    for point in points:
        if point.rate < rate:
            if before is None:
                return point.strength
            share = (before.rate - rate) / (before.rate - point.rate)
            return before.strength + share * (point.strength - before.strength)
        before = point
    return None

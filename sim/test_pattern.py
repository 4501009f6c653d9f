# SPDX-License-Identifier: Apache-2.0
"""The firmware finds the pad that `pattern_source` draws, by way of the golden models of all cores."""

import pytest

from firmware.library import make
from golden.pattern_source import centre, frame, travel
from sim.accuracy.paths import golden
from sim.accuracy.rows import Reference
from sim.accuracy.shots import Shot, Unit, develop

LIMIT_PX = 0.5
LIMIT_DEG = 0.5
ALTITUDE_M = 1.0
"""Of the camera that would see the pad as large as it is drawn."""


def test_the_pad_of_the_pattern_is_found() -> None:
    """In the middle, at the lower end of the path and at its right end; the first is shown twice."""
    make("host")
    numbers = (0, travel(1280, 720)[1], travel(1280, 720)[0])
    shots = []
    for number in numbers:
        x_px, y_px = centre(number, move=True)
        known = frame(number, move=True), Reference(True, True, x_px, y_px, 0.0)
        shots.append(Shot(str(number), lambda known=known: known, ALTITUDE_M))
    film = develop(Unit("pattern", tuple(shots), clip=True))
    for seen, known in zip(golden(film).seen, film.references, strict=True):
        assert seen.pad is not None, f"no pad in frame {seen.name}"
        assert (seen.pad.x_px, seen.pad.y_px) == pytest.approx((known.x_px, known.y_px), abs=LIMIT_PX)
        assert abs(seen.pad.angle_deg) < LIMIT_DEG

# SPDX-License-Identifier: Apache-2.0
"""What is measured: frames with what is known of them, in units that share nothing with each other."""

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np

from scripts.frames import FrameSet
from sim.accuracy.rows import Reference
from sim.world.pose import Truth

SHOWINGS_LEAST = 9
"""How often an independent picture is shown at least.

The first showing has no thresholds. From the second on the firmware moves MIN_AREA from 100 px towards 30 (few shapes)
or 150 (too many), where it is by the eighth showing; a test sees that it then stays.
"""
SHOWINGS_STEADY = 4
"""A picture in which the pad was seen so often in a row, the last time included, is not shown again."""
SHOWINGS_MOST = 60
"""A second: every threshold factor that the firmware tries while it sees no pad, and the usual one again."""


@dataclass(frozen=True)
class Shot:
    """One frame before it is drawn or read.

    Attributes:
        name: Its name in the set.
        draw: Gives (720, 1280, 3) uint8 RGB and what is true of it, the same each time; can go to another process.
        lidar_m: What the LiDAR measures.
        difficulty: What the reference calls it; "-" where it does not.
        strength: How strong the set's disturbance is.
        attitude_rad: Roll and pitch as the autopilot says before the record of the frame; None = it says nothing.
    """

    name: str
    draw: Callable[[], tuple[np.ndarray, Reference]]
    lidar_m: float
    difficulty: str = "-"
    strength: float | None = None
    attitude_rad: tuple[float, float] | None = None


@dataclass(frozen=True)
class Unit:
    """Frames that go through one firmware from its start: one picture, or a clip.

    Attributes:
        set: Name of the set.
        shots: The frames in order.
        clip: Each frame follows the one before; else there is one frame, shown until everything has settled.
        showings: How often a picture is shown at most; a clip is shown as it is.
    """

    set: str
    shots: tuple[Shot, ...]
    clip: bool = False
    showings: int = SHOWINGS_MOST

    def __post_init__(self) -> None:
        if not self.shots or (len(self.shots) > 1 and not self.clip):
            raise ValueError(f"a unit of {self.set} is one picture or a clip, not {len(self.shots)} pictures")


@dataclass(frozen=True)
class Film:
    """A unit with its pictures.

    Attributes:
        unit: The unit.
        images: A picture a shot.
        references: What is true of each.
    """

    unit: Unit
    images: tuple[np.ndarray, ...] = field(repr=False)
    references: tuple[Reference, ...]

    @property
    def frames(self) -> FrameSet:
        """The unit as demo and vectors know frames."""
        shots = self.unit.shots
        return FrameSet(
            title=self.unit.set,
            names=tuple(shot.name for shot in shots),
            sequential=self.unit.clip,
            truths=tuple(_truth(shot, known) for shot, known in zip(shots, self.references, strict=True)),
            altitude_csv=None,
            open=lambda: iter(self.images),
        )


def develop(unit: Unit) -> Film:
    """Draw all pictures of a unit."""
    images, references = zip(*(shot.draw() for shot in unit.shots), strict=True)
    return Film(unit, images, references)


def _truth(shot: Shot, known: Reference) -> Truth | None:
    """The reference as the demo's pictures take it."""
    if known.x_px is None or known.y_px is None:
        return None
    return Truth(
        x_px=known.x_px,
        y_px=known.y_px,
        angle_deg=known.angle_deg or 0.0,
        altitude_m=known.altitude_m or shot.lidar_m,
        lidar_m=shot.lidar_m,
        right_m=known.right_m or 0.0,
        forward_m=known.forward_m or 0.0,
        visible=known.required,
    )

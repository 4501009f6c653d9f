# SPDX-License-Identifier: Apache-2.0
"""What is measured: frames with what is known of them, in units that share nothing with each other."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from sim.accuracy.rows import Reference
from sim.world.pose import Truth


@dataclass(frozen=True)
class Shot:
    """One frame before it is drawn or read.

    Attributes:
        name: Its name in the set.
        picture: Gives (720, 1280, 3) uint8 RGB, the same each time; can be sent to another process.
        lidar_m: What the LiDAR measures.
        reference: What is true of it.
        difficulty: What the reference calls it; "-" where it does not.
        strength: How strong the set's disturbance is.
    """

    name: str
    picture: Callable[[], np.ndarray]
    lidar_m: float
    reference: Reference
    difficulty: str = "-"
    strength: float | None = None

    @property
    def truth(self) -> Truth | None:
        """The reference as the demo's pictures take it."""
        known = self.reference
        if known.x_px is None or known.y_px is None:
            return None
        return Truth(
            x_px=known.x_px,
            y_px=known.y_px,
            angle_deg=known.angle_deg or 0.0,
            altitude_m=known.altitude_m or self.lidar_m,
            lidar_m=self.lidar_m,
            right_m=known.right_m or 0.0,
            forward_m=known.forward_m or 0.0,
            visible=known.required,
        )


@dataclass(frozen=True)
class Unit:
    """Frames that go through one firmware from its start: one picture, or a clip.

    Attributes:
        set: Name of the set.
        shots: The frames in order.
        clip: Each frame follows the one before; else there is one frame, shown until everything has settled.
    """

    set: str
    shots: tuple[Shot, ...]
    clip: bool = False

    def __post_init__(self) -> None:
        if not self.shots or (len(self.shots) > 1 and not self.clip):
            raise ValueError(f"a unit of {self.set} is one picture or a clip, not {len(self.shots)} pictures")

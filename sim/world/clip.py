# SPDX-License-Identifier: Apache-2.0
"""The bundled clip: a short descent on to the pad, made when it is asked for."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from sim.world.camera import Camera
from sim.world.pose import Pose, Truth, truth_of
from sim.world.renderer import Look, render

_START = Pose(altitude_m=2.0, right_m=0.55, forward_m=0.32, pad_yaw_deg=-38.0)
_END = Pose(altitude_m=0.5, right_m=0.02, forward_m=-0.015, pad_yaw_deg=-6.0)
_LOOK = Look(noise_sigma=1.2, gradient=0.12, gradient_deg=35.0, shadow=0.12, motion_px=0.6, motion_deg=20.0)


@dataclass(frozen=True)
class ClipFrame:
    """One frame of a clip before it is rendered."""

    pose: Pose
    look: Look
    camera: Camera
    seed: int

    @property
    def truth(self) -> Truth:
        """What is true of the frame."""
        return truth_of(self.camera, self.pose)

    def image(self) -> np.ndarray:
        """(height, width, 3) uint8 RGB."""
        return render(self.pose, self.look, self.camera, self.seed)[0]


def demo_clip(count: int = 6, camera: Camera | None = None, seed: int = 1) -> list[ClipFrame]:
    """A level descent from 2.0 m, off to the side, to 0.5 m over the pad.

    Altitude falls by the same factor from frame to frame, as it does when the
    descent slows down near the ground; offsets and yaw close in with it.

    Args:
        count: Frames, at least 2.
        camera: The camera; default the 1280 x 720 one.
        seed: Chooses meadow and noise.
    """
    if count < 2:
        raise ValueError(f"a clip needs 2 frames or more, not {count}")
    return [ClipFrame(_between(index / (count - 1)), _LOOK, camera or Camera(), seed) for index in range(count)]


def images(clip: list[ClipFrame]) -> Iterator[np.ndarray]:
    """The clip's frames, rendered one by one."""
    return (frame.image() for frame in clip)


def _between(share: float) -> Pose:
    altitude = _START.altitude_m * (_END.altitude_m / _START.altitude_m) ** share
    # The share of the way down, so that the path over the ground is straight.
    gone = (_START.altitude_m - altitude) / (_START.altitude_m - _END.altitude_m)

    def mix(start: float, end: float) -> float:
        return start + (end - start) * gone

    return Pose(
        altitude_m=round(altitude, 3),
        right_m=mix(_START.right_m, _END.right_m),
        forward_m=mix(_START.forward_m, _END.forward_m),
        pad_yaw_deg=mix(_START.pad_yaw_deg, _END.pad_yaw_deg),
    )

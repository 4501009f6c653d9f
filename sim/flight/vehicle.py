# SPDX-License-Identifier: Apache-2.0
"""A multicopter under its velocity controller: velocities follow with a lag, it leans as it accelerates."""

import math
from dataclasses import dataclass

_G = 9.81
_LAG_S = 0.35
_YAW_LAG_S = 0.15
_LEAN_MAX_RAD = 0.35
GROUND_M = 0.06
"""Height of the camera when the vehicle stands."""


@dataclass
class Vehicle:
    """Where it is and how it moves; the pad lies at the origin, its upper edge to the north.

    Attributes:
        north_m: Place.
        east_m: Place.
        height_m: Camera above the ground.
        heading_rad: Clockwise from north.
        velocity_m_s: North, east, up.
        yaw_rate_rad_s: Clockwise.
        roll_rad: Right side down is positive.
        pitch_rad: Nose up is positive.
    """

    north_m: float = 0.0
    east_m: float = 0.0
    height_m: float = 2.0
    heading_rad: float = 0.0
    velocity_m_s: tuple[float, float, float] = (0.0, 0.0, 0.0)
    yaw_rate_rad_s: float = 0.0
    roll_rad: float = 0.0
    pitch_rad: float = 0.0

    @property
    def stands(self) -> bool:
        """It is on the ground."""
        return self.height_m <= GROUND_M

    def move(
        self, wanted_m_s: tuple[float, float, float], yaw_rate_rad_s: float, wind_m_s2: tuple[float, float], dt_s: float
    ) -> None:
        """Let time pass.

        Args:
            wanted_m_s: Velocity ahead, right, up in the level heading frame.
            yaw_rate_rad_s: Wanted, clockwise.
            wind_m_s2: What gusts add to the acceleration, north and east.
            dt_s: How long.
        """
        cos, sin = math.cos(self.heading_rad), math.sin(self.heading_rad)
        wanted = (
            cos * wanted_m_s[0] - sin * wanted_m_s[1],
            sin * wanted_m_s[0] + cos * wanted_m_s[1],
            wanted_m_s[2],
        )
        own = [(want - now) / _LAG_S for want, now in zip(wanted, self.velocity_m_s, strict=True)]
        gusts = (*wind_m_s2, 0.0)
        self.velocity_m_s = tuple(
            now + (push + gust) * dt_s for now, push, gust in zip(self.velocity_m_s, own, gusts, strict=True)
        )
        self.north_m += self.velocity_m_s[0] * dt_s
        self.east_m += self.velocity_m_s[1] * dt_s
        self.height_m = max(GROUND_M, self.height_m + self.velocity_m_s[2] * dt_s)
        self.yaw_rate_rad_s += (yaw_rate_rad_s - self.yaw_rate_rad_s) / _YAW_LAG_S * dt_s
        self.heading_rad += self.yaw_rate_rad_s * dt_s
        # It accelerates ahead with its nose down, to the right with its right side down.
        self.pitch_rad = _lean(-(cos * own[0] + sin * own[1]))
        self.roll_rad = _lean(-sin * own[0] + cos * own[1])
        if self.stands:
            self.velocity_m_s = (0.0, 0.0, max(0.0, self.velocity_m_s[2]))
            self.yaw_rate_rad_s = self.roll_rad = self.pitch_rad = 0.0


def _lean(acceleration_m_s2: float) -> float:
    return max(-_LEAN_MAX_RAD, min(_LEAN_MAX_RAD, math.atan(acceleration_m_s2 / _G)))

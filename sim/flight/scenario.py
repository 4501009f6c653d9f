# SPDX-License-Identifier: Apache-2.0
"""One flight: board, autopilot, vehicle and pad in a loop, with events on the way."""

import math
from collections.abc import Callable
from dataclasses import dataclass, field

from pymavlink.dialects.v20 import common as mavlink

from firmware.library import AUTOPILOT, GROUND, ROOT
from scripts.landing.model import SOURCE, load
from sim.flight.autopilot import Autopilot
from sim.flight.board import Board, Listener
from sim.flight.sight import objects_of
from sim.flight.vehicle import Vehicle
from sim.world.camera import Camera
from sim.world.pose import Pose, camera_from_level

TICK_US = 5_000
FRAME_US = 33_333


@dataclass
class Sent:
    """A message of the firmware and when it came."""

    time_s: float
    message: mavlink.MAVLink_message

    def __str__(self) -> str:
        return f"{self.time_s:7.2f} {self.message}"


@dataclass
class Flight:
    """A flight in progress; events change its flags.

    Attributes:
        autopilot: With its vehicle.
        board: With the firmware.
        pad_hidden: The camera shows no pad.
        camera_dead: No frames come.
        camera_broken: The frames that come are malformed.
        lidar_dead: The LiDAR gives nothing.
        lidar_factor: What it measures, as a part of the truth.
        wind: Acceleration by gusts at a time in seconds.
        noise: What comes on a link besides what is said, each tick.
        sent: What the firmware sent to the autopilot and to the ground.
        texts: STATUSTEXT to the ground with their times.
        track: Time in s, north, east, height in m and heading in rad, each tick.
    """

    autopilot: Autopilot
    board: Board
    pad_hidden: bool = False
    camera_dead: bool = False
    camera_broken: bool = False
    lidar_dead: bool = False
    lidar_factor: float = 1.0
    wind: Callable[[float], tuple[float, float]] = lambda _time_s: (0.0, 0.0)
    noise: Callable[[int], bytes] = lambda _link: b""
    sent: dict[int, list[Sent]] = field(default_factory=lambda: {AUTOPILOT: [], GROUND: []})
    texts: list[tuple[float, str]] = field(default_factory=list)
    track: list[tuple[float, float, float, float, float]] = field(default_factory=list)

    def __post_init__(self) -> None:
        self.camera = Camera()
        self.now_us = 0
        self._ground = mavlink.MAVLink(None, srcSystem=255, srcComponent=190)
        self._listeners = {AUTOPILOT: Listener(), GROUND: Listener()}

    @property
    def time_s(self) -> float:
        """Time since power-up."""
        return self.now_us / 1e6

    @property
    def phases(self) -> list[tuple[float, str]]:
        """When each phase began, and its name, by what was said of it."""
        rules = load(ROOT / SOURCE).rules
        phases = [(0.0, "STANDBY")]
        for time_s, text in self.texts:
            to = [r.to for r in rules if f"Touchdown: {r.reason}" == text and phases[-1][1] in r.sources]
            if to and to[0] != phases[-1][1]:
                phases.append((time_s, to[0]))
        return phases

    @property
    def vehicle(self) -> Vehicle:
        """What flies."""
        return self.autopilot.vehicle

    def command(self, command: int, param1: float = 0.0) -> None:
        """The ground sends a COMMAND_LONG to the firmware."""
        self.from_ground(mavlink.MAVLink_command_long_message(1, 191, command, 0, param1, 0, 0, 0, 0, 0, 0))

    def from_ground(self, message: mavlink.MAVLink_message) -> None:
        """The ground sends a message."""
        self.board.say(GROUND, bytes(message.pack(self._ground)))

    def switch(self, on: bool) -> None:
        """The pilot moves the switch of channel 8."""
        self.autopilot.rc_us[7] = 2000 if on else 1000

    def run(self, until_s: float, stop: Callable[["Flight"], bool] = lambda _flight: False) -> bool:
        """Fly until a time, or until `stop` holds; returns whether it held."""
        while self.time_s < until_s:
            self._tick()
            if stop(self):
                return True
        return False

    def run_to(self, text: str, within_s: float = 60.0) -> float:
        """Fly until the ground reads a text; returns when.

        Raises:
            AssertionError: it does not come in time.
        """
        start = len(self.texts)
        if not self.run(self.time_s + within_s, lambda flight: any(text in said for _, said in flight.texts[start:])):
            raise AssertionError(f"no '{text}' within {within_s} s; the ground read {self.texts[start:]}")
        return self.time_s

    def _tick(self) -> None:
        self.now_us += TICK_US
        self.autopilot.fly(self.now_us, TICK_US / 1e6, self.wind(self.time_s))
        self.board.say(AUTOPILOT, self.autopilot.say(self.now_us))
        for link in (AUTOPILOT, GROUND):
            self.board.say(link, self.noise(link))
        if self.now_us // FRAME_US != (self.now_us - TICK_US) // FRAME_US and not self.camera_dead:
            self._frame()
        self._pass_on(self.board.run_to(self.now_us, None if self.lidar_dead else round(1000 * self._lidar_m())))
        vehicle = self.vehicle
        heading_rad = math.remainder(vehicle.heading_rad, math.tau)
        self.track.append((self.time_s, vehicle.north_m, vehicle.east_m, vehicle.height_m, heading_rad))

    def _pose(self) -> Pose:
        vehicle = self.vehicle
        cos, sin = math.cos(vehicle.heading_rad), math.sin(vehicle.heading_rad)
        return Pose(
            altitude_m=vehicle.height_m,
            right_m=sin * vehicle.north_m - cos * vehicle.east_m,
            forward_m=-cos * vehicle.north_m - sin * vehicle.east_m,
            pad_yaw_deg=-math.degrees(vehicle.heading_rad),
            roll_deg=math.degrees(vehicle.roll_rad),
            pitch_deg=math.degrees(vehicle.pitch_rad),
        )

    def _lidar_m(self) -> float:
        return self.lidar_factor * self.vehicle.height_m / float(camera_from_level(self._pose())[2, 2])

    def _frame(self) -> None:
        if self.camera_broken:
            self.board.show(None)
            return
        objects = objects_of(self.camera, self._pose(), self.board.min_area_px)
        self.board.show(objects[:0] if self.pad_hidden else objects)

    def _pass_on(self, sent: dict[int, bytes]) -> None:
        for link, data in sent.items():
            messages = self._listeners[link].hear(data)
            self.sent[link] += [Sent(self.time_s, message) for message in messages]
            if link == GROUND:
                self.texts += [(self.time_s, m.text) for m in messages if m.get_type() == "STATUSTEXT"]
            elif data:
                self.board.say(AUTOPILOT, self.autopilot.hear(data, self.now_us))

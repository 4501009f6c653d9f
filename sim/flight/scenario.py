# SPDX-License-Identifier: Apache-2.0
"""One flight: firmware, autopilot, vehicle and pad in a loop, with events on the way."""

import math
from collections.abc import Callable
from dataclasses import dataclass, field

from pymavlink.dialects.v20 import common as mavlink

from firmware.library import AUTOPILOT, GROUND, ROOT, Firmware, decode
from golden import result_writer
from scripts.landing.model import SOURCE, load
from sim.flight.autopilot import Autopilot
from sim.flight.sight import objects_of
from sim.flight.vehicle import Vehicle
from sim.world.camera import Camera
from sim.world.pose import Pose, camera_from_level

TICK_US = 5_000
FRAME_US = 33_333
_SIZE = (1280, 720)


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
        pad_hidden: The camera shows no pad.
        camera_dead: No records come.
        lidar_dead: The LiDAR gives nothing.
        lidar_factor: What it measures, as a part of the truth.
        wind: Acceleration by gusts at a time in seconds.
        sent: What the firmware sent to the autopilot and to the ground.
        texts: STATUSTEXT to the ground with their times.
        track: Time in s, north, east, height in m and heading in rad, each tick.
    """

    autopilot: Autopilot
    pad_hidden: bool = False
    camera_dead: bool = False
    lidar_dead: bool = False
    lidar_factor: float = 1.0
    wind: Callable[[float], tuple[float, float]] = lambda _time_s: (0.0, 0.0)
    sent: dict[int, list[Sent]] = field(default_factory=lambda: {AUTOPILOT: [], GROUND: []})
    texts: list[tuple[float, str]] = field(default_factory=list)
    track: list[tuple[float, float, float, float, float]] = field(default_factory=list)

    def __post_init__(self) -> None:
        self.firmware = Firmware()
        self.camera = Camera()
        self.now_us = 0
        self._frames = 0
        self._ground = mavlink.MAVLink(None, srcSystem=255, srcComponent=190)
        self._factor_before = self.firmware.factor

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
        self.firmware.on_bytes(GROUND, bytes(message.pack(self._ground)), self.now_us)

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
        self.firmware.on_bytes(AUTOPILOT, self.autopilot.say(self.now_us), self.now_us)
        if self.now_us // FRAME_US != (self.now_us - TICK_US) // FRAME_US and not self.camera_dead:
            self._frame()
        lidar_m = self._lidar_m()
        self.firmware.tick(self.now_us, None if self.lidar_dead else round(1000 * lidar_m))
        self._pass_on()
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
        self._frames += 1
        objects = objects_of(self.camera, self._pose(), self.firmware.min_area_px)
        record = result_writer.record(
            {
                "frame_number": self._frames,
                "start_time_us": self.now_us - 16_500,
                "scan_time_us": 16_072,
                "altitude_mm": 0 if self.lidar_dead else round(1000 * self._lidar_m()),
                "altitude_valid": int(not self.lidar_dead),
                "frame_size_width": _SIZE[0],
                "frame_size_height": _SIZE[1],
                "threshold_factor": self._factor_before,
                "min_area": self.firmware.min_area_px,
            },
            objects[:0] if self.pad_hidden else objects,
        )
        self._factor_before = self.firmware.factor
        error = self.firmware.on_record(record, self.now_us)
        assert error == 0, f"the firmware refuses a record with {error}"

    def _pass_on(self) -> None:
        for link in (AUTOPILOT, GROUND):
            data = bytes(self.firmware.sent[link])
            self.firmware.sent[link].clear()
            messages = decode(data) if data else []
            self.sent[link] += [Sent(self.time_s, message) for message in messages]
            if link == GROUND:
                self.texts += [(self.time_s, m.text) for m in messages if m.get_type() == "STATUSTEXT"]
            elif data:
                answers = self.autopilot.hear(data, self.now_us)
                self.firmware.on_bytes(AUTOPILOT, answers, self.now_us)

# SPDX-License-Identifier: Apache-2.0
"""Steps that the tests of whole flights are made of: hover, get to a phase, look at what was commanded."""

import pytest
from pymavlink.dialects.v20 import common as mavlink

from firmware.library import AUTOPILOT
from sim.flight.autopilot import ARDUPILOT, PX4, Autopilot
from sim.flight.board import Board
from sim.flight.scenario import Flight
from sim.flight.vehicle import Vehicle

PROFILES = (ARDUPILOT, PX4)
ABORT = mavlink.MAV_CMD_DO_GO_AROUND
LAND = mavlink.MAV_CMD_NAV_LAND
PAUSE_CONTINUE = mavlink.MAV_CMD_DO_PAUSE_CONTINUE
SAY_LOG = mavlink.MAV_CMD_USER_1
PHASES = {
    "ENGAGE": "start",
    "CENTRE": "pad seen",
    "DESCEND": "pad below",
    "ALIGN": "low enough to turn",
    "LAND": "aligned",
}
"""What the ground reads when a phase of a normal landing begins."""
SAID_S = 0.25
"""In which a STATUSTEXT is on its way to the ground at 57600 baud, behind what was said before."""
elf = pytest.mark.elf


def hover(
    board: Board, profile: str = ARDUPILOT, slow_heartbeat: bool = False, powered_s: float = 2.5, **where: float
) -> Flight:
    """A flight that hovers near the pad, powered up some time ago."""
    vehicle = Vehicle(**({"north_m": -0.4, "east_m": 0.3, "height_m": 1.6} | where))
    flight = Flight(Autopilot(profile, vehicle, slow_heartbeat=slow_heartbeat), board)
    flight.run(powered_s)
    return flight


def to_phase(flight: Flight, phase: str) -> None:
    """Start, and fly on until a phase has just begun."""
    flight.switch(True)
    for name, text in PHASES.items():
        flight.run_to(text)
        if name == phase:
            return
    raise AssertionError(f"no phase {phase}")


def commands_after(flight: Flight, time_s: float) -> list[str]:
    """Types of what could move the vehicle, sent to the autopilot after a time."""
    moving = ("SET_POSITION_TARGET_LOCAL_NED", "COMMAND_LONG")
    return [
        str(sent)
        for sent in flight.sent[AUTOPILOT]
        if sent.time_s > time_s
        and sent.message.get_type() in moving
        and getattr(sent.message, "command", 0) != mavlink.MAV_CMD_SET_MESSAGE_INTERVAL
    ]


def assert_lets_go(flight: Flight, seconds: float = 3.0) -> None:
    """From now on nothing is commanded."""
    since = flight.time_s
    flight.run(since + seconds)
    assert commands_after(flight, since) == []


def velocities(flight: Flight, time_s: float) -> list[mavlink.MAVLink_message]:
    """Setpoints after a time."""
    return [
        sent.message
        for sent in flight.sent[AUTOPILOT]
        if sent.time_s > time_s and sent.message.get_type() == "SET_POSITION_TARGET_LOCAL_NED"
    ]

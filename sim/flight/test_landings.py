# SPDX-License-Identifier: Apache-2.0
"""Whole landings; `conftest.py` says with which firmware."""

import math
import random

import pytest
from pymavlink.dialects.v20 import common as mavlink

from firmware.library import AUTOPILOT
from sim.flight.autopilot import ARDUPILOT, PX4
from sim.flight.board import Board
from sim.flight.steps import (
    LAND,
    PROFILES,
    assert_lets_go,
    elf,
    hover,
    to_phase,
    velocities,
)


@pytest.mark.parametrize("profile", [pytest.param(ARDUPILOT, marks=elf), PX4])
def test_normal_landing_to_motors_off(profile: str, board: Board) -> None:
    flight = hover(board, profile, heading_rad=0.6)
    flight.switch(True)
    flight.run_to("down, motors off", 90)
    vehicle = flight.vehicle
    assert [text for _, text in flight.texts] == [
        f"Touchdown: {text}"
        for text in (
            "started",
            "start",
            "steering",
            "pad seen",
            "pad below",
            "low enough to turn",
            "aligned",
            "touched down",
            "down, motors off",
        )
    ]
    assert not flight.autopilot.armed
    assert vehicle.stands
    assert math.hypot(vehicle.north_m, vehicle.east_m) < 0.1
    assert abs(math.degrees(vehicle.heading_rad)) < 5
    assert_lets_go(flight)


@pytest.mark.parametrize("start_m", [0.9, 2.6])
def test_phase_1_is_at_the_search_height_wherever_it_starts(start_m: float, board: Board) -> None:
    """With the pad in sight from the beginning."""
    flight = hover(board, height_m=start_m, north_m=-0.2, east_m=0.1)
    to_phase(flight, "CENTRE")
    assert abs(flight.vehicle.height_m - start_m) < 0.1
    flight.run_to("pad below", 30)
    assert 1.55 < flight.vehicle.height_m < 2.05
    flight.run_to("down, motors off", 60)


@pytest.mark.parametrize("profile", PROFILES)
def test_landing_with_a_heartbeat_once_a_second(profile: str, board: Board) -> None:
    """It stands still while it waits for the word of a mode; a PX4 without setpoints would fall out of OFFBOARD."""
    flight = hover(board, profile, slow_heartbeat=True)
    flight.switch(True)
    flight.run_to("down, motors off", 90)
    assert not any("WAIT" in phase or "GIVE_UP" in phase for _, phase in flight.phases)
    modes = [s for s in flight.sent[AUTOPILOT] if getattr(s.message, "command", 0) == mavlink.MAV_CMD_DO_SET_MODE]
    assert len(modes) == 2
    beats = [
        s
        for s in flight.sent[AUTOPILOT]
        if getattr(s.message, "command", 0) == mavlink.MAV_CMD_SET_MESSAGE_INTERVAL
        and s.message.param1 == mavlink.MAVLINK_MSG_ID_HEARTBEAT
    ]
    assert len(beats) == 5


def test_landing_in_gusts(board: Board) -> None:
    flight = hover(board, ARDUPILOT, heading_rad=-2.0)
    random.seed(7)
    gusts = [(random.gauss(0, 0.5), random.gauss(0, 0.5)) for _ in range(200)]
    flight.wind = lambda time_s: gusts[int(2 * time_s) % len(gusts)]
    flight.command(LAND)
    flight.run_to("down, motors off", 90)
    assert math.hypot(flight.vehicle.north_m, flight.vehicle.east_m) < 0.25


def test_every_velocity_is_within_the_limits_and_none_comes_without_a_phase(board: Board) -> None:
    flight = hover(board, north_m=-1.0, east_m=1.0)
    before = flight.time_s
    assert velocities(flight, 0.0) == []
    to_phase(flight, "LAND")
    speeds = [math.hypot(v.vx, v.vy) for v in velocities(flight, before)]
    assert 0.3 < max(speeds) <= 0.501
    assert max(abs(v.vz) for v in velocities(flight, before)) <= 0.41
    assert len(speeds) > 20 * (flight.time_s - before)


def test_motors_that_stay_on_after_touchdown(board: Board) -> None:
    flight = hover(board)
    flight.autopilot.sticky = True
    to_phase(flight, "LAND")
    flight.run_to("touched down", 20)
    touched_s = flight.time_s
    flight.run_to("down, motors off", 8)
    assert flight.time_s - touched_s > 5.0

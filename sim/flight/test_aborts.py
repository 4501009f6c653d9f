# SPDX-License-Identifier: Apache-2.0
"""The pilot takes over, or the landing is called off, in every phase."""

import itertools
import math

import pytest
from pymavlink.dialects.v20 import common as mavlink

from sim.flight.autopilot import ARDUPILOT, PX4
from sim.flight.board import Board
from sim.flight.scenario import Flight
from sim.flight.steps import (
    ABORT,
    PAUSE_CONTINUE,
    PHASES,
    PROFILES,
    SAID_S,
    assert_lets_go,
    commands_after,
    elf,
    hover,
    to_phase,
    velocities,
)


def to_search(flight: Flight) -> None:
    """Look for a pad that is not seen."""
    flight.pad_hidden = True
    flight.switch(True)
    flight.run_to("steering")


def to_hold(flight: Flight) -> None:
    """Be held on the way to the pad."""
    to_phase(flight, "CENTRE")
    flight.command(PAUSE_CONTINUE, 0)
    flight.run_to("held by the ground", SAID_S)


def to_wait(flight: Flight) -> None:
    """Lose the pad."""
    to_phase(flight, "CENTRE")
    flight.pad_hidden = True
    flight.run_to("pad lost", 1)


def to_climb(flight: Flight) -> None:
    """Lose the pad for so long that it climbs."""
    to_wait(flight)
    flight.run_to("pad still lost", 5)


ASIDE = {"SEARCH": to_search, "HOLD": to_hold, "WAIT": to_wait, "CLIMB": to_climb}
"""Phases of a landing that is not normal, and how to get there."""


def assert_aborts(flight: Flight, by: str, seconds: float = 3.0) -> None:
    """Told to, it hands the vehicle back, and for so long commands nothing."""
    told_s = flight.time_s
    if by == "switch":
        flight.switch(False)
    else:
        flight.command(ABORT)
    flight.run_to("aborted", 0.3 + SAID_S)
    assert [v for v in velocities(flight, told_s + 0.3) if v.vx or v.vy or v.vz or v.yaw_rate] == []
    flight.run_to("handed back to the autopilot", 2)
    assert flight.autopilot.mode == "hold"
    assert_lets_go(flight, seconds)


@pytest.mark.parametrize(
    ("phase", "profile"),
    [
        pytest.param(*each, marks=elf if each in (("CENTRE", ARDUPILOT), ("LAND", PX4)) else ())
        for each in itertools.product(PHASES, PROFILES)
    ],
)
def test_pilot_takes_over(phase: str, profile: str, board: Board) -> None:
    """Let go at once, whatever the phase."""
    flight = hover(board, profile)
    to_phase(flight, phase)
    flight.run(flight.time_s + 0.5)
    flight.autopilot.mode = "rtl"
    flight.run_to("mode taken by pilot or failsafe", 0.2 + SAID_S)
    assert_lets_go(flight)
    assert flight.autopilot.told == "rtl"
    assert commands_after(flight, flight.autopilot.told_us / 1e6 + 0.02) == []
    assert flight.autopilot.mode == "rtl"


@pytest.mark.parametrize("slow", [False, True])
@pytest.mark.parametrize("profile", PROFILES)
def test_pilot_takes_over_unheard_of_just_before_the_pad_is_lost(profile: str, slow: bool, board: Board) -> None:
    """His mode is never asked away, whatever is wanted between two HEARTBEATs."""
    flight = hover(board, profile, slow)
    to_phase(flight, "LAND")
    assert flight.run(flight.time_s + 2.5, lambda flying: flying.autopilot.told == "land")
    told_s = flight.time_s
    flight.run(told_s + 0.05)
    flight.pad_hidden = True
    # He does so after the last HEARTBEAT before 0.5 s have passed without a pad.
    flight.run(told_s + (0.055 if slow else 0.405))
    flight.autopilot.mode = "loiter"
    since = flight.time_s
    flight.run_to("pad lost", 0.5 + SAID_S)
    flight.run_to("mode taken by pilot or failsafe", 1.1)
    assert_lets_go(flight)
    assert [row for row in commands_after(flight, since) if "COMMAND_LONG" in row] == []
    assert flight.autopilot.mode == "loiter"


@pytest.mark.parametrize("by", ["switch", pytest.param("command", marks=elf)])
@pytest.mark.parametrize("phase", PHASES)
def test_abort(phase: str, by: str, board: Board) -> None:
    """The autopilot's own hold is asked for, then nothing any more."""
    flight = hover(board)
    to_phase(flight, phase)
    assert_aborts(flight, by)


@pytest.mark.parametrize("by", ["switch", pytest.param("command", marks=elf)])
@pytest.mark.parametrize("phase", ASIDE)
def test_abort_aside_from_the_normal_landing(phase: str, by: str, board: Board) -> None:
    # So low that it still climbs when it is told.
    flight = hover(board, powered_s=1.0, height_m=1.0)
    ASIDE[phase](flight)
    assert flight.phases[-1][1] == phase
    assert_aborts(flight, by, 1.5)


@pytest.mark.parametrize("by", ["switch", pytest.param("command", marks=elf)])
def test_abort_on_the_ground_leaves_the_autopilot_alone(by: str, board: Board) -> None:
    flight = hover(board, powered_s=1.0, north_m=-0.1, east_m=0.1, height_m=0.5)
    flight.autopilot.sticky = True
    to_phase(flight, "CENTRE")
    # The shortest way down.
    flight.autopilot.battery_percent = 10
    flight.autopilot.next_us[mavlink.MAVLINK_MSG_ID_SYS_STATUS] = 0
    flight.run_to("battery low: lands at once", 2)
    flight.run_to("touched down", 10)
    if by == "switch":
        flight.switch(False)
    else:
        flight.command(ABORT)
    flight.run_to("aborted on the ground", 0.1 + SAID_S)
    assert_lets_go(flight, 1.5)
    assert flight.autopilot.mode == "land"


@pytest.mark.parametrize("profile", PROFILES)
@pytest.mark.parametrize("phase", ["CENTRE", "DESCEND", "ALIGN"])
def test_abort_with_an_autopilot_that_does_not_hold(phase: str, profile: str, board: Board) -> None:
    """It is stopped, not left to the last velocity."""
    flight = hover(board, profile, north_m=-0.8, east_m=0.6)
    to_phase(flight, phase)
    flight.run(flight.time_s + 0.8)
    flight.autopilot.deaf = True
    vehicle = flight.vehicle
    north_m, east_m, height_m = vehicle.north_m, vehicle.east_m, vehicle.height_m
    flight.command(ABORT)
    flight.run_to("autopilot refuses to hold: take over", 5)
    assert_lets_go(flight)
    assert math.hypot(vehicle.north_m - north_m, vehicle.east_m - east_m) < 0.3
    assert abs(vehicle.height_m - height_m) < 0.2


def test_abort_while_the_autopilot_lands_sends_it_no_velocity(board: Board) -> None:
    """It may not hear them there, and lands on until it holds."""
    flight = hover(board)
    to_phase(flight, "LAND")
    flight.run(flight.time_s + 0.5)
    flight.autopilot.deaf = True
    told_s = flight.time_s
    flight.command(ABORT)
    flight.run_to("autopilot refuses to hold: take over", 5)
    assert velocities(flight, told_s) == []


def test_autopilot_that_does_not_land_stands_still(board: Board) -> None:
    flight = hover(board)
    to_phase(flight, "DESCEND")
    flight.run(flight.time_s + 0.8)
    flight.autopilot.deaf = True
    flight.autopilot.battery_percent = 10
    flight.run_to("battery low: lands at once", 2)
    height_m = flight.vehicle.height_m
    flight.run_to("autopilot refuses a mode", 5)
    flight.run_to("autopilot refuses to hold: take over", 5)
    assert abs(flight.vehicle.height_m - height_m) < 0.2

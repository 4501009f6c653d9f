# SPDX-License-Identifier: Apache-2.0
"""Each failure on the way, and what keeps a landing from being started."""

import math
import random
from collections.abc import Callable

import pytest
from pymavlink.dialects.v20 import common as mavlink

from firmware.library import AUTOPILOT
from sim.flight.autopilot import ARDUPILOT, PX4, Autopilot
from sim.flight.board import Board
from sim.flight.scenario import Flight
from sim.flight.steps import LAND, SAID_S, assert_lets_go, elf, hover, to_phase, velocities
from sim.flight.vehicle import Vehicle

Change = Callable[[Flight], None]


def _set(**values: object) -> Change:
    def change(flight: Flight) -> None:
        for name, value in values.items():
            setattr(flight if hasattr(flight, name) else flight.autopilot, name, value)

    return change


MISSING = {
    "pad": (_set(pad_hidden=True), _set(pad_hidden=False), "pad lost"),
    "camera": (_set(camera_dead=True), _set(camera_dead=False), "no frames"),
    "whole frames": (_set(camera_broken=True), _set(camera_broken=False), "no frames"),
    "lidar": (_set(lidar_dead=True), _set(lidar_dead=False), "LiDAR gives nothing"),
    "lidar wrong": (_set(lidar_factor=0.4), _set(lidar_factor=1.0), "LiDAR contradicts the pad's size"),
    "attitude": (_set(no_attitude=True), _set(no_attitude=False), "no ATTITUDE from autopilot"),
}


@pytest.mark.parametrize("missing", MISSING)
@pytest.mark.parametrize("phase", ["CENTRE", "ALIGN"])
def test_what_is_missing_for_a_while(phase: str, missing: str, board: Board) -> None:
    """It stands still, and lands when it is back."""
    lose, find, text = MISSING[missing]
    flight = hover(board)
    to_phase(flight, phase)
    lose(flight)
    flight.run_to(text, 2.0)
    since = flight.time_s
    flight.run(since + 1.0)
    assert all(v.vx == v.vy == v.vz == v.yaw_rate == 0.0 for v in velocities(flight, since))
    assert velocities(flight, since)
    find(flight)
    flight.run_to("pad seen again", 2.0)
    flight.run_to("down, motors off", 60)


@pytest.mark.parametrize(
    ("missing", "text"),
    [
        ("camera", "still no frames"),
        pytest.param("whole frames", "still no frames", marks=elf),
        pytest.param("lidar", "LiDAR still gives nothing", marks=elf),
        pytest.param("lidar wrong", "LiDAR still contradicts", marks=elf),
        ("attitude", "still no ATTITUDE"),
    ],
)
def test_what_stays_missing_ends_the_landing(missing: str, text: str, board: Board) -> None:
    flight = hover(board)
    to_phase(flight, "DESCEND")
    # Nearer, where the pad leaves so little doubt that it is still seen when the LiDAR adds its own.
    flight.run(flight.time_s + 2.5)
    MISSING[missing][0](flight)
    flight.run_to(text, 8.0)
    flight.run_to("handed back to the autopilot", 3.0)
    assert flight.autopilot.mode == "hold"
    assert_lets_go(flight)


@elf
def test_pad_that_stays_lost_is_looked_for_from_higher_up(board: Board) -> None:
    flight = hover(board)
    to_phase(flight, "ALIGN")
    flight.pad_hidden = True
    flight.run_to("pad lost", 2)
    low_m = flight.vehicle.height_m
    flight.run_to("pad still lost", 6)
    flight.run_to("high enough to search", 12)
    assert flight.vehicle.height_m > low_m + 0.5
    flight.run_to("no pad found", 45)
    flight.run_to("handed back to the autopilot", 3)
    assert math.hypot(flight.vehicle.north_m, flight.vehicle.east_m) < 3.5
    assert_lets_go(flight)


def test_pad_that_is_lost_again_and_again(board: Board) -> None:
    flight = hover(board)
    to_phase(flight, "CENTRE")
    for _ in range(3):
        flight.pad_hidden = True
        flight.run_to("pad lost", 2)
        flight.pad_hidden = False
        flight.run_to("pad seen again", 2)
    flight.pad_hidden = True
    flight.run_to("pad lost too often", 2)
    flight.run_to("handed back to the autopilot", 3)


def test_pad_lost_while_the_autopilot_lands(board: Board) -> None:
    """High enough it turns back; below TD_COMMIT_M it goes on."""
    flight = hover(board)
    to_phase(flight, "LAND")
    flight.run(flight.time_s + 0.5)
    flight.pad_hidden = True
    flight.run_to("pad lost", 1)
    flight.run(flight.time_s + 0.5)
    assert flight.autopilot.mode == "steer"
    flight.pad_hidden = False
    flight.run_to("aligned", 30)
    flight.run(flight.time_s + 20, lambda flying: flying.vehicle.height_m < 0.35)
    flight.pad_hidden = True
    flight.run_to("down, motors off", 10)
    assert math.hypot(flight.vehicle.north_m, flight.vehicle.east_m) < 0.15


@elf
def test_autopilot_falls_silent(board: Board) -> None:
    flight = hover(board)
    to_phase(flight, "DESCEND")
    flight.autopilot.silent = True
    flight.run_to("autopilot is silent", 4)
    assert_lets_go(flight)


@pytest.mark.parametrize(
    ("how", "profile"),
    [
        pytest.param("refuses", ARDUPILOT, marks=elf),
        ("refuses", PX4),
        ("deaf", ARDUPILOT),
        ("deaf", PX4),
    ],
)
def test_autopilot_does_not_let_itself_be_steered(how: str, profile: str, board: Board) -> None:
    flight = hover(board, profile)
    setattr(flight.autopilot, how, True)
    flight.switch(True)
    flight.run_to("autopilot refuses to be steered", 5)
    assert_lets_go(flight)
    assert flight.autopilot.mode == "loiter"


@elf
def test_autopilot_refuses_to_land_and_then_to_hold(board: Board) -> None:
    flight = hover(board)
    to_phase(flight, "ALIGN")
    flight.autopilot.refuses = True
    flight.run_to("autopilot refuses a mode", 20)
    flight.run_to("autopilot refuses to hold: take over", 5)
    assert_lets_go(flight)


@pytest.mark.parametrize("phase", [pytest.param("CENTRE", marks=elf), "DESCEND", "ALIGN"])
def test_low_battery_with_the_pad_in_sight(phase: str, board: Board) -> None:
    flight = hover(board)
    to_phase(flight, phase)
    flight.autopilot.battery_percent = 10
    flight.run_to("battery low: lands at once", 2)
    flight.run_to("down, motors off", 30)


def test_low_battery_without_a_pad(board: Board) -> None:
    flight = hover(board)
    flight.pad_hidden = True
    flight.switch(True)
    flight.run_to("steering", 3)
    flight.autopilot.battery_percent = 10
    flight.run_to("battery low and no pad in sight", 2)
    flight.run_to("handed back to the autopilot", 3)


@pytest.mark.parametrize(
    ("change", "text"),
    [
        pytest.param(_set(battery_percent=5), "no start: battery is low", marks=elf),
        (_set(camera_dead=True), "no start: no frames"),
        (_set(lidar_dead=True), "no start: LiDAR gives nothing"),
        (_set(no_attitude=True), "no start: no ATTITUDE from autopilot"),
        (_set(armed=False), "no start: motors are off"),
        (_set(silent=True), "no start: autopilot is silent"),
    ],
)
def test_no_start(change: Change, text: str, board: Board) -> None:
    flight = hover(board)
    change(flight)
    flight.run(flight.time_s + 4)
    flight.command(LAND)
    flight.run_to(text, SAID_S)
    assert_lets_go(flight)


@elf
def test_garbage_on_both_wires_changes_nothing(board: Board) -> None:
    flight = hover(board)
    chance = random.Random(3)
    flight.noise = lambda _link: chance.randbytes(chance.randrange(40))
    to_phase(flight, "LAND")
    flight.run_to("down, motors off", 30)


def test_message_intervals_are_asked_for_until_they_come(board: Board) -> None:
    flight = Flight(Autopilot(ARDUPILOT, Vehicle()), board)
    hear = flight.autopilot.hear
    flight.autopilot.hear = lambda _data, _now_us: b""
    flight.run(4.0)
    asked = [sent for sent in flight.sent[AUTOPILOT] if sent.message.get_type() == "COMMAND_LONG"]
    attitude = [sent for sent in asked if sent.message.param1 == mavlink.MAVLINK_MSG_ID_ATTITUDE]
    assert len(attitude) >= 3
    flight.autopilot.hear = hear
    flight.run(6.0)
    since = flight.time_s
    flight.run(8.0)
    assert not [s for s in flight.sent[AUTOPILOT] if s.time_s > since and s.message.get_type() == "COMMAND_LONG"]

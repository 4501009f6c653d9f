# SPDX-License-Identifier: Apache-2.0
"""Whole landings and each failure on the way; `conftest.py` says with which firmware."""

import itertools
import math
import random
from collections.abc import Callable

import pytest
from pymavlink.dialects.v20 import common as mavlink

from firmware.library import AUTOPILOT, GROUND
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


def velocities(flight: Flight, time_s: float) -> list[mavlink.MAVLink_message]:
    """Setpoints after a time."""
    return [
        sent.message
        for sent in flight.sent[AUTOPILOT]
        if sent.time_s > time_s and sent.message.get_type() == "SET_POSITION_TARGET_LOCAL_NED"
    ]


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


@elf
def test_ground_link_lost(board: Board) -> None:
    """It counts only where the ground said that it is needed."""
    flight = hover(board)
    heartbeat = mavlink.MAVLink_heartbeat_message(mavlink.MAV_TYPE_GCS, 8, 0, 0, 4, 3)
    name = b"TD_GCS_NEEDED"
    flight.from_ground(mavlink.MAVLink_param_set_message(1, 191, name, 1.0, mavlink.MAV_PARAM_TYPE_REAL32))
    flight.from_ground(heartbeat)
    to_phase(flight, "CENTRE")
    flight.run_to("ground station lost", 6)
    flight.run_to("handed back to the autopilot", 3)


@elf
def test_hold_and_go_on(board: Board) -> None:
    flight = hover(board)
    to_phase(flight, "DESCEND")
    flight.command(PAUSE_CONTINUE, 0)
    flight.run_to("held by the ground", SAID_S)
    since = flight.time_s
    flight.run(since + 2)
    assert all(v.vx == v.vy == v.vz == v.yaw_rate == 0.0 for v in velocities(flight, since))
    flight.command(PAUSE_CONTINUE, 1)
    flight.run_to("goes on", SAID_S)
    flight.run_to("down, motors off", 60)


def test_hold_as_soon_as_it_starts_and_a_start_that_is_sent_again(board: Board) -> None:
    flight = hover(board)
    flight.command(LAND)
    flight.run_to("start", SAID_S)
    flight.command(LAND)
    flight.command(PAUSE_CONTINUE, 0)
    flight.run_to("held by the ground", SAID_S)
    since = flight.time_s
    flight.run(since + 1)
    assert flight.autopilot.mode == "steer"
    assert all(v.vx == v.vy == v.vz == v.yaw_rate == 0.0 for v in velocities(flight, 0))
    flight.command(LAND)
    flight.command(PAUSE_CONTINUE, 1)
    flight.run_to("goes on", SAID_S)
    flight.run_to("pad seen", 1)
    answers = [sent.message for sent in flight.sent[GROUND] if sent.message.get_type() == "COMMAND_ACK"]
    assert [(answer.command, answer.result) for answer in answers] == [
        (LAND, mavlink.MAV_RESULT_ACCEPTED),
        (LAND, mavlink.MAV_RESULT_ACCEPTED),
        (PAUSE_CONTINUE, mavlink.MAV_RESULT_ACCEPTED),
        (LAND, mavlink.MAV_RESULT_TEMPORARILY_REJECTED),
        (PAUSE_CONTINUE, mavlink.MAV_RESULT_ACCEPTED),
    ]
    assert [text for _, text in flight.texts].count("Touchdown: start") == 1


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


def test_switch_that_is_on_at_power_up_starts_nothing(board: Board) -> None:
    flight = Flight(Autopilot(ARDUPILOT, Vehicle()), board)
    flight.switch(True)
    flight.run(5.0)
    assert not any("start" in text for _, text in flight.texts[1:])
    flight.switch(False)
    flight.run(6.0)
    flight.switch(True)
    flight.run_to("start", 1)


def test_motors_that_stay_on_after_touchdown(board: Board) -> None:
    flight = hover(board)
    flight.autopilot.sticky = True
    to_phase(flight, "LAND")
    flight.run_to("touched down", 20)
    touched_s = flight.time_s
    flight.run_to("down, motors off", 8)
    assert flight.time_s - touched_s > 5.0


@elf
def test_garbage_on_both_wires_changes_nothing(board: Board) -> None:
    flight = hover(board)
    chance = random.Random(3)
    flight.noise = lambda _link: chance.randbytes(chance.randrange(40))
    to_phase(flight, "LAND")
    flight.run_to("down, motors off", 30)


def test_log_of_phases_is_said_when_asked_for(board: Board) -> None:
    flight = hover(board)
    to_phase(flight, "CENTRE")
    flight.command(ABORT)
    flight.run_to("handed back", 3)
    seen = len(flight.texts)
    flight.command(SAY_LOG)
    flight.run(flight.time_s + 1)
    rows = [text.split(" ", 1)[1] for _, text in flight.texts[seen:]]
    assert rows == [
        "STANDBY>ENGAGE: start",
        "ENGAGE>SEARCH: steering",
        "SEARCH>CENTRE: pad seen",
        "CENTRE>GIVE_UP: aborted",
        "GIVE_UP>STANDBY: handed back to the autopilot",
    ]
    seen = len(flight.texts)
    flight.command(LAND)
    flight.run(flight.time_s + SAID_S)
    assert [text for _, text in flight.texts[seen:]] == ["Touchdown: start"]


def test_parameters_as_a_ground_station_sees_them(board: Board) -> None:
    flight = hover(board)
    flight.from_ground(mavlink.MAVLink_param_request_list_message(1, 191))
    flight.run(flight.time_s + 2)
    values = [sent.message for sent in flight.sent[GROUND] if sent.message.get_type() == "PARAM_VALUE"]
    assert [value.param_index for value in values] == list(range(values[0].param_count))
    assert len({value.param_id for value in values}) == len(values)

    def set_speed(value: float) -> float:
        kind = mavlink.MAV_PARAM_TYPE_REAL32
        flight.from_ground(mavlink.MAVLink_param_set_message(1, 191, b"TD_SPEED", value, kind))
        flight.run(flight.time_s + SAID_S)
        answers = [sent.message for sent in flight.sent[GROUND] if sent.message.get_type() == "PARAM_VALUE"]
        return answers[-1].param_value

    assert set_speed(0.25) == 0.25
    assert set_speed(25.0) == 0.25
    assert set_speed(math.nan) == 0.25


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

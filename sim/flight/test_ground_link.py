# SPDX-License-Identifier: Apache-2.0
"""What the ground is told, and what it can ask for besides a landing and its end."""

import math

from pymavlink.dialects.v20 import common as mavlink

from firmware.library import GROUND
from sim.flight.autopilot import ARDUPILOT, Autopilot
from sim.flight.board import Board
from sim.flight.scenario import Flight
from sim.flight.steps import ABORT, LAND, PAUSE_CONTINUE, SAID_S, SAY_LOG, elf, hover, to_phase, velocities
from sim.flight.vehicle import Vehicle


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


def test_switch_that_is_on_at_power_up_starts_nothing(board: Board) -> None:
    flight = Flight(Autopilot(ARDUPILOT, Vehicle()), board)
    flight.switch(True)
    flight.run(5.0)
    assert not any("start" in text for _, text in flight.texts[1:])
    flight.switch(False)
    flight.run(6.0)
    flight.switch(True)
    flight.run_to("start", 1)


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

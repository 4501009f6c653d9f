# SPDX-License-Identifier: Apache-2.0
"""Bytes a second on both wires, at each baud rate, while a landing is flown and the ground asks for everything."""

import re
from collections import Counter
from dataclasses import dataclass

import pytest
from pymavlink.dialects.v20 import common as mavlink

from firmware.library import AUTOPILOT, GROUND, ROOT, Firmware, make
from sim.flight import scenario
from sim.flight.autopilot import ARDUPILOT, PX4, Autopilot
from sim.flight.board import HostBoard
from sim.flight.scenario import Flight
from sim.flight.vehicle import Vehicle

FAST, NARROW = 921_600, 57_600
BITS_A_BYTE = 10
SHARE = 0.7
"""Of a wire that may be filled: the rest is for what comes at its own time, and for whoever else uses the wire."""
SECONDS = 4
WAIT_S = 0.1
FRAME_US, TICK_US = 16_667, 1000
"""As on the board."""


class WiredBoard(HostBoard):
    """The core, with wires of so many baud to autopilot and ground."""

    def __init__(self, bauds: tuple[int, int]) -> None:
        super().__init__()
        self._firmware = Firmware(bauds=bauds)


@dataclass
class Traffic:
    """What went over the wires while the firmware steered.

    Attributes:
        flight: The flight.
        sent: By wire, messages a second by kind and name.
        bytes_s: By wire, the fullest second.
        said_s: The fullest second of what the autopilot sent.
        lasts_s: By wire, how long a message waited at most before its last byte had left.
    """

    flight: Flight
    sent: dict[int, Counter]
    bytes_s: dict[int, int]
    said_s: int
    lasts_s: dict[int, float]


def name_of(message: mavlink.MAVLink_message) -> str:
    """Its kind, or the name of an array."""
    kind = message.get_type()
    return message.name.rstrip("\0") if kind == "DEBUG_FLOAT_ARRAY" else kind


def fullest(sizes: list[tuple[float, int]]) -> int:
    """Bytes of the fullest second, of times and sizes in order."""
    most = start = total = 0
    for at_s, size in sizes:
        total += size
        while sizes[start][0] <= at_s - 1.0:
            total -= sizes[start][1]
            start += 1
        most = max(most, total)
    return most


def longest_wait(sizes: list[tuple[float, int]], baud: int) -> float:
    """Until the last byte of a message has left, seconds."""
    free_s = longest = 0.0
    for at_s, size in sizes:
        free_s = max(free_s, at_s) + BITS_A_BYTE * size / baud
        longest = max(longest, free_s - at_s)
    return longest


def traffic(bauds: tuple[int, int], profile: str = ARDUPILOT) -> Traffic:
    """Steer above the pad for some seconds while both ends ask for all they can, and count."""
    flight = Flight(Autopilot(profile, Vehicle(north_m=-0.4, east_m=0.3, height_m=1.8)), WiredBoard(bauds))
    autopilot = mavlink.MAVLink(None, srcSystem=1, srcComponent=1)
    said: list[tuple[float, int]] = []
    say = flight.autopilot.say

    def counted(now_us: int) -> bytes:
        data = say(now_us)
        # PX4 asks for our time ten times a second, and our question is answered.
        if now_us % 100_000 < TICK_US:
            data += bytes(mavlink.MAVLink_timesync_message(0, now_us * 1000).pack(autopilot))
        if now_us % 1_000_000 < TICK_US:
            data += bytes(mavlink.MAVLink_timesync_message(now_us * 1000, 1).pack(autopilot))
        said.append((now_us / 1e6, len(data)))
        return data

    flight.autopilot.say = counted
    flight.run(2.5)
    flight.switch(True)
    flight.run_to("pad seen")
    start_s = flight.time_s
    for second in range(SECONDS):
        # The list of parameters, then the log: each takes less than a second.
        if second % 2:
            flight.command(mavlink.MAV_CMD_USER_1)
        else:
            flight.from_ground(mavlink.MAVLink_param_request_list_message(1, 191))
        flight.run(start_s + second + 1)
    rows = {
        wire: [row for row in flight.sent[wire] if start_s < row.time_s <= start_s + SECONDS]
        for wire in (AUTOPILOT, GROUND)
    }
    sizes = {wire: [(row.time_s, len(row.message.get_msgbuf())) for row in rows[wire]] for wire in rows}
    return Traffic(
        flight,
        {wire: Counter(name_of(row.message) for row in rows[wire]) for wire in rows},
        {wire: fullest(sizes[wire]) for wire in rows},
        fullest([row for row in said if start_s < row[0] <= start_s + SECONDS]),
        {wire: longest_wait(sizes[wire], baud) for wire, baud in zip(rows, bauds, strict=True)},
    )


@pytest.fixture(scope="module", autouse=True)
def _library() -> None:
    make("host")


@pytest.fixture
def as_on_the_board(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(scenario, "FRAME_US", FRAME_US)
    monkeypatch.setattr(scenario, "TICK_US", TICK_US)


RATES = {
    FAST: {"LANDING_TARGET": 60, "PAD": 60, "SET_POSITION_TARGET_LOCAL_NED": 30, "DISTANCE_SENSOR": 20, "ATTITUDE": 50},
    NARROW: {
        "LANDING_TARGET": 20,
        "PAD": 30,
        "SET_POSITION_TARGET_LOCAL_NED": 20,
        "DISTANCE_SENSOR": 10,
        "ATTITUDE": 25,
    },
}
"""Messages a second."""


def test_the_page_says_the_same() -> None:
    page = (ROOT / "docs" / "firmware.md").read_text()
    for name in RATES[FAST]:
        row = re.search(rf"^\| {name}\b[^|]*\| \d+ \| (\d+)\b[^|]*\| \d+ \| (\d+)\b", page, re.MULTILINE)
        assert row is not None, name
        assert (int(row[1]), int(row[2])) == (RATES[FAST][name], RATES[NARROW][name]), name


@pytest.mark.usefixtures("as_on_the_board")
@pytest.mark.parametrize("profile", [ARDUPILOT, PX4])
@pytest.mark.parametrize("bauds", [(FAST, FAST), (FAST, NARROW), (115_200, 115_200), (NARROW, NARROW)])
def test_every_wire_has_room(bauds: tuple[int, int], profile: str) -> None:
    seen = traffic(bauds, profile)
    for wire, baud in zip((AUTOPILOT, GROUND), bauds, strict=True):
        assert seen.bytes_s[wire] * BITS_A_BYTE < SHARE * baud, f"wire {wire}: {seen.sent[wire]}"
        assert seen.lasts_s[wire] < WAIT_S
        rates = RATES[NARROW if baud == NARROW else FAST]
        for name, rate in rates.items():
            if name in seen.sent[wire]:
                # One at either end of the time; setpoints come every 33 ms, not every 33.3.
                assert abs(seen.sent[wire][name] - SECONDS * rate) <= 2, f"{name}: {seen.sent[wire]}"
    assert seen.said_s * BITS_A_BYTE < SHARE * bauds[0]
    assert {"LANDING_TARGET", "SET_POSITION_TARGET_LOCAL_NED", "DISTANCE_SENSOR", "TIMESYNC", "HEARTBEAT"} <= set(
        seen.sent[AUTOPILOT]
    )
    assert {"PAD", "HEALTH", "PARAM_VALUE", "STATUSTEXT", "COMMAND_ACK", "HEARTBEAT"} <= set(seen.sent[GROUND])
    wanted = RATES[NARROW if bauds[0] == NARROW else FAST]["ATTITUDE"]
    assert seen.flight.autopilot.intervals_us[mavlink.MAVLINK_MSG_ID_ATTITUDE] == 1_000_000 // wanted


@pytest.mark.parametrize("profile", [ARDUPILOT, PX4])
def test_it_lands_over_narrow_wires(profile: str) -> None:
    vehicle = Vehicle(north_m=-0.5, east_m=0.4, height_m=1.8, heading_rad=1.0)
    flight = Flight(Autopilot(profile, vehicle), WiredBoard((NARROW, NARROW)))
    flight.run(2.5)
    flight.switch(True)
    flight.run_to("down, motors off")
    assert abs(flight.vehicle.north_m) < 0.05
    assert abs(flight.vehicle.east_m) < 0.05


def test_the_newest_goes_out() -> None:
    """A target that comes back is told with its first frame, and what is left out is never made up for later."""
    flight = Flight(Autopilot(ARDUPILOT, Vehicle(height_m=1.5)), WiredBoard((NARROW, NARROW)))
    flight.run(2.0)
    flight.pad_hidden = True
    flight.run(3.0)
    flight.pad_hidden = False
    flight.run(4.0)
    times = [row.time_s for row in flight.sent[AUTOPILOT] if row.message.get_type() == "LANDING_TARGET"]
    assert min(time_s for time_s in times if time_s > 3.0) < 3.0 + 0.04
    for row in flight.sent[AUTOPILOT]:
        if row.message.get_type() == "LANDING_TARGET":
            assert row.time_s - row.message.time_usec / 1e6 < 0.02

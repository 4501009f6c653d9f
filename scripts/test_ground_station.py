# SPDX-License-Identifier: Apache-2.0
"""The ground station against the firmware's core, over UDP."""

import re
import socket
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest
from pymavlink.dialects.v20 import common as mavlink

from firmware.library import GROUND, Firmware, make
from scripts import ground_station, ground_view
from scripts.errors import UserError
from scripts.ground_view import View

APP_H = Path(__file__).resolve().parent.parent / "firmware" / "core" / "app.h"


def _free_port() -> int:
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


@contextmanager
def touchdown(port: int) -> Iterator[Firmware]:
    """A firmware whose ground link is a UDP socket that sends to the port."""
    make("host")
    firmware = Firmware()
    ended = threading.Event()

    def run() -> None:
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as wire:
            wire.bind(("127.0.0.1", 0))
            wire.settimeout(0.005)
            start_s = time.monotonic()
            while not ended.is_set():
                now_us = int(1e6 * (time.monotonic() - start_s))
                firmware.tick(now_us)
                data = bytes(firmware.sent[GROUND])
                firmware.sent[GROUND].clear()
                if data:
                    wire.sendto(data, ("127.0.0.1", port))
                try:
                    firmware.on_bytes(GROUND, wire.recv(2000), now_us)
                except (TimeoutError, ConnectionError):
                    continue

    thread = threading.Thread(target=run)
    thread.start()
    try:
        yield firmware
    finally:
        ended.set()
        thread.join()


def test_abort_is_answered(capsys: pytest.CaptureFixture[str]) -> None:
    port = _free_port()
    with touchdown(port):
        ground_station.main(["--link", f"udp:{port}", "--do", "abort"])
    assert capsys.readouterr().out == "Touchdown takes it: abort.\n"


def test_it_shows_link_phase_texts_and_parameters(capsys: pytest.CaptureFixture[str]) -> None:
    port = _free_port()
    with touchdown(port):
        station = ground_station.Station(f"udp:{port}", 57_600)
        end_s = time.monotonic() + 10
        asked = False
        while time.monotonic() < end_s and len(station.view.parameters) < 11:
            station.listen()
            if station.view.heard_s is not None and not asked:
                asked = True
                station.ask_parameters()
            time.sleep(0.01)
        ground_station.watch(station, station.now_s + 3.0)
    shown = capsys.readouterr().out
    assert "link    ok" in shown
    assert "phase   STANDBY" in shown
    assert "no frames, check camera" in shown
    assert "TD_SPEED         0.5" in shown


def test_nobody_there_is_one_sentence(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(ground_station, "ANSWER_S", 0.05)
    with pytest.raises(UserError, match="nobody answered 5 times to abort"):
        ground_station.main(["--link", f"udp:{_free_port()}", "--do", "abort"])


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["--link", "udp:here"], "names no port"),
        (["--link", "/dev/nothing-there"], "cannot be opened"),
        (["--link", "udp:14550", "--do", "fly"], "invalid choice"),
        ([], "required: --link"),
    ],
)
def test_what_is_wrong_is_one_sentence(arguments: list[str], message: str) -> None:
    with pytest.raises(UserError, match=message):
        ground_station.main(arguments)


def test_health_is_the_firmwares() -> None:
    """Names of the elements that the view picks by number; and the page has a row for each element."""
    enum = re.search(r"enum app_health_field \{(.*?)\}", APP_H.read_text(), re.DOTALL)
    assert enum is not None, f"{APP_H} has no enum app_health_field"
    names = re.findall(r"^\s*APP_HEALTH_(\w+)", enum[1], re.MULTILINE)
    assert names.pop() == "FIELDS", "the number of fields comes last"
    assert names[ground_view._PHASE_AT] == "PHASE"
    assert names[ground_view._DROPPED] == ["DROPPED_AUTOPILOT", "DROPPED_GROUND"]
    assert names[ground_view._BOARD] == ["LIDAR_AGE_MS", "TIMESYNC_US", "STACK_BYTES", "BUSY_PERMILLE", "FRAME_US"]
    assert names[ground_view._RX_LOST] == [
        "RX_FULL_AUTOPILOT",
        "RX_FULL_GROUND",
        "RX_OVERRUNS_AUTOPILOT",
        "RX_OVERRUNS_GROUND",
    ]
    page = (APP_H.parents[2] / "docs" / "firmware.md").read_text()
    rows = re.findall(r"^\|[^|]*\|[^|]*\| \| ([\d, ]+) \|[^|]*\|$", page, re.MULTILINE)
    assert [int(number) for row in rows for number in row.split(",")] == list(range(len(names)))


def test_view_of_a_pad() -> None:
    view = View()
    packer = mavlink.MAVLink(None, srcSystem=1, srcComponent=191)
    other = mavlink.MAVLink(None, srcSystem=1, srcComponent=1)

    def take(message: mavlink.MAVLink_message, sender: mavlink.MAVLink = packer, now_s: float = 1.0) -> None:
        parser = mavlink.MAVLink(None)
        (received,) = parser.parse_buffer(bytes(message.pack(sender)))
        view.take(received, now_s)

    assert view.lines(0.0)[0] == "link    nothing heard yet"
    pad = [1.0, 700.0, 300.0, 30.0, 1.5, 0.2, -0.1, 77.0, 20.0, 0.0, 0.3, 1.5] + [0.0] * 46
    take(mavlink.MAVLink_debug_float_array_message(0, b"PAD", 1, pad), other)
    assert view.lines(1.0)[2] == "pad     no frames yet"
    take(mavlink.MAVLink_debug_float_array_message(0, b"PAD", 1, pad))
    assert (
        "right +0.20 m, ahead -0.10 m, turned +30 degrees, altitude 1.50 m, doubt 0.30, frame 77" in view.lines(1.0)[2]
    )
    take(mavlink.MAVLink_debug_float_array_message(0, b"PAD", 1, [0.0, *pad[1:]]))
    assert "not seen" in view.lines(1.0)[2]
    assert view.lines(1.0)[4] == "board   not told yet"
    assert view.lines(1.0)[5] == "wires   not told yet"
    health = [0.0] * 7 + [1.0, 2.0] + [0.0] * 4 + [12.0, 2300.0, 5120.0, 345.0, 6789.0, 3.0, 4.0, 5.0, 6.0] + [0.0] * 36
    take(mavlink.MAVLink_debug_float_array_message(0, b"HEALTH", 2, health))
    assert view.lines(1.0)[4] == (
        "board   LiDAR 12 ms old, TIMESYNC in 2.3 ms, stack 5120 bytes, processor 34.5 % busy, longest frame 6.8 ms"
    )
    assert view.lines(1.0)[5] == (
        "wires   of autopilot and ground: 1 and 2 messages not sent, 3 and 4 bytes and 5 and 6 overruns lost on arrival"
    )
    take(mavlink.MAVLink_debug_float_array_message(0, b"HEALTH", 2, health[:13] + [9999.0] + [0.0] * 44))
    assert "no LiDAR reading, autopilot's clock not known, stack 0" in view.lines(1.0)[4]
    take(mavlink.MAVLink_heartbeat_message(18, 8, 0, 0, mavlink.MAV_STATE_CRITICAL, 3))
    assert "FAULT" in view.lines(1.5)[0]
    assert "silent" in view.lines(5.0)[0]

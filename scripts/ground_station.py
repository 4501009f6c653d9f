# SPDX-License-Identifier: Apache-2.0
"""Shows what a Touchdown does, and starts, holds or aborts a landing, in a terminal.

    python -m scripts.ground_station --link /dev/ttyUSB0 [--baud 57600]
    python -m scripts.ground_station --link udp:14550 --do abort

Keys: s start, a abort, h hold, g go on, l log of phases, p parameters, q quit.
"""

import os
import select
import sys
import termios
import time
import tty
from collections.abc import Iterator
from contextlib import contextmanager

os.environ.setdefault("MAVLINK20", "1")
import serial
from pymavlink import mavutil
from pymavlink.dialects.v20 import common as mavlink

from scripts.errors import ArgumentParser, UserError, run_main
from scripts.ground_view import View

ACTIONS = {
    "start": (mavlink.MAV_CMD_NAV_LAND, 0.0),
    "abort": (mavlink.MAV_CMD_DO_GO_AROUND, 0.0),
    "hold": (mavlink.MAV_CMD_DO_PAUSE_CONTINUE, 0.0),
    "go-on": (mavlink.MAV_CMD_DO_PAUSE_CONTINUE, 1.0),
    "log": (mavlink.MAV_CMD_USER_1, 0.0),
}
KEYS = {"s": "start", "a": "abort", "h": "hold", "g": "go-on", "l": "log"}
SYSTEM, COMPONENT = 1, mavlink.MAV_COMP_ID_ONBOARD_COMPUTER
TRIES = 5
ANSWER_S = 1.0
_DRAW_S = 0.2
_HEARTBEAT_S = 1.0


class Station:
    """One link to a Touchdown."""

    def __init__(self, link: str, baud: int) -> None:
        url = f"udpin:0.0.0.0:{link.removeprefix('udp:')}" if link.startswith("udp:") else link
        try:
            self._link = mavutil.mavlink_connection(
                url, baud=baud, source_system=255, source_component=mavlink.MAV_COMP_ID_MISSIONPLANNER
            )
        except (OSError, serial.SerialException, ValueError) as error:
            raise UserError(
                f"{link} cannot be opened ({error}); give LINK=port or LINK=udp:number, and close what else uses it."
            ) from None
        self.view = View()
        self._start_s = time.monotonic()
        self._next_heartbeat_s = 0.0

    @property
    def now_s(self) -> float:
        """Seconds since the link was opened."""
        return time.monotonic() - self._start_s

    def listen(self) -> None:
        """Take all that has come, and say that we are there."""
        while (message := self._link.recv_match(blocking=False)) is not None:
            self.view.take(message, self.now_s)
        if self.now_s >= self._next_heartbeat_s:
            self._next_heartbeat_s = self.now_s + _HEARTBEAT_S
            self._link.mav.heartbeat_send(mavlink.MAV_TYPE_GCS, mavlink.MAV_AUTOPILOT_INVALID, 0, 0, 0)

    def send(self, action: str) -> None:
        """Send a command once."""
        command, parameter = ACTIONS[action]
        self._link.mav.command_long_send(SYSTEM, COMPONENT, command, 0, parameter, 0, 0, 0, 0, 0, 0)

    def ask_parameters(self) -> None:
        """Ask for all of them."""
        self._link.mav.param_request_list_send(SYSTEM, COMPONENT)

    def do(self, action: str) -> None:
        """Send a command until it is answered.

        Raises:
            UserError: it is not answered, or refused.
        """
        for _ in range(TRIES):
            self.view.answers.clear()
            self.send(action)
            end_s = self.now_s + ANSWER_S
            while self.now_s < end_s:
                self.listen()
                results = [result for command, result in self.view.answers if command == ACTIONS[action][0]]
                if results and results[-1] == mavlink.MAV_RESULT_ACCEPTED:
                    return
                if results:
                    name = mavlink.enums["MAV_RESULT"][results[-1]].name
                    raise UserError(f"Touchdown refuses to {action}: {name}; what it says in words tells why.")
                time.sleep(0.01)
        raise UserError(f"nobody answered {TRIES} times to {action}; check link, baud rate and power.")


@contextmanager
def _raw_keys() -> Iterator[bool]:
    """Keys come at once; false where there is no terminal."""
    if not sys.stdin.isatty():
        yield False
        return
    before = termios.tcgetattr(sys.stdin)
    tty.setcbreak(sys.stdin)
    try:
        yield True
    finally:
        termios.tcsetattr(sys.stdin, termios.TCSADRAIN, before)


def _key(keys: bool) -> str:
    if keys and select.select([sys.stdin], [], [], 0)[0]:
        return sys.stdin.read(1)
    return ""


def watch(station: Station, seconds: float) -> None:
    """Draw until q is pressed, or for so long; 0 = without end."""
    with _raw_keys() as keys:
        next_s = 0.0
        while not seconds or station.now_s < seconds:
            station.listen()
            key = _key(keys)
            if key == "q":
                return
            if key in KEYS:
                station.send(KEYS[key])
            elif key == "p":
                station.ask_parameters()
            if station.now_s >= next_s:
                next_s = station.now_s + _DRAW_S
                _draw(station, keys)
            time.sleep(0.01)


def _draw(station: Station, keys: bool) -> None:
    lines = station.view.lines(station.now_s)
    lines += ["", *(f"{name:16} {value:g}" for name, value in station.view.parameters.items())]
    lines += ["", "s start  a abort  h hold  g go on  l log  p parameters  q quit"] if keys else []
    if keys:
        print("\x1b[H\x1b[2J" + "\n".join(lines), flush=True)
    else:
        print("\n".join(lines), flush=True)


def main(arguments: list[str] | None = None) -> None:
    """Entry point."""
    parser = ArgumentParser(prog="python -m scripts.ground_station", description=__doc__)
    parser.add_argument("--link", required=True, help="serial port, or udp:PORT to listen on")
    parser.add_argument("--baud", type=int, default=57_600, help="of a serial port")
    parser.add_argument("--do", choices=sorted(ACTIONS), help="send this command, wait for its answer, and end")
    parser.add_argument("--seconds", type=float, default=0.0, help="watch for so long; 0 = until q")
    options = parser.parse_args(arguments)
    if options.link.startswith("udp:") and not options.link.removeprefix("udp:").isdigit():
        raise UserError(f"{options.link} names no port; write it as udp:14550.")
    station = Station(options.link, options.baud)
    if options.do:
        station.do(options.do)
        print(f"Touchdown takes it: {options.do}.")
    else:
        watch(station, options.seconds)


if __name__ == "__main__":
    run_main(main)

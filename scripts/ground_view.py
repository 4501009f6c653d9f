# SPDX-License-Identifier: Apache-2.0
"""What a ground station knows of a Touchdown, from its messages, and how a terminal shows it."""

from collections import deque
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path

from pymavlink.dialects.v20 import common as mavlink

from scripts.demo_decode import PAD_FIELDS
from scripts.landing.model import SOURCE, load

ROOT = Path(__file__).resolve().parents[1]
TEXTS = 12
SILENT_S = 3.0
_HEALTH = ("records", "rejected", "with pad", "malformed", "overflow")
_BRIDGED = 0x200
_PHASE_AT = 12
_DROPPED = slice(7, 9)
_BOARD = slice(13, 18)
_RX_LOST = slice(18, 22)
_LIDAR_AGE_MAX_MS = 9999


@dataclass
class View:
    """Newest of each kind.

    Attributes:
        pad: Fields of the PAD array, empty before the first.
        health: Elements of the HEALTH array.
        texts: Newest STATUSTEXT with their times.
        parameters: Values by name.
        heard_s: When anything came.
        failed: The newest HEARTBEAT said CRITICAL.
        answers: COMMAND_ACK, as command and result.
    """

    pad: dict[str, float] = field(default_factory=dict)
    health: list[float] = field(default_factory=list)
    texts: deque[tuple[float, str]] = field(default_factory=lambda: deque(maxlen=TEXTS))
    parameters: dict[str, float] = field(default_factory=dict)
    heard_s: float | None = None
    failed: bool = False
    answers: list[tuple[int, int]] = field(default_factory=list)

    def take(self, message: mavlink.MAVLink_message, now_s: float) -> None:
        """Note what a message says; those of other components are left out."""
        if message.get_srcComponent() != mavlink.MAV_COMP_ID_ONBOARD_COMPUTER:
            return
        kind = message.get_type()
        self.heard_s = now_s
        if kind == "HEARTBEAT":
            self.failed = message.system_status == mavlink.MAV_STATE_CRITICAL
        elif kind == "DEBUG_FLOAT_ARRAY" and message.name == "PAD":
            self.pad = dict(zip(PAD_FIELDS, message.data, strict=False))
        elif kind == "DEBUG_FLOAT_ARRAY" and message.name == "HEALTH":
            self.health = list(message.data)
        elif kind == "STATUSTEXT":
            self.texts.append((now_s, message.text))
        elif kind == "PARAM_VALUE":
            self.parameters[message.param_id] = message.param_value
        elif kind == "COMMAND_ACK":
            self.answers.append((message.command, message.result))

    def lines(self, now_s: float) -> list[str]:
        """The view as lines of text."""
        return [
            self._link(now_s),
            self._phase(),
            self._pad(),
            self._counts(),
            self._board(),
            self._wires(),
            "",
            *(f"{at:8.1f}  {text}" for at, text in self.texts),
        ]

    def _link(self, now_s: float) -> str:
        if self.heard_s is None:
            return "link    nothing heard yet"
        age = now_s - self.heard_s
        state = "silent" if age > SILENT_S else "FAULT: see below" if self.failed else "ok"
        return f"link    {state}, newest message {age:.1f} s ago"

    def _phase(self) -> str:
        names = _phases()
        number = int(self.health[_PHASE_AT]) if len(self.health) > _PHASE_AT else len(names)
        return f"phase   {names[number] if number < len(names) else 'not told yet'}"

    def _pad(self) -> str:
        pad = self.pad
        if not pad:
            return "pad     no frames yet"
        altitude = f"altitude {pad['altitude_m']:.2f} m" if pad["altitude_m"] else "altitude not known"
        if not pad["found"]:
            return f"pad     not seen, {altitude}, {pad['object_count']:.0f} objects, frame {pad['frame_number']:.0f}"
        how = ", predicted" if int(pad["flags"]) & _BRIDGED else ""
        return (
            f"pad     right {pad['right_m']:+.2f} m, ahead {pad['forward_m']:+.2f} m, "
            f"turned {pad['angle_deg']:+.0f} degrees, {altitude}, doubt {pad['doubt']:.2f}{how}, "
            f"frame {pad['frame_number']:.0f}"
        )

    def _counts(self) -> str:
        if not self.health:
            return "health  not told yet"
        return "health  " + ", ".join(f"{name} {value:.0f}" for name, value in zip(_HEALTH, self.health, strict=False))

    def _board(self) -> str:
        if not self.health:
            return "board   not told yet"
        lidar_ms, round_trip_us, stack_bytes, busy_permille, frame_us = self.health[_BOARD]
        lidar = f"LiDAR {lidar_ms:.0f} ms old" if lidar_ms < _LIDAR_AGE_MAX_MS else "no LiDAR reading"
        clock = f"TIMESYNC in {round_trip_us / 1000:.1f} ms" if round_trip_us else "autopilot's clock not known"
        return (
            f"board   {lidar}, {clock}, stack {stack_bytes:.0f} bytes, processor {busy_permille / 10:.1f} % busy, "
            f"longest frame {frame_us / 1000:.1f} ms"
        )

    def _wires(self) -> str:
        if not self.health:
            return "wires   not told yet"
        sent = [f"{value:.0f}" for value in self.health[_DROPPED]]
        full = [f"{value:.0f}" for value in self.health[_RX_LOST][:2]]
        overruns = [f"{value:.0f}" for value in self.health[_RX_LOST][2:]]
        return (
            f"wires   of autopilot and ground: {' and '.join(sent)} messages not sent, "
            f"{' and '.join(full)} bytes and {' and '.join(overruns)} overruns lost on arrival"
        )


@cache
def _phases() -> tuple[str, ...]:
    return tuple(phase.name for phase in load(ROOT / SOURCE).phases)

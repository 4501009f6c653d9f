# SPDX-License-Identifier: Apache-2.0
"""The firmware's core in this process, through the C interface of `firmware/host/host.h`."""

import ctypes
import fcntl
import subprocess
from pathlib import Path

from pymavlink.dialects.v20 import common as mavlink

from golden.generated.landing_regs import THRESHOLD_FACTOR_MASK, THRESHOLD_FACTOR_SHIFT

ROOT = Path(__file__).resolve().parent.parent
BUILD = ROOT / "build" / "firmware"
AUTOPILOT, GROUND = 0, 1
_WRITE = ctypes.CFUNCTYPE(None, ctypes.c_void_p, ctypes.c_int, ctypes.POINTER(ctypes.c_uint8), ctypes.c_size_t)


def make(*targets: str) -> str:
    """Run `make -C firmware` and return what it printed. Tests that run beside each other take turns.

    Raises:
        AssertionError: it failed; the message holds all that it printed.
    """
    BUILD.mkdir(parents=True, exist_ok=True)
    with (BUILD / "make.lock").open("w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        run = subprocess.run(
            ["make", "-C", str(ROOT / "firmware"), *targets],
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            check=False,
        )
    assert run.returncode == 0, f"make -C firmware {' '.join(targets)} failed:\n{run.stdout}"
    return run.stdout


def decode(data: bytes) -> list[mavlink.MAVLink_message]:
    """All messages in the bytes of one link.

    Raises:
        AssertionError: some byte belongs to no valid MAVLink 2 message.
    """
    parser = mavlink.MAVLink(None)
    parser.robust_parsing = True
    messages = parser.parse_buffer(data) or []
    bad = [message for message in messages if message.get_type() == "BAD_DATA"]
    assert not bad, f"{len(bad)} stretches of bytes are not MAVLink: {bad[0]}"
    assert sum(len(message.get_msgbuf()) for message in messages) == len(data), "the last message is cut off"
    return messages


def attitude_bytes(roll_rad: float, pitch_rad: float, now_us: int = 0) -> bytes:
    """An ATTITUDE as the autopilot sends it: right side down and nose up are positive."""
    message = mavlink.MAVLink_attitude_message(now_us // 1000 % 2**32, roll_rad, pitch_rad, 0.0, 0.0, 0.0, 0.0)
    return bytes(message.pack(mavlink.MAVLink(None, srcSystem=1, srcComponent=1)))


class Firmware:
    """One run of the core. A new instance starts anew; only the newest may be used.

    Attributes:
        sent: bytes sent so far, by link.
    """

    def __init__(self, now_us: int = 0, bauds: tuple[int, int] = (0, 0)) -> None:
        """Start it.

        Args:
            now_us: Time of the start.
            bauds: Of the wires to autopilot and ground, to which rates fit; 0 = no limit.
        """
        self._library = ctypes.CDLL(str(BUILD / "libtouchdown.so"))
        self._write = _WRITE(self._collect)  # kept: C holds no reference
        self.sent = {AUTOPILOT: bytearray(), GROUND: bytearray()}
        self._library.touchdown_set_bauds(*(ctypes.c_uint32(baud) for baud in bauds))
        self._library.touchdown_init(self._write, None, ctypes.c_uint64(now_us))

    def _collect(self, _context: int, link: int, data: "ctypes._Pointer[ctypes.c_uint8]", size: int) -> None:
        self.sent[link] += bytes(data[:size])

    def on_record(self, record: bytes, now_us: int = 0) -> int:
        """Hand over one result record; 0, or a negative number of `firmware/core/record.h`."""
        return self._library.touchdown_on_record(record, ctypes.c_size_t(len(record)), ctypes.c_uint64(now_us))

    def on_bytes(self, link: int, data: bytes, now_us: int = 0) -> None:
        """Hand over bytes that arrived on a link."""
        self._library.touchdown_on_bytes(link, data, ctypes.c_size_t(len(data)), ctypes.c_uint64(now_us))

    def attitude(self, roll_rad: float, pitch_rad: float, now_us: int = 0) -> None:
        """Hand over an ATTITUDE of the autopilot."""
        self.on_bytes(AUTOPILOT, attitude_bytes(roll_rad, pitch_rad, now_us), now_us)

    def tick(self, now_us: int, lidar_mm: int | None = 1000, age_us: int = 0) -> None:
        """Let time pass. `lidar_mm` None: the LiDAR has no valid reading."""
        self._library.touchdown_tick(
            ctypes.c_uint64(now_us), lidar_mm is not None, ctypes.c_uint32(lidar_mm or 0), ctypes.c_uint32(age_us)
        )

    def set_options(self, options: int) -> None:
        """Let the detection do only what this mask of DETECT_* in `firmware/core/detect.h` allows."""
        self._library.touchdown_set_options(ctypes.c_uint32(options))

    @property
    def min_area_px(self) -> int:
        """What the firmware would now write into MIN_AREA."""
        return self._library.touchdown_min_area()

    @property
    def threshold(self) -> int:
        """What the firmware would now write into THRESHOLD: factor and flat limit."""
        return self._library.touchdown_threshold()

    @property
    def factor(self) -> int:
        """The factor in it, Q1.8."""
        return (self.threshold & THRESHOLD_FACTOR_MASK) >> THRESHOLD_FACTOR_SHIFT

    def take(self, link: int) -> list[mavlink.MAVLink_message]:
        """Messages sent on a link since the last call."""
        data = bytes(self.sent[link])
        self.sent[link].clear()
        return decode(data)

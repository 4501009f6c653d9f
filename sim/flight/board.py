# SPDX-License-Identifier: Apache-2.0
"""What flies: the firmware's core in this process, or the board's ELF on QEMU's Zynq with landing_core beside it."""

import shutil
import socket
import struct
import subprocess
import tempfile
import time
from collections.abc import Mapping
from pathlib import Path
from typing import Protocol

import numpy as np
from pymavlink.dialects.v20 import common as mavlink

from firmware.library import AUTOPILOT, GROUND, Firmware
from golden import result_writer
from scripts.errors import UserError
from sim.cosim.build import build_firmware, build_flight_plugin, build_meter_plugin, symbols
from sim.cosim.qemu import find_qemu, last_sentence, qemu_command

SIZE = (1280, 720)
_NO_FRAME, _MALFORMED = -1, -2
_WAIT_S = 60.0
_LOOK_S = 0.1


class Board(Protocol):
    """A firmware with time, wires, a camera and a LiDAR."""

    min_area_px: int
    """Smaller shapes need not be shown."""

    def say(self, link: int, data: bytes) -> None:
        """Bytes come in on a link from now on."""

    def show(self, objects: np.ndarray | None) -> None:
        """A frame with these shapes, `OBJECT_DTYPE`, starts now; None: one that is malformed."""

    def run_to(self, now_us: int, lidar_mm: int | None) -> dict[int, bytes]:
        """Let time pass; returns what was sent, by link. `lidar_mm` None: the LiDAR gives nothing."""

    def close(self) -> None:
        """Power off."""


class HostBoard:
    """The core alone: it takes no time, and bytes are there at once.

    A record is handled in the instant in which its frame starts; it says that the frame began a frame's time ago.
    """

    def __init__(self) -> None:
        self._firmware = Firmware()
        self._frames = 0
        self._factor_before = self._firmware.factor
        self._heard: list[tuple[int, bytes]] = []
        self._frame: np.ndarray | None = None

    @property
    def min_area_px(self) -> int:
        """What the firmware would write into MIN_AREA."""
        return self._firmware.min_area_px

    def say(self, link: int, data: bytes) -> None:
        """See `Board`."""
        self._heard.append((link, data))

    def show(self, objects: np.ndarray | None) -> None:
        """See `Board`."""
        self._frames += 1
        self._frame = objects

    def run_to(self, now_us: int, lidar_mm: int | None) -> dict[int, bytes]:
        """See `Board`."""
        for link, data in self._heard:
            self._firmware.on_bytes(link, data, now_us)
        self._heard.clear()
        if self._frame is not None:
            self._on_frame(self._frame, now_us, lidar_mm)
            self._frame = None
        self._firmware.tick(now_us, lidar_mm)
        sent = {link: bytes(data) for link, data in self._firmware.sent.items()}
        for data in self._firmware.sent.values():
            data.clear()
        return sent

    def _on_frame(self, objects: np.ndarray, now_us: int, lidar_mm: int | None) -> None:
        record = result_writer.record(
            {
                "frame_number": self._frames,
                "start_time_us": now_us - 16_500,
                "scan_time_us": 16_072,
                "altitude_mm": lidar_mm or 0,
                "altitude_valid": int(lidar_mm is not None),
                "frame_size_width": SIZE[0],
                "frame_size_height": SIZE[1],
                "threshold_factor": self._factor_before,
                "min_area": self._firmware.min_area_px,
            },
            objects,
        )
        self._factor_before = self._firmware.factor
        error = self._firmware.on_record(record, now_us)
        assert error == 0, f"the firmware refuses a record with {error}"

    def close(self) -> None:
        """See `Board`."""


class ZynqBoard:
    """The ELF on QEMU; what lies between camera and objects has stand-ins, the rest of landing_core is the RTL."""

    min_area_px = 0
    """landing_core leaves out what is too small."""

    def __init__(self, spans: Mapping[str, tuple[str, str]] | None = None) -> None:
        """Power up.

        Args:
            spans: Instructions to be counted, from one symbol of the ELF to another; see `passes`.

        Raises:
            UserError: a tool is missing, something cannot be built, or QEMU does not start, with what it said.
        """
        qemu, elf, plugin = find_qemu(), build_firmware(), build_flight_plugin()
        self._folder = Path(tempfile.mkdtemp(prefix="touchdown-"))
        self._heard = {AUTOPILOT: b"", GROUND: b""}
        self._frame = _NO_FRAME
        self._objects = b""
        self._wire: socket.socket | None = None
        self._log = self._folder / "run.log"
        path = self._folder / "world"
        command = qemu_command(qemu, elf, plugin, {"world": path}, self._folder, log_uarts=False)
        command += self._meter(elf, spans) if spans else []
        with socket.socket(socket.AF_UNIX) as door, self._log.open("w") as log:
            door.bind(str(path))
            door.listen(1)
            self._process = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=log, stderr=subprocess.STDOUT)
            try:
                self._wire = self._opened(door)
            except UserError:
                self.close()
                raise

    def _opened(self, door: socket.socket) -> socket.socket:
        door.settimeout(_LOOK_S)
        deadline = time.monotonic() + _WAIT_S
        while time.monotonic() < deadline:
            try:
                wire, _ = door.accept()
            except TimeoutError:
                if self._process.poll() is not None:
                    raise UserError(f"QEMU ended: {last_sentence(self._log) or 'it did not say why'}") from None
            else:
                wire.settimeout(_WAIT_S)
                return wire
        raise UserError(f"QEMU does not start within {_WAIT_S:g} s; is the machine overloaded?")

    def _meter(self, elf: Path, spans: Mapping[str, tuple[str, str]]) -> list[str]:
        addresses = symbols(elf)
        wanted = "".join(f",{name}={addresses[a]:x}-{addresses[b]:x}" for name, (a, b) in spans.items())
        return ["-plugin", f"file={build_meter_plugin()},out={self._folder / 'meter.txt'}{wanted}"]

    def passes(self, span: str) -> list[int]:
        """Instructions of each pass of a span so far, in order."""
        lines = (self._folder / "meter.txt").read_text(encoding="ascii").splitlines()
        return [int(count) for name, count in map(str.split, lines) if name == span]

    def say(self, link: int, data: bytes) -> None:
        """See `Board`; bytes take the time of the line."""
        self._heard[link] += data

    def show(self, objects: np.ndarray | None) -> None:
        """See `Board`."""
        self._frame = _MALFORMED if objects is None else len(objects)
        self._objects = b"" if objects is None else objects.tobytes()

    def run_to(self, now_us: int, lidar_mm: int | None) -> dict[int, bytes]:
        """See `Board`; what is still on the line comes next time.

        Raises:
            UserError: QEMU ended, with what it said.
        """
        heard = [self._heard[link] for link in (AUTOPILOT, GROUND)]
        numbers = (1000 * now_us, lidar_mm or 0, self._frame, len(heard[0]), len(heard[1]))
        try:
            self._wire.sendall(struct.pack("<QIiII", *numbers) + heard[0] + heard[1] + self._objects)
            counts = struct.unpack("<II", self._take(8))
            sent = {link: self._take(counts[link]) for link in (AUTOPILOT, GROUND)}
        except OSError as error:
            self._process.wait(_WAIT_S)
            raise UserError(f"QEMU ended: {last_sentence(self._log) or error}") from error
        self._heard = {AUTOPILOT: b"", GROUND: b""}
        self._frame, self._objects = _NO_FRAME, b""
        return sent

    def _take(self, count: int) -> bytes:
        data = b""
        while len(data) < count:
            piece = self._wire.recv(count - len(data))
            if not piece:
                raise ConnectionResetError("the connection is closed")
            data += piece
        return data

    def close(self) -> None:
        """See `Board`."""
        self._process.kill()
        self._process.wait()
        if self._wire is not None:
            self._wire.close()
        shutil.rmtree(self._folder, ignore_errors=True)


class Listener:
    """Takes MAVLink off a line piece by piece."""

    def __init__(self) -> None:
        self._parser = mavlink.MAVLink(None)
        self._parser.robust_parsing = True

    def hear(self, data: bytes) -> list[mavlink.MAVLink_message]:
        """Messages that have ended.

        Raises:
            AssertionError: some byte belongs to no valid MAVLink 2 message.
        """
        messages = (self._parser.parse_buffer(data) or []) if data else []
        bad = [message for message in messages if message.get_type() == "BAD_DATA"]
        assert not bad, f"{len(bad)} stretches of bytes are not MAVLink: {bad[0]}"
        return messages

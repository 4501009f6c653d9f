# SPDX-License-Identifier: Apache-2.0
"""What outlasts a restart, on QEMU's Zynq: the record of a crash, and parameters that the ground has set."""

import re
import shutil
import socket
import subprocess
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest
from pymavlink.dialects.v20 import common as mavlink

from firmware.library import BUILD, make

LIMIT_S = 60.0
_PC = 15


class Board:
    """The ELF on QEMU, with UART1 on a socket, a monitor, and a debugger's door."""

    def __init__(self, folder: Path, process: subprocess.Popen) -> None:
        self._process = process
        self._ground = self._open(folder / "uart1")
        self._debug_path = folder / "gdb"
        self._parser = mavlink.MAVLink(None)
        self._parser.robust_parsing = True
        self._packer = mavlink.MAVLink(None, srcSystem=255, srcComponent=190)
        self.said: list[mavlink.MAVLink_message] = []

    def _open(self, path: Path) -> socket.socket:
        deadline = time.monotonic() + LIMIT_S
        while True:
            assert self._process.poll() is None, "QEMU ended"
            wire = socket.socket(socket.AF_UNIX)
            try:
                wire.connect(str(path))
            except (FileNotFoundError, ConnectionRefusedError):
                wire.close()
                assert time.monotonic() < deadline, f"QEMU does not open {path.name}"
                time.sleep(0.05)
            else:
                wire.settimeout(0.05)
                return wire

    def wait_for(self, kind: str, pattern: str) -> mavlink.MAVLink_message:
        """The next message of a kind whose text matches; those before it are used up."""
        deadline = time.monotonic() + LIMIT_S
        while time.monotonic() < deadline:
            while self.said:
                message = self.said.pop(0)
                if message.get_type() == kind and re.search(pattern, str(message)):
                    return message
            try:
                self.said += self._parser.parse_buffer(self._ground.recv(4096)) or []
            except TimeoutError:
                continue
        raise AssertionError(f"no {kind} with '{pattern}' within {LIMIT_S} s")

    def send(self, message: mavlink.MAVLink_message) -> None:
        """The ground sends a message."""
        self._ground.sendall(bytes(message.pack(self._packer)))

    def restart(self) -> None:
        """A reset of the processor; memory that the ELF does not fill stays."""
        self._process.stdin.write("system_reset\n")
        self._process.stdin.flush()

    def jump(self, address: int) -> None:
        """Let the processor go on somewhere else."""
        with self._open(self._debug_path) as wire:
            # It lets no one set registers who has not asked which there are.
            self._ask(wire, "qXfer:features:read:target.xml:0,fff", b"</target>#")
            self._ask(wire, f"P{_PC:x}={address.to_bytes(4, 'little').hex()}", b"$OK#")
            self._ask(wire, "D", b"$OK#")

    @staticmethod
    def _ask(wire: socket.socket, text: str, expected: bytes) -> None:
        wire.settimeout(LIMIT_S / 4)
        wire.sendall(f"${text}#{sum(text.encode()) % 256:02x}".encode())
        answer = b""
        # That it has stopped it says unasked.
        while expected not in answer:
            try:
                answer += wire.recv(4096)
            except TimeoutError:
                raise AssertionError(f"the debugger's door answers {answer!r} to {text}") from None
        wire.sendall(b"+")


@pytest.fixture
def board(tmp_path: Path) -> Iterator[Board]:
    with running(tmp_path) as one:
        yield one


@contextmanager
def running(folder: Path) -> Iterator[Board]:
    """A board that has just been powered up."""
    qemu = shutil.which("qemu-system-arm")
    assert qemu is not None, "qemu-system-arm is not installed; run make setup"
    make("elf")
    command = [
        *(qemu, "-M", "xilinx-zynq-a9", "-m", "512M", "-display", "none", "-nodefaults", "-monitor", "stdio"),
        *("-serial", "null", "-chardev", f"socket,id=u1,path={folder / 'uart1'},server=on,wait=off"),
        *("-serial", "chardev:u1", "-gdb", f"unix:path={folder / 'gdb'},server=on,wait=off"),
        *("-kernel", str(BUILD / "touchdown.elf")),
    ]
    process = subprocess.Popen(
        command, stdin=subprocess.PIPE, stdout=subprocess.DEVNULL, stderr=subprocess.STDOUT, text=True
    )
    try:
        yield Board(folder, process)
    finally:
        process.kill()
        process.wait()


def test_a_crash_is_told_at_once_and_at_the_next_start_alone(board: Board) -> None:
    board.wait_for("HEARTBEAT", "")
    board.jump(0x0000_0040)
    board.wait_for("STATUSTEXT", "Touchdown: prefetch abort at 00000040")
    board.restart()
    message = board.wait_for("STATUSTEXT", "restarted: prefetch abort at 00000040")
    assert message.severity == mavlink.MAV_SEVERITY_CRITICAL
    board.restart()
    board.wait_for("STATUSTEXT", "Touchdown: started")
    board.wait_for("HEARTBEAT", "")
    board.wait_for("HEARTBEAT", "")
    assert not [message for message in board.said if "restarted" in str(message)]


def test_parameters_outlast_a_restart_and_not_power(board: Board, tmp_path: Path) -> None:
    name = b"TD_SPEED"
    read = mavlink.MAVLink_param_request_read_message(1, 191, name, -1)
    board.wait_for("HEARTBEAT", "")
    board.send(mavlink.MAVLink_param_set_message(1, 191, name, 0.25, mavlink.MAV_PARAM_TYPE_REAL32))
    assert board.wait_for("PARAM_VALUE", "TD_SPEED").param_value == 0.25
    board.restart()
    board.wait_for("STATUSTEXT", "Touchdown: started")
    board.send(read)
    assert board.wait_for("PARAM_VALUE", "TD_SPEED").param_value == 0.25
    other = tmp_path / "power"
    other.mkdir()
    with running(other) as fresh:
        fresh.wait_for("HEARTBEAT", "")
        fresh.send(read)
        assert fresh.wait_for("PARAM_VALUE", "TD_SPEED").param_value == 0.5

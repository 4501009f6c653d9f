# SPDX-License-Identifier: Apache-2.0
"""The ELF on QEMU's Zynq without programmable logic, with the ground's wire, a reset button and a debugger's door."""

import re
import shutil
import socket
import subprocess
import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, suppress
from pathlib import Path

from pymavlink.dialects.v20 import common as mavlink

from firmware.library import BUILD, make

LIMIT_S = 60.0
_POLL_S = 0.05
FREE = 0x01F0_0000
"""Memory that nothing uses."""
_PC, STATUS = 15, 25
_SYSTEM_MODE = 0x5F
"""Of CPSR; fast interrupts are off."""
_RUNNING_PRIORITY, _IDLE = 0xF8F0_0114, 0xFF
"""Of the interrupt that is being handled, and of none."""
_MEMORY = re.compile(rb"\$([0-9a-f]{8})#")


class Board:
    """The ELF on QEMU, with UART1 on a socket, a monitor, and a debugger's door."""

    def __init__(self, folder: Path, process: subprocess.Popen) -> None:
        self._process = process
        self._ground = self._open(folder / "uart1")
        self._debug_path = folder / "gdb"
        self._packer = mavlink.MAVLink(None, srcSystem=255, srcComponent=190)
        self._listen()

    def _listen(self) -> None:
        self._parser = mavlink.MAVLink(None)
        self._parser.robust_parsing = True
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
                wire.settimeout(_POLL_S)
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
        """A reset of the processor; memory that the ELF does not fill stays.

        What it sent before is forgotten, so that a message that is cut off does not swallow the first after it.
        """
        with self._door() as wire:
            self._ground.setblocking(False)
            with suppress(BlockingIOError):
                while self._ground.recv(4096):
                    pass
            self._ground.settimeout(_POLL_S)
            self._listen()
            self._ask(wire, f"qRcmd,{b'system_reset'.hex()}", b"$OK#")
            self._ask(wire, "D", b"$OK#")

    def jump(self, address: int, registers: Sequence[int] = (), code: Sequence[int] = ()) -> None:
        """Let the processor go on somewhere else, in system mode with interrupts on.

        Args:
            address: Where.
            registers: What the first registers hold by then.
            code: Instructions that are put there before.
        """
        deadline = time.monotonic() + LIMIT_S
        while not self._jump_unless_in_a_handler(address, registers, code):
            assert time.monotonic() < deadline, "it is always in an interrupt's handler"

    def _jump_unless_in_a_handler(self, address: int, registers: Sequence[int], code: Sequence[int]) -> bool:
        """True when done. Who leaves a handler for good gets no further interrupt."""
        with self._door() as wire:
            idle = self._word(wire, _RUNNING_PRIORITY) == _IDLE
            if idle:
                if code:
                    data = b"".join(word.to_bytes(4, "little") for word in code)
                    self._ask(wire, f"M{address:x},{len(data):x}:{data.hex()}", b"$OK#")
                values = {**dict(enumerate(registers)), STATUS: _SYSTEM_MODE, _PC: address}
                for number, value in values.items():
                    self._ask(wire, f"P{number:x}={value.to_bytes(4, 'little').hex()}", b"$OK#")
            self._ask(wire, "D", b"$OK#")
        return idle

    def word(self, address: int) -> int:
        """What the processor would read there."""
        with self._door() as wire:
            value = self._word(wire, address)
            self._ask(wire, "D", b"$OK#")
        return value

    def _word(self, wire: socket.socket, address: int) -> int:
        return int.from_bytes(bytes.fromhex(self._ask(wire, f"m{address:x},4", b"#", of_memory=True)), "little")

    def register(self, number: int) -> int:
        """What a register of the processor holds; STATUS is CPSR."""
        with self._door() as wire:
            answer = self._ask(wire, f"p{number:x}", b"#", of_memory=True)
            self._ask(wire, "D", b"$OK#")
        return int.from_bytes(bytes.fromhex(answer), "little")

    @contextmanager
    def _door(self) -> Iterator[socket.socket]:
        with self._open(self._debug_path) as wire:
            # It lets no one set registers who has not asked which there are; its answer to that comes after it has
            # said that it stopped.
            self._ask(wire, "qXfer:features:read:target.xml:0,fff", b"</target>#")
            yield wire

    @staticmethod
    def _ask(wire: socket.socket, text: str, expected: bytes, of_memory: bool = False) -> str:
        wire.settimeout(LIMIT_S / 4)
        wire.sendall(f"${text}#{sum(text.encode()) % 256:02x}".encode())
        answer = b""
        while expected not in answer or (of_memory and _MEMORY.search(answer) is None):
            try:
                answer += wire.recv(4096)
            except TimeoutError:
                raise AssertionError(f"the debugger's door answers {answer!r} to {text}") from None
        wire.sendall(b"+")
        found = _MEMORY.search(answer)
        return found[1].decode() if of_memory and found else ""


def address_of(symbol: str) -> int:
    """Where the ELF has a symbol."""
    listing = subprocess.run(
        ["arm-none-eabi-nm", str(BUILD / "touchdown.elf")], capture_output=True, text=True, check=True
    ).stdout
    (found,) = [line.split()[0] for line in listing.splitlines() if line.split()[-1] == symbol]
    return int(found, 16)


@contextmanager
def running(folder: Path) -> Iterator[Board]:
    """A board that has just been powered up."""
    qemu = shutil.which("qemu-system-arm")
    assert qemu is not None, "qemu-system-arm is not installed; run make setup"
    make("elf")
    command = [
        *(qemu, "-M", "xilinx-zynq-a9", "-m", "512M", "-display", "none", "-nodefaults", "-monitor", "none"),
        *("-serial", "null", "-chardev", f"socket,id=u1,path={folder / 'uart1'},server=on,wait=off"),
        *("-serial", "chardev:u1", "-gdb", f"unix:path={folder / 'gdb'},server=on,wait=off"),
        *("-kernel", str(BUILD / "touchdown.elf")),
    ]
    process = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    try:
        yield Board(folder, process)
    finally:
        process.kill()
        process.wait()

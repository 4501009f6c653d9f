# SPDX-License-Identifier: Apache-2.0
"""Builds, C unit tests, constants, and the ELF on QEMU's Zynq without programmable logic."""

import re
import shutil
import subprocess
import time
from pathlib import Path

import pytest

from firmware.library import BUILD, ROOT, decode, make
from golden import pad_geometry

BOOT_LIMIT_S = 60.0
NO_HARDWARE = "Touchdown: no landing_core, load the bitstream"


def test_unit_tests() -> None:
    """C unit tests under the address and undefined-behaviour sanitizers. Replay: make -C firmware test."""
    output = make("test")
    assert re.search(r"unit_tests: [1-9]\d* checks, 0 failures", output), output


def test_pad_geometry_is_golden() -> None:
    header = (ROOT / "firmware" / "core" / "pad_geometry.h").read_text()
    defined = {
        name: float(value) for name, value in re.findall(r"^#define (\w+_MM) \(?(-?[\d.]+)\)?$", header, re.MULTILINE)
    }
    expected = {
        name: value
        for name, value in vars(pad_geometry).items()
        if name.endswith("_MM") and not name.startswith("PAPER_")
    }
    assert defined == expected


def test_a_reading_is_fresh_as_long_as_the_hardware_says() -> None:
    header = (ROOT / "firmware/core/fusion.h").read_text()
    hardware = (ROOT / "rtl/lidar_pwm/lidar_pwm.v").read_text()
    (limit,) = re.findall(r"^#define FUSION_LIDAR_MAX_AGE_US (\d+)U$", header, re.MULTILINE)
    assert re.findall(r"parameter MAX_AGE_US = (\d+)", hardware) == [limit]


def test_core_knows_no_board() -> None:
    """No header of the board, no address and no heap in the part that also runs elsewhere."""
    for source in sorted((ROOT / "firmware" / "core").glob("*.[ch]")):
        text = source.read_text()
        for included in re.findall(r'#include "([^"]+)"', text):
            assert not (ROOT / "firmware" / "board" / included).exists(), f"{source.name} includes {included}"
        assert not re.search(r"\b(malloc|calloc|realloc|free)\s*\(", text), f"{source.name} uses the heap"


def test_elf_is_reproducible(tmp_path: Path) -> None:
    """Same sources, another folder, headers generated anew: the same bytes."""
    make("elf")
    make("elf", f"OUT={tmp_path / 'out'}", f"MAVLINK={tmp_path / 'mavlink'}")
    assert (tmp_path / "out" / "touchdown.elf").read_bytes() == (BUILD / "touchdown.elf").read_bytes()


@pytest.fixture(scope="module")
def qemu() -> str:
    path = shutil.which("qemu-system-arm")
    if path is None:
        pytest.fail("qemu-system-arm is not installed; run make setup")
    return path


def boot(qemu: str, elf: Path, folder: Path, enough: int) -> tuple[bytes, bytes, str]:
    """Run the ELF until UART1 has sent `enough` bytes.

    Returns:
        What UART0 and UART1 sent, and what the CPU then sees at address 0 and at the first instruction.
    """
    uarts = [folder / "uart0.bin", folder / "uart1.bin"]
    command = [
        *(qemu, "-M", "xilinx-zynq-a9", "-m", "512M", "-icount", "shift=1,sleep=off"),
        *("-display", "none", "-nodefaults", "-monitor", "stdio"),
        *(option for uart in uarts for option in ("-serial", f"file:{uart}")),
        *("-kernel", str(elf)),
    ]
    pipe = subprocess.PIPE
    process = subprocess.Popen(command, stdin=pipe, stdout=pipe, stderr=pipe, text=True)
    try:
        deadline = time.monotonic() + BOOT_LIMIT_S
        while not (uarts[1].exists() and uarts[1].stat().st_size >= enough):
            assert process.poll() is None, f"QEMU ended: {process.stderr.read() if process.stderr else ''}"
            assert time.monotonic() < deadline, f"UART1 sent less than {enough} bytes in {BOOT_LIMIT_S} s"
            time.sleep(0.05)
        monitor, _ = process.communicate("x /1wx 0\nx /1wx 0x100000\nquit\n", timeout=BOOT_LIMIT_S)
    finally:
        process.kill()
        process.wait()
    return uarts[0].read_bytes(), uarts[1].read_bytes(), monitor


def whole(data: bytes) -> bytes:
    """What was sent before QEMU was stopped, without a message cut off at its end."""
    place = 0
    while place + 12 <= len(data) and place + 12 + data[place + 1] <= len(data):
        place += 12 + data[place + 1]
    return data[:place]


def test_boot_without_hardware(qemu: str, tmp_path: Path) -> None:
    """The ID reads 0: the ground station is told why, heartbeats say CRITICAL, and nothing claims a distance."""
    make("elf")
    uart0, uart1, monitor = boot(qemu, BUILD / "touchdown.elf", tmp_path, 2000)
    assert "Cannot access memory" in monitor, f"the MMU does not catch null pointers: {monitor}"
    assert re.search(r"00100000: 0x[0-9a-f]{8}", monitor), f"the MMU does not map the code: {monitor}"
    autopilot, ground = decode(whole(uart0)), decode(whole(uart1))
    assert {message.get_type() for message in autopilot} == {"HEARTBEAT"}
    assert {message.get_type() for message in ground} == {"HEARTBEAT", "STATUSTEXT"}
    for message in (*autopilot, *ground):
        assert (message.get_srcSystem(), message.get_srcComponent()) == (1, 191)
        if message.get_type() == "HEARTBEAT":
            assert (message.type, message.autopilot, message.system_status) == (18, 8, 5)
    texts = [message.text for message in ground if message.get_type() == "STATUSTEXT"]
    assert texts[0] == "Touchdown: started"
    assert len(texts) > 5
    assert set(texts[1:]) == {NO_HARDWARE}
    assert [message.get_seq() for message in ground] == [index % 256 for index in range(len(ground))]

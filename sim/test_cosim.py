# SPDX-License-Identifier: Apache-2.0
"""Pixels in, UART bytes out: the board's ELF on QEMU with the verilated hardware, and the same firmware on the host."""

import os
import subprocess
import time
from pathlib import Path

import numpy as np
import pytest
from pymavlink.dialects.v20 import common as mavlink

from golden.generated.landing_regs import FRAME_SIZE_OFFSET, HEADER_FLAGS_THRESHOLDS_MISSING_MASK
from scripts.errors import UserError
from sim.cosim.build import build_firmware, build_plugin
from sim.cosim.frame_list import write_frame_list
from sim.cosim.qemu import find_qemu, qemu_command
from sim.cosim.result import CosimResult, Uart, read_result
from sim.cosim.run import run_cosim
from sim.world.camera import Camera
from sim.world.clip import demo_clip, images

# A quarter of the camera's resolution: just above the ground the pad is still large enough for its shapes.
WIDTH, HEIGHT = 320, 180
FRAME_PERIOD_US = 10_000
MESSAGE_BYTES = 12  # of a MAVLink 2 frame without its payload
BITS_A_BYTE = 10


def clip() -> tuple[list[np.ndarray], list[int]]:
    """The end of a descent as a small camera sees it, and altitudes in millimetres."""
    frames = demo_clip(40, Camera().scaled(4))[-3:]
    return list(images(frames)), [round(frame.pose.altitude_m * 1000) for frame in frames]


def run(firmware: str, out_dir: Path) -> CosimResult:
    """One run of the small clip."""
    frames, altitudes = clip()
    return run_cosim(
        frames, altitudes, firmware=firmware, repeat=2, out_dir=out_dir, frame_period_us=FRAME_PERIOD_US, tail_us=20_000
    )


@pytest.fixture(scope="module")
def on_qemu(tmp_path_factory: pytest.TempPathFactory) -> CosimResult:
    """The board's ELF."""
    return run("qemu", tmp_path_factory.mktemp("qemu"))


@pytest.fixture(scope="module")
def on_host(tmp_path_factory: pytest.TempPathFactory) -> CosimResult:
    """The firmware compiled for this machine."""
    return run("host", tmp_path_factory.mktemp("host"))


def messages(uart: Uart) -> list[tuple[int, mavlink.MAVLink_message]]:
    """Each message and the index of its last byte; a wrong checksum fails the test."""
    parser = mavlink.MAVLink(None)
    found = []
    for index, byte in enumerate(uart.data):
        message = parser.parse_char(bytes([byte]))
        if message is not None:
            assert message.get_type() != "BAD_DATA", f"byte {index} of the UART: {message}"
            found.append((index, message))
    return found


def landing_targets(result: CosimResult) -> list[tuple[int, mavlink.MAVLink_message]]:
    """The LANDING_TARGETs, and the index of the last byte of each."""
    return [(index, message) for index, message in messages(result.uart0) if message.get_type() == "LANDING_TARGET"]


def test_two_runs_give_the_same_bytes(on_qemu: CosimResult, tmp_path: Path) -> None:
    again = run("qemu", tmp_path)
    for name in ("uart0.bin", "uart1.bin", "events.txt", "records.bin"):
        assert (tmp_path / name).read_bytes() == (on_qemu.out_dir / name).read_bytes(), f"{name} differs between runs"
    assert again.simulated_ns == on_qemu.simulated_ns


def test_what_qemu_sends_is_what_is_logged(on_qemu: CosimResult) -> None:
    assert (on_qemu.out_dir / "uart0.bin").read_bytes() == on_qemu.uart0.data
    assert (on_qemu.out_dir / "uart1.bin").read_bytes() == on_qemu.uart1.data


def test_every_frame_has_its_record(on_qemu: CosimResult) -> None:
    assert [frame.index for frame in on_qemu.frames] == list(range(6))
    for frame in on_qemu.frames:
        assert frame.record is not None, f"frame {frame.index} has no record"
        header = frame.record["header"]
        assert header["frame_number"] == frame.index + 1
        missing = bool(header["flags"] & HEADER_FLAGS_THRESHOLDS_MISSING_MASK)
        assert missing == (frame.index == 0)
        assert (header["frame_size_width"], header["frame_size_height"]) == (WIDTH, HEIGHT)
        assert abs(int(header["start_time_us"]) - frame.first_pixel_ns // 1000) <= 1
        assert frame.last_pixel_ns < frame.record_ns < frame.last_pixel_ns + 100_000
    assert len(on_qemu.irq_ns) == 6


def test_frames_keep_the_asked_period(on_qemu: CosimResult) -> None:
    starts = np.array([frame.first_pixel_ns for frame in on_qemu.frames])
    line_us = (WIDTH + 370) / 74.25
    assert np.all(np.abs(np.diff(starts) / 1000 - FRAME_PERIOD_US) <= line_us)


def test_the_pad_becomes_a_landing_target(on_qemu: CosimResult) -> None:
    targets = landing_targets(on_qemu)
    # All but the first frame, which has no thresholds.
    started = [int(frame.record["header"]["start_time_us"]) for frame in on_qemu.frames[1:]]
    assert [message.time_usec for _, message in targets] == started
    latencies_ns = {
        frame.index: int(on_qemu.uart0.done_ns[index]) - frame.last_pixel_ns
        for (index, _), frame in zip(targets, on_qemu.frames[1:], strict=True)
    }
    assert all(0 < latency_ns < 5_000_000 for latency_ns in latencies_ns.values()), f"ns, by frame: {latencies_ns}"
    # From picture to picture the clip jumps; where one is shown again, the pad is where it was.
    tracked_ns = [latencies_ns[index] for index in (3, 5)]
    assert max(tracked_ns) <= 2_000_000, f"ns, by frame: {latencies_ns}"
    assert max(tracked_ns) - min(tracked_ns) <= 100_000, f"ns, by frame: {latencies_ns}"


def test_bytes_take_their_time_on_the_wire(on_qemu: CosimResult) -> None:
    for uart, baud in ((on_qemu.uart0, 921_600), (on_qemu.uart1, 57_600)):
        byte_ns = BITS_A_BYTE * 1e9 / baud
        gaps = np.diff(uart.done_ns)
        assert np.all(gaps > 0.98 * byte_ns), "bytes overlap on the wire"
        assert np.all(uart.done_ns - uart.push_ns > 0.98 * byte_ns)
        assert np.median(gaps) < 1.02 * byte_ns, "the firmware does not keep the wire busy within a message"


def test_the_host_finds_the_same(on_qemu: CosimResult, on_host: CosimResult) -> None:
    """Same targets but for time: firmware on the host needs none, so its hardware starts earlier."""

    def without_time(result: CosimResult) -> list[dict[str, object]]:
        return [{**message.to_dict(), "time_usec": 0} for _, message in landing_targets(result)]

    assert without_time(on_host) == without_time(on_qemu)
    assert len(without_time(on_host)) == 5


def test_the_firmware_still_receives(tmp_path: Path) -> None:
    """A TIMESYNC request to UART0 is answered, although the plugin stands before the FIFO register."""
    for suffix in ("in", "out"):
        os.mkfifo(tmp_path / f"uart0.{suffix}")
    request = mavlink.MAVLink(None, srcSystem=1, srcComponent=1)
    asked_ns = 123_456_789_012
    frames = write_frame_list(tmp_path / "frames.tdf", [np.zeros((16, 16, 3), np.uint8)], [1000], repeat=6)
    arguments = {"frames": frames.path, "out": tmp_path, "frame-clocks": 500_000, "tail-us": 5000}
    command = qemu_command(find_qemu(), build_firmware(), build_plugin(), arguments, tmp_path)
    command[command.index(f"file:{tmp_path / 'uart0.bin'}")] = f"pipe:{tmp_path / 'uart0'}"
    with (tmp_path / "uart0.in").open("r+b", buffering=0) as line:
        qemu = subprocess.Popen(command)
        # QEMU drops what comes before the firmware has set up its UART; a frame on the wire means that it has.
        while qemu.poll() is None and b"\nlast 0" not in _bytes_of(tmp_path / "events.txt"):
            time.sleep(0.01)
        line.write(request.timesync_encode(0, asked_ns).pack(request))
        assert qemu.wait(timeout=300) == 0
    replies = [message for _, message in messages(read_result(tmp_path, 0).uart0) if message.get_type() == "TIMESYNC"]
    assert [reply.ts1 for reply in replies] == [asked_ns]
    assert replies[0].tc1 > 0


def _bytes_of(path: Path) -> bytes:
    return path.read_bytes() if path.exists() else b""


def _qemu_that_says(text: str, folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    script = folder / "qemu-system-arm"
    script.write_text(f"#!/bin/sh\necho '{text}'\n")
    script.chmod(0o755)
    monkeypatch.setenv("PATH", str(folder))


def test_missing_qemu_is_one_sentence(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("PATH", str(tmp_path))
    with pytest.raises(UserError, match=r"^qemu-system-arm is not installed: install Debian 12's package .*\.$"):
        run("qemu", tmp_path / "out")


@pytest.mark.parametrize("text", ["QEMU emulator version 10.0.2 (Debian)", "gibberish"])
def test_unknown_qemu_is_one_sentence(text: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    _qemu_that_says(text, tmp_path, monkeypatch)
    with pytest.raises(
        UserError, match=r"install Debian 12's package qemu-system-arm \(7\.2\), or use FIRMWARE=host\.$"
    ):
        run("qemu", tmp_path / "out")


# What a firmware must not do, and what the run says of it. PL is where landing_core stands.
PL = "ldr r0, =0x43C00000\n"
WRONG_FIRMWARE = [
    pytest.param(
        "",
        "the firmware did not enable the camera input within 20 ms; look at its messages on UART1.",
        id="hangs",
    ),
    pytest.param(
        f"{PL} ldr r1, =720 << 16 | 1279\n str r1, [r0, #{FRAME_SIZE_OFFSET}]\n",
        f"the firmware wrote {720 << 16 | 1279} to FRAME_SIZE and not {720 << 16 | 1280}, "
        "the 1280x720 of the board's camera.",
        id="writes-a-wrong-size",
    ),
    pytest.param(
        f"{PL} ldr r1, [r0, #0x100]\n",
        "landing_core refuses the CPU's read at register offset 0x100: a data abort on the board.",
        id="reads-beyond-the-registers",
    ),
    pytest.param(
        f"{PL} str r1, [r0, #0xffc]\n",
        "landing_core refuses the CPU's write at register offset 0xffc: a data abort on the board.",
        id="writes-beyond-the-registers",
    ),
]


@pytest.mark.parametrize(("code", "sentence"), WRONG_FIRMWARE)
def test_a_wrong_firmware_is_one_sentence(code: str, sentence: str, tmp_path: Path) -> None:
    source, elf = tmp_path / "wrong.S", tmp_path / "wrong.elf"
    source.write_text(f"_start: {code} b .\n")
    flags = ["-nostdlib", "-mcpu=cortex-a9", "-Ttext", "0x100000"]
    subprocess.run(["arm-none-eabi-gcc", *flags, "-o", str(elf), str(source)], check=True)
    frames = write_frame_list(tmp_path / "frames.tdf", [np.zeros((16, 16, 3), np.uint8)], [1000])
    arguments = {"frames": frames.path, "out": tmp_path, "frame-clocks": 0, "tail-us": 0}
    command = qemu_command(find_qemu(), elf, build_plugin(), arguments, tmp_path)
    process = subprocess.run(command, capture_output=True, text=True, check=False, timeout=300)
    assert process.returncode == 1
    assert process.stderr.splitlines()[-1] == f"touchdown: {sentence}"


FRAME = np.zeros((HEIGHT, WIDTH, 3), np.uint8)


@pytest.mark.parametrize(
    ("frames", "altitudes", "sentence"),
    [
        ([], [], "there are no frames to show"),
        ([FRAME, FRAME], [1000], "there is no altitude for frame 1"),
        ([FRAME], [-1], "the altitude of frame 0 is -1 mm"),
        ([FRAME], [50_000], "the altitude of frame 0 is 50000 mm"),
        ([FRAME[..., 0]], [1000], "give uint8 RGB"),
        ([FRAME.astype(np.float32)], [1000], "give uint8 RGB"),
        ([np.zeros((721, 1280, 3), np.uint8)], [1000], "frame 0 is 1280x721"),
        ([FRAME, FRAME[1:]], [1000, 1000], "give one size"),
    ],
)
def test_unusable_frames_are_one_sentence(
    frames: list[np.ndarray], altitudes: list[int], sentence: str, tmp_path: Path
) -> None:
    with pytest.raises(UserError, match=sentence):
        run_cosim(frames, altitudes, firmware="host", out_dir=tmp_path)


def test_what_the_autopilot_says_has_its_limits(tmp_path: Path) -> None:
    with pytest.raises(UserError, match="65 bytes come with frame 1; give at most 64"):
        run_cosim([FRAME] * 2, [1000] * 2, firmware="host", out_dir=tmp_path, from_autopilot=[b"", bytes(65)])
    with pytest.raises(UserError, match="use FIRMWARE=host"):
        run_cosim([FRAME], [1000], firmware="qemu", out_dir=tmp_path, from_autopilot=[bytes(1)])


def test_unknown_firmware_is_one_sentence(tmp_path: Path) -> None:
    with pytest.raises(UserError, match=r"^unknown firmware 'board'; choose one of: qemu, host\.$"):
        run_cosim([FRAME], [1000], firmware="board", out_dir=tmp_path)

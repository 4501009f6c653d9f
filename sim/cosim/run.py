# SPDX-License-Identifier: Apache-2.0
"""Runs frames through landing_core and the firmware: pixels in, UART bytes out."""

import subprocess
import time
from collections.abc import Callable, Iterable
from pathlib import Path

import numpy as np

from scripts.errors import UserError
from sim.cosim.build import ROOT, build_firmware, build_host, build_plugin
from sim.cosim.frame_list import FrameList, write_frame_list
from sim.cosim.qemu import find_qemu, last_sentence, qemu_command
from sim.cosim.result import CosimResult, read_result

FIRMWARES = ("qemu", "host")
PIX_HZ = 74_250_000
POLL_S = 0.1
STALL_S = 300


def _say(text: str) -> None:
    print(text, flush=True)


def _command(
    firmware: str, frames: FrameList, out_dir: Path, *, frame_period_us: int, tail_us: int, ground_baud: int | None
) -> list[str]:
    arguments = {
        "frames": frames.path,
        "out": out_dir,
        "frame-clocks": frame_period_us * PIX_HZ // 1_000_000,
        "tail-us": tail_us,
    }
    if firmware == "host":
        return [str(build_host()), *(f"{key}={value}" for key, value in arguments.items())]
    qemu = find_qemu()
    return qemu_command(qemu, build_firmware(ground_baud), build_plugin(), arguments, out_dir)


def _shown(events: Path) -> int:
    """Frames that were shown whole so far."""
    return events.read_bytes().count(b"\nlast ") if events.exists() else 0


def _follow(process: subprocess.Popen, events: Path, frames: int, progress: Callable[[str], None]) -> None:
    """Wait for the process and report each frame.

    Raises:
        UserError: no frame passed for a long time.
    """
    shown = 0
    moved = time.monotonic()
    while process.poll() is None:
        time.sleep(POLL_S)
        now = _shown(events)
        if now != shown:
            shown = now
            moved = time.monotonic()
            progress(f"co-simulation: frame {shown} of {frames}")
        elif time.monotonic() - moved > STALL_S:
            process.kill()
            process.wait()
            raise UserError(f"the co-simulation made no progress for {STALL_S} s and was stopped at frame {shown}.")


def run_cosim(
    frames: Iterable[np.ndarray],
    altitudes_mm: Iterable[int],
    *,
    firmware: str = "qemu",
    repeat: int = 1,
    out_dir: Path = ROOT / "build" / "cosim" / "run",
    frame_period_us: int = 0,
    tail_us: int = 30_000,
    from_autopilot: Iterable[bytes] = (),
    ground_baud: int | None = None,
    progress: Callable[[str], None] = _say,
) -> CosimResult:
    """Show frames to the verilated landing_core and run the firmware on what it finds.

    Args:
        frames: uint8 RGB of shape (height, width, 3), one size of at most 1280x720; taken one at a time.
        altitudes_mm: what the LiDAR measures during each frame; 0 = no return.
        firmware: "qemu" runs the board's ELF on QEMU's Zynq, "host" the same sources compiled for this machine.
        repeat: how often each frame is shown in a row. Result frame i is given frame i // repeat.
        out_dir: where the run leaves its files; made if needed.
        frame_period_us: least time from frame to frame; 0 = what 720p60 blanking gives (16667 us at 1280x720).
        tail_us: simulated time after the last pixel.
        from_autopilot: what the autopilot says on UART0 before the record of each frame; with firmware="host" alone.
        ground_baud: of UART1, with firmware="qemu"; None = what the board has.
        progress: is told in one line how far the run is.

    Raises:
        UserError: what was given is wrong, a tool is missing or of the wrong version, or the run failed.
    """
    if firmware not in FIRMWARES:
        raise UserError(f"unknown firmware '{firmware}'; choose one of: {', '.join(FIRMWARES)}.")
    messages = list(from_autopilot)
    if firmware == "qemu" and any(messages):
        raise UserError("what the autopilot says does not reach QEMU; use FIRMWARE=host for it.")
    out_dir = out_dir.resolve()
    if "," in str(out_dir):
        raise UserError(f"the output folder {out_dir} has a comma in its name; choose one without.")
    out_dir.mkdir(parents=True, exist_ok=True)
    for name in ("events.txt", "records.bin", "uart0.bin", "uart1.bin"):
        (out_dir / name).unlink(missing_ok=True)
    if firmware == "qemu":
        find_qemu()
    frame_list = write_frame_list(out_dir / "frames.tdf", frames, altitudes_mm, repeat, messages)
    progress(f"co-simulation: building what is missing (firmware: {firmware})")
    command = _command(
        firmware, frame_list, out_dir, frame_period_us=frame_period_us, tail_us=tail_us, ground_baud=ground_baud
    )
    progress(f"co-simulation: {frame_list.shown} frames of {frame_list.width}x{frame_list.height}")
    start = time.monotonic()
    log = out_dir / "run.log"
    with log.open("w") as output:
        process = subprocess.Popen(command, cwd=ROOT, stdin=subprocess.DEVNULL, stdout=output, stderr=subprocess.STDOUT)
        try:
            _follow(process, out_dir / "events.txt", frame_list.shown, progress)
        finally:
            if process.poll() is None:
                process.kill()
                process.wait()
    if process.returncode != 0:
        if sentence := last_sentence(log):
            raise UserError(sentence)
        raise UserError(f"the co-simulation ended with code {process.returncode}; look at {log}.")
    frame_list.path.unlink()
    return read_result(out_dir, time.monotonic() - start)

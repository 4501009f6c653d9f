# SPDX-License-Identifier: Apache-2.0
"""What a run of the co-simulation gave. Times are nanoseconds of simulated time since reset."""

from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
import numpy.typing as npt

from golden.generated.landing_regs import RECORD_DTYPE
from scripts.errors import UserError


@dataclass(frozen=True)
class Uart:
    """Bytes that the firmware sent on one UART."""

    data: bytes = field(repr=False)
    push_ns: npt.NDArray[np.int64] = field(repr=False)
    """When each byte was written to the UART."""
    done_ns: npt.NDArray[np.int64] = field(repr=False)
    """When the stop bit of each byte ended on the wire, at the baud rate that the firmware set."""


@dataclass(frozen=True)
class Frame:
    """One frame on the wire. `record` is a `RECORD_DTYPE` scalar; it and its time are None where none was written."""

    index: int
    first_pixel_ns: int
    last_pixel_ns: int
    record: np.void | None = field(repr=False)
    record_ns: int | None


@dataclass(frozen=True)
class CosimResult:
    """Frames, UART bytes and how long the run took."""

    frames: list[Frame] = field(repr=False)
    uart0: Uart
    uart1: Uart
    irq_ns: npt.NDArray[np.int64] = field(repr=False)
    """When the interrupt of the programmable logic rose."""
    simulated_ns: int
    wall_s: float
    out_dir: Path


def _uart(events: list[list[str]], port: int) -> Uart:
    lines = [event for event in events if event[0] == "uart" and event[1] == str(port)]
    return Uart(
        bytes(int(event[4], 16) for event in lines),
        np.array([int(event[2]) for event in lines], np.int64),
        np.array([int(event[3]) for event in lines], np.int64),
    )


def read_result(out_dir: Path, wall_s: float) -> CosimResult:
    """Read what sim/cosim/run_log.cpp left in `out_dir`.

    Raises:
        UserError: the run did not come to its end.
    """
    events = [line.split() for line in (out_dir / "events.txt").read_text(encoding="ascii").splitlines()]
    if not events or events[-1][0] != "end":
        raise UserError(f"the co-simulation stopped before its end; look at {out_dir / 'run.log'}.")
    first = {int(event[1]): int(event[2]) for event in events if event[0] == "first"}
    last = {int(event[1]): int(event[2]) for event in events if event[0] == "last"}
    record_ns = [int(event[1]) for event in events if event[0] == "record"]
    records = np.fromfile(out_dir / "records.bin", RECORD_DTYPE)
    # Frames are numbered from 1 as they start at the enabled camera, and the camera waits until it is enabled.
    written = zip(records, record_ns, strict=True)
    of_frame = {int(record["header"]["frame_number"]) - 1: (record, time) for record, time in written}
    frames = [Frame(i, first[i], last[i], *of_frame.get(i, (None, None))) for i in sorted(last)]
    irq_ns = np.array([int(event[2]) for event in events if event[0] == "irq" and event[1] == "1"], np.int64)
    return CosimResult(frames, _uart(events, 0), _uart(events, 1), irq_ns, int(events[-1][1]), wall_s, out_dir)

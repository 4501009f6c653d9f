# SPDX-License-Identifier: Apache-2.0
"""Joins what was streamed with what the firmware said: one row a frame."""

from dataclasses import dataclass

import numpy as np

from scripts.demo_decode import Line, Message, pad_report
from scripts.errors import UserError
from scripts.frames import FrameSet
from sim.cosim.result import Frame
from sim.world.pose import Truth, wrap_degrees


@dataclass(frozen=True)
class Pad:
    """Where the firmware saw the pad."""

    x_px: float
    y_px: float
    angle_deg: float
    right_m: float
    forward_m: float


@dataclass(frozen=True)
class Row:
    """One frame of the source.

    Attributes:
        name: The frame's name.
        pad: None where no pad was found.
        altitude_m: The firmware's altitude; None where it had none.
        target: The LANDING_TARGET that went to the autopilot for this frame.
        latency_us: From the last pixel to the last byte of that message on the wire.
        record: The result record, `RECORD_DTYPE`.
        truth: What is exactly true, where that is known.
    """

    name: str
    pad: Pad | None
    altitude_m: float | None
    target: Message | None
    latency_us: float | None
    record: np.void
    truth: Truth | None

    @property
    def objects(self) -> np.ndarray:
        """The objects the hardware reported, `OBJECT_DTYPE`."""
        return self.record["objects"][: int(self.record["header"]["object_count"])]

    @property
    def error_px(self) -> float | None:
        """Distance from the true image of the ring's centre."""
        if self.pad is None or self.truth is None:
            return None
        return float(np.hypot(self.pad.x_px - self.truth.x_px, self.pad.y_px - self.truth.y_px))

    @property
    def error_deg(self) -> float | None:
        """Difference to the true angle, without sign."""
        if self.pad is None or self.truth is None:
            return None
        return abs(wrap_degrees(self.pad.angle_deg - self.truth.angle_deg))

    @property
    def error_m(self) -> float | None:
        """Distance from the true offset over the ground."""
        if self.pad is None or self.truth is None:
            return None
        return float(np.hypot(self.pad.right_m - self.truth.right_m, self.pad.forward_m - self.truth.forward_m))


def showings(frames: FrameSet) -> tuple[int, list[int]]:
    """How the camera shows the frames.

    Thresholds come from the frame before. Pictures that have nothing to do with
    each other are therefore shown twice, and the second time counts; a clip or a
    video is shown as it is, after one more showing of its first frame.

    Returns:
        (repeat, counted): how often each frame is shown in a row, and for each frame the showing that counts.
    """
    count = len(frames.names)
    if frames.sequential:
        return 1, list(range(1, count + 1))
    return 2, list(range(1, 2 * count, 2))


def collect(frames: FrameSet, counted: list[int], shown: list[Frame], autopilot: Line, ground: Line) -> list[Row]:
    """One row for each frame.

    Args:
        frames: The source.
        counted: For each frame the showing that counts, an index into `shown`.
        shown: All showings, in order.
        autopilot: UART0.
        ground: UART1.

    Raises:
        UserError: hardware or firmware said nothing about a frame, so the run failed.
    """
    # Both messages carry the time of the frame's first pixel, which is its name in hardware and firmware.
    reports = {message.fields["time_usec"]: report for message in ground.messages if (report := pad_report(message))}
    targets = {message.fields["time_usec"]: message for message in autopilot.of("LANDING_TARGET")}
    rows = []
    for name, truth, showing in zip(frames.names, frames.truths, counted, strict=True):
        if showing >= len(shown):
            raise UserError(f"frame {name} was not shown; look at the log of the run.")
        record = shown[showing].record
        if record is None:
            raise UserError(f"the hardware wrote no result record for frame {name}; look at the log of the run.")
        time_us = int(record["header"]["start_time_us"])
        if time_us not in reports:
            raise UserError(f"the firmware sent no PAD message for frame {name}; look at the log of the run.")
        report, target = reports[time_us], targets.get(time_us)
        if bool(report["found"]) != (target is not None):
            raise UserError(f"PAD and LANDING_TARGET disagree about frame {name}; look at the log of the run.")
        rows.append(
            Row(
                name=name,
                pad=_pad(report),
                altitude_m=report["altitude_m"] or None,
                target=target,
                latency_us=(target.done_ns - shown[showing].last_pixel_ns) / 1000.0 if target else None,
                record=record,
                truth=truth,
            )
        )
    return rows


def _pad(report: dict[str, float]) -> Pad | None:
    if not report["found"]:
        return None
    return Pad(report["x_px"], report["y_px"], report["angle_deg"], report["right_m"], report["forward_m"])


def describe_target(target: Message | None) -> str:
    """LANDING_TARGET in a few words."""
    if target is None:
        return "none"
    fields = target.fields
    return (
        f"LANDING_TARGET #{target.sequence} "
        f"x {fields['angle_x']:+.4f} y {fields['angle_y']:+.4f} rad, {fields['distance']:.3f} m"
    )

# SPDX-License-Identifier: Apache-2.0
"""Writes the frame list that the C++ camera shows; sim/verilated/frame_list.h has the layout."""

import struct
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from scripts.errors import UserError

MAGIC = b"TDF1"
HEADER_BYTES = 20
ALTITUDE_BYTES = 4
MAX_MESSAGE_BYTES = 64
HD = (1280, 720)
FULL_HD = (1920, 1080)
MIN_SIDE = 16
MAX_ALTITUDE_MM = 40_000


@dataclass(frozen=True)
class FrameList:
    """A frame list on disk: size of a frame, how many it holds, and how often each is shown in a row."""

    path: Path
    width: int
    height: int
    count: int
    repeat: int

    @property
    def shown(self) -> int:
        """Frames on the wire."""
        return self.count * self.repeat


def _checked(index: int, frame: np.ndarray, shape: tuple[int, ...] | None, most: tuple[int, int]) -> np.ndarray:
    if frame.dtype != np.uint8 or frame.ndim != 3 or frame.shape[2] != 3:
        raise UserError(f"frame {index} is {frame.dtype} {frame.shape}; give uint8 RGB of shape (height, width, 3).")
    height, width = frame.shape[:2]
    if not (MIN_SIDE <= width <= most[0] and MIN_SIDE <= height <= most[1]):
        raise UserError(f"frame {index} is {width}x{height}; the hardware takes 16x16 to {most[0]}x{most[1]}.")
    if shape is not None and frame.shape != shape:
        raise UserError(f"frame {index} is {width}x{height} and frame 0 is {shape[1]}x{shape[0]}; give one size.")
    return np.ascontiguousarray(frame)


def write_frame_list(
    path: Path,
    frames: Iterable[np.ndarray],
    altitudes_mm: Iterable[int],
    repeat: int = 1,
    from_autopilot: Iterable[bytes] = (),
    *,
    most: tuple[int, int] = HD,
) -> FrameList:
    """Write frames and their altitudes as they come; no more than one frame is held in memory.

    Args:
        path: file to write.
        frames: uint8 RGB, (height, width, 3), all of one size.
        altitudes_mm: what the LiDAR measures during each frame, in millimetres; 0 = no return.
        repeat: how often each frame is shown in a row.
        from_autopilot: what the autopilot says before the record of each frame; none where these come to their end.
        most: width and height for which the hardware is built.

    Raises:
        UserError: no frames, a frame of wrong shape or size, too few altitudes, an altitude out of range, or too much
            that the autopilot says.
    """
    if repeat < 1:
        raise UserError(f"repeat is {repeat}; show each frame at least once.")
    count = 0
    shape = None
    altitudes = iter(altitudes_mm)
    messages = list(from_autopilot)
    for index, message in enumerate(messages):
        if len(message) > MAX_MESSAGE_BYTES:
            raise UserError(f"{len(message)} bytes come with frame {index}; give at most {MAX_MESSAGE_BYTES}.")
    with path.open("wb") as file:
        file.write(bytes(HEADER_BYTES))
        for frame in frames:
            pixels = _checked(count, frame, shape, most)
            shape = pixels.shape
            altitude = next(altitudes, None)
            if altitude is None:
                raise UserError(f"there is no altitude for frame {count}; give one a frame.")
            if not 0 <= altitude <= MAX_ALTITUDE_MM:
                raise UserError(f"the altitude of frame {count} is {altitude} mm; the LiDAR sees 0 to 40000 mm.")
            file.write(struct.pack("<I", round(altitude)))
            file.write(pixels.tobytes())
            count += 1
        if shape is None:
            raise UserError("there are no frames to show; give at least one.")
        if any(messages):
            for index in range(count):
                message = messages[index] if index < len(messages) else b""
                file.write(struct.pack(f"<I{MAX_MESSAGE_BYTES}s", len(message), message))
        file.seek(0)
        file.write(MAGIC + struct.pack("<4I", shape[1], shape[0], count, repeat))
    return FrameList(path, shape[1], shape[0], count, repeat)


def read_frame_list(frames: FrameList) -> Iterator[np.ndarray]:
    """The frames of a list in the order in which they are shown; uint8 (height, width, 3), read-only."""
    size = ALTITUDE_BYTES + frames.height * frames.width * 3
    data = np.memmap(frames.path, np.uint8, "r", HEADER_BYTES, (frames.count, size))
    for index in range(frames.shown):
        pixels = data[index // frames.repeat, ALTITUDE_BYTES:]
        yield pixels.reshape(frames.height, frames.width, 3)

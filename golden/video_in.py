# SPDX-License-Identifier: Apache-2.0
"""Model of `video_in`: from samples of raw video, one a cycle of `pix_clk`, to frames, faults and measured size.

It knows no clock ratio and no FIFO: what comes out while the FIFO is never full.
"""

from dataclasses import dataclass, field

import numpy as np
import numpy.typing as npt


@dataclass
class CapturedFrame:
    """One frame that started at the camera while enabled."""

    number: int
    """From 1; counts every such frame."""
    width: int
    """Configured pixels a line, sampled with the first pixel."""
    height: int
    """Configured lines, sampled with the first pixel."""
    pixels: npt.NDArray[np.uint32]
    """RGB of the pixels before the fault in raster order, shape (n,); all of them if there was none."""
    malformed: bool
    """Whether a fault was seen. The last frame of the samples may be neither malformed nor complete."""


@dataclass
class Captured:
    """What `video_in` makes of a sequence of samples."""

    frames: list[CapturedFrame] = field(default_factory=list)
    """In order, also those without a pixel (illegal size)."""
    measured_size: tuple[int, int] = (0, 0)
    """Pixels in the last line, and lines, of the last frame that was ended by vsync."""

    @property
    def malformed(self) -> int:
        """Number of malformed frames."""
        return sum(frame.malformed for frame in self.frames)


def _runs(de: npt.NDArray[np.bool_]) -> list[tuple[int, int]]:
    """Return (first, end) of each run of samples with data enable: the lines."""
    edges = np.flatnonzero(np.diff(np.concatenate([[False], de, [False]]).astype(np.int8)))
    return [(int(first), int(end)) for first, end in edges.reshape(-1, 2)]


def _judge(lines: list[npt.NDArray[np.uint32]], width: int, height: int, ended: int) -> tuple[list[int], bool]:
    """Return the pixels before the first fault and whether there is one.

    `ended` is 2 if vsync ended the frame, 1 if only its last line has ended, 0 if the samples stop within that line.
    """
    pixels: list[int] = []
    for index, line in enumerate(lines):
        if index == height:
            return pixels, True
        pixels += line[:width].tolist()
        line_ended = ended > 0 or index < len(lines) - 1
        if line.size > width or (line.size < width and line_ended):
            return pixels, True
    return pixels, ended == 2 and len(lines) < height


def video_in(
    data: npt.ArrayLike,
    de: npt.ArrayLike,
    vsync: npt.ArrayLike,
    width: npt.ArrayLike,
    height: npt.ArrayLike,
    *,
    enable: npt.ArrayLike = True,
    max_size: tuple[int, int] = (1280, 720),
    vsync_active: bool = True,
) -> Captured:
    """Return what comes out of `video_in`.

    Args:
        data: RGB, uint32 of shape (n,); counts only where `de` is set.
        de: data enable, bool of shape (n,).
        vsync: level of vsync, bool of shape (n,). Its level in the last pixel of a line is its idle level.
        width: configured pixels a line, a number or one for each sample, shape (n,).
        height: configured lines, likewise.
        enable: configured enable, likewise.
        max_size: `MAX_WIDTH` and `MAX_HEIGHT`; a frame of an illegal configured size is malformed at its first pixel.
        vsync_active: `VSYNC_ACTIVE`, the active level expected before the first pixel.

    Raises:
        ValueError: the arrays differ in shape.
    """
    data, de, vsync = np.asarray(data, np.uint32), np.asarray(de, np.bool_), np.asarray(vsync, np.bool_)
    if not data.shape == de.shape == vsync.shape:
        raise ValueError("data, de and vsync must have one value for each sample.")
    widths, heights = np.broadcast_to(width, de.shape), np.broadcast_to(height, de.shape)
    enables = np.broadcast_to(enable, de.shape)
    captured = Captured()
    runs = _runs(de)
    idle, gap_start = not vsync_active, 0
    groups: list[tuple[int, list[tuple[int, int]]]] = []
    # A line that follows vsync opens a group, unless vsync stays where it is: then its polarity was another one.
    in_frame = False
    endings: list[bool] = []
    for first, end in runs:
        if bool(np.any(vsync[gap_start:first] != idle)):
            if in_frame:
                endings.append(True)
            in_frame = bool(vsync[first] == idle)
            if in_frame:
                groups.append((first, []))
        if in_frame:
            groups[-1][1].append((first, end))
        idle, gap_start = bool(vsync[end - 1]), end
    if in_frame:
        endings.append(bool(np.any(vsync[gap_start:] != idle)))
    for (first, lines), ended in zip(groups, endings, strict=True):
        last_first, last_end = lines[-1]
        if ended:
            captured.measured_size = (last_end - last_first, len(lines))
        if not enables[first]:
            continue
        size = int(widths[first]), int(heights[first])
        state = 2 if ended else int(last_end < de.size)
        if 0 < size[0] <= max_size[0] and 0 < size[1] <= max_size[1]:
            pixels, malformed = _judge([data[a:b] for a, b in lines], *size, state)
        else:
            pixels, malformed = [], True
        captured.frames.append(
            CapturedFrame(len(captured.frames) + 1, *size, np.array(pixels, dtype=np.uint32), malformed)
        )
    return captured

# SPDX-License-Identifier: Apache-2.0
"""What `frame_source` makes of memory: bytes of a picture to frames, and the places of a frame on the pixel clock."""

from dataclasses import dataclass

import numpy as np

BLANK = 0x202020
"""Colour of pixels that were not there in time."""
PIXEL_BYTES = 4


@dataclass(frozen=True)
class Places:
    """Sizes of raw video: pixels a line, then porch, sync and total; the same in lines. The default is 720p."""

    width: int = 1280
    h_front: int = 110
    h_sync: int = 40
    h_total: int = 1650
    height: int = 720
    v_front: int = 5
    v_sync: int = 5
    v_total: int = 750

    def at(self, cycle: int) -> tuple[int, int, int]:
        """(de, hsync, vsync) so many cycles after the first pixel of a frame."""
        y, x = divmod(cycle % (self.h_total * self.v_total), self.h_total)
        of_line, of_frame = x - self.width - self.h_front, y - self.height - self.v_front
        return (
            int(x < self.width and y < self.height),
            int(0 <= of_line < self.h_sync),
            int(0 <= of_frame < self.v_sync),
        )


def memory_of(rgb: np.ndarray) -> bytes:
    """Bytes of a picture as they lie in memory: B, G, R, 0 of each pixel, line after line.

    Args:
        rgb: (height, width, 3) uint8, R first.
    """
    height, width = rgb.shape[:2]
    pixels = np.zeros((height, width, PIXEL_BYTES), np.uint8)
    pixels[..., :3] = rgb[..., ::-1]
    return pixels.tobytes()


def frame_of(memory: bytes, width: int, height: int) -> np.ndarray:
    """The frame that is played: (height, width) uint32, 0xRRGGBB.

    Args:
        memory: From the base on, at least the picture.
        width: Pixels.
        height: Lines.
    """
    words = np.frombuffer(memory, "<u4", width * height)
    return (words & 0xFFFFFF).astype(np.uint32).reshape(height, width)


def shown(frame: np.ndarray, in_time: int | None = None) -> np.ndarray:
    """The frame on the wire, as long as `frame` is, flat.

    Args:
        frame: (height, width) uint32.
        in_time: How many pixels from the first were there in time; None = all.
    """
    out = frame.ravel().copy()
    if in_time is not None:
        out[in_time:] = BLANK
    return out

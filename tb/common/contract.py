# SPDX-License-Identifier: Apache-2.0
"""Model of the frame contract in docs/design.md: which frames a sequence of beats contains, and how many faults."""

from dataclasses import dataclass, field

import numpy as np

from tb.common.stream import Beat, unpack


@dataclass
class SentFrame:
    """Pixels of one frame up to its fault, `ppc` a beat; complete if there was none."""

    width: int
    height: int
    pixels: list[int] = field(default_factory=list)
    ppc: int = 1

    @property
    def complete(self) -> bool:
        """Whether all pixels came."""
        return len(self.pixels) == self.width * self.height

    @property
    def last_expected(self) -> int:
        """`tlast` that the next beat must have."""
        return int(len(self.pixels) % self.width == self.width - self.ppc)

    def image(self) -> np.ndarray:
        """Return the frame as an integer array (height, width), missing pixels 0."""
        values = np.zeros(self.width * self.height, np.int64)
        values[: len(self.pixels)] = self.pixels
        return values.reshape(self.height, self.width)


@dataclass(frozen=True)
class SizeLimits:
    """Frame sizes a core takes, ends included. A frame of another size is malformed from its first pixel on."""

    min_width: int
    min_height: int
    max_width: int
    max_height: int

    def allow(self, width: int, height: int) -> bool:
        """Return whether a frame of this size is legal."""
        return self.min_width <= width <= self.max_width and self.min_height <= height <= self.max_height


def sent_frames(beats: list[Beat], limits: SizeLimits, bits: int = 0, ppc: int = 1) -> tuple[list[SentFrame], int]:
    """Return the frames in the beats, in order, and the number of `frame_error` pulses.

    Frames whose first pixel is already faulty are left out: nothing of them may appear. `size` of the latest beat that
    has one is the configured size. A beat holds `ppc` pixels of `bits` bits; a width is a multiple of that many.
    """
    frames: list[SentFrame] = []
    errors = 0
    size = (0, 0)
    current: SentFrame | None = None
    silent = True
    for beat in beats:
        size = beat.size or size
        if beat.user:
            early = current is not None and not current.complete
            current = SentFrame(*size, ppc=ppc)
            good = limits.allow(*size) and size[0] % ppc == 0 and beat.last == int(size[0] == ppc)
            errors += early or not good
            silent = not good
            if good:
                current.pixels += unpack([beat.data], bits, ppc)
                frames.append(current)
            else:
                current = None
        elif silent:
            continue
        elif current is None or current.complete or beat.last != current.last_expected:
            errors += 1
            current, silent = None, True
        else:
            current.pixels += unpack([beat.data], bits, ppc)
    return frames, errors

# SPDX-License-Identifier: Apache-2.0
"""The bytes that `result_writer` leaves in memory for a frame, and the ring that it leaves behind."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np

from golden.generated.landing_regs import (
    HEADER_DTYPE,
    HEADER_FLAGS_ALTITUDE_VALID_MASK,
    HEADER_FLAGS_OBJECTS_OVERFLOW_MASK,
    HEADER_FLAGS_THRESHOLDS_MISSING_MASK,
    HEADER_FLAGS_THRESHOLDS_STALE_MASK,
    HEADER_ID_MAGIC,
    HEADER_ID_VERSION,
    OBJECT_DTYPE,
    RECORD_MAX_OBJECTS,
    RING_BUFFERS,
    RING_STRIDE_BYTES,
)

FLAGS = {
    "thresholds_missing": HEADER_FLAGS_THRESHOLDS_MISSING_MASK,
    "thresholds_stale": HEADER_FLAGS_THRESHOLDS_STALE_MASK,
    "altitude_valid": HEADER_FLAGS_ALTITUDE_VALID_MASK,
}


def record(values: Mapping[str, int], objects: np.ndarray, max_objects: int = RECORD_MAX_OBJECTS) -> bytes:
    """Return one record: the header and the objects that fit.

    Args:
        values: members of `HEADER_DTYPE` that are given from outside, and the flags named in `FLAGS` as 0 or 1.
        objects: structured array of `OBJECT_DTYPE`, any length; those after `max_objects` are dropped and counted.
        max_objects: room of a buffer.
    """
    kept = objects[:max_objects]
    dropped = len(objects) - len(kept)
    header = np.zeros((), HEADER_DTYPE)
    for name in HEADER_DTYPE.names:
        header[name] = values.get(name, 0)
    header["id_version"] = HEADER_ID_VERSION
    header["id_magic"] = HEADER_ID_MAGIC
    header["flags"] = sum(mask for name, mask in FLAGS.items() if values.get(name, 0))
    if dropped:
        header["flags"] |= HEADER_FLAGS_OBJECTS_OVERFLOW_MASK
    header["object_count"] = len(kept)
    header["objects_dropped"] = dropped
    return header.tobytes() + kept.astype(OBJECT_DTYPE).tobytes()


@dataclass(frozen=True)
class Frame:
    """What the writer sees of one frame.

    `complete` is False when no trailer came before the next first beat; `write_error` is True when a memory write of
    the frame was answered with an error.
    """

    values: Mapping[str, int]
    objects: np.ndarray = field(repr=False)
    complete: bool = True
    write_error: bool = False


@dataclass(frozen=True)
class Published:
    """A record that software may read: byte offset from the ring base, buffer index, frame number, bytes."""

    offset: int
    index: int
    frame_number: int
    data: bytes = field(repr=False)


@dataclass(frozen=True)
class Outcome:
    """What a sequence of frames leaves: records in order, frames lost, and frames whose writes failed."""

    published: list[Published]
    unwritten: int
    errors: int


def run(frames: Sequence[Frame], max_objects: int = RECORD_MAX_OBJECTS) -> Outcome:
    """Return what is published for `frames`; a lost frame leaves its buffer to the next one."""
    published: list[Published] = []
    for frame in frames:
        if frame.complete and not frame.write_error:
            index = len(published) % RING_BUFFERS
            data = record(frame.values, frame.objects, max_objects)
            published.append(Published(index * RING_STRIDE_BYTES, index, frame.values["frame_number"], data))
    return Outcome(published, len(frames) - len(published), sum(frame.write_error for frame in frames))

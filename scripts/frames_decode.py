# SPDX-License-Identifier: Apache-2.0
"""Decodes a picture, and refuses one that is not whole: OpenCV would show the part that is there, and gray below."""

import os
import sys
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from typing import IO

import cv2
import numpy as np

DAMAGE = (b"Corrupt JPEG data", b"Premature end of JPEG", b"CRC error")
"""What libjpeg and libpng say of a damaged file; they have more to say of some that are whole."""


@contextmanager
def _stderr_of_libraries() -> Iterator[IO[bytes]]:
    """Where the decoders' own words go meanwhile; they know no other way than file descriptor 2."""
    sys.stderr.flush()
    with tempfile.TemporaryFile() as said:
        before = os.dup(2)
        os.dup2(said.fileno(), 2)
        try:
            yield said
        finally:
            os.dup2(before, 2)
            os.close(before)


def _has_its_end(data: bytes) -> bool:
    """False for an empty file, and for a JPEG or PNG that was cut off."""
    if data.startswith(b"\xff\xd8"):
        return data.rfind(b"\xff\xd9") > data.rfind(b"\xff\xda")
    if data.startswith(b"\x89PNG"):
        return b"IEND" in data[-12:]
    return bool(data)


def decode_picture(data: bytes) -> np.ndarray | None:
    """A picture as (height, width, 3) uint8 BGR; None if the file is none, or cut off, or damaged within."""
    if not _has_its_end(data):
        return None
    with _stderr_of_libraries() as said:
        picture = cv2.imdecode(np.frombuffer(data, np.uint8), cv2.IMREAD_COLOR)
        said.seek(0)
        words = said.read()
    return None if any(damage in words for damage in DAMAGE) else picture

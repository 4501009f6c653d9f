# SPDX-License-Identifier: Apache-2.0
"""The inputs that are kept for a fuzz target, in one file: of each its length, four bytes, little endian, then itself.

`firmware/fuzz/replay.c` reads the same.
"""

import hashlib
from pathlib import Path

from scripts.errors import UserError

ROOT = Path(__file__).resolve().parent.parent
LENGTH_BYTES = 4


def corpus_path(target: str) -> Path:
    """Where the kept inputs of a target are."""
    return ROOT / "firmware" / "fuzz" / "corpus" / f"{target}.packed"


def inputs_of(packed: bytes) -> list[bytes]:
    """The inputs in a packed corpus.

    Raises:
        UserError: it ends within an input.
    """
    inputs = []
    place = 0
    while place < len(packed):
        size = int.from_bytes(packed[place : place + LENGTH_BYTES], "little")
        place += LENGTH_BYTES
        if place + size > len(packed):
            raise UserError("the packed corpus ends within an input: restore it, or delete it and begin anew.")
        inputs.append(packed[place : place + size])
        place += size
    return inputs


def unpack(path: Path, folder: Path) -> int:
    """Write each input into a file of its own, named by its content; how many there are, 0 without a corpus."""
    inputs = inputs_of(path.read_bytes()) if path.is_file() else []
    for data in inputs:
        (folder / hashlib.sha1(data, usedforsecurity=False).hexdigest()).write_bytes(data)
    return len(inputs)


def packed_of(inputs: list[bytes]) -> bytes:
    """The inputs as one, in their order."""
    return b"".join(len(data).to_bytes(LENGTH_BYTES, "little") + data for data in inputs)


def pack(folder: Path, path: Path) -> int:
    """Put the files of a folder into one, short ones first; how many there are."""
    inputs = sorted((file.read_bytes() for file in folder.iterdir()), key=lambda data: (len(data), data))
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(packed_of(inputs))
    return len(inputs)

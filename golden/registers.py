# SPDX-License-Identifier: Apache-2.0
"""What the generated tables of registers are made of."""

from typing import NamedTuple


class Field(NamedTuple):
    """Bits of a register; access is "ro", "constant", "rw" or "w1c"; reset is 0 where hardware gives the value."""

    name: str
    lsb: int
    width: int
    access: str
    reset: int


class Register(NamedTuple):
    """One 32-bit register at a byte offset."""

    name: str
    offset: int
    fields: tuple[Field, ...]

# SPDX-License-Identifier: Apache-2.0
"""What the generated tables of registers are made of, and what software reads back from them."""

from collections.abc import Mapping, Sequence
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


OKAY, SLVERR = 0, 2

State = dict[int, int]
"""Stored bits of each register, by offset."""


def reset_state(registers: Sequence[Register]) -> State:
    """Return the stored bits after reset: constants, reset values, cleared status."""
    return {register.offset: sum(field.reset << field.lsb for field in register.fields) for register in registers}


def mask(register: Register, *access: str) -> int:
    """Return the bits of a register that are of one of these kinds."""
    return sum(((1 << field.width) - 1) << field.lsb for field in register.fields if field.access in access)


def write(registers: Sequence[Register], state: State, address: int, data: int, strobes: int) -> tuple[State, int]:
    """Return the state after a write of 32 bits with 4 byte strobes, and the response."""
    offset = address & ~3
    if offset not in state:
        return state, SLVERR
    register, old = next(one for one in registers if one.offset == offset), state[offset]
    lanes = sum(0xFF << (8 * byte) for byte in range(4) if strobes >> byte & 1)
    stored = lanes & mask(register, "rw")
    cleared = data & lanes & mask(register, "w1c")
    return {**state, offset: ((old & ~stored) | (data & stored)) & ~cleared}, OKAY


def read(registers: Sequence[Register], state: State, address: int, inputs: Mapping[int, int]) -> tuple[int, int]:
    """Return the data and the response of a read.

    Args:
        registers: all of them.
        state: stored bits.
        address: byte address; the low two bits are ignored.
        inputs: what the hardware drives into the "ro" fields, as register words by offset.
    """
    offset = address & ~3
    if offset not in state:
        return 0, SLVERR
    register = next(one for one in registers if one.offset == offset)
    return state[offset] | (inputs.get(offset, 0) & mask(register, "ro")), OKAY

# SPDX-License-Identifier: Apache-2.0
"""What software reads back from the registers, from the generated table of fields."""

from collections.abc import Mapping

from golden.generated.landing_regs import REGISTERS, TIME_HI_OFFSET, TIME_LO_OFFSET, Register

OKAY, SLVERR = 0, 2
BY_OFFSET = {register.offset: register for register in REGISTERS}
IRQ_STATUS = next(register for register in REGISTERS if register.name == "IRQ_STATUS")
IRQ_ENABLE = next(register for register in REGISTERS if register.name == "IRQ_ENABLE")

State = dict[int, int]
"""Stored bits of each register, by offset."""


def reset_state() -> State:
    """Return the stored bits after reset: constants, reset values, cleared status."""
    return {register.offset: sum(field.reset << field.lsb for field in register.fields) for register in REGISTERS}


def _mask(register: Register, *access: str) -> int:
    return sum(((1 << field.width) - 1) << field.lsb for field in register.fields if field.access in access)


def write(state: State, address: int, data: int, strobes: int) -> tuple[State, int]:
    """Return the state after a write of 32 bits with 4 byte strobes, and the response."""
    offset = address & ~3
    if offset not in BY_OFFSET:
        return state, SLVERR
    register, old = BY_OFFSET[offset], state[offset]
    lanes = sum(0xFF << (8 * byte) for byte in range(4) if strobes >> byte & 1)
    stored = lanes & _mask(register, "rw")
    cleared = data & lanes & _mask(register, "w1c")
    return {**state, offset: ((old & ~stored) | (data & stored)) & ~cleared}, OKAY


def read(state: State, address: int, inputs: Mapping[int, int]) -> tuple[State, int, int]:
    """Return the state after a read, the data and the response.

    Args:
        state: stored bits.
        address: byte address; the low two bits are ignored.
        inputs: what the hardware drives into the "ro" fields, as register words by offset.
    """
    offset = address & ~3
    if offset not in BY_OFFSET:
        return state, 0, SLVERR
    if offset == TIME_LO_OFFSET:
        state = {**state, TIME_HI_OFFSET: inputs[TIME_HI_OFFSET]}
    if offset == TIME_HI_OFFSET:
        return state, state[offset], OKAY
    return state, state[offset] | (inputs.get(offset, 0) & _mask(BY_OFFSET[offset], "ro")), OKAY


def set_status(state: State, events: int) -> State:
    """Return the state after hardware events, a mask of `IRQ_STATUS`; they win over a clear in the same clock."""
    return {**state, IRQ_STATUS.offset: state[IRQ_STATUS.offset] | (events & _mask(IRQ_STATUS, "w1c"))}


def interrupt(state: State) -> bool:
    """Return whether an enabled status bit is set."""
    return bool(state[IRQ_STATUS.offset] & state[IRQ_ENABLE.offset])

# SPDX-License-Identifier: Apache-2.0
"""What software reads back from the registers of landing_core, from the generated table of fields."""

from collections.abc import Mapping

from golden import registers
from golden.generated.landing_regs import REGISTERS, TIME_HI_OFFSET, TIME_LO_OFFSET
from golden.registers import OKAY, SLVERR, State

__all__ = ["OKAY", "SLVERR", "State"]
IRQ_STATUS = next(register for register in REGISTERS if register.name == "IRQ_STATUS")
IRQ_ENABLE = next(register for register in REGISTERS if register.name == "IRQ_ENABLE")


def reset_state() -> State:
    """Return the stored bits after reset."""
    return registers.reset_state(REGISTERS)


def write(state: State, address: int, data: int, strobes: int) -> tuple[State, int]:
    """Return the state after a write of 32 bits with 4 byte strobes, and the response."""
    return registers.write(REGISTERS, state, address, data, strobes)


def read(state: State, address: int, inputs: Mapping[int, int]) -> tuple[State, int, int]:
    """Return the state after a read, the data and the response.

    Args:
        state: stored bits.
        address: byte address; the low two bits are ignored.
        inputs: what the hardware drives into the "ro" fields, as register words by offset.
    """
    offset = address & ~3
    if offset == TIME_LO_OFFSET:
        state = {**state, TIME_HI_OFFSET: inputs[TIME_HI_OFFSET]}
    # TIME_HI gives what it has kept, not what the hardware says now.
    now = {} if offset == TIME_HI_OFFSET else inputs
    return state, *registers.read(REGISTERS, state, address, now)


def set_status(state: State, events: int) -> State:
    """Return the state after hardware events, a mask of `IRQ_STATUS`; they win over a clear in the same clock."""
    return {**state, IRQ_STATUS.offset: state[IRQ_STATUS.offset] | (events & registers.mask(IRQ_STATUS, "w1c"))}


def interrupt(state: State) -> bool:
    """Return whether an enabled status bit is set."""
    return bool(state[IRQ_STATUS.offset] & state[IRQ_ENABLE.offset])

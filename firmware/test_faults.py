# SPDX-License-Identifier: Apache-2.0
"""Each way into a fault, on QEMU's Zynq: what it says at once and at the next start, and that it has a stack.

QEMU never answers an access late, so what a processor does then on its own is done by hand: it leaves its reason,
changes its mode and goes to a vector.
"""

from collections.abc import Iterator
from pathlib import Path

import pytest

from firmware.qemu_board import FREE, STATUS, Board, address_of, running

UNMAPPED = 0x8000_0000
MASK_INTERRUPTS, TAKE_R0_FOR_STACK = 0xF10C_0080, 0xE1A0_D000
UNDEFINED, LOAD_AT_R0, SUPERVISOR_CALL = 0xE7F0_00F0, 0xE590_1000, 0xEF00_0000
R0_IS_THE_REASON, ENTER_ABORT_MODE, CAME_FROM_R2, IN_STATE_R1, GO_TO_R3 = (
    *(0xEE05_0F10, 0xF10E_01D7, 0xE1A0_E002, 0xE16F_F001, 0xE12F_FF13),
)
LATE, TRANSLATION = 0x406, 0x005
"""Reasons of data aborts, as DFSR has them."""
ON_DATA_ABORT = 0x10
"""In a table of vectors."""
SYSTEM_MODE, INTERRUPT_MODE, MODE = 0x5F, 0xD2, 0x1F
ABORTS_MASKED, INTERRUPTS_MASKED = 1 << 8, 1 << 7


@pytest.fixture
def board(tmp_path: Path) -> Iterator[Board]:
    with running(tmp_path) as one:
        one.wait_for("HEARTBEAT", "")
        yield one


def check_told(board: Board, text: str) -> None:
    """At once, and at the next start."""
    board.wait_for("STATUSTEXT", f"Touchdown: {text}")
    board.restart()
    board.wait_for("STATUSTEXT", "Touchdown: started")
    board.wait_for("STATUSTEXT", f"restarted: {text}")


@pytest.mark.parametrize(
    ("instruction", "kind"),
    [(UNDEFINED, "undefined instruction"), (LOAD_AT_R0, "data abort"), (SUPERVISOR_CALL, "supervisor call")],
)
def test_a_fault_is_told_with_its_own_address(board: Board, instruction: int, kind: str) -> None:
    """Its stack is not the main code's, which leads nowhere by then."""
    board.jump(FREE, [UNMAPPED], [MASK_INTERRUPTS, TAKE_R0_FOR_STACK, instruction])
    check_told(board, f"{kind} at {FREE + 8:08x}")


def abort_as_if(board: Board, reason: int, table: str) -> None:
    """A data abort that came before the instruction at FREE + 20, which is an undefined one."""
    code = [R0_IS_THE_REASON, ENTER_ABORT_MODE, CAME_FROM_R2, IN_STATE_R1, GO_TO_R3, UNDEFINED]
    board.jump(FREE, [reason, SYSTEM_MODE, FREE + 20 + 8, address_of(table) + ON_DATA_ABORT], code)


@pytest.mark.parametrize(("reason", "kind"), [(LATE, "asynchronous abort"), (TRANSLATION, "data abort")])
def test_a_late_answer_of_a_bus_is_told_as_such(board: Board, reason: int, kind: str) -> None:
    abort_as_if(board, reason, "vectors")
    check_told(board, f"{kind} at {FREE + 20:08x}")


def test_what_the_boot_loader_left_is_passed_over(board: Board) -> None:
    """It goes on where it was, in the mode it was in."""
    abort_as_if(board, LATE, "loader_vectors")
    check_told(board, f"undefined instruction at {FREE + 20:08x}")


def test_a_late_answer_is_let_in_while_it_runs(board: Board) -> None:
    """But while an interrupt is handled, which begins in a mode of its own: then it waits for the end of that."""
    states = [board.register(STATUS) for _ in range(20)]
    assert {state & MODE for state in states} <= {SYSTEM_MODE & MODE, INTERRUPT_MODE & MODE}, states
    assert [state for state in states if not state & ABORTS_MASKED], [f"{state:x}" for state in states]
    assert not [state for state in states if state & ABORTS_MASKED and not state & INTERRUPTS_MASKED]

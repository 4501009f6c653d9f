# SPDX-License-Identifier: Apache-2.0
"""The watchdog on QEMU's Zynq, which counts and never resets: who feeds it, and what the start after it says."""

import time
from collections.abc import Iterator
from pathlib import Path

import pytest

from firmware.qemu_board import FREE, LIMIT_S, Board, address_of, running

LOAD, COUNTER, CONTROL = 0xF8F0_0620, 0xF8F0_0624, 0xF8F0_0628
LOAD_VALUE = 325_000 * 500
"""Half a second at the board's PERIPHCLK; on QEMU, whose timers run at 100 MHz, 1.6 s."""
ENABLED = 0b1001
BRANCH_TO_ITSELF = 0xEAFF_FFFE
STORE_R3_AT_R2, STORE_R1_AT_R0, GO_TO_R4 = 0xE582_3000, 0xE580_1000, 0xE12F_FF14
STORE_R6_AT_R5, STORE_R7_AT_R5 = 0xE585_6000, 0xE585_7000
UART1_FIFO, MAVLINK_2, LONGEST = 0xE000_1030, 0xFD, 0xFF
SLCR_UNLOCK, UNLOCK_KEY, REBOOT_STATUS, BITTEN = 0xF800_0008, 0xDF0D, 0xF800_0258, 1 << 17
PAINT = 0x5AFE_57AC


@pytest.fixture
def board(tmp_path: Path) -> Iterator[Board]:
    with running(tmp_path) as one:
        one.wait_for("HEARTBEAT", "")
        yield one


def test_a_healthy_loop_feeds_it(board: Board) -> None:
    assert (board.word(LOAD), board.word(CONTROL)) == (LOAD_VALUE, ENABLED)
    counts = []
    for _ in range(20):
        time.sleep(0.1)
        counts.append(board.word(COUNTER))
    # Half a second of the board's time has passed often; a round of the loop takes a millisecond, and this machine is
    # busy.
    assert min(counts) > 0, counts
    assert sorted(counts)[len(counts) // 2] > LOAD_VALUE // 2, counts


def test_a_stuck_loop_does_not(board: Board) -> None:
    """Interrupts are on, the tick's among them: an interrupt alone feeds nothing."""
    ticks = address_of("ticks")
    board.jump(FREE, code=[BRANCH_TO_ITSELF])
    before = board.word(ticks)
    deadline = time.monotonic() + LIMIT_S
    while board.word(COUNTER) > 0:
        assert time.monotonic() < deadline, "it counts on"
        time.sleep(0.1)
    time.sleep(0.5)
    assert board.word(COUNTER) == 0
    assert board.word(ticks) > before


def test_a_crash_does_not(board: Board) -> None:
    board.jump(0x0000_0040)
    board.wait_for("STATUSTEXT", "Touchdown: prefetch abort at 00000040")
    deadline = time.monotonic() + LIMIT_S
    while board.word(COUNTER) > 0:
        assert time.monotonic() < deadline, "it counts on"
        time.sleep(0.1)


def test_the_next_start_says_so_once(board: Board) -> None:
    """The system's note of a reset by the watchdog is made by hand, then the start-up code runs.

    It is heard although the reset cut a message off after its length.
    """
    cut = [UART1_FIFO, MAVLINK_2, LONGEST]
    registers = [REBOOT_STATUS, BITTEN, SLCR_UNLOCK, UNLOCK_KEY, address_of("start"), *cut]
    board.jump(FREE, registers, [STORE_R3_AT_R2, STORE_R1_AT_R0, STORE_R6_AT_R5, STORE_R7_AT_R5, GO_TO_R4])
    board.wait_for("STATUSTEXT", "Touchdown: started")
    board.wait_for("STATUSTEXT", "restarted: watchdog")
    assert board.word(REBOOT_STATUS) == 0
    board.jump(address_of("start"))
    board.wait_for("STATUSTEXT", "Touchdown: started")
    board.wait_for("HEARTBEAT", "")
    board.wait_for("HEARTBEAT", "")
    assert not [message for message in board.said if "restarted" in str(message)]


def test_the_stack_is_painted(board: Board) -> None:
    """What was never used still is; what is in use is not."""
    bottom, top = address_of("stack_bottom"), address_of("stack_top")
    assert (top - bottom) == 32 * 1024
    assert board.word(bottom) == PAINT
    used = [address for address in range(top - 4, top - 256, -4) if board.word(address) != PAINT]
    assert used, "nothing was ever on the stack"

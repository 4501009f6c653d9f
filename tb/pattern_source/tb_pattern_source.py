# SPDX-License-Identifier: Apache-2.0
"""Clock and monitor for the tests of pattern_source, and what the monitor must see."""

from collections.abc import Iterable
from itertools import pairwise
from random import Random, getrandbits

import cocotb
import numpy as np
from cocotb.clock import Clock
from cocotb.handle import HierarchyObject, LogicArrayObject
from cocotb.triggers import RisingEdge, Timer, ValueChange
from cocotb.types import LogicArray
from cocotb.utils import get_sim_time

from golden.pattern_source import Timing, frame, syncs
from tb.common.figures import page_figures
from tb.common.run import four_state, parameter, where

TIMING = Timing(
    width=parameter("WIDTH", 1280),
    h_front=parameter("H_FRONT", 110),
    h_sync=parameter("H_SYNC", 40),
    h_total=parameter("H_TOTAL", 1650),
    height=parameter("HEIGHT", 720),
    v_front=parameter("V_FRONT", 5),
    v_sync=parameter("V_SYNC", 5),
    v_total=parameter("V_TOTAL", 750),
)
FRAME = TIMING.h_total * TIMING.v_total
"""Cycles of a frame."""
VSYNC = TIMING.h_total * (TIMING.height + TIMING.v_front)
"""Cycles from a frame's first pixel to its vsync."""
LATENCY, MOVE_AHEAD = page_figures("pattern_source")[:2]
CLOCK_PS = 10_000


class Bench:
    """Clock, inputs and monitor. The monitor wakes up when an output changes, so that a whole frame is not too long."""

    def __init__(self, dut: HierarchyObject) -> None:
        self.dut, self.rng = dut, Random(getrandbits(64))
        self._free = LogicArray("X") if four_state() else None
        dut.pix_rst.value = 1
        dut.move.value = 0
        cocotb.start_soon(Clock(dut.pix_clk, CLOCK_PS, unit="ps", impl="gpi").start(start_high=False))
        outputs = ((dut.out_de, 26), (dut.out_hsync, 25), (dut.out_vsync, 24), (dut.out_data, 0))
        # Of each output, when it changed, in ps, and what to; -1: unknown.
        self._changes: list[list[tuple[int, int]]] = [[(0, -1)] for _ in outputs]
        for (signal, shift), changes in zip(outputs, self._changes, strict=True):
            cocotb.start_soon(self._watch(signal, shift, changes))

    async def reset(self, cycles: int = 8) -> None:
        """Reset for so many cycles; the outputs are 0 from the next one on."""
        await RisingEdge(self.dut.pix_clk)
        self.dut.pix_rst.value = 1
        self._set_move(None)
        seen = await self.take(cycles)
        assert not seen[1:].any(), f"outputs {seen[1:].max():07X} in reset; {where()}"
        self.dut.pix_rst.value = 0

    async def take(self, cycles: int, moves: Iterable[bool] = ()) -> np.ndarray:
        """What is there at so many clock edges after this one.

        Args:
            cycles: How many.
            moves: What `move` is at the edge of each vsync after a reset; at all others it is unknown, or the opposite.

        Returns:
            int64: {de, hsync, vsync, data} of each.
        """
        begin = now = round(get_sim_time("ps"))
        for changes in self._changes:
            del changes[:-1]
        at = LATENCY + VSYNC - 1 - MOVE_AHEAD
        taken = list(moves)
        if taken:
            self._set_move(None, not taken[0])
        for move, following in pairwise([*taken, False]):
            if at + 2 >= cycles:
                break
            # Between two edges, to be there at the second.
            for edge, value in ((at, (move, move)), (at + 1, (None, not following))):
                await Timer(begin + edge * CLOCK_PS + CLOCK_PS // 2 - now, "ps")
                now = round(get_sim_time("ps"))
                self._set_move(*value)
            at += FRAME
        await Timer(begin + cycles * CLOCK_PS - CLOCK_PS // 2 - now, "ps")
        seen = np.zeros(cycles, np.int64)
        for changes in self._changes:
            # A value that comes after an edge is there at the next.
            first = [max((when - begin) // CLOCK_PS, 0) for when, _ in changes]
            values = [value for _, value in changes]
            assert -1 not in values[first.count(0) - 1 :], f"an output is unknown; {where()}"
            seen += np.repeat(values, np.diff([*first, cycles]))
        await RisingEdge(self.dut.pix_clk)
        return seen

    def _set_move(self, value: bool | None, otherwise: bool = False) -> None:
        """None: unknown, which not every simulator knows."""
        known = otherwise if value is None else value
        self.dut.move.value = self._free if value is None and self._free is not None else int(known)

    @staticmethod
    async def _watch(signal: LogicArrayObject, shift: int, changes: list[tuple[int, int]]) -> None:
        change = ValueChange(signal)
        while True:
            value = signal.value
            changes.append((round(get_sim_time("ps")), int(value) << shift if value.is_resolvable else -1))
            await change


def expected(moves: list[bool], cycles: int) -> np.ndarray:
    """Samples from the reset on, of as many cycles.

    Args:
        moves: What `move` was at the vsync of each frame but the last.
        cycles: How many.
    """
    de, hsync, vsync = np.moveaxis(syncs(TIMING).astype(np.int64), -1, 0)
    parts = [np.zeros(LATENCY, np.int64)]
    for number, move in enumerate([False, *moves]):
        samples = de << 26 | hsync << 25 | vsync << 24
        rgb = frame(number, move, TIMING.width, TIMING.height).astype(np.int64)
        samples[: TIMING.height, : TIMING.width] |= rgb[..., 0] << 16 | rgb[..., 1] << 8 | rgb[..., 2]
        parts.append(samples.ravel())
    return np.concatenate(parts)[:cycles]


def check(seen: np.ndarray, moves: list[bool]) -> None:
    """Assert that the samples from the reset on are what they must be."""
    wanted = expected(moves, len(seen))
    assert len(seen) == len(wanted), f"{len(seen)} samples were taken where {len(wanted)} are known"
    bad = np.flatnonzero(seen != wanted)
    if len(bad):
        number, within = divmod(int(bad[0]) - LATENCY, FRAME)
        y, x = divmod(within, TIMING.h_total)
        raise AssertionError(
            f"frame {number}, x {x}, y {y}: expected {{de, hsync, vsync, data}} {wanted[bad[0]]:07X}, "
            f"got {seen[bad[0]]:07X}; {len(bad)} of {len(seen)} differ; {where()}"
        )

# SPDX-License-Identifier: Apache-2.0
"""pattern_source against `golden.pattern_source`, cycle for cycle: pictures, syncs, the path, `move`, resets."""

import cocotb
import numpy as np
from cocotb.handle import HierarchyObject

from golden.pattern_source import travel
from tb.common.run import where
from tb.pattern_source.tb_pattern_source import FRAME, LATENCY, TIMING, Bench, check

IS_WHOLE = FRAME > 1_000_000
"""A frame as the camera sends it, of which there is time for one."""
PATH = 4 * max(travel(TIMING.width, TIMING.height))
IS_SMALL = PATH * FRAME < 60_000
FRAMES = 1 if IS_WHOLE else 2


@cocotb.test()
@cocotb.parametrize(move=[False, True])
async def pictures_and_syncs(dut: HierarchyObject, move: bool) -> None:
    """The first frames after a reset; of a whole one, with the pad where it stands and begins to travel, just that."""
    bench = Bench(dut)
    await bench.reset()
    moves = [move] * FRAMES
    seen = await bench.take(LATENCY + FRAMES * FRAME, moves)
    check(seen, moves)


@cocotb.test(skip=IS_WHOLE)
async def lengths(dut: HierarchyObject) -> None:
    """Of lines, frames, syncs and blanking, counted from the syncs alone."""
    bench = Bench(dut)
    await bench.reset()
    seen = (await bench.take(LATENCY + 2 * FRAME + TIMING.h_total, [False, False]))[LATENCY:]
    de, hsync, vsync = ((seen >> bit & 1).astype(np.int8) for bit in (26, 25, 24))

    def rises(signal: np.ndarray) -> np.ndarray:
        return np.flatnonzero(np.diff(signal, prepend=0) > 0)

    def falls(signal: np.ndarray) -> np.ndarray:
        return np.flatnonzero(np.diff(signal, prepend=0) < 0)

    lines = rises(de)
    assert (falls(de)[: len(lines)] - lines[: len(falls(de))] == TIMING.width).all(), where()
    assert set(np.diff(rises(hsync))) == {TIMING.h_total}, where()
    assert rises(hsync)[0] == TIMING.width + TIMING.h_front, where()
    assert set((falls(hsync) - rises(hsync)[: len(falls(hsync))]).tolist()) == {TIMING.h_sync}, where()
    assert lines[TIMING.height] - lines[0] == FRAME, where()
    assert rises(vsync)[0] == (TIMING.height + TIMING.v_front) * TIMING.h_total, where()
    assert falls(vsync)[0] - rises(vsync)[0] == TIMING.v_sync * TIMING.h_total, where()
    assert not (seen[de == 0] & 0xFFFFFF).any(), f"data in blanking; {where()}"


@cocotb.test(skip=not IS_SMALL)
async def the_whole_path(dut: HierarchyObject) -> None:
    """To both ends, back, and on as in the beginning."""
    bench = Bench(dut)
    await bench.reset()
    moves = [True] * (PATH + PATH // 4 + 2)
    seen = await bench.take(LATENCY + len(moves) * FRAME, moves)
    check(seen, moves)


@cocotb.test(skip=IS_WHOLE)
async def move_counts_when_it_is_taken(dut: HierarchyObject) -> None:
    """Once a frame, to the clock; the path goes on while the pad stands in the middle."""
    bench = Bench(dut)
    for _ in range(3 if IS_SMALL else 1):
        await bench.reset()
        moves = [True, False, True, True, *(bench.rng.random() < 0.5 for _ in range(8 if IS_SMALL else 0))]
        seen = await bench.take(LATENCY + len(moves) * FRAME + FRAME // 2, moves)
        check(seen, moves)


@cocotb.test(skip=IS_WHOLE)
async def reset_begins_anew(dut: HierarchyObject) -> None:
    """Anywhere in a frame, for a single cycle or more, also with the pad on its way."""
    bench = Bench(dut)
    for _ in range(20 if IS_SMALL else 4):
        await bench.reset(bench.rng.choice([2, 3, 9]))
        cycles = bench.rng.randint(1, FRAME * 3 // 2)
        moves = [True, True]
        check(await bench.take(cycles, moves), moves)

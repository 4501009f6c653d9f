# SPDX-License-Identifier: Apache-2.0
"""frame_source: whole frames, memory that is slow, sleeps or fails, cfg_* at any time, a stopped clock, resets."""

import cocotb
from cocotb.handle import HierarchyObject
from cocotb.triggers import RisingEdge

from tb.common.figures import page_figures
from tb.common.run import core_name, where
from tb.frame_source.tb_frame_source import (
    BEATS,
    BURSTS,
    CLK_NS,
    FIFO_DEPTH,
    FRAME_CYCLES,
    MAX_OUTSTANDING,
    PIXELS,
    PLACES,
    Bench,
    all_whole,
)

# Periods of pix_clk in ns, against 10 of clk. The last asks for more than memory gives where lines have no blanking.
PIX_NS = {"half": 20.0, "720p": 13.468, "near_equal": 10.002, "1080p": 6.734, "triple": 3.334}
IS_DENSE = PLACES.h_total < 2 * PLACES.width
HAS_BURSTS = BURSTS > 2


def clk_of(pix_cycles: float, bench: Bench) -> int:
    """So many cycles of pix_clk in cycles of clk."""
    return int(pix_cycles * bench.pix_ns / CLK_NS)


@cocotb.test()
@cocotb.parametrize(pix=list(PIX_NS), memory=["calm", "stormy"])
async def whole_frames(dut: HierarchyObject, pix: str, memory: str) -> None:
    """Every sync in its cycle, every pixel, and no underflow where memory is fast enough."""
    bench = Bench(dut, PIX_NS[pix])
    if memory == "stormy":
        bench.memory.latency = (1, 8)
        bench.memory.stall(0.3 if PIX_NS[pix] > CLK_NS else 0.1)
    await bench.reset()
    await bench.until(4)
    verdicts = bench.check()
    if not (IS_DENSE and PIX_NS[pix] < CLK_NS):
        all_whole(verdicts)
        assert bench.underflows.count == 0, f"underflow came {bench.underflows.count} times; {where()}"


@cocotb.test()
@cocotb.parametrize(pix=["half", "720p", "1080p"])
async def latency(dut: HierarchyObject, pix: str) -> None:
    """The first address of a frame is there as soon as the page says, and not much sooner."""
    of_pix, of_clk = page_figures(core_name())[:2]
    bench = Bench(dut, PIX_NS[pix])
    await bench.reset()
    await bench.until(4)
    all_whole(bench.check())
    slowest = 0.0
    for frame, run in zip(bench.frames, bench.runs(), strict=False):
        # The monitor sees a pixel at the end of its cycle.
        after = run[0].offered_ns - CLK_NS - (frame.seen_ns[-1] - bench.pix_ns) - of_pix * bench.pix_ns
        slowest = max(slowest, after / CLK_NS)
        assert after <= of_clk * CLK_NS, f"{after / CLK_NS:.2f} cycles of clk, not at most {of_clk}; {where()}"
    assert slowest > of_clk - 2, f"{slowest:.2f} cycles of clk, documented {of_clk}; {where()}"


@cocotb.test()
@cocotb.parametrize(attempt=list(range(4)))
async def memory_that_sleeps(dut: HierarchyObject, attempt: int) -> None:
    """At any time, for up to two frames: the rest of what is late is blank; what comes after it woke is whole."""
    bench = Bench(dut, list(PIX_NS.values())[attempt % 3])
    bench.memory.deaf = attempt % 2 == 1
    await bench.reset()
    late = 0
    for _ in range(3):
        await bench.clocks(bench.rng.randint(1, clk_of(FRAME_CYCLES, bench)))
        bench.memory.asleep = True
        await bench.clocks(bench.rng.randint(1, clk_of(2 * FRAME_CYCLES, bench)))
        bench.memory.asleep = False
        awake = len(bench.frames)
        await bench.until(awake + 2)
        verdicts = bench.check()
        assert verdicts[awake + 1].whole == PIXELS, f"frame {awake + 1} is not whole; {where()}"
        late = sum(not verdict.complete for verdict in verdicts)
    assert late, f"memory slept, and nothing was late; {where()}"


@cocotb.test()
async def a_pause_that_the_fifo_covers(dut: HierarchyObject) -> None:
    """Between the frames the FIFO is filled; then memory may sleep until it is empty, and no longer."""
    bench = Bench(dut)
    held = min(BEATS, FIFO_DEPTH + 1)
    await bench.reset()
    for extra in (0, 1):
        ended = len(bench.frames) + 1
        await bench.until(ended)
        # All of the blanking but the last cycles.
        while bench.syncs % FRAME_CYCLES != FRAME_CYCLES - 3:
            await RisingEdge(dut.pix_clk)
        taken = sum(len(burst.taken_ns) for burst in bench.runs()[-1])
        assert taken == held, f"{taken} beats were taken before the frame, not {held}; {where()}"
        bench.memory.asleep = True
        whole = (2 * held - 1) // PLACES.width * PLACES.h_total + (2 * held - 1) % PLACES.width
        pause = whole - 10 if not extra else PLACES.height * PLACES.h_total
        for _ in range(max(pause, 0)):
            await RisingEdge(dut.pix_clk)
        bench.memory.asleep = False
        await bench.until(ended + 1)
        late = extra if held < BEATS else 0
        assert bench.underflows.count == late, f"underflow came {bench.underflows.count} times, not {late}; {where()}"
        bench.underflows.count = 0
        await bench.until(ended + 2)
        assert bench.underflows.count == 0, f"the next frame is not whole; {where()}"


@cocotb.test()
@cocotb.parametrize(beat=["first", "any", "last"])
async def read_errors(dut: HierarchyObject, beat: str) -> None:
    """SLVERR on a burst: nothing more of the frame is read, its rest is blank, the next one is whole."""
    bench = Bench(dut)
    bad_frames = {1, 2, 4}
    read = -1
    which = 0

    def bad_beat(burst: object) -> int | None:
        nonlocal read, which
        if burst.address in bench.bases:
            read, which = read + 1, burst.number + bench.rng.randrange(BURSTS)
        if read not in bad_frames or burst.number != which:
            return None
        return {"first": 0, "last": burst.beats - 1, "any": bench.rng.randrange(burst.beats)}[beat]

    bench.memory.bad_beat = bad_beat
    await bench.reset()
    await bench.until(7)
    verdicts = bench.check()
    # The frame after reset is not read.
    wrong = [index - 1 for index, verdict in enumerate(verdicts) if index and verdict.whole != PIXELS]
    assert wrong == sorted(bad_frames), f"pictures {wrong} are not whole, expected {sorted(bad_frames)}; {where()}"
    after = [len(run) for index, run in enumerate(bench.runs()) if index in bad_frames]
    assert max(after) <= BURSTS, f"bursts {after} after an error; {where()}"


@cocotb.test()
async def two_errors_are_told_once(dut: HierarchyObject) -> None:
    """Also when the frame ends before the second one comes."""
    bench = Bench(dut)
    bench.memory.bad_beat = lambda burst: 0
    await bench.reset()
    for _ in range(3):
        await bench.until(len(bench.frames) + 1)
        bench.memory.latency = (1, 60)
    await bench.until(len(bench.frames) + 1)
    bench.memory.bad_beat = lambda burst: None
    awake = len(bench.frames)
    await bench.until(awake + 2)
    assert bench.check()[awake + 1].whole == PIXELS, f"the frame after errors is not whole; {where()}"


@cocotb.test(skip=not HAS_BURSTS)
async def an_error_ends_the_reading(dut: HierarchyObject) -> None:
    """Of a frame whose first burst fails at once, no more is asked for than was on the way."""
    bench = Bench(dut)
    bench.memory.bad_beat = lambda burst: 0 if burst.address in bench.bases else None
    await bench.reset()
    await bench.until(4)
    bench.check()
    lengths = [len(run) for run in bench.runs()]
    assert max(lengths) <= MAX_OUTSTANDING, f"{lengths} bursts a frame were asked for; {where()}"


@cocotb.test()
@cocotb.parametrize(memory=["calm", "sleepy"])
async def enable_at_any_moment(dut: HierarchyObject, memory: str) -> None:
    """A frame is the picture or black, by what was asked for before it; black ones are not read."""
    bench = Bench(dut)
    bench.configure(0, bench.bases[0])
    await bench.reset()
    await bench.until(2)
    assert not bench.memory.bursts, f"memory was read while disabled; {where()}"
    enable = 0
    for turn in range(8):
        enable = 1 - enable
        bench.configure(enable, bench.rng.choice(bench.bases))
        await bench.clocks(bench.rng.randint(1, clk_of(2 * FRAME_CYCLES, bench)))
        bench.memory.asleep = memory == "sleepy" and turn % 3 == 1
    bench.memory.asleep = False
    bench.configure(1, bench.bases[1])
    await bench.until(len(bench.frames) + 1)
    ended = len(bench.frames)
    bench.configure(0, bench.bases[0])
    await bench.until(ended + 2)
    verdicts = bench.check()
    assert verdicts[-1].off, f"a frame came while disabled; {where()}"
    assert {verdict.off for verdict in verdicts[1:]} == {True, False}, f"all frames are alike; {where()}"


@cocotb.test()
async def disabled_while_memory_sleeps(dut: HierarchyObject) -> None:
    """Black comes although bursts are under way, with no underflow; when they end, nothing of them is shown."""
    bench = Bench(dut)
    bench.memory.asleep = True
    await bench.reset()
    await bench.until(2)
    bench.configure(0, bench.bases[0])
    before = bench.underflows.count
    await bench.until(5)
    assert bench.underflows.count == before, f"underflow although disabled; {where()}"
    bench.memory.asleep = False
    bench.configure(1, bench.bases[2])
    await bench.until(8)
    verdicts = bench.check()
    assert [verdict.off for verdict in verdicts[2:5]] == [True] * 3, f"frames 2 to 4 are not black; {where()}"
    assert verdicts[-1].whole == PIXELS, f"the last frame is not whole; {where()}"


@cocotb.test()
async def base_at_any_moment(dut: HierarchyObject) -> None:
    """A frame comes from one base, that of its start, whatever the low bits say; pictures may end where memory does."""
    bench = Bench(dut)
    await bench.reset()
    for turn in range(8):
        bench.configure(1, bench.bases[turn % len(bench.bases)])
        await bench.clocks(bench.rng.randint(1, clk_of(2 * FRAME_CYCLES, bench)))
    await bench.until(len(bench.frames) + 1)
    verdicts = bench.check()
    all_whole(verdicts)
    assert len({verdict.base for verdict in verdicts}) > 2, f"the base never changed; {where()}"


@cocotb.test()
@cocotb.parametrize(pix=["720p", "1080p"])
async def a_clock_that_stops_changes_nothing(dut: HierarchyObject, pix: str) -> None:
    """At any cycle, and for longer than a frame; the picture goes on where it was."""
    bench = Bench(dut, PIX_NS[pix])
    await bench.reset()
    while len(bench.frames) < 4:
        for _ in range(bench.rng.randint(1, FRAME_CYCLES // 3)):
            await RisingEdge(dut.pix_clk)
        await bench.stop_clock(bench.rng.choice([1, 40, clk_of(FRAME_CYCLES, bench)]))
    await bench.until(4)
    verdicts = bench.check()
    if not (IS_DENSE and PIX_NS[pix] < CLK_NS):
        all_whole(verdicts)


@cocotb.test()
@cocotb.parametrize(stands=[False, True])
async def reset_at_any_moment(dut: HierarchyObject, stands: bool) -> None:
    """Within frames and bursts, with the memory, also while pix_clk stands still: it begins anew."""
    bench = Bench(dut)
    for _ in range(6):
        await (bench.reset_while_the_clock_stands() if stands else bench.reset(bench.rng.randint(1, 4)))
        bench.memory.latency = (1, bench.rng.choice([1, 30]))
        await bench.until(bench.rng.randint(1, 3))
        all_whole(bench.check())
        await bench.clocks(bench.rng.randint(0, clk_of(FRAME_CYCLES, bench)))


@cocotb.test(skip=not HAS_BURSTS)
async def bursts_on_the_way(dut: HierarchyObject) -> None:
    """As many as documented, and they cover the latency of memory."""
    bench = Bench(dut)
    bench.memory.asleep = True
    await bench.reset()
    await bench.until(2)
    assert bench.memory.most == min(MAX_OUTSTANDING, BURSTS), f"{bench.memory.most} bursts are under way; {where()}"
    bench.memory.asleep = False
    # A burst of 16 beats is 32 pixels; one may be in the making.
    bench.memory.latency = (clk_of(32, bench) * (MAX_OUTSTANDING - 1) - 24,) * 2
    await bench.until(6)
    verdicts = bench.check()
    assert [verdict.whole for verdict in verdicts[4:]] == [PIXELS] * 2, f"the last frames are not whole; {where()}"

# SPDX-License-Identifier: Apache-2.0
"""video_out: whole frames, missing, cut off and late ones, overflows, a stopped clock, resets, either polarity."""

from dataclasses import replace

import cocotb
from cocotb.handle import HierarchyObject
from cocotb.triggers import ClockCycles, RisingEdge

from tb.common.run import where
from tb.video_out.tb_video_out import ACTIVE, CLK_NS, DELAY, FIFO_DEPTH, Bench, Blanking, Sent, camera, pixels_of

# Periods of pix_clk in ns, against 10 of clk. With the last two the stream falls behind within a line.
PIX_NS = {"half": 20.0, "720p": 13.468, "near_equal": 10.002, "1080p": 6.734, "triple": 3.334}
IS_SMALL = DELAY < 1000
SHAPES = ["720p", "tight", "random"]
IN_TIME = 8
"""Cycles of pix_clk, and 3 of clk, by which a pixel must come before its place at the monitor."""


def blanking(bench: Bench, shape: str, gap: int = 4) -> Blanking:
    """Lines and frames with much, little or random blanking."""
    return {
        "720p": Blanking(gap, 20, 20, 60),
        "tight": Blanking(gap if gap > 4 else 1, 0, 1, 0),
        "random": Blanking(gap + 8, 60, 30, 60, None if gap > 4 else bench.rng),
    }[shape]


@cocotb.test()
@cocotb.parametrize(pix=list(PIX_NS), shape=SHAPES)
async def whole_frames(dut: HierarchyObject, pix: str, shape: str) -> None:
    bench = Bench(dut, PIX_NS[pix])
    await bench.reset()
    sizes = [(bench.rng.randint(1, 10), bench.rng.randint(1, 7)) for _ in range(6 if IS_SMALL else 3)]
    raw, frames = camera(bench.rng, sizes, blanking(bench, shape, 4 if PIX_NS[pix] >= CLK_NS else 40))
    await bench.play(raw, frames, [Sent()] * len(frames))
    bench.check(raw, [pixels_of(lines) for lines in frames])
    assert bench.blanks.count == 0, f"frame_blank pulsed {bench.blanks.count} times; {where()}"


@cocotb.test()
@cocotb.parametrize(shape=SHAPES)
async def the_other_polarity(dut: HierarchyObject, shape: str) -> None:
    """It is learnt from the first line; the frame of that may be blank."""
    bench = Bench(dut)
    await bench.reset()
    # A blank frame is given up until the camera's next vsync, so that must not come before the frame's turn.
    raw, frames = camera(bench.rng, [(7, 4)] * 4, replace(blanking(bench, shape), front=DELAY, rng=None), 1 - ACTIVE)
    await bench.play(raw, frames, [Sent()] * len(frames))
    first = pixels_of(frames[0])
    seen = [sample.data for sample in bench.seen if sample.de][: len(first)]
    expected = [first if seen == first else pixels_of(frames[0], 0), *(pixels_of(lines) for lines in frames[1:])]
    bench.check(raw, expected)


@cocotb.test()
@cocotb.parametrize(pix=["half", "720p", "near_equal"])
async def the_last_moment(dut: HierarchyObject, pix: str) -> None:
    """A frame that comes as late as the page allows is shown; one that comes when it should be shown is not."""
    bench = Bench(dut, PIX_NS[pix])
    await bench.reset()
    late = DELAY - IN_TIME - int(3 * CLK_NS / PIX_NS[pix]) - 1
    raw, frames = camera(bench.rng, [(5, 3)] * 5, Blanking(4, DELAY, 20, 60))
    sent = [Sent(), Sent(lag=late), Sent(lag=DELAY), Sent(lag=late), Sent()]
    await bench.play(raw, frames, sent)
    bench.check(
        raw, [pixels_of(lines, 0 if how.lag == DELAY else None) for lines, how in zip(frames, sent, strict=True)]
    )
    assert bench.blanks.count == 1, f"frame_blank pulsed {bench.blanks.count} times; {where()}"


@cocotb.test()
@cocotb.parametrize(attempt=list(range(4)))
async def cut_missing_and_late_frames(dut: HierarchyObject, attempt: int) -> None:
    """Each is blank from the first pixel that is not there in time, and told of once; a whole one after it is whole."""
    bench = Bench(dut)
    rng = bench.rng
    await bench.reset()
    fates = ["cut", "missing", "late", "whole", "cut", "whole", "missing", "whole", "late", "whole"]
    if IS_SMALL:
        fates += [rng.choice(fates) for _ in range(6)] + ["whole"]
    raw, frames = camera(rng, [(7, 5)] * len(fates), Blanking(4, DELAY, 20, 60))
    sent, expected = [], []
    for fate, lines in zip(fates, frames, strict=True):
        count = rng.randint(1, 34) if fate == "cut" else 0 if fate == "missing" else None
        sent.append(Sent(count, DELAY + 1 if fate == "late" else DELAY // 3))
        expected.append(pixels_of(lines, 0 if fate == "late" else count))
    await bench.play(raw, frames, sent)
    bench.check(raw, expected)
    blanks = sum(fate != "whole" for fate in fates)
    assert bench.blanks.count == blanks, f"frame_blank pulsed {bench.blanks.count} times, not {blanks}; {where()}"


@cocotb.test(skip=not IS_SMALL)
@cocotb.parametrize(back=[0, 5, 40])
async def a_missing_frame_is_followed_by_whole_ones(dut: HierarchyObject, back: int) -> None:
    """Also where less than the delay lies between vsync and pixels."""
    bench = Bench(dut)
    await bench.reset()
    raw, frames = camera(bench.rng, [(12, 8)] * 5, Blanking(4, 20, 20, back))
    await bench.play(raw, frames, [Sent(lag=10), Sent(0), *[Sent(lag=10)] * 3])
    bench.check(raw, [pixels_of(lines, 0 if index == 1 else None) for index, lines in enumerate(frames)])


@cocotb.test(skip=not IS_SMALL)
async def early_start_of_the_stream(dut: HierarchyObject) -> None:
    """A frame that breaks off because the next begins: what is left of it is blank, the next is whole."""
    bench = Bench(dut)
    await bench.reset()
    raw, frames = camera(bench.rng, [(9, 8)] * 3, Blanking(4, 5, 5, 5))
    count = 30
    await bench.play(raw, frames, [Sent(), Sent(count), Sent(lag=0)])
    samples = [sample.data for sample in bench.seen if sample.de][72:144]
    whole = next(index for index, pixel in enumerate(samples) if pixel != pixels_of(frames[1])[index])
    assert whole == count, f"{whole} pixels of the frame that broke off were shown, not {count}; {where()}"
    bench.check(raw, [pixels_of(frames[0]), pixels_of(frames[1], count), pixels_of(frames[2])])


@cocotb.test(skip=not IS_SMALL)
async def overflow(dut: HierarchyObject) -> None:
    """Frames that come faster than they are shown: what the FIFO holds is shown, then nothing; the next one is whole.

    The second of two finds the FIFO full at its first pixel and is gone altogether.
    """
    bench = Bench(dut)
    await bench.reset()
    raw, frames = camera(bench.rng, [(30, 6)] * 4, Blanking(4, 20, 20, 60))
    count, many = 30 * 6, FIFO_DEPTH + 6
    await bench.play(raw, frames, [Sent(), Sent(many, 0, fast=True), Sent(lag=-10_000, fast=True), Sent()])
    samples = [sample.data for sample in bench.seen if sample.de][count : 2 * count]
    pairs = enumerate(zip(samples, pixels_of(frames[1]), strict=True))
    whole = next(index for index, (got, sent) in pairs if got != sent)
    assert FIFO_DEPTH <= whole < many, f"{whole} pixels of {many} were shown; {where()}"
    bench.check(raw, [pixels_of(lines, shown) for lines, shown in zip(frames, [None, whole, 0, None], strict=True)])
    assert bench.blanks.count == 2, f"frame_blank pulsed {bench.blanks.count} times; {where()}"


@cocotb.test()
async def a_clock_that_stops_changes_nothing(dut: HierarchyObject) -> None:
    """At any sample, of camera and monitor."""
    bench = Bench(dut)
    await bench.reset()
    raw, frames = camera(bench.rng, [(9, 4)] * 3, blanking(bench, "720p"))
    await bench.play(raw, frames, [Sent()] * 3, stops=0.05 if IS_SMALL else 0.001)
    bench.check(raw, [pixels_of(lines) for lines in frames])
    assert bench.blanks.count == 0, f"frame_blank pulsed {bench.blanks.count} times; {where()}"


@cocotb.test(skip=not IS_SMALL)
@cocotb.parametrize(stands=[False, True])
async def reset_forgets_what_waits(dut: HierarchyObject, stands: bool) -> None:
    """Within a frame, also while pix_clk stands still; a frame whose vsync comes after it is whole."""
    bench = Bench(dut)
    await bench.reset()
    for _ in range(6):
        raw, frames = camera(bench.rng, [(9, 4)] * 2, blanking(bench, "720p"))
        await bench.play(raw, frames, [Sent()] * 2)
        bench.check(raw, [pixels_of(lines) for lines in frames])
        raw, frames = camera(bench.rng, [(9, 4)], blanking(bench, "720p"))
        running = cocotb.start_soon(bench.play(raw, frames, [Sent()]))
        for _ in range(bench.rng.randint(100, 260)):
            await RisingEdge(dut.pix_clk)
        running.cancel()
        bench.stop()
        await (bench.reset_while_the_clock_stands() if stands else bench.reset())


@cocotb.test(skip=not IS_SMALL)
async def the_rest_of_a_frame_is_nothing_after_a_reset(dut: HierarchyObject) -> None:
    """Pixels that come without their frame's first one take no place from the next frame."""
    bench = Bench(dut)
    await bench.reset()
    await bench.pour(1, first=True)
    await bench.reset()
    raw, frames = camera(bench.rng, [(9, 4)], Blanking(4, DELAY, 20, 4 * FIFO_DEPTH))
    # As many as would all but fill the FIFO, from which one goes a cycle of pix_clk: up to just before the frame.
    pix_per_clk = CLK_NS / PIX_NS["720p"]
    count = int((FIFO_DEPTH - 4) / (1 - pix_per_clk))
    playing = cocotb.start_soon(bench.play(raw, frames, [Sent(lag=0, fast=True)]))
    await ClockCycles(dut.clk, int(raw.de.index(1) / pix_per_clk) - count - 4)
    await bench.pour(count)
    await playing
    bench.check(raw, [pixels_of(lines) for lines in frames])


@cocotb.test(skip=not IS_SMALL)
async def a_reset_within_a_frame_is_no_blank_frame(dut: HierarchyObject) -> None:
    """What is left of that frame goes by unsaid; the next one is whole."""
    bench = Bench(dut)
    await bench.reset()
    raw, frames = camera(bench.rng, [(9, 20), (9, 4)], Blanking(4, DELAY, 20, 60))
    playing = cocotb.start_soon(bench.play(raw, frames, [Sent(), Sent()]))
    await ClockCycles(dut.pix_clk, raw.de.index(1) + 40)
    await bench.reset()
    await playing
    expected = pixels_of(frames[1])
    seen = [sample.data for sample in bench.seen if sample.de]
    assert len(seen) > len(expected), f"nothing is left of the frame with the reset; {where()}"
    assert seen[-len(expected) :] == expected, f"the frame after the reset is not whole; {where()}"
    assert bench.blanks.count == 0, f"frame_blank pulsed {bench.blanks.count} times; {where()}"

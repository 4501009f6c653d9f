# SPDX-License-Identifier: Apache-2.0
"""video_out: whole frames, missing, cut off and late ones, an overflow, a stopped clock, resets."""

import cocotb
from cocotb.handle import HierarchyObject

from tb.common.run import where
from tb.video_out.tb_video_out import DELAY, FIFO_DEPTH, Bench, Blanking, Sent, camera, pixels_of

PIX_NS = {"half": 20.0, "720p": 13.468, "near_equal": 10.002}
IS_SMALL = DELAY < 1000
SHAPES = {
    "720p": Blanking(4, 20, 20, 60),
    "tight": Blanking(1, 0, 1, 80),
    "random": Blanking(12, 60, 30, 60),
}
# Long enough to throw a full FIFO away.
LONG = Blanking(4, 20, 20, FIFO_DEPTH + 40)


@cocotb.test()
@cocotb.parametrize(pix=list(PIX_NS), shape=list(SHAPES))
async def whole_frames(dut: HierarchyObject, pix: str, shape: str) -> None:
    bench = Bench(dut, PIX_NS[pix])
    await bench.reset()
    sizes = [(bench.rng.randint(1, 17), bench.rng.randint(1, 7)) for _ in range(6 if IS_SMALL else 3)]
    raw, frames = camera(bench.rng, sizes, SHAPES[shape])
    await bench.play(raw, frames, [Sent()] * len(frames))
    bench.check(raw, [pixels_of(lines) for lines in frames])
    assert bench.blanks.count == 0, f"frame_blank pulsed {bench.blanks.count} times; {where()}"


@cocotb.test()
@cocotb.parametrize(attempt=list(range(4)))
async def cut_missing_and_late_frames(dut: HierarchyObject, attempt: int) -> None:
    """Each is blank from the first pixel that is not there in time, and told of once; the one after it is whole."""
    bench = Bench(dut)
    rng = bench.rng
    await bench.reset()
    raw, frames = camera(rng, [(7, 5)] * (9 if IS_SMALL else 4), LONG)
    sent, expected, blanks = [], [], 0
    for lines in frames:
        fate = rng.choice(["whole", "cut", "missing", "late"]) if sent and sent[-1] == Sent() else "whole"
        if fate == "cut":
            sent.append(Sent(rng.randint(1, 34)))
            expected.append(pixels_of(lines, sent[-1].count))
        elif fate == "missing":
            sent.append(Sent(0))
            expected.append(pixels_of(lines, 0))
        elif fate == "late":
            sent.append(Sent(lag=DELAY + 1))
            expected.append(pixels_of(lines, 0))
        else:
            sent.append(Sent())
            expected.append(pixels_of(lines))
        blanks += fate != "whole"
    await bench.play(raw, frames, sent)
    bench.check(raw, expected)
    assert blanks, f"every frame was whole: no use; {where()}"
    assert bench.blanks.count == blanks, f"frame_blank pulsed {bench.blanks.count} times, not {blanks}; {where()}"


@cocotb.test(skip=not IS_SMALL)
async def overflow(dut: HierarchyObject) -> None:
    """A frame that comes faster than it is shown: what the FIFO holds is shown, then nothing; the next one is whole."""
    bench = Bench(dut)
    await bench.reset()
    raw, frames = camera(bench.rng, [(30, 6)] * 3, LONG)
    count = 30 * 6
    await bench.play(raw, frames, [Sent(), Sent(count), Sent()])
    samples = [sample.data for sample in bench.seen if sample.de][count : 2 * count]
    whole = next(
        index for index, pair in enumerate(zip(samples, pixels_of(frames[1]), strict=True)) if pair[0] != pair[1]
    )
    assert FIFO_DEPTH <= whole < count, f"{whole} pixels of {count} were shown; {where()}"
    bench.check(raw, [pixels_of(frames[0]), pixels_of(frames[1], whole), pixels_of(frames[2])])
    assert bench.blanks.count == 1, f"frame_blank pulsed {bench.blanks.count} times; {where()}"


@cocotb.test()
async def a_clock_that_stops_changes_nothing(dut: HierarchyObject) -> None:
    bench = Bench(dut)
    await bench.reset()
    raw, frames = camera(bench.rng, [(9, 4)] * 3, SHAPES["720p"])
    await bench.play(raw, frames, [Sent()] * 3, stop=300)
    bench.check(raw, [pixels_of(lines) for lines in frames])


@cocotb.test(skip=not IS_SMALL)
async def reset_forgets_what_waits(dut: HierarchyObject) -> None:
    """Also within a frame; the first frame after it is whole, if its vsync was seen."""
    bench = Bench(dut)
    for _ in range(6):
        await bench.reset()
        raw, frames = camera(bench.rng, [(9, 4)] * 2, SHAPES["720p"])
        await bench.play(raw, frames, [Sent()] * 2)
        bench.check(raw, [pixels_of(lines) for lines in frames])
        raw, frames = camera(bench.rng, [(9, 4)], SHAPES["720p"])
        running = cocotb.start_soon(bench.play(raw, frames, [Sent()]))
        for _ in range(bench.rng.randint(100, 260)):
            await cocotb.triggers.RisingEdge(dut.pix_clk)
        running.cancel()
        bench.stop()

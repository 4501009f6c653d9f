# SPDX-License-Identifier: Apache-2.0
"""video_in against its model: clock ratios, blanking, malformed frames, overflow, stopped clock, reset, crossing."""

from random import Random

import cocotb
from cocotb.handle import HierarchyObject
from cocotb.triggers import RisingEdge, Timer

from tb.common.compare import check_markers
from tb.common.figures import page_figures
from tb.common.run import where
from tb.common.stream import split_frames, stalls
from tb.video_in.tb_video_in import (
    CLK_NS,
    FAULTS,
    FIFO_DEPTH,
    MAX_SIZE,
    TIGHT,
    VSYNC_ACTIVE,
    Bench,
    Blanking,
    Raw,
    blanking,
    check,
    check_starts,
    lines_of,
    model,
    spoil,
)

# Periods of pix_clk in ns, against 10 of clk. With the last two, a line is faster than clk and waits in the FIFO.
PIX_NS = {"half": 20.0, "720p": 13.468, "near_equal": 10.002, "equal": 10.0, "1080p": 6.734, "triple": 3.334}
FASTER = ("1080p", "triple")


def random_size(rng: Random) -> tuple[int, int]:
    """Return a small frame size, one pixel included."""
    return rng.randint(1, 17), rng.randint(1, 7)


def small_size(rng: Random) -> tuple[int, int]:
    """Return a frame size that the FIFO takes up although m_axis stalls; a fault adds lines and pixels."""
    return rng.randint(1, 3), rng.randint(1, 3)


async def play_and_check(bench: Bench, raw: Raw, width: int, height: int) -> None:
    await bench.play(raw)
    await bench.settle()
    check(bench, model(raw, width, height))


@cocotb.test()
@cocotb.parametrize(pix=list(PIX_NS), shape=["tight", "720p", "random"])
async def good_frames(dut: HierarchyObject, pix: str, shape: str) -> None:
    """Frames at each ratio of the clocks. Lines that are faster than clk fit the FIFO and leave it time to drain."""
    bench = Bench(dut, PIX_NS[pix])
    rng = bench.rng
    await bench.reset()
    width, height = random_size(rng)
    gap = 1
    if pix in FASTER:
        width = min(width, 8)
        gap = 4 * width
    shapes = {
        "tight": Blanking(gap, 0, 1, 0),
        "720p": Blanking(max(gap, 4), 20, 20, 40),
        "random": Blanking(gap + 12, 60, 30, 60, None if pix in FASTER else rng),
    }
    await bench.configure(width, height)
    raw = Raw()
    for _ in range(5):
        raw.frame(lines_of(rng, width, height), shapes[shape])
    raw.blank(1, sync=True)
    await play_and_check(bench, raw, width, height)


@cocotb.test()
@cocotb.parametrize(attempt=list(range(6)), stop_clock=[False, True], stalled=[0.0, 0.3])
async def malformed_frames(dut: HierarchyObject, attempt: int, stop_clock: bool, stalled: float) -> None:
    """Every kind of fault, between good frames and after one another; pix_clk may stop, and m_axis stall, anywhere."""
    bench = Bench(dut, backpressure=stalled)
    rng = bench.rng
    await bench.reset()
    width, height = small_size(rng) if stalled else random_size(rng)
    await bench.configure(width, height)
    if stop_clock:
        bench.pause_clock = stalls(rng, 0.1)
    raw, shape = Raw(), TIGHT if attempt < 2 else blanking(rng)
    if stalled:
        shape = Blanking(4 * width, 20, 20, 100)
    for _ in range(12):
        lines = lines_of(rng, width, height)
        raw.frame(spoil(rng, lines, rng.choice(FAULTS)) if rng.random() < 0.6 else lines, shape)
    raw.frame(lines_of(rng, width, height), shape)
    await play_and_check(bench, raw, width, height)


@cocotb.test()
async def backpressure(dut: HierarchyObject) -> None:
    """Downstream stalls that the FIFO takes up."""
    bench = Bench(dut, backpressure=0.3)
    rng = bench.rng
    await bench.reset()
    width, height = (11, 7) if FIFO_DEPTH > 1000 else (2, 2)
    await bench.configure(width, height)
    raw = Raw()
    for _ in range(8):
        raw.frame(lines_of(rng, width, height), Blanking(2 * width, 20, 20, 100))
    await play_and_check(bench, raw, width, height)


@cocotb.test()
async def overflow(dut: HierarchyObject) -> None:
    """A stall longer than the FIFO: frames that lost a pixel are cut off and counted once, the next one is whole."""
    bench = Bench(dut)
    rng = bench.rng
    await bench.reset()
    width, height = (17, 9) if FIFO_DEPTH < 1000 else (40, 20)
    await bench.configure(width, height)
    frames = [lines_of(rng, width, height) for _ in range(9)]
    raw = Raw()
    for lines in frames:
        raw.frame(lines, Blanking(3, 20, 20, 40))
    raw.blank(1, sync=True)
    frame_cycles = len(raw.de) // len(frames) * bench.pix_ns / CLK_NS
    cocotb.start_soon(stall_twice(bench, frame_cycles))
    await bench.play(raw)
    await bench.settle()

    received = split_frames(bench.sink.taken)
    numbers = [number for number, _, _ in bench.starts]
    check_starts(bench, sorted(set(numbers)))
    assert len(received) == len(numbers), f"{len(received)} frames came with numbers {numbers}; {where()}"
    whole = 0
    for beats, number in zip(received, numbers, strict=True):
        pixels = [pixel for line in frames[number - 1] for pixel in line]
        got = [beat.data for beat in beats]
        assert got == pixels[: len(got)], f"frame {number} is not a start of what the camera sent; {where()}"
        check_markers(beats, width, f"frame {number}")
        whole += len(got) == len(pixels)
    pulses = (bench.seen.count, bench.malformed.count, bench.overflow.count)
    expected = (len(frames), 0, len(frames) - whole)
    assert pulses == expected, f"(seen, malformed, overflow) {pulses}, expected {expected}; {where()}"
    assert 1 <= bench.overflow.count < len(frames) - 2, f"{bench.overflow.count} overflows: no use; {where()}"
    assert numbers[-1] == len(frames), f"the last frame did not come; {where()}"
    assert len(received[-1]) == width * height, f"the last frame is not whole; {where()}"


async def stall_twice(bench: Bench, frame_cycles: float) -> None:
    """Stall for less than a frame, then for more than two, so that whole frames are dropped."""
    for start, length in ((1.3, 0.6), (1.2, 2.5)):
        await bench.cycles(int(start * frame_cycles))
        bench.sink.pause = stalls(bench.rng, 1)
        await bench.cycles(int(length * frame_cycles))
        bench.sink.pause = stalls(bench.rng, 0)


@cocotb.test()
async def disabled_from_the_next_frame_on(dut: HierarchyObject) -> None:
    """Clearing cfg_enable within a frame lets that frame end; later ones are neither sent, numbered nor counted."""
    bench = Bench(dut)
    rng = bench.rng
    await bench.reset()
    width, height, shape = 6, 5, Blanking(4, 10, 10, 20)
    await bench.configure(width, height)
    raw = Raw()
    enables: list[bool] = []
    wanted = [True, True, False, False, True]
    for enable in wanted:
        raw.frame(lines_of(rng, width, height), shape)
        enables += [enable] * (len(raw.de) - len(enables))
    raw.blank(1, sync=True)
    enables.append(True)
    edges = cocotb.start_soon(switch(bench, [(60, 1), (len(enables) // 5, 0), (2 * (len(enables) // 5), 1)]))
    await bench.play(raw)
    await bench.settle()
    edges.cancel()
    check(bench, model(raw, width, height, enables))


async def switch(bench: Bench, steps: list[tuple[int, int]]) -> None:
    """Set cfg_enable after so many cycles of pix_clk each."""
    for cycles, enable in steps:
        for _ in range(cycles):
            await RisingEdge(bench.dut.pix_clk)
        bench.dut.cfg_enable.value = enable


ILLEGAL = [(0, 4), (4, 0), (MAX_SIZE[0] + 1, 4), (4, MAX_SIZE[1] + 1), (65535, 65535)]


@cocotb.test()
@cocotb.parametrize(size=ILLEGAL)
async def illegal_sizes(dut: HierarchyObject, size: tuple[int, int]) -> None:
    """A configured size of 0 or beyond the maximum makes each frame malformed, and nothing comes out."""
    bench = await fresh_bench(dut, *size)
    raw = Raw()
    for _ in range(2):
        raw.frame(lines_of(bench.rng, 4, 4), Blanking(2, 5, 5, 5))
    raw.blank(2, sync=True)
    await play_and_check(bench, raw, *size)


@cocotb.test()
async def either_polarity(dut: HierarchyObject) -> None:
    """Vsync of the other polarity is learnt from the first line; only the frame that runs then is lost."""
    bench = await fresh_bench(dut, 5, 4)
    raw = Raw(active=1 - VSYNC_ACTIVE)
    for _ in range(4):
        raw.frame(lines_of(bench.rng, 5, 4), Blanking(3, 5, 5, 5))
    raw.blank(2, sync=True)
    expected = model(raw, 5, 4)
    assert len(expected.frames) == 3, f"the model sees {len(expected.frames)} frames; {where()}"
    await play_and_check(bench, raw, 5, 4)


@cocotb.test()
async def sizes_never_mix(dut: HierarchyObject) -> None:
    """While the configuration flips between 5x6 and 6x5 at any time, a frame of 5x5 or 6x6 never passes."""
    bench = await fresh_bench(dut, 5, 6)
    flips = cocotb.start_soon(flip(bench, [(5, 6), (6, 5)]))
    held = cocotb.start_soon(word_stands_still(dut))
    raw = Raw()
    for _ in range(60):
        side = bench.rng.choice([5, 6])
        raw.frame(lines_of(bench.rng, side, side), Blanking(2, 3, 3, 3, bench.rng))
    raw.blank(2, sync=True)
    await bench.play(raw)
    await bench.settle()
    flips.cancel()
    held.cancel()
    counts = (bench.seen.count, bench.malformed.count)
    assert counts == (60, 60), f"(seen, malformed) {counts}, expected (60, 60); {where()}"


async def word_stands_still(dut: HierarchyObject) -> None:
    """Assert that the word under way stands still until acknowledged: simulated bits have no skew to show it."""
    sync, last, under_way = dut.cfg_sync, None, False
    while True:
        await RisingEdge(dut.clk)
        now = str(sync.hold_reg.value)
        assert not under_way or now == last, f"the word changed from {last} to {now} under way; {where()}"
        last, under_way = now, int(sync.request_reg.value) != int(sync.acknowledge_in_src.value)


async def flip(bench: Bench, sizes: list[tuple[int, int]]) -> None:
    """Change both halves of the size in one cycle, after any number of cycles."""
    while True:
        for size in sizes:
            bench.dut.cfg_width.value, bench.dut.cfg_height.value = size
            await bench.cycles(bench.rng.randint(1, 12))


@cocotb.test()
@cocotb.parametrize(stopped=[False, True])
async def reset_in_a_frame(dut: HierarchyObject, stopped: bool) -> None:
    """Nothing from before a reset comes out after it, also when pix_clk stood still during the reset."""
    width, height = 7, 5
    bench = await fresh_bench(dut, width, height)
    for _ in range(6):
        raw = Raw()
        raw.frame(lines_of(bench.rng, width, height), Blanking(3, 5, 5, 5))
        playing = cocotb.start_soon(bench.play(raw))
        await bench.cycles(bench.rng.randint(15, 70))
        bench.sink.pause = stalls(bench.rng, 1)
        await bench.cycles(bench.rng.randint(1, 12))
        if stopped:
            bench.pix_clock.stop()
        playing.cancel()
        bench.idle()
        bench.sink.pause = stalls(bench.rng, 0)
        await bench.reset(bench.rng.randint(1, 3))
        assert not bench.sink.taken, f"pixels from before the reset; {where()}"
        if stopped:
            bench.pix_clock.start(start_high=False)
        await bench.settle()
        raw = Raw()
        raw.frame(lines_of(bench.rng, width, height), Blanking(3, 5, 5, 5))
        raw.blank(2, sync=True)
        await play_and_check(bench, raw, width, height)


@cocotb.test()
async def reset_forgets_the_measured_size(dut: HierarchyObject) -> None:
    """After a reset the measured size is 0x0 until a frame has ended; vsync alone ends none."""
    bench = await fresh_bench(dut, 5, 4)
    raw = Raw()
    raw.frame(lines_of(bench.rng, 5, 4), Blanking(3, 5, 5, 5))
    raw.blank(2, sync=True)
    await play_and_check(bench, raw, 5, 4)
    await bench.reset()
    raw = Raw()
    for _ in range(3):
        raw.blank(4)
        raw.blank(4, sync=True)
    await play_and_check(bench, raw, 5, 4)


@cocotb.test()
async def nothing_starts_before_vsync(dut: HierarchyObject) -> None:
    """A camera in mid-frame at the end of reset: its lines are dropped until vsync, that before the reset forgotten."""
    bench = await fresh_bench(dut, 5, 4)
    raw = Raw()
    raw.blank(4, sync=True)
    raw.blank(4)
    await bench.play(raw)
    await bench.reset()
    raw = Raw()
    for line in lines_of(bench.rng, 5, 4):
        raw.line(line, 3)
    raw.frame(lines_of(bench.rng, 5, 4), Blanking(3, 5, 5, 5))
    raw.blank(2, sync=True)
    expected = model(raw, 5, 4)
    assert len(expected.frames) == 1, f"the model sees {len(expected.frames)} frames; {where()}"
    await play_and_check(bench, raw, 5, 4)


@cocotb.test()
@cocotb.parametrize(size=[(MAX_SIZE[0], 2), (2, MAX_SIZE[1])])
async def largest_sizes(dut: HierarchyObject, size: tuple[int, int]) -> None:
    """The largest width and the largest height are legal."""
    bench = await fresh_bench(dut, *size)
    raw = Raw()
    for _ in range(2):
        raw.frame(lines_of(bench.rng, *size), Blanking(2, 5, 5, 5))
    raw.blank(2, sync=True)
    expected = model(raw, *size)
    assert not expected.malformed, f"the model refuses {size}; {where()}"
    await play_and_check(bench, raw, *size)


@cocotb.test(skip=VSYNC_ACTIVE == 1)
@cocotb.parametrize(size=[(65540, 1), (1, 65540)])
async def measured_size_saturates(dut: HierarchyObject, size: tuple[int, int]) -> None:
    """A line, or a frame, longer than the counters hold: malformed once, measured as 65535."""
    bench = await fresh_bench(dut, 4, 3)
    raw = Raw()
    raw.frame([[0xA5A5A5] * size[0]] * size[1])
    raw.blank(2, sync=True)
    await bench.play(raw)
    await bench.settle()
    measured = int(dut.measured_width.value), int(dut.measured_height.value)
    assert measured == (min(size[0], 65535), min(size[1], 65535)), f"measured {measured} of {size}; {where()}"
    counts = (bench.seen.count, bench.malformed.count, bench.overflow.count)
    assert counts == (1, 1, 0), f"(seen, malformed, overflow) {counts}, expected (1, 1, 0); {where()}"


@cocotb.test()
@cocotb.parametrize(pix=["half", "720p", "equal", "triple"])
async def latency(dut: HierarchyObject, pix: str) -> None:
    """From the edge that samples the first pixel to the first beat: 3 cycles of pix_clk, 3 to 5 of clk."""
    bench = Bench(dut, PIX_NS[pix])
    await bench.reset()
    await bench.configure(3, 2)
    raw = Raw()
    raw.frame(lines_of(bench.rng, 3, 2), Blanking(12, 5, 5, 5))
    pix_cycles, fewest, most_cycles = page_figures("video_in")
    least, most = (pix_cycles * bench.pix_ns + cycles * CLK_NS for cycles in (fewest, most_cycles))
    for _ in range(20):
        # Every frame meets another phase of the two clocks.
        bench.first_pixel_ns = bench.first_beat_ns = 0.0
        await bench.stop_clock(1)
        await Timer(bench.rng.randrange(10000), unit="ps")
        await bench.play(raw)
        await bench.settle()
        # The bench sees a beat one edge after it was put on m_axis.
        delay = bench.first_beat_ns - CLK_NS - bench.first_pixel_ns
        assert least - 0.01 <= delay <= most + 0.01, f"latency {delay} ns, documented {least} to {most}; {where()}"


async def fresh_bench(dut: HierarchyObject, width: int, height: int) -> Bench:
    """Return a bench after reset, configured."""
    bench = Bench(dut)
    await bench.reset()
    await bench.configure(width, height)
    return bench

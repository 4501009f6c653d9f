# SPDX-License-Identifier: Apache-2.0
"""threshold_stats: frame contract, each window's beat, the order against the video, latency, stall, flat windows."""

from collections.abc import Callable
from random import Random, getrandbits

import cocotb
import numpy as np
from cocotb.handle import HierarchyObject

from golden.threshold_stats import threshold_stats, window_count
from tb.common.contract import SentFrame, SizeLimits, sent_frames
from tb.common.figures import page_figures
from tb.common.matrix import SCENES, STALLS, VideoCore, check_frames, send_and_check, start
from tb.common.patterns import random_frame, structured_frames
from tb.common.run import parameter, where
from tb.common.stream import Beat, StreamBench, StreamSink, Taken, frame_beats, split_frames, stalls

WINDOW_LOG2 = parameter("WINDOW_LOG2", 7)
SIDE = 1 << WINDOW_LOG2
LIMITS = SizeLimits(1, 1, parameter("MAX_WIDTH", 1280), parameter("MAX_HEIGHT", 720))
CORE = VideoCore(golden=lambda frame: frame, bits_in=8, reach=0, limits=LIMITS)
FACTORS = [0, 256, 64, 511, 1, 255, 257]
FLAT_LIMITS = [0, 255, 16, 245, 1]
"""245 takes a third of the windows of 8x8 random pixels."""
FLAT_PLACES: dict[str, Callable[[Random, int, int], bool]] = {
    "some": lambda rng, row, column: rng.random() < 0.6,
    "first_window": lambda rng, row, column: row == column == 0,
    "first_column": lambda rng, row, column: column == 0,
    "all": lambda rng, row, column: True,
}
LATENCY, FIRST_BEAT_LATENCY = page_figures("threshold_stats")
STALL, STALL_A_WINDOW = page_figures("threshold_stats", "Throughput")[2:4]


def factor_of(first_pixel: int) -> int:
    """Return the factor that goes with a frame, so that model and bench agree without talking."""
    return FACTORS[first_pixel % len(FACTORS)]


def flat_limit_of(first_pixel: int) -> int:
    """Return the flat limit that goes with a frame; 35 frames have every pair of it and a factor."""
    return FLAT_LIMITS[first_pixel % len(FLAT_LIMITS)]


async def begin(dut: HierarchyObject, stall: str) -> tuple[StreamBench, StreamSink]:
    """Return bench and sink of the stat stream; its configuration is right with each start of frame only."""
    rng = Random(getrandbits(64))
    stats = StreamSink(dut, "m_stat_axis", dut.clk, dut.rst, rng)
    dut.cfg_factor.value = 0
    dut.cfg_flat_limit.value = 0
    bench = await start(dut, rng, stall)
    bench.logs.append(stats.taken)
    stats.pause = stalls(rng, STALLS[stall][1])
    set_size, scramble = bench.source.on_beat, Random(rng.getrandbits(64))

    def on_beat(beat: Beat) -> None:
        set_size(beat)
        dut.cfg_factor.value = factor_of(beat.data) if beat.user else scramble.getrandbits(9)
        dut.cfg_flat_limit.value = flat_limit_of(beat.data) if beat.user else scramble.getrandbits(8)

    bench.source.on_beat = on_beat
    return bench, stats


def expected_beats(frame: SentFrame) -> list[tuple[int, int, int]]:
    """Return (tdata, tuser, tlast) of the rows of windows that the pixels of a frame complete."""
    factor, flat_limit = factor_of(frame.pixels[0]), flat_limit_of(frame.pixels[0])
    values = threshold_stats(frame.image().astype(np.uint8), factor, WINDOW_LOG2, flat_limit).beats()
    beats = []
    for row, line in enumerate(values.tolist()):
        if min((row + 1) * SIDE, frame.height) * frame.width <= len(frame.pixels):
            beats += [(data, int(row + i == 0), int(i == len(line) - 1)) for i, data in enumerate(line)]
    return beats


def check_stats(stats: list[Taken], frames: list[SentFrame]) -> None:
    """Assert that the stat stream holds exactly the windows of the frames."""
    got = [(beat.data, beat.user, beat.last) for beat in stats]
    wanted = [(*beat, index) for index, frame in enumerate(frames) for beat in expected_beats(frame)]
    for at, (one, other) in enumerate(zip(wanted, got, strict=False)):
        assert one[:3] == other, (
            f"stat beat {at}, frame {one[3]}: expected (tdata, tuser, tlast) ({one[0]:08x}, {one[1]}, {one[2]}), "
            f"got ({other[0]:08x}, {other[1]}, {other[2]}); {where()}"
        )
    assert len(got) == len(wanted), f"{len(got)} stat beats came, expected {len(wanted)}; {where()}"


def check_order(stats: list[Taken], video: list[Taken], frames: list[SentFrame]) -> None:
    """Assert that a row of windows comes after its last pixel and before the next frame's first pixel."""
    pixels = split_frames(video)
    at = 0
    for index, frame in enumerate(frames):
        for row in range(len(expected_beats(frame)) // window_count(frame.width, WINDOW_LOG2)):
            last_pixel = pixels[index][min((row + 1) * SIDE, frame.height) * frame.width - 1]
            assert stats[at].cycle > last_pixel.cycle, f"frame {index}: row {row} came before its pixels; {where()}"
            at += window_count(frame.width, WINDOW_LOG2)
            if index + 1 < len(pixels):
                assert stats[at - 1].cycle < pixels[index + 1][0].cycle, (
                    f"frame {index}: row {row} came after the next start of frame; {where()}"
                )


def affordable(sizes: list[tuple[int, int]], pixels: int = 20000) -> list[tuple[int, int]]:
    """Return the sizes, without those too many: windows of 128 make frames that take long to simulate."""
    chosen = []
    for width, height in sizes:
        if width * height <= pixels:
            pixels -= width * height
            chosen.append((width, height))
    return chosen


async def run(dut: HierarchyObject, stall: str, beats: list[Beat]) -> None:
    bench, stats = await begin(dut, stall)
    await send_and_check(bench, CORE, beats)
    await bench.cycles(40 + 12 * window_count(LIMITS.max_width, WINDOW_LOG2))
    frames, _ = sent_frames(beats, LIMITS)
    check_stats(stats.taken, frames)
    check_order(stats.taken, bench.sink.taken, frames)


@cocotb.test()
@cocotb.parametrize(scene=list(SCENES), stall=list(STALLS))
async def frame_contract(dut: HierarchyObject, scene: str, stall: str) -> None:
    await run(dut, stall, SCENES[scene](Random(getrandbits(64)), CORE))


@cocotb.test()
@cocotb.parametrize(stall=list(STALLS))
async def cut_windows(dut: HierarchyObject, stall: str) -> None:
    """Frames around multiples of the window, back to back: one pixel less, none, one more; one line, one column."""
    rng = Random(getrandbits(64))
    some = [1, SIDE - 1, SIDE, SIDE + 1, 2 * SIDE + 1]
    sizes = [(w, h) for w in some for h in some if LIMITS.allow(w, h)]
    rng.shuffle(sizes)
    await run(dut, stall, [beat for size in affordable(sizes) for beat in frame_beats(random_frame(rng, *size, 8))])


def patchy_frame(rng: Random, width: int, height: int, flat_limit: int, place: str) -> np.ndarray:
    """Return a frame for this limit whose windows at `place` are flat, by one step or wholly, and the others not."""
    first = rng.choice([pixel for pixel in range(256) if flat_limit_of(pixel) == flat_limit])
    frame = random_frame(rng, width, height, 8)
    for row in range(window_count(height, WINDOW_LOG2)):
        for column in range(window_count(width, WINDOW_LOG2)):
            flat = flat_limit > 0 and FLAT_PLACES[place](rng, row, column)
            spread = rng.choice([0, flat_limit - 1] if flat else [flat_limit, rng.randint(flat_limit, 255), 255])
            low = rng.randint(0, 255 - spread) if row or column else min(first, 255 - spread)
            window = frame[row * SIDE : (row + 1) * SIDE, column * SIDE : (column + 1) * SIDE]
            window[:] = low + window % (spread + 1)
            window.flat[-1], window.flat[0] = low + spread, low
    frame[0, 0] = first
    return frame


@cocotb.test()
@cocotb.parametrize(place=list(FLAT_PLACES), stall=["full_speed", "idle_backpressure"])
async def flat_windows(dut: HierarchyObject, place: str, stall: str) -> None:
    """Flat windows take a neighbour's threshold; the limit changes with each frame, and frames are cut off between."""
    rng = Random(getrandbits(64))
    long = 2 * SIDE + 1 if SIDE > 8 else 4 * SIDE + 1
    short = 3 if SIDE > 8 else long  # Windows of 128 in both directions make frames that take long to simulate.
    sizes = [(min(w, LIMITS.max_width), min(h, LIMITS.max_height)) for w, h in ((long, short), (short, long))]
    beats: list[Beat] = []
    for flat_limit in rng.sample(FLAT_LIMITS, len(FLAT_LIMITS)):
        size = rng.choice(sizes)
        for keep in (size[0] * size[1], rng.randrange(size[0], size[0] * size[1])):
            beats += frame_beats(patchy_frame(rng, *size, flat_limit, place))[:keep]
    await run(dut, stall, beats)


@cocotb.test()
async def extremes_in_every_corner(dut: HierarchyObject) -> None:
    """One pixel that differs, at each border of the windows."""
    rng = Random(getrandbits(64))
    width, height = (min(2 * SIDE - 3, 37), min(2 * SIDE - 1, 11)) if SIDE > 2 else (5, 5)
    frames = structured_frames(rng, width, height, 8)
    await run(dut, "full_speed", [beat for frame in frames.values() for beat in frame_beats(frame)])


@cocotb.test()
async def stat_stalls_hold_the_next_frame(dut: HierarchyObject) -> None:
    """However long the stat stream stalls, nothing is lost or overtaken."""
    bench, stats = await begin(dut, "full_speed")
    stats.pause = stalls(bench.rng, 0.95)
    width, height = min(3 * SIDE, LIMITS.max_width, 24), min(3 * SIDE, LIMITS.max_height, 24)
    beats = [beat for _ in range(4) for beat in frame_beats(random_frame(bench.rng, width, height, 8))]
    bench.source.send_beats(beats)
    await bench.drain(quiet=2000, limit=100000)
    frames, _ = sent_frames(beats, LIMITS)
    check_frames(split_frames(bench.sink.taken), frames, CORE)
    check_stats(stats.taken, frames)
    check_order(stats.taken, bench.sink.taken, frames)


@cocotb.test()
@cocotb.parametrize(stall=list(STALLS))
async def reset_in_a_frame(dut: HierarchyObject, stall: str) -> None:
    bench, stats = await begin(dut, stall)
    rng = bench.rng
    for _ in range(6):
        bench.source.send_beats([beat for _ in range(3) for beat in frame_beats(random_frame(rng, 9, 9, 8))])
        await bench.cycles(rng.randint(1, 300))
        await bench.reset(rng.randint(1, 3))
        beats = [beat for _ in range(2) for beat in frame_beats(random_frame(rng, 9, 9, 8))]
        await send_and_check(bench, CORE, beats)
        await bench.cycles(60)
        check_stats(stats.taken, sent_frames(beats, LIMITS)[0])


@cocotb.test()
async def latency_and_stall(dut: HierarchyObject) -> None:
    """The figures of the page: of a pixel, of the first beat, of the stall between frames; no stall within a frame."""
    bench, stats = await begin(dut, "full_speed")
    width, height = min(2 * SIDE + 1, LIMITS.max_width, 300), min(SIDE, LIMITS.max_height)
    height = min(height, 16)
    beats = [beat for _ in range(3) for beat in frame_beats(random_frame(bench.rng, width, height, 8))]
    await send_and_check(bench, CORE, beats)
    columns = window_count(width, WINDOW_LOG2)
    one, two, three = split_frames(bench.sink.taken)
    delays = {out.cycle - into.cycle for into, out in zip(bench.input.taken[:5], one[:5], strict=True)}
    assert delays == {LATENCY}, f"latencies {delays}, documented {LATENCY}; {where()}"
    assert one[-1].cycle - one[0].cycle == width * height - 1, f"bubbles within a frame; {where()}"
    first = stats.taken[0].cycle - one[-1].cycle
    assert first == FIRST_BEAT_LATENCY, f"first stat beat after {first} cycles; {where()}"
    for before, after in ((one, two), (two, three)):
        stall = after[0].cycle - before[-1].cycle - 1
        assert stall == STALL + STALL_A_WINDOW * columns, f"a stall of {stall} cycles with {columns} columns; {where()}"

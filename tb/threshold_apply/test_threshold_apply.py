# SPDX-License-Identifier: Apache-2.0
"""threshold_apply: decisions, the choice of the set, the frame contract, levels, latency."""

from random import Random

import cocotb
import numpy as np
from cocotb.handle import HierarchyObject

from golden.threshold_apply import threshold_map
from golden.threshold_stats import window_count
from tb.common.figures import page_figures
from tb.common.matrix import SCENES, STALLS, VideoCore
from tb.common.patterns import random_frame
from tb.common.run import where
from tb.common.stream import Beat, frame_beats, split_frames
from tb.threshold_apply.tb_threshold_apply import LIMITS, WINDOW_LOG2, Bench, Served, random_nodes, set_beats

SIDE = 1 << WINDOW_LOG2
CORE = VideoCore(golden=lambda frame: frame, bits_in=8, reach=0, limits=LIMITS)
(LATENCY,) = page_figures("threshold_apply")


def close_frame(rng: Random, nodes: np.ndarray, width: int, height: int) -> np.ndarray:
    """Return a frame whose pixels are the integer part of their threshold, or one more or less: the hard decisions."""
    whole = threshold_map(nodes, width, height, WINDOW_LOG2) >> (10 + 2 * WINDOW_LOG2)
    return np.clip(whole + random_frame(rng, width, height, 8) % 3 - 1, 0, 255)


async def play(bench: Bench, frames: list[np.ndarray], sets: list[list[Beat]]) -> list[Served]:
    """Send frames as fast as the core takes them; each set follows its start of frame, before the next one."""
    await bench.begin()
    for index, (frame, beats) in enumerate(zip(frames, sets, strict=True)):
        bench.send(frame_beats(frame))
        await bench.until_started(index + 1)
        bench.stats.send_beats(beats)
        await bench.until_told()
    return await bench.finish()


def sizes_around_windows(rng: Random) -> list[tuple[int, int]]:
    """Return sizes around multiples of half a window, and the greatest line; of windows of 128 a few."""
    some = sorted({1, SIDE // 2, SIDE // 2 + 1, SIDE - 1, SIDE, SIDE + 1, 2 * SIDE, 3 * SIDE + SIDE // 2 + 1})
    sizes = [(w, h) for w in some for h in some if LIMITS.allow(w, h)]
    rng.shuffle(sizes)
    chosen, room = [(min(LIMITS.max_width, 1280), min(LIMITS.max_height, 5))], 15000
    for width, height in sizes:
        if width * height * 2 <= room:
            room -= width * height * 2
            chosen.append((width, height))
    return chosen


@cocotb.test()
@cocotb.parametrize(stall=list(STALLS))
async def decisions(dut: HierarchyObject, stall: str) -> None:
    """Two frames of each size: the first only brings thresholds, the second has a pixel close to each of them."""
    bench = Bench(dut, stall)
    frames, sets = [], []
    for width, height in sizes_around_windows(bench.rng):
        nodes = random_nodes(bench.rng, width, height)
        frames += [random_frame(bench.rng, width, height, 8), close_frame(bench.rng, nodes, width, height)]
        sets += [set_beats(nodes, bench.rng)] * 2
    served = await play(bench, frames, sets)
    fresh = sum(one.nodes is not None and not one.stale for one in served)
    assert fresh >= len(frames) // 2, f"only {fresh} of {len(frames)} frames had thresholds; {where()}"


@cocotb.test()
async def bottom_rows(dut: HierarchyObject) -> None:
    """A narrow frame of full height passes every row of windows."""
    bench = Bench(dut, "full_speed")
    width, height = min(3, LIMITS.max_width), LIMITS.max_height
    nodes = random_nodes(bench.rng, width, height)
    frames = [random_frame(bench.rng, width, height, 8), close_frame(bench.rng, nodes, width, height)]
    served = await play(bench, frames, [set_beats(nodes, bench.rng)] * 2)
    assert served[1].nodes is not None, f"the set of {nodes.shape} did not serve; {where()}"


def spoilt(rng: Random, beats: list[Beat], columns: int) -> list[Beat]:
    """Return the beats of a set with one fault, or without any."""
    beats, at = list(beats), rng.randrange(len(beats))
    fault = rng.choice(["none", "none", "cut", "no start", "marker", "restart", "too long", "too wide"])
    if fault == "cut":
        del beats[at:]
    elif fault == "no start":
        beats[0] = beats[0]._replace(user=0)
    elif fault == "marker":
        beats[at] = beats[at]._replace(last=1 - beats[at].last)
    elif fault == "restart":
        beats = beats[:at] + beats
    elif fault == "too long":
        beats += [beat._replace(user=0) for beat in beats[:columns]]
    elif fault == "too wide":
        beats.insert(columns - 1, beats[columns - 1]._replace(user=0, last=0))
    return beats


@cocotb.test()
@cocotb.parametrize(stall=list(STALLS))
async def choice_of_the_set(dut: HierarchyObject, stall: str) -> None:
    """Sets that are cut, torn or of another shape never serve; the older one does, or none after a change of size."""
    bench = Bench(dut, stall)
    rng, frames, sets = bench.rng, [], []
    width, height = 2, 2
    for _ in range(40):
        if rng.random() < 0.3:
            width, height = rng.randint(1, min(17, LIMITS.max_width)), rng.randint(2, 17)
        nodes = random_nodes(rng, width, height)
        frames.append(random_frame(rng, width, height, 8))
        sets.append(spoilt(rng, set_beats(nodes, rng), window_count(width, WINDOW_LOG2)))
    served = await play(bench, frames, sets)
    kinds = {(one.nodes is None, one.stale) for one in served}
    assert kinds == {(True, False), (False, True), (False, False)}, f"only {kinds} occurred; {where()}"


@cocotb.test()
@cocotb.parametrize(scene=list(SCENES), stall=list(STALLS))
async def frame_contract(dut: HierarchyObject, scene: str, stall: str) -> None:
    """The matrix, while sets come at any time, some of them torn by a start of frame."""
    bench = await Bench(dut, stall).begin()
    rng = bench.rng
    bench.send(SCENES[scene](rng, CORE))
    running = cocotb.start_soon(tell_sets(bench))
    await bench.video.drain(quiet=40, limit=1000 + 12 * len(bench.sent))
    running.cancel()
    bench.stats.stop()
    await bench.finish()


async def tell_sets(bench: Bench) -> None:
    """Tell sets that fit the configured size, with pauses."""
    while True:
        await bench.video.cycles(bench.rng.randint(1, 60))
        width, height = int(bench.dut.cfg_width.value), int(bench.dut.cfg_height.value)
        if LIMITS.allow(width, height):
            bench.stats.send_beats(set_beats(random_nodes(bench.rng, width, height), bench.rng))
            await bench.until_told()


@cocotb.test()
@cocotb.parametrize(stall=list(STALLS))
async def reset_forgets_the_thresholds(dut: HierarchyObject, stall: str) -> None:
    """What was told before the reset, and what is told after it but before a frame says its size, serves no frame."""
    bench = await Bench(dut, stall).begin()
    for _ in range(5):
        frame = random_frame(bench.rng, 9, 7, 8)
        bench.send(frame_beats(frame))
        await bench.until_started(1)
        bench.stats.send_beats(set_beats(random_nodes(bench.rng, 9, 7), bench.rng))
        await bench.until_told()
        bench.send(frame_beats(frame))
        await bench.video.cycles(bench.rng.randint(1, 120))
        bench.stats.stop()
        await bench.video.reset(bench.rng.randint(1, 3))
        bench.stats.send_beats(set_beats(random_nodes(bench.rng, 9, 7), bench.rng))
        await bench.until_told()
        bench.send(frame_beats(frame) * 2)
        served = await bench.finish()
        assert [one.nodes for one in served] == [None, None], f"thresholds survived a reset; {where()}"
        await bench.video.reset()


@cocotb.test()
async def latency(dut: HierarchyObject) -> None:
    """10 cycles for each pixel, over the ends of lines and frames: there are no bubbles."""
    bench = Bench(dut, "full_speed")
    frames = [random_frame(bench.rng, min(17, LIMITS.max_width), 5, 8) for _ in range(3)]
    nodes = random_nodes(bench.rng, frames[0].shape[1], 5)
    await play(bench, frames, [set_beats(nodes, bench.rng)] * 3)
    pairs = zip(bench.video.input.taken, bench.video.sink.taken, strict=True)
    delays = {out.cycle - into.cycle for into, out in pairs}
    assert delays == {LATENCY}, f"latencies {delays}, documented {LATENCY}; {where()}"
    received = split_frames(bench.video.sink.taken)
    cycles = received[-1][-1].cycle - received[0][0].cycle + 1
    assert cycles == 3 * frames[0].size, f"{3 * frames[0].size} pixels took {cycles} cycles; {where()}"

# SPDX-License-Identifier: Apache-2.0
"""rgb2gray: arithmetic, markers, latency, stalls and reset."""

from random import Random, getrandbits

import cocotb
import numpy as np
from cocotb.handle import HierarchyObject

from golden.rgb2gray import rgb2gray
from tb.common.compare import check_frame
from tb.common.figures import page_figures
from tb.common.matrix import STALLS, named, start
from tb.common.patterns import random_frame
from tb.common.run import parameter, where
from tb.common.stream import Beat, StreamBench, frame_beats, pack, split_frames, unpack

(LATENCY,) = page_figures("rgb2gray")
PPC = parameter("PPC", 1)


def gray_of(packed: np.ndarray) -> np.ndarray:
    """Gray values of an integer array of `{R, G, B}` words."""
    return rgb2gray(np.stack([packed >> 16 & 255, packed >> 8 & 255, packed & 255], axis=-1).astype(np.uint8))


async def send(bench: StreamBench, beats: list[Beat]) -> None:
    bench.source.send_beats(beats)
    await bench.drain(quiet=20, limit=200 + 12 * len(beats))


def ties() -> list[int]:
    """Every colour whose weighted sum is a tie of the rounding (no colour is one below a tie)."""
    red, green, blue = np.ogrid[0:256, 0:256, 0:256]
    fraction = (9798 * red + 19235 * green + 3735 * blue).astype(np.int32) & 32767
    return [int(r) << 16 | int(g) << 8 | int(b) for r, g, b in np.argwhere(fraction == 16384)]


def corner_frame() -> np.ndarray:
    """The colours at which a carry or the rounding could go wrong, and each channel alone; 32 pixels wide."""
    ends = [0, 1, 2, 127, 128, 254, 255]
    corners = [r << 16 | g << 8 | b for r in ends for g in ends for b in ends]
    ramps = [value << shift for shift in (0, 8, 16) for value in range(256)]
    words = corners + ramps + ties()
    words += words[: -len(words) % 32]
    return np.array(words, np.int64).reshape(-1, 32)


@cocotb.test()
@cocotb.parametrize(stall=named(STALLS))
async def frames_back_to_back(dut: HierarchyObject, stall: str) -> None:
    rng = Random(getrandbits(64))
    bench = await start(dut, rng, stall)
    frames = [random_frame(rng, PPC * rng.randint(1, 19), rng.randint(1, 9), 24) for _ in range(6)]
    frames.append(corner_frame())
    await send(bench, [beat for frame in frames for beat in frame_beats(frame, 24, PPC)])
    received = split_frames(bench.sink.taken)
    assert len(received) == len(frames), f"{len(received)} frames came, expected {len(frames)}; {where()}"
    for index, (beats, frame) in enumerate(zip(received, frames, strict=True)):
        check_frame(beats, gray_of(frame), f"frame {index}", bits=8, ppc=PPC)


@cocotb.test()
@cocotb.parametrize(stall=named(STALLS))
async def markers_travel_with_their_pixel(dut: HierarchyObject, stall: str) -> None:
    """Any sequence of markers, legal or not, leaves as it came."""
    rng = Random(getrandbits(64))
    bench = await start(dut, rng, stall)
    beats = [Beat(rng.getrandbits(24 * PPC), rng.getrandbits(1), rng.getrandbits(1)) for _ in range(500)]
    await send(bench, beats)
    got = [(beat.data, beat.user, beat.last) for beat in bench.sink.taken]
    grays = gray_of(np.array(unpack([beat.data for beat in beats], 24, PPC))).tolist()
    expected = [(gray, beat.user, beat.last) for gray, beat in zip(pack(grays, 8, PPC), beats, strict=True)]
    assert len(got) == len(expected), f"{len(got)} beats came, expected {len(expected)}; {where()}"
    for index, (one, other) in enumerate(zip(got, expected, strict=True)):
        assert one == other, f"beat {index}: expected (gray, tuser, tlast) {other}, got {one}; {where()}"


@cocotb.test()
async def latency(dut: HierarchyObject) -> None:
    bench = await start(dut, Random(getrandbits(64)), "full_speed")
    await send(bench, frame_beats(random_frame(bench.rng, 16 * PPC, 4, 24), 24, PPC))
    delays = {out.cycle - into.cycle for into, out in zip(bench.input.taken, bench.sink.taken, strict=True)}
    assert delays == {LATENCY}, f"latencies {delays}, documented {LATENCY}; {where()}"
    cycles = bench.input.taken[-1].cycle - bench.input.taken[0].cycle
    assert cycles == 63, f"64 beats took {cycles + 1} cycles; {where()}"


@cocotb.test()
@cocotb.parametrize(stall=named(STALLS))
async def reset_drops_what_is_inside(dut: HierarchyObject, stall: str) -> None:
    rng = Random(getrandbits(64))
    bench = await start(dut, rng, stall)
    for _ in range(10):
        bench.source.send_beats(frame_beats(random_frame(rng, 20, 10, 24), 24, PPC))
        await bench.cycles(rng.randint(1, 100))
        await bench.reset(rng.randint(1, 3))
        frame = random_frame(rng, 5 * PPC, 3, 24)
        await send(bench, frame_beats(frame, 24, PPC))
        check_frame(bench.sink.taken, gray_of(frame), "frame after reset", bits=8, ppc=PPC)

# SPDX-License-Identifier: Apache-2.0
"""The frame contract matrix: every scene x every stall pattern, for cores with one video input and one video output.

A test module needs no more than this::

    CORE = VideoCore(golden=erode3x3, bits_in=1, reach=1, limits=SizeLimits(2, 1, MAX_WIDTH, MAX_HEIGHT))

    @cocotb.test()
    @cocotb.parametrize(scene=named(SCENES), stall=named(STALLS))
    async def frame_contract(dut, scene, stall):
        await run_scene(dut, CORE, scene, stall)

Cores with other outputs use `SCENES[name](rng, core)` for the beats and `contract.sent_frames` for what they hold.
"""

from collections.abc import Callable
from dataclasses import dataclass
from random import Random, getrandbits

import cocotb
import numpy as np
from cocotb.handle import HierarchyObject

from tb.common.compare import check_frame, check_markers
from tb.common.contract import SentFrame, SizeLimits, sent_frames
from tb.common.figures import page_figures
from tb.common.patterns import random_frame, structured_frames
from tb.common.run import core_name, where
from tb.common.stream import Beat, StreamBench, Taken, frame_beats, split_frames, stalls, unpack


@dataclass(frozen=True)
class VideoCore:
    """A core with one video stream in and one out, pixel for pixel.

    Args:
        golden: integer array (height, width) -> the same shape.
        bits_in: width of an input pixel, and of an output one.
        reach: how many rows and columns around a pixel its output depends on (0 pointwise, 1 for 3x3, 2 for 5x5).
        limits: legal frame sizes.
        ppc: pixels a beat.
    """

    golden: Callable[[np.ndarray], np.ndarray]
    bits_in: int
    reach: int
    limits: SizeLimits
    ppc: int = 1

    @property
    def reach_beats(self) -> int:
        """How many beats left and right of a beat its output depends on."""
        return -(-self.reach // self.ppc)


# (idle fraction, backpressure fraction)
STALLS = {"full_speed": (0.0, 0.0), "idle": (0.5, 0.0), "backpressure": (0.0, 0.5), "idle_backpressure": (0.4, 0.4)}

Scene = Callable[[Random, VideoCore], list[Beat]]


def named(table: dict[str, object]) -> list[cocotb.Param]:
    """Return options for `cocotb.parametrize`: the keys, spelled out in the names of the tests."""
    return [cocotb.Param(value=key, name=key) for key in table]


def random_size(rng: Random, core: VideoCore) -> tuple[int, int]:
    """Return a small legal frame size, odd and even ones alike where they are legal."""
    limits, ppc = core.limits, core.ppc
    width = rng.randint(max(limits.min_width // ppc, 3), min(limits.max_width // ppc, 17))
    return width * ppc, rng.randint(max(limits.min_height, 3), min(limits.max_height, 11))


def _frame(rng: Random, core: VideoCore, size: tuple[int, int] | None = None) -> list[Beat]:
    width, height = size or random_size(rng, core)
    return frame_beats(random_frame(rng, width, height, core.bits_in), core.bits_in, core.ppc)


def _stray(rng: Random, core: VideoCore, last: int | None = None) -> Beat:
    """Return a beat of no frame; `tlast` at random unless it is given."""
    data = rng.getrandbits(core.bits_in * core.ppc)
    return Beat(data, 0, rng.getrandbits(1) if last is None else last)


def _around(rng: Random, core: VideoCore, middle: list[Beat]) -> list[Beat]:
    """Put beats between two good frames, the second twice so that it is followed by another."""
    return _frame(rng, core) + middle + _frame(rng, core) + _frame(rng, core)


def _clean(rng: Random, core: VideoCore) -> list[Beat]:
    size = random_size(rng, core)
    return [beat for _ in range(4) for beat in _frame(rng, core, size)]


def _structured(rng: Random, core: VideoCore) -> list[Beat]:
    width, height = random_size(rng, core)
    frames = structured_frames(rng, width, height, core.bits_in)
    return [beat for frame in frames.values() for beat in frame_beats(frame, core.bits_in, core.ppc)]


def _sizes(rng: Random, core: VideoCore) -> list[Beat]:
    limits = core.limits
    widths = [limits.min_width + step * core.ppc for step in range(5)]
    heights = [limits.min_height + step for step in range(5)]
    sizes = [(width, height) for width in widths for height in heights]
    sizes += [(limits.max_width, limits.min_height + 2), (limits.min_width, limits.max_height)]
    if limits.max_width * limits.max_height <= 4096:
        sizes += [(limits.max_width, limits.max_height)] * 2
    rng.shuffle(sizes)
    return [beat for size in sizes if limits.allow(*size) for beat in _frame(rng, core, size)]


def _beats_before_first(rng: Random, core: VideoCore) -> list[Beat]:
    return [_stray(rng, core) for _ in range(20)] + _frame(rng, core) + _frame(rng, core)


def _extra_beats(rng: Random, core: VideoCore) -> list[Beat]:
    return _around(rng, core, [_stray(rng, core) for _ in range(rng.randint(1, 30))])


def _wrong_line(lengthen: bool) -> Scene:
    def scene(rng: Random, core: VideoCore) -> list[Beat]:
        width, height = random_size(rng, core)
        line = width // core.ppc
        lines = [_frame(rng, core, (width, height))[y * line : (y + 1) * line] for y in range(height)]
        bad = rng.randrange(height)
        if lengthen:
            extra = [_stray(rng, core, last=0) for _ in range(rng.randint(1, line))]
            lines[bad] = lines[bad][:-1] + extra + lines[bad][-1:]
            lines[bad] = [beat._replace(last=int(i == len(lines[bad]) - 1)) for i, beat in enumerate(lines[bad])]
        else:
            lines[bad] = lines[bad][: rng.randint(1, line - 1)]
            lines[bad][-1] = lines[bad][-1]._replace(last=1)
        return _around(rng, core, [beat for line in lines for beat in line])

    return scene


def _cut(at_line: bool) -> Scene:
    def scene(rng: Random, core: VideoCore) -> list[Beat]:
        width, height = random_size(rng, core)
        line = width // core.ppc
        keep = line * rng.randint(1, height - 1) if at_line else rng.randint(1, line * height - 1)
        return _around(rng, core, _frame(rng, core, (width, height))[:keep])

    return scene


def _starts_in_a_row(rng: Random, core: VideoCore) -> list[Beat]:
    size = random_size(rng, core)
    return _around(rng, core, [_frame(rng, core, size)[0] for _ in range(rng.randint(2, 6))])


def _illegal_size(rng: Random, core: VideoCore) -> list[Beat]:
    """Frames that are what the configuration says, but whose size the core must refuse; each before a good one."""
    limits, ppc = core.limits, core.ppc
    sizes = [
        (limits.max_width + ppc, limits.min_height),
        (limits.min_width, limits.max_height + 1),
        (limits.min_width - ppc, limits.min_height + 1),
        (limits.min_width + ppc, limits.min_height - 1),
    ]
    beats = []
    for size in sizes:
        if min(size) > 0:
            beats += _frame(rng, core, size) + _frame(rng, core)
    part_of_a_beat = [(limits.min_width + ppc + more, limits.min_height) for more in range(1, ppc)]
    for size in ((0, 0), (65535, 65535), *part_of_a_beat):
        start, *rest = _frame(rng, core)
        beats += [start._replace(size=size), *rest, *_frame(rng, core)]
    return beats


def _noise(rng: Random, core: VideoCore) -> list[Beat]:
    """Frames in which markers flip and beats vanish or double at random, each bad one followed by a good one."""
    beats: list[Beat] = []
    for _ in range(8):
        for beat in _frame(rng, core):
            fate = rng.random()
            if fate < 0.02:
                continue
            if fate < 0.03:
                beat = beat._replace(last=1 - beat.last)  # noqa: PLW2901
            elif fate < 0.04:
                beats.append(beat._replace(size=None))
            elif fate < 0.045:
                beat = beat._replace(user=1 - beat.user)  # noqa: PLW2901
            beats.append(beat)
        beats += _frame(rng, core)
    return beats


SCENES: dict[str, Scene] = {
    "clean": _clean,
    "structured": _structured,
    "sizes": _sizes,
    "beats_before_first": _beats_before_first,
    "extra_beats": _extra_beats,
    "short_line": _wrong_line(lengthen=False),
    "long_line": _wrong_line(lengthen=True),
    "cut_in_line": _cut(at_line=False),
    "missing_lines": _cut(at_line=True),
    "starts_in_a_row": _starts_in_a_row,
    "illegal_size": _illegal_size,
    "noise": _noise,
}


def _seeded(name: str) -> Random:
    # cocotb seeds `random` from the seed of the run and the name of the test.
    return Random(f"{name} {getrandbits(64)}")


async def run_scene(dut: HierarchyObject, core: VideoCore, scene: str, stall: str) -> None:
    """Send one scene and check output frames, markers, `frame_error` count and the protocol."""
    rng = _seeded(scene)
    bench = await start(dut, rng, stall)
    await send_and_check(bench, core, SCENES[scene](rng, core))


async def run_reset(dut: HierarchyObject, core: VideoCore, stall: str) -> None:
    """Reset at random times within a frame; after each, only what was sent since may come out."""
    rng = _seeded("reset")
    bench = await start(dut, rng, stall)
    for _ in range(5):
        bench.source.send_beats(_clean(rng, core))
        await bench.cycles(rng.randint(1, 400))
        await bench.reset(rng.randint(1, 3))
        await send_and_check(bench, core, _frame(rng, core) + _frame(rng, core))


async def start(dut: HierarchyObject, rng: Random, stall: str) -> StreamBench:
    """Return a bench after reset with the named stall pattern."""
    bench = StreamBench(dut, rng)
    idle, backpressure = STALLS[stall]
    bench.source.pause = stalls(Random(rng.getrandbits(64)), idle)
    bench.sink.pause = stalls(Random(rng.getrandbits(64)), backpressure)
    await bench.reset()
    return bench


async def send_and_check(bench: StreamBench, core: VideoCore, beats: list[Beat]) -> None:
    """Send beats and check all that comes out until the core is quiet."""
    frames, errors = sent_frames(beats, core.limits, core.bits_in, core.ppc)
    bench.source.send_beats(beats)
    flush = sum((core.reach + 1) * (frame.width + 4) for frame in frames)
    await bench.drain(quiet=60 + 8 * core.limits.min_width, limit=1000 + 12 * (len(beats) + flush))
    check_frames(split_frames(bench.sink.taken), frames, core)
    assert bench.errors is None or bench.errors.count == errors, (
        f"frame_error pulsed {bench.errors.count} times, expected {errors}; {where()}"
    )


def check_frames(received: list[list[Taken]], sent: list[SentFrame], core: VideoCore) -> None:
    """Assert that each complete frame came out whole, and of each cut one what its pixels determine and no more."""
    remaining = list(received)
    for index, frame in enumerate(sent):
        name = f"frame {index} of {len(sent)}"
        expected = core.golden(frame.image())
        count = determined(frame, core)
        if not count:
            continue
        assert remaining, f"{name} ({frame.width}x{frame.height}) did not come; {where()}"
        beats = remaining.pop(0)
        if frame.complete:
            check_frame(beats, expected, name, core.reach, bits=core.bits_in, ppc=core.ppc)
            continue
        got = unpack([beat.data for beat in beats], core.bits_in, core.ppc)
        wanted = expected.ravel()[:count].tolist()
        least = count - held_back(frame, core)
        assert got == wanted[: len(got)] and least <= len(got), (
            f"{name}, cut off after {len(frame.pixels)} of {frame.width}x{frame.height} pixels: "
            f"expected {least} to {count} pixels of {wanted}, got {len(got)}: {got}; {where()}"
        )
        check_markers(beats, frame.width, f"cut {name}", core.ppc)
    assert not remaining, f"{len(remaining)} frames came that nobody sent, the first {remaining[0][:5]}; {where()}"


def determined(frame: SentFrame, core: VideoCore) -> int:
    """Number of output pixels, from the first and in whole beats, whose windows lie in the pixels that came."""
    line = frame.width // core.ppc
    for index in range(line * frame.height):
        y, x = divmod(index, line)
        newest = min(y + core.reach, frame.height - 1) * line + min(x + core.reach_beats, line - 1)
        if newest * core.ppc >= len(frame.pixels):
            return index * core.ppc
    return frame.width * frame.height


def held_back(frame: SentFrame, core: VideoCore) -> int:
    """How many of these pixels may stay inside: the ends of a line wait until as many columns of the next have come.

    They leave by themselves before the next line begins; so it depends on the gaps whether a frame that is cut off
    right after the first beat of a line holds some back.
    """
    begun = len(frame.pixels) % frame.width // core.ppc
    return (core.reach_beats - begun) * core.ppc if 0 < begun < core.reach_beats else 0


async def check_latency(dut: HierarchyObject, core: VideoCore) -> None:
    """Assert the latency and throughput that the page of the core gives, at full speed.

    Each output beat must leave so many cycles after the newest beat it depends on was taken (on the border: after the
    cycle in which that beat would have been taken, were the frame larger), and the next frame must be taken as many
    lines after the last beat as a window reaches.
    """
    lines, columns, cycles = page_figures(core_name())
    assert (lines, columns) == (core.reach, core.reach), f"the page says {lines} lines, {columns} pixels; {where()}"
    bench = await start(dut, _seeded("latency"), "full_speed")
    width, height = core.limits.min_width + 8, core.limits.min_height + 6
    beats = _frame(bench.rng, core, (width, height)) * 2
    await send_and_check(bench, core, beats)
    line = width // core.ppc
    in_frame = line * height
    for frame in range(2):
        first = bench.input.taken[frame * in_frame].cycle
        for index in range(in_frame):
            entered = bench.input.taken[frame * in_frame + index].cycle - first
            assert entered == index, f"frame {frame}: beat {index} was taken {entered - index} cycles late; {where()}"
            expected = index + core.reach * line + core.reach_beats + cycles
            left = bench.sink.taken[frame * in_frame + index].cycle - first
            assert left == expected, (
                f"frame {frame}: beat {index} left {left} cycles after the first was taken, documented {expected} "
                f"({core.reach} lines, {core.reach_beats} beats and {cycles} cycles); {where()}"
            )
    pause = bench.input.taken[in_frame].cycle - bench.input.taken[in_frame - 1].cycle - 1
    assert pause == lines * line, (
        f"the input stalled {pause} cycles after a frame, documented {lines} x {line}; {where()}"
    )

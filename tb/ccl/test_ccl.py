# SPDX-License-Identifier: Apache-2.0
"""Tests of ccl against the golden labelling.

The mass of images is in tb/ccl/test_exhaustive.py; here are the protocol, X, the frame contract, the configuration, and
each latency to the clock.
"""

from collections.abc import Iterator
from random import Random, getrandbits

import cocotb
import numpy as np
from cocotb.handle import HierarchyObject

from golden.ccl import ccl
from golden.generated.landing_regs import OBJECT_DTYPE
from tb.ccl.tb_ccl import CLOSE_CLOCKS, LAST_LINE_CLOCKS, NEXT_CLOCKS, QUEUED, REPORT_AT_EDGE_CLOCKS, REPORT_CLOCKS
from tb.common.contract import SentFrame, SizeLimits, sent_frames
from tb.common.matrix import SCENES, STALLS, VideoCore, named, start
from tb.common.patterns import structured_frames
from tb.common.run import parameter, where
from tb.common.stream import Beat, PulseCounter, StreamBench, Taken, frame_beats, split_frames

MAX_WIDTH = parameter("MAX_WIDTH", 1280)
MAX_HEIGHT = parameter("MAX_HEIGHT", 720)
AREA = parameter("AREA", 1)
MOMENTS = parameter("MOMENTS", 2)
CORE = VideoCore(golden=lambda image: image, bits_in=1, reach=0, limits=SizeLimits(1, 1, MAX_WIDTH, MAX_HEIGHT))


class Config:
    """Drives `cfg_min_area` and `cfg_label_zeros`, with new values for each frame if `vary`, and remembers them."""

    def __init__(self, bench: StreamBench, rng: Random, vary: bool) -> None:
        self.min_area, self.zeros = rng.choice([0, 1, 2, 5, 1000, 0xFFFFFFFF]), rng.getrandbits(1)
        self.of_frame: list[tuple[int, int]] = []
        self._bench, self._rng, self._vary = bench, rng, vary
        self._set_size = bench.source.on_beat
        bench.source.on_beat = self._on_beat
        self._drive(self.min_area, self.zeros)

    def _drive(self, min_area: int, zeros: int) -> None:
        self._bench.dut.cfg_min_area.value = min_area
        self._bench.dut.cfg_label_zeros.value = zeros

    def _on_beat(self, beat: Beat) -> None:
        self._set_size(beat)
        if not self._vary:
            return
        if beat.user:
            self.of_frame.append((self._rng.choice([0, 0, 1, 2, 3, 5]), self._rng.getrandbits(1)))
            self._drive(*self.of_frame[-1])
        else:
            # Only what is there with the start of frame counts.
            self._drive(self._rng.getrandbits(32), self._rng.getrandbits(1))


def golden_objects(image: np.ndarray, min_area: int, zeros: int) -> np.ndarray:
    """Golden objects of those that this build sends."""
    return ccl(image, min_area if AREA else 0, bool(zeros))


def as_built(objects: np.ndarray) -> np.ndarray:
    """Golden objects, without what this build leaves out."""
    left_out = [] if AREA else ["area"]
    for level, names in {1: ["sum_x", "sum_y"], 2: ["sum_xx", "sum_yy", "sum_xy"]}.items():
        left_out += names if level > MOMENTS else []
    for name in left_out:
        objects[name] = 0
    return objects


def object_of(beat: Taken) -> np.void:
    """Decode a beat."""
    return np.frombuffer(beat.data.to_bytes(64, "little"), OBJECT_DTYPE)[0]


def check_objects(beats: list[Taken], expected: np.ndarray, name: str) -> None:
    """Assert that the beats are the first of the expected objects, field by field."""
    for index, beat in enumerate(beats):
        assert not beat.last, f"{name}: beat {index} has tlast; {where()}"
        assert index < expected.size, f"{name}: object {index} of {expected.size} came: {object_of(beat)}; {where()}"
        got = object_of(beat)
        for field in OBJECT_DTYPE.names:
            assert got[field] == expected[index][field], (
                f"{name}: object {index} of {expected.size} (last pixel in raster order): {field} is {got[field]}, "
                f"expected {expected[index][field]}; got {got}, expected {expected[index]}; {where()}"
            )


def due_objects(frame: SentFrame, min_area: int, zeros: int) -> np.ndarray:
    """Golden objects of a frame; of one that is cut off those that its pixels show to be whole."""
    if frame.complete:
        return as_built(golden_objects(frame.image(), min_area, zeros))
    # Whole is what stays as it is whatever else comes; what reaches the last line comes with the end of the frame.
    missing = (np.arange(frame.width * frame.height) >= len(frame.pixels)).reshape(frame.height, frame.width)
    without, with_all = (np.where(missing, value, frame.image()) for value in (zeros, 1 - zeros))
    others = {item.tobytes() for item in golden_objects(with_all, min_area, zeros)}
    objects = golden_objects(without, min_area, zeros)
    due = [item.tobytes() in others and item["box_max_y"] < frame.height - 1 for item in objects]
    return as_built(objects[np.array(due, bool)])


def check_frames(taken: list[Taken], sent: list[SentFrame], configs: Iterator[tuple[int, int]]) -> None:
    """Assert all objects and a trailer for each complete frame; of a cut one those that were due, and no others."""
    groups = split_frames(taken)
    for index, (frame, (min_area, zeros)) in enumerate(zip(sent, configs, strict=False)):
        name = f"frame {index} of {len(sent)} ({frame.width}x{frame.height}, min_area {min_area}, zeros {zeros})"
        expected = due_objects(frame, min_area, zeros)
        least = expected.size
        if not frame.complete:
            # One at the end of a line is a clock late; the next frame, if it comes at once, may forget it.
            whole_lines = len(frame.pixels) % frame.width == 0
            least -= bool(whole_lines and least and expected[-1]["box_max_x"] == frame.width - 1)
            fits = groups and not groups[0][-1].last and object_of(groups[0][0]).tobytes() == expected[:1].tobytes()
            if not least and not fits:
                continue
        assert groups, f"{name}: nothing came; {where()}"
        objects = groups.pop(0)
        if frame.complete:
            *objects, trailer = objects
            assert trailer.last, f"{name}: {len(objects) + 1} beats without a trailer, expected {expected}; {where()}"
            assert trailer.data == 0, f"{name}: the trailer is not zero; {where()}"
        check_objects(objects, expected, name)
        assert least <= len(objects), f"{name}: {len(objects)} of {expected.size} objects; {where()}"
    assert not groups, f"{len(groups)} frames came that nobody sent; {where()}"


def forever(value: tuple[int, int]) -> Iterator[tuple[int, int]]:
    """Yield the same configuration for each frame."""
    while True:
        yield value


async def send_and_check(bench: StreamBench, beats: list[Beat], config: Config, sent: list[SentFrame]) -> None:
    """Send, wait until the core is quiet, check."""
    bench.source.send_beats(beats)
    await bench.drain(quiet=2 * MAX_WIDTH + 60, limit=2000 + 30 * len(beats))
    check_frames(
        bench.sink.taken, sent, iter(config.of_frame) if config.of_frame else forever((config.min_area, config.zeros))
    )


async def reset_and_check(bench: StreamBench, beats: list[Beat], config: Config) -> None:
    """Reset, send, check objects and pulses: what comes is that of these beats from the first clock on."""
    dut = bench.dut
    # They count from the next reset on.
    started = PulseCounter(dut.frame_started, dut.clk, dut.rst)
    last = PulseCounter(dut.last_pixel, dut.clk, dut.rst)
    await bench.reset(bench.rng.randint(1, 3))
    frames, errors = sent_frames(beats, CORE.limits)
    await send_and_check(bench, beats, config, frames)
    for name, got, expected in (
        ("frame_error", bench.errors.count, errors),
        ("frame_started", started.count, len(frames)),
        ("last_pixel", last.count, sum(frame.complete for frame in frames)),
    ):
        assert got == expected, f"{name} pulsed {got} times, expected {expected}; {where()}"


def random_image(rng: Random, width: int, height: int) -> np.ndarray:
    """Independent pixels of a random density of 1 to 99 %."""
    generator = np.random.default_rng(rng.getrandbits(64))
    return (generator.random((height, width)) < rng.randint(1, 99) / 100).astype(np.int64)


def seeded() -> Random:
    """Return a generator that follows the seed of the run."""
    return Random(getrandbits(64))


@cocotb.test()
@cocotb.parametrize(scene=named(SCENES), stall=named(STALLS))
async def frame_contract(dut: HierarchyObject, scene: str, stall: str) -> None:
    rng = seeded()
    bench = await start(dut, rng, stall)
    config = Config(bench, rng, vary=False)
    await reset_and_check(bench, SCENES[scene](rng, CORE), config)


@cocotb.test()
@cocotb.parametrize(stall=named(STALLS))
async def random_images(dut: HierarchyObject, stall: str) -> None:
    rng = seeded()
    bench = await start(dut, rng, stall)
    config = Config(bench, rng, vary=True)
    images = [random_image(rng, rng.randint(1, MAX_WIDTH), rng.randint(1, MAX_HEIGHT)) for _ in range(25)]
    beats = [beat for image in images for beat in frame_beats(image)]
    await send_and_check(bench, beats, config, sent_frames(beats, CORE.limits)[0])


@cocotb.test()
@cocotb.parametrize(stall=named(STALLS))
async def hard_images(dut: HierarchyObject, stall: str) -> None:
    rng = seeded()
    bench = await start(dut, rng, stall)
    config = Config(bench, rng, vary=True)
    images = list(structured_frames(rng, MAX_WIDTH, MAX_HEIGHT, 1).values())
    beats = [beat for image in images for beat in frame_beats(image)]
    await send_and_check(bench, beats, config, sent_frames(beats, CORE.limits)[0])


@cocotb.test()
@cocotb.parametrize(stall=named(STALLS))
async def reset_within_a_frame(dut: HierarchyObject, stall: str) -> None:
    rng = seeded()
    bench = await start(dut, rng, stall)
    config = Config(bench, rng, vary=False)
    for _ in range(8):
        bench.source.send_beats([b for _ in range(4) for b in frame_beats(random_image(rng, MAX_WIDTH, MAX_HEIGHT))])
        await bench.cycles(rng.randint(1, 3 * MAX_WIDTH * MAX_HEIGHT))
        beats = [beat for _ in range(2) for beat in frame_beats(random_image(rng, MAX_WIDTH, MAX_HEIGHT))]
        await reset_and_check(bench, beats, config)


@cocotb.test()
async def blocked_output_loses_nothing(dut: HierarchyObject) -> None:
    """The output stands still until the input does, with as many waiting as the page says; then all of it comes."""
    rng = seeded()
    bench = await start(dut, rng, "full_speed")
    config = Config(bench, rng, vary=False)
    config.min_area = config.zeros = dut.cfg_min_area.value = dut.cfg_label_zeros.value = 0
    blocked = [True]
    bench.sink.pause = iter(lambda: blocked[0], None)
    dots = np.zeros((MAX_HEIGHT, MAX_WIDTH), np.int64)
    dots[::2, ::2] = 1
    beats = [beat for _ in range(4) for beat in frame_beats(dots)]
    bench.source.send_beats(beats)
    await bench.cycles(8 * dots.size)
    assert not bench.source.empty, f"the input did not stall although {np.sum(dots)} objects wait; {where()}"
    assert not bench.sink.taken
    accepted = [beat.cycle for beat in bench.input.taken]
    stalled = accepted[-1] + 1
    # What came after the stall is of a pixel that was taken: those behind it would have been due later.
    accepted += [stalled + dots.size] * dots.size
    waiting = sum(report_clock(place, accepted, dots) <= stalled for place in last_pixels(dots))
    assert waiting == QUEUED, f"{waiting} components waited as the input stalled, expected {QUEUED}; {where()}"
    blocked[0] = False
    await send_and_check(bench, [], config, sent_frames(beats, CORE.limits)[0])


@cocotb.test()
async def latency_and_stall_to_the_clock(dut: HierarchyObject) -> None:
    """At full speed each object comes, and the input goes on, in exactly the clock that the page of the core says."""
    rng = seeded()
    bench = await start(dut, rng, "full_speed")
    config = Config(bench, rng, vary=False)
    config.min_area = config.zeros = dut.cfg_min_area.value = dut.cfg_label_zeros.value = 0
    for _ in range(12):
        bench.input.taken.clear()
        bench.sink.taken.clear()
        image = random_image(rng, rng.randint(1, MAX_WIDTH), rng.randint(2, MAX_HEIGHT))
        height, width = image.shape
        beats = frame_beats(image) + frame_beats(image)
        await send_and_check(bench, beats, config, sent_frames(beats, CORE.limits)[0])
        accepted = [beat.cycle for beat in bench.input.taken]
        first = [beat.cycle for beat in split_frames(bench.sink.taken)[0]]
        runs = run_ends(image[-1])
        expected = [report_clock(place, accepted, image) for place in last_pixels(image)]
        expected.append(accepted[image.size - 1] + CLOSE_CLOCKS + len(runs))
        assert first == expected, f"{width}x{height}: objects came in clocks {first}, expected {expected}; {where()}"
        after, promised = accepted[image.size], accepted[image.size - 1] + NEXT_CLOCKS + len(runs)
        assert after == promised, f"{width}x{height}: next frame in clock {after}, expected {promised}; {where()}"
        steps = np.diff(accepted[: image.size])
        assert (steps == 1).all(), f"{width}x{height}: the input stalled within a frame; {where()}"


def run_ends(line: np.ndarray) -> list[int]:
    """Return the columns in which runs of ones end."""
    return np.flatnonzero(np.diff(np.append(line, 0)) == -1).tolist()


def last_pixels(image: np.ndarray) -> list[tuple[int, int]]:
    """Return (x, y) of the last pixel in raster order of each component, in raster order."""
    places = []
    for y in range(image.shape[0]):
        for x in run_ends(image[y]):
            # A run holds the last pixel of its component if the component of all up to here ends with it.
            upto = image.copy()
            upto[y + 1 :] = 0
            upto[y, x + 1 :] = 0
            grown = ccl(upto)[-1]
            if any(np.array_equal(grown, whole) for whole in ccl(image)):
                places.append((x, y))
    return places


def report_clock(place: tuple[int, int], accepted: list[int], image: np.ndarray) -> int:
    """Return the clock in which the object with that last pixel is due."""
    (x, y), (height, width) = place, image.shape
    if y == height - 1:
        return accepted[image.size - 1] + LAST_LINE_CLOCKS + run_ends(image[y]).index(x)
    if x == width - 1:
        return accepted[(y + 2) * width - 1] + REPORT_AT_EDGE_CLOCKS
    return accepted[(y + 1) * width + x + 1] + REPORT_CLOCKS

# SPDX-License-Identifier: Apache-2.0
"""The model of which thresholds serve which frame, and the bench with both streams."""

from collections.abc import Iterator
from random import Random, getrandbits
from typing import NamedTuple

import cocotb
import numpy as np
from cocotb.handle import HierarchyObject
from cocotb.triggers import RisingEdge

from golden.threshold_apply import threshold_apply, threshold_map
from golden.threshold_stats import window_count
from tb.common.compare import check_frame, check_markers
from tb.common.contract import SentFrame, SizeLimits, sent_frames
from tb.common.matrix import STALLS, start
from tb.common.run import parameter, where
from tb.common.stream import Beat, StreamBench, StreamMonitor, StreamSource, Taken, split_frames, stalls

WINDOW_LOG2 = parameter("WINDOW_LOG2", 7)
LIMITS = SizeLimits(1, 1, parameter("MAX_WIDTH", 1280), parameter("MAX_HEIGHT", 720))


class Served(NamedTuple):
    """What one frame is compared with; `nodes` is None while thresholds are missing."""

    nodes: np.ndarray | None
    stale: bool


class Sets:
    """Which set of thresholds serves which frame, from the hand-overs in their order."""

    def __init__(self) -> None:
        self.serving: np.ndarray | None = None
        self.whole: np.ndarray | None = None
        self.rows: list[list[int]] | None = None
        self.shape: tuple[int, int] | None = None

    def start(self, width: int, height: int) -> Served:
        """Take the start of a good frame and return what serves it."""
        shape = window_count(height, WINDOW_LOG2), window_count(width, WINDOW_LOG2)
        if shape != self.shape:
            self.serving, self.whole = None, None
        stale = self.serving is not None and self.whole is None
        if self.whole is not None:
            self.serving = self.whole
        self.shape, self.whole, self.rows = shape, None, None
        return Served(self.serving, stale)

    def beat(self, data: int, user: int, last: int) -> None:
        """Take one beat of the stat stream. A set with a wrong marker, or a beat too many, ends there."""
        if self.shape is None:
            return
        if user:
            self.rows, self.whole = [[]], None
        if self.rows is None:
            return
        rows, (height, width) = self.rows, self.shape
        rows[-1].append(data & 0xFFFF)
        if last != int(len(rows[-1]) == width):
            self.rows = None
        elif last and len(rows) == height:
            self.whole, self.rows = np.array(rows, dtype=np.uint16), None
        elif last:
            rows.append([])


def dark_of(first_pixel: int) -> bool:
    """Return the `cfg_dark_is_one` that goes with a frame, so that model and bench agree without talking."""
    return bool(first_pixel & 1)


def set_beats(nodes: np.ndarray, rng: Random) -> list[Beat]:
    """Return the beats of a set of thresholds (rows, columns); the extremes are noise."""
    columns = nodes.shape[1]
    return [
        Beat(rng.getrandbits(16) << 16 | value, int(index == 0), int(index % columns == columns - 1))
        for index, value in enumerate(nodes.ravel().tolist())
    ]


def random_nodes(rng: Random, width: int, height: int) -> np.ndarray:
    """Return thresholds for a frame: uint16 (rows, columns), anything that threshold_stats can tell, ends included."""
    generator = np.random.default_rng(rng.getrandbits(64))
    shape = window_count(height, WINDOW_LOG2), window_count(width, WINDOW_LOG2)
    if rng.random() < 0.3:
        return generator.choice(np.array([0, 1, 0xFF00, 0xFEFF, 0x8000], np.uint16), shape)
    return generator.integers(0, 0xFF01, shape, dtype=np.uint16)


class Bench:
    """`StreamBench` with the stat stream, and the levels of each frame."""

    def __init__(self, dut: HierarchyObject, stall: str) -> None:
        self.dut, self.stall, self.rng = dut, stall, Random(getrandbits(64))
        self.stats = StreamSource(dut, "s_stat_axis", dut.clk, Random(self.rng.getrandbits(64)))
        self.told = StreamMonitor(dut, "s_stat_axis", dut.clk, dut.rst)
        self.levels: list[tuple[int, int]] = []
        self.sums: list[int | None] = []
        self.video: StreamBench
        self.sent: list[Beat] = []

    async def begin(self) -> "Bench":
        """Start clock and reset."""
        self.dut.cfg_dark_is_one.value = 0
        # The stat stream counts cycles from the same edge as the others.
        self.video = await start(self.dut, self.rng, self.stall)
        self.video.logs += [self.told.taken, self.sent, self.levels]
        self.stats.pause = stalls(Random(self.rng.getrandbits(64)), STALLS[self.stall][0])
        set_size = self.video.source.on_beat

        def on_beat(beat: Beat) -> None:
            set_size(beat)
            # It counts with the first pixel alone.
            self.dut.cfg_dark_is_one.value = dark_of(beat.data) if beat.user else self.rng.getrandbits(1)

        self.video.source.on_beat = on_beat
        cocotb.start_soon(self._watch_levels())
        cocotb.start_soon(self._watch_stat_ready())
        cocotb.start_soon(self._watch_sums())
        return self

    def send(self, beats: list[Beat]) -> None:
        """Queue beats of video."""
        self.sent += beats
        self.video.source.send_beats(beats)

    async def until_started(self, frames: int) -> None:
        """Wait until so many starts of frame were handed over."""
        taken, started, seen = self.video.input.taken, 0, 0
        while True:
            started += sum(beat.user for beat in taken[seen:])
            seen = len(taken)
            if started >= frames:
                return
            await RisingEdge(self.dut.clk)

    async def until_told(self) -> None:
        """Wait until the stat stream is handed over."""
        while not self.stats.empty:
            await RisingEdge(self.dut.clk)

    async def finish(self) -> list[Served]:
        """Drain, check all that came out, and return what served each frame."""
        await self.video.drain(quiet=40, limit=1000 + 12 * len(self.sent))
        frames, errors = sent_frames(self.sent, LIMITS)
        served = self._served(frames)
        received = split_frames(self.video.sink.taken)
        assert len(received) == len(frames), f"{len(received)} frames came, expected {len(frames)}; {where()}"
        for index, (beats, frame, serving) in enumerate(zip(received, frames, served, strict=True)):
            check(beats, frame, serving, f"frame {index}")
            sums, self.sums = self.sums[: len(beats)], self.sums[len(beats) :]
            check_sums(sums, frame, serving, f"frame {index}")
        levels = [(int(one.nodes is None), int(one.stale)) for one in served]
        assert self.levels == levels, f"(missing, stale) {self.levels}, expected {levels}; {where()}"
        pulses = self.video.errors.count
        assert pulses == errors, f"frame_error pulsed {pulses} times, expected {errors}; {where()}"
        return served

    def _served(self, frames: list[SentFrame]) -> list[Served]:
        """Replay the hand-overs; a stat beat in the same cycle as a start of frame comes too late and is lost."""
        model, served, told = Sets(), [], iter(self.told.taken)
        pending: Taken | None = next(told, None)
        remaining: Iterator[SentFrame] = iter(frames)
        size = (0, 0)
        for beat, taken in zip(self.sent, self.video.input.taken, strict=True):
            size = beat.size or size
            if not beat.user or not LIMITS.allow(*size) or beat.last != int(size[0] == 1):
                continue
            while pending and pending.cycle < taken.cycle:
                model.beat(pending.data, pending.user, pending.last)
                pending = next(told, None)
            frame = next(remaining)
            served.append(model.start(frame.width, frame.height))
            if pending and pending.cycle == taken.cycle:
                pending = next(told, None)
        return served

    async def _watch_levels(self) -> None:
        """Record both levels after each start of frame handed over; elsewhere they stand still."""
        dut, edge, last, started = self.dut, RisingEdge(self.dut.clk), (1, 0), False
        while True:
            await edge
            if int(dut.rst.value):
                last, started = (1, 0), False
                continue
            now = (int(dut.thresholds_missing.value), int(dut.thresholds_stale.value))
            if started:
                self.levels.append(now)
            else:
                assert now == last, f"(missing, stale) changed to {now} within a frame; {where()}"
            last = now
            valid, ready = int(dut.m_axis_tvalid.value), int(dut.m_axis_tready.value)
            started = bool(valid and ready and int(dut.m_axis_tuser.value))

    async def _watch_stat_ready(self) -> None:
        """The stat stream waits only after a start of frame was taken, until the pipeline has moved by one pixel."""
        dut, edge, may_wait = self.dut, RisingEdge(self.dut.clk), False
        while True:
            await edge
            if int(dut.rst.value):
                may_wait = True
                continue
            ready = int(dut.s_stat_axis_tready.value)
            assert ready or may_wait, f"s_stat_axis_tready is 0 without a start of frame; {where()}"
            start = int(dut.s_axis_tvalid.value) and int(dut.s_axis_tready.value) and int(dut.s_axis_tuser.value)
            may_wait = bool(start) or (may_wait and not int(dut.advance.value))

    async def _watch_sums(self) -> None:
        """Record the interpolated sum of each pixel as it goes into the comparison; None where it is undefined."""
        dut, edge = self.dut, RisingEdge(self.dut.clk)
        while True:
            await edge
            if int(dut.rst.value):
                self.sums.clear()
            elif int(dut.out_valid.value) and int(dut.advance.value):
                value = dut.interpolate.sum9_reg.value
                self.sums.append(int(value) if value.is_resolvable else None)


def check_sums(sums: list[int | None], frame: SentFrame, serving: Served, name: str) -> None:
    """Assert that the threshold inside the core is exact to its last bit, which the output alone would seldom show."""
    if serving.nodes is None:
        return
    wanted = threshold_map(serving.nodes, frame.width, frame.height, WINDOW_LOG2).ravel().tolist()
    for at, got in enumerate(sums):
        assert got == wanted[at], (
            f"{name} ({frame.width}x{frame.height}): threshold at x {at % frame.width}, y {at // frame.width}: "
            f"expected {wanted[at]}, got {got} in units of 2**-{10 + 2 * WINDOW_LOG2}; {where()}"
        )


def check(beats: list[Taken], frame: SentFrame, serving: Served, name: str) -> None:
    """Assert that a frame, cut or complete, is what the golden model makes of its pixels."""
    gray, dark = frame.image().astype(np.uint8), dark_of(frame.pixels[0])
    expected = threshold_apply(gray, serving.nodes, dark, WINDOW_LOG2)
    if frame.complete:
        check_frame(beats, expected, name)
        return
    wanted = expected.ravel()[: len(frame.pixels)].tolist()
    assert [beat.data for beat in beats] == wanted, f"{name}, which was cut off, differs; {where()}"
    check_markers(beats, frame.width, name)

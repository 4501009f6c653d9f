# SPDX-License-Identifier: Apache-2.0
"""Raw video for the tests of video_in: its generator, the driver on pix_clk, and the bench."""

from collections.abc import Iterator
from dataclasses import dataclass, field
from random import Random, getrandbits

import cocotb
import numpy.typing as npt
from cocotb.clock import Clock
from cocotb.handle import HierarchyObject
from cocotb.triggers import RisingEdge, Timer
from cocotb.types import LogicArray
from cocotb.utils import get_sim_time

from golden.video_in import Captured, video_in
from tb.common.compare import check_markers
from tb.common.run import four_state, parameter, where
from tb.common.stream import PulseCounter, StreamSink, split_frames, stalls

CLK_NS = 10.0
MAX_SIZE = (parameter("MAX_WIDTH", 1280), parameter("MAX_HEIGHT", 720))
FIFO_DEPTH = parameter("FIFO_DEPTH", 1024)
VSYNC_ACTIVE = parameter("VSYNC_ACTIVE", 1)


@dataclass
class Blanking:
    """Cycles of blanking; each is drawn anew from 1 to its value where `rng` is given (porches from 0)."""

    line: int = 1
    front: int = 0
    sync: int = 1
    back: int = 0
    rng: Random | None = None

    def draw(self, name: str) -> int:
        """Return one length."""
        most, least = getattr(self, name), int(name in ("line", "sync"))
        return self.rng.randint(least, most) if self.rng else most


TIGHT = Blanking()
"""As little blanking as there can be."""


def blanking(rng: Random) -> Blanking:
    """Return tight, 720p-like (370 of 1650, 30 of 750, scaled) or random blanking."""
    return rng.choice([TIGHT, Blanking(4, 20, 20, 40), Blanking(12, 60, 30, 60, rng)])


@dataclass
class Raw:
    """Samples of raw video, one a cycle of pix_clk, and the configuration that holds while each is sampled."""

    data: list[int] = field(default_factory=list)
    de: list[int] = field(default_factory=list)
    vsync: list[int] = field(default_factory=list)
    active: int = VSYNC_ACTIVE

    def blank(self, cycles: int, sync: bool = False) -> None:
        """Add blanking, with vsync or without."""
        self.data += [0] * cycles
        self.de += [0] * cycles
        self.vsync += [self.active if sync else 1 - self.active] * cycles

    def line(self, pixels: list[int], gap: int) -> None:
        """Add a line and the blanking after it."""
        self.data += pixels
        self.de += [1] * len(pixels)
        self.vsync += [1 - self.active] * len(pixels)
        self.blank(gap)

    def frame(self, lines: list[list[int]], blank: Blanking = TIGHT) -> None:
        """Add vsync and the lines of a frame."""
        self.blank(blank.draw("front"))
        self.blank(blank.draw("sync"), sync=True)
        self.blank(blank.draw("back"))
        for pixels in lines:
            self.line(pixels, blank.draw("line"))


def lines_of(rng: Random, width: int, height: int) -> list[list[int]]:
    """Return random RGB lines."""
    return [[rng.getrandbits(24) for _ in range(width)] for _ in range(height)]


FAULTS = ("short", "long", "few", "many")


def spoil(rng: Random, lines: list[list[int]], kind: str) -> list[list[int]]:
    """Return the lines with one of the faults: a short or long line, too few or too many lines."""
    lines = [list(line) for line in lines]
    index = rng.randrange(len(lines))
    if kind == "short" and len(lines[index]) > 1:
        del lines[index][rng.randrange(1, len(lines[index])) :]
    elif kind == "few" and len(lines) > 1:
        del lines[rng.randrange(1, len(lines)) :]
    elif kind == "many":
        lines += lines_of(rng, len(lines[0]), rng.randint(1, 3))
    else:
        lines[index] += lines_of(rng, rng.randint(1, 5), 1)[0]
    return lines


class Bench:
    """Both clocks, reset, driver of raw video, checked sink, counters of the pulses, and a clock of microseconds."""

    def __init__(self, dut: HierarchyObject, pix_ns: float = 13.468, backpressure: float = 0.0) -> None:
        self.dut, self.rng, self.pix_ns = dut, Random(getrandbits(64)), pix_ns
        self.samples, self.first_pixel_ns, self.first_beat_ns = Raw(), 0.0, 0.0
        self.pause_clock: Iterator[bool] = stalls(self.rng, 0)
        dut.rst.value = 1
        dut.cfg_enable.value = 1
        dut.time_us.value = getrandbits(64)
        dut.vid_hsync.value = 0
        dut.cfg_width.value = 0
        dut.cfg_height.value = 0
        cocotb.start_soon(Clock(dut.clk, CLK_NS, unit="ns").start())
        self.pix_clock = Clock(dut.pix_clk, round(pix_ns / 2, 3) * 2, unit="ns")
        self.pix_clock.start(start_high=False)
        self.idle()
        self.sink = StreamSink(dut, "m_axis", dut.clk, dut.rst, self.rng)
        self.sink.pause = stalls(self.rng, backpressure)
        self.seen, self.malformed, self.overflow = (
            PulseCounter(getattr(dut, f"frame_{name}"), dut.clk, dut.rst) for name in ("seen", "malformed", "overflow")
        )
        self.starts: list[tuple[int, int, int]] = []
        cocotb.start_soon(self._watch_starts())

    async def reset(self, cycles: int = 3) -> None:
        """Reset; counts and received beats start anew."""
        await RisingEdge(self.dut.clk)
        self.dut.rst.value = 1
        await self.cycles(cycles)
        self.dut.rst.value = 0
        self.sink.taken.clear()
        self.starts.clear()
        for counter in (self.seen, self.malformed, self.overflow):
            counter.count = 0
        await self.settle()

    async def cycles(self, count: int) -> None:
        """Wait for edges of clk."""
        for _ in range(count):
            await RisingEdge(self.dut.clk)

    async def settle(self) -> None:
        """Wait until a configuration has crossed, and until what crossed has come out."""
        await Timer(round(12 * (self.pix_ns + CLK_NS)), unit="ns")
        while self.sink.monitor.cycle - self.sink.monitor.last_active < 20:
            await RisingEdge(self.dut.clk)

    async def configure(self, width: int, height: int, enable: int = 1) -> None:
        """Set the configuration and wait until it counts."""
        self.dut.cfg_width.value, self.dut.cfg_height.value, self.dut.cfg_enable.value = width, height, enable
        await self.settle()

    async def play(self, raw: Raw) -> None:
        """Drive samples; pix_clk may stop between any two of them."""
        edge = RisingEdge(self.dut.pix_clk)
        await edge
        for data, de, vsync in zip(raw.data, raw.de, raw.vsync, strict=True):
            self._drive(data, de, vsync)
            if next(self.pause_clock):
                await self.stop_clock(self.rng.randint(1, 40))
            await edge
            if de and not self.first_pixel_ns:
                self.first_pixel_ns = get_sim_time("ns")
        self._drive(0, 0, raw.vsync[-1])

    async def stop_clock(self, cycles: int) -> None:
        """Stop pix_clk for some cycles of clk."""
        self.pix_clock.stop()
        await self.cycles(cycles)
        self.pix_clock.start(start_high=False)

    def idle(self) -> None:
        """Drive blanking."""
        self._drive(0, 0, 1 - VSYNC_ACTIVE)

    def _drive(self, data: int, de: int, vsync: int) -> None:
        idle = LogicArray("X" * 24) if four_state() else self.rng.getrandbits(24)
        self.dut.vid_data.value = data if de else idle
        self.dut.vid_de.value, self.dut.vid_vsync.value = de, vsync

    async def _watch_starts(self) -> None:
        """Record (number, start, now) where m_axis first shows a start of frame; count time_us up each cycle."""
        dut, edge, shown, now = self.dut, RisingEdge(self.dut.clk), False, 0
        while True:
            await edge
            start = str(dut.m_axis_tvalid.value) == "1" and str(dut.m_axis_tuser.value) == "1"
            if start and not shown:
                self.starts.append((int(dut.frame_number.value), int(dut.frame_start_us.value), now))
                if not self.first_beat_ns:
                    self.first_beat_ns = get_sim_time("ns")
            shown = start and str(dut.m_axis_tready.value) == "0"
            now = int(dut.time_us.value)
            dut.time_us.value = (now + 1) % (1 << 64)


def check(bench: Bench, expected: Captured) -> None:
    """Assert that frames, numbers, start times, pulses and measured size are those of the model."""
    shown = [frame for frame in expected.frames if frame.pixels.size]
    received = split_frames(bench.sink.taken)
    for index, (beats, frame) in enumerate(zip(received, shown, strict=False)):
        got = [beat.data for beat in beats]
        wanted = frame.pixels.tolist()
        name = f"frame {index} (number {frame.number}, {frame.width}x{frame.height})"
        for at, (one, other) in enumerate(zip(wanted, got, strict=False)):
            y, x = divmod(at, frame.width)
            assert one == other, f"{name}: first bad pixel x {x}, y {y}: expected {one:06x}, got {other:06x}; {where()}"
        assert len(got) == len(wanted), f"{name}: {len(got)} pixels came, expected {len(wanted)}; {where()}"
        check_markers(beats, frame.width, name)
    assert len(received) == len(shown), f"{len(received)} frames came, expected {len(shown)}; {where()}"
    check_starts(bench, [frame.number for frame in shown])
    pulses = (bench.seen.count, bench.malformed.count, bench.overflow.count)
    wanted_pulses = (len(expected.frames), expected.malformed, 0)
    assert pulses == wanted_pulses, f"(seen, malformed, overflow) {pulses}, expected {wanted_pulses}; {where()}"
    measured = int(bench.dut.measured_width.value), int(bench.dut.measured_height.value)
    assert measured == expected.measured_size, f"measured {measured}, expected {expected.measured_size}; {where()}"


def check_starts(bench: Bench, numbers: list[int]) -> None:
    """Assert that each start of frame came with its number and with the time at which it was put on m_axis."""
    got = [number for number, _, _ in bench.starts]
    assert got == numbers, f"frame numbers {got}, expected {numbers}; {where()}"
    for number, start, now in bench.starts:
        assert start == now, f"frame {number}: frame_start_us {start}, expected {now}; {where()}"


def model(raw: Raw, width: int, height: int, enable: npt.ArrayLike = True) -> Captured:
    """Return what the golden model makes of the samples."""
    return video_in(
        raw.data,
        raw.de,
        raw.vsync,
        width,
        height,
        enable=enable,
        max_size=MAX_SIZE,
        vsync_active=bool(VSYNC_ACTIVE),
    )

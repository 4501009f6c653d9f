# SPDX-License-Identifier: Apache-2.0
"""A camera's syncs and a stream that lags behind them, for the tests of video_out, and what the monitor must see."""

from dataclasses import dataclass
from random import Random, getrandbits

import cocotb
from cocotb.clock import Clock
from cocotb.handle import HierarchyObject
from cocotb.triggers import RisingEdge
from cocotb.types import LogicArray

from golden.video_out import shown, syncs
from tb.common.run import four_state, parameter, where
from tb.common.stream import PulseCounter
from tb.video_in.tb_video_in import Blanking, Raw, lines_of

CLK_NS = 10.0
DELAY = parameter("DELAY", 13200)
FIFO_DEPTH = parameter("FIFO_DEPTH", 16384)
ACTIVE = parameter("VSYNC_ACTIVE", 1)
LAG = DELAY // 3
"""Cycles of pix_clk that the stream is usually behind the camera."""
CLOCK_STOP = 150
"""Cycles of clk for which pix_clk stands still, where it does."""


@dataclass(frozen=True)
class Sent:
    """What comes of one frame on the stream: so many pixels from the first (None = all), from `lag` cycles on.

    They come no faster than the camera's, unless `fast`.
    """

    count: int | None = None
    lag: int = LAG
    fast: bool = False


@dataclass(frozen=True)
class Sample:
    """One cycle of pix_clk at the monitor."""

    data: int
    de: int
    hsync: int
    vsync: int


class Bench:
    """Both clocks, camera, stream and monitor."""

    def __init__(self, dut: HierarchyObject, pix_ns: float = 13.468) -> None:
        self.dut, self.rng = dut, Random(getrandbits(64))
        dut.rst.value = 1
        dut.vid_de.value, dut.vid_hsync.value, dut.vid_vsync.value = 0, 0, 1 - ACTIVE
        self._idle()
        cocotb.start_soon(Clock(dut.clk, CLK_NS, unit="ns").start())
        self._pix_clock = Clock(dut.pix_clk, round(pix_ns / 2, 3) * 2, unit="ns")
        self._pix_clock.start(start_high=False)
        self.blanks = PulseCounter(dut.frame_blank, dut.clk, dut.rst)
        self.seen: list[Sample] = []
        self.hsync: list[int] = []
        self._at = 0

    async def reset(self, cycles: int = 4) -> None:
        """Reset long enough for the ring of the syncs to hold blanking again."""
        await RisingEdge(self.dut.clk)
        self.dut.rst.value = 1
        for _ in range(cycles):
            await RisingEdge(self.dut.clk)
        self.dut.rst.value = 0
        self.blanks.count = 0
        for _ in range(10):
            await RisingEdge(self.dut.pix_clk)

    async def play(self, raw: Raw, frames: list[list[list[int]]], sent: list[Sent], stops: float = 0.0) -> None:
        """Play the camera to its end, and the delay after it; the stream sends the frames as `sent` says.

        Args:
            raw: the camera.
            frames: RGB lines of each frame in it.
            sent: what comes of each.
            stops: how likely pix_clk stands still after a sample.
        """
        starts = [at for at, de in enumerate(raw.de) if de and self._is_first(raw, at)]
        assert len(starts) == len(frames)
        raw.blank(DELAY + 20)
        self.hsync = [self.rng.getrandbits(1) for _ in raw.de]
        self.seen, self._at = [], 0
        self._running = cocotb.start_soon(self._stream(frames, sent, starts))
        for at, (de, vsync) in enumerate(zip(raw.de, raw.vsync, strict=True)):
            self._at = at
            self.dut.vid_de.value = de
            self.dut.vid_hsync.value = self.hsync[at]
            self.dut.vid_vsync.value = vsync
            await RisingEdge(self.dut.pix_clk)
            out = self.dut.out_data, self.dut.out_de, self.dut.out_hsync, self.dut.out_vsync
            text = [str(signal.value) for signal in out]
            assert not set("".join(text)) - {"0", "1"}, f"the monitor gets {text} at sample {at}; {where()}"
            self.seen.append(Sample(*(int(bits, 2) for bits in text)))
            if self.rng.random() < stops:
                await self.stop_clock(CLOCK_STOP)
        await self._running
        for _ in range(10):
            await RisingEdge(self.dut.clk)

    async def pour(self, count: int, first: bool = False) -> None:
        """Send pixels without a break, one a cycle of clk, of which the first begins a frame or none does."""
        for index in range(count):
            self.dut.s_axis_tvalid.value = 1
            self.dut.s_axis_tdata.value = self.rng.getrandbits(24)
            self.dut.s_axis_tuser.value = int(first and index == 0)
            self.dut.s_axis_tlast.value = 0
            await RisingEdge(self.dut.clk)
        self._idle()

    async def stop_clock(self, cycles: int) -> None:
        """Let pix_clk stand still for so many cycles of clk; the monitor stands still with it."""
        self._pix_clock.stop()
        for _ in range(cycles):
            await RisingEdge(self.dut.clk)
        self._pix_clock.start(start_high=False)

    async def reset_while_the_clock_stands(self) -> None:
        """Reset and let go again while pix_clk stands still."""
        self._pix_clock.stop()
        self.dut.rst.value = 1
        for _ in range(5):
            await RisingEdge(self.dut.clk)
        self.dut.rst.value = 0
        for _ in range(5):
            await RisingEdge(self.dut.clk)
        self.blanks.count = 0
        self._pix_clock.start(start_high=False)
        for _ in range(10):
            await RisingEdge(self.dut.pix_clk)

    def stop(self) -> None:
        """Let camera and stream fall silent, after `play` was cancelled."""
        self._running.cancel()
        self._idle()
        self.dut.vid_de.value, self.dut.vid_vsync.value = 0, 1 - ACTIVE

    @staticmethod
    def _is_first(raw: Raw, at: int) -> bool:
        """Whether a pixel is the first after vsync."""
        before = at - 1
        while before >= 0 and not raw.de[before]:
            if raw.vsync[before] == raw.active:
                return True
            before -= 1
        return False

    async def _stream(self, frames: list[list[list[int]]], sent: list[Sent], starts: list[int]) -> None:
        edge = RisingEdge(self.dut.clk)
        for lines, how, start in zip(frames, sent, starts, strict=True):
            pixels = [pixel for line in lines for pixel in line][: how.count]
            while self._at < start + how.lag:
                await edge
            for index, pixel in enumerate(pixels):
                self.dut.s_axis_tvalid.value = 1
                self.dut.s_axis_tdata.value = pixel
                self.dut.s_axis_tuser.value = int(index == 0)
                self.dut.s_axis_tlast.value = self.rng.getrandbits(1)
                await edge
                assert self.dut.s_axis_tready.value == 1, f"the stream is stalled; {where()}"
                # No faster than the camera, or the FIFO would have to hold the difference.
                self._idle()
                while not how.fast and self._at < start + how.lag + index:
                    await edge

    def _idle(self) -> None:
        self.dut.s_axis_tvalid.value = 0
        self.dut.s_axis_tdata.value = LogicArray("X" * 24) if four_state() else getrandbits(24)
        self.dut.s_axis_tuser.value = LogicArray("X") if four_state() else getrandbits(1)
        self.dut.s_axis_tlast.value = LogicArray("X") if four_state() else getrandbits(1)

    def check(self, raw: Raw, expected: list[list[int]]) -> None:
        """Assert that the monitor got the syncs, DELAY cycles later, and these pixels.

        Args:
            raw: the camera.
            expected: the pixels of each frame, BLANK where it must be blank.
        """
        monitor: list[list[int]] = []
        after_sync = False
        of_camera = list(zip(raw.de, self.hsync, raw.vsync, strict=True))
        for at, (sample, wanted) in enumerate(zip(self.seen, syncs(of_camera, DELAY, (0, 0, 0)), strict=True)):
            got = (sample.de, sample.hsync, sample.vsync)
            # Before the camera there was blanking, with syncs of any kind.
            good = got == wanted if at >= DELAY else not sample.de
            assert good, f"(de, hsync, vsync) {got} at sample {at}, expected {wanted}; {where()}"
            if sample.de:
                if after_sync:
                    monitor.append([])
                monitor[-1].append(sample.data)
            else:
                assert sample.data == 0, f"{sample.data:06X} in blanking at sample {at}; {where()}"
            after_sync = (after_sync or (at >= DELAY and sample.vsync == raw.active)) and not sample.de
        assert len(monitor) == len(expected), f"{len(monitor)} frames, expected {len(expected)}; {where()}"
        for index, (got, wanted) in enumerate(zip(monitor, expected, strict=True)):
            bad = [at for at, pair in enumerate(zip(got, wanted, strict=True)) if pair[0] != pair[1]]
            assert not bad, (
                f"frame {index}, pixel {bad[0]}: expected {wanted[bad[0]]:06X}, got {got[bad[0]]:06X}; "
                f"{len(bad)} of {len(got)} differ; {where()}"
            )


def camera(
    rng: Random, sizes: list[tuple[int, int]], shape: Blanking, active: int = ACTIVE
) -> tuple[Raw, list[list[list[int]]]]:
    """Raw video of random frames, with this level of vsync, and their lines."""
    raw, frames = Raw(active=active), [lines_of(rng, *size) for size in sizes]
    for lines in frames:
        raw.frame(lines, shape)
    raw.blank(3, sync=True)
    return raw, frames


def pixels_of(lines: list[list[int]], whole: int | None = None) -> list[int]:
    """The pixels that the monitor must get of a frame of which so many came in time."""
    return shown([pixel for line in lines for pixel in line], whole)

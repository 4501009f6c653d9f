# SPDX-License-Identifier: Apache-2.0
"""Memory, clocks and a monitor for the tests of frame_source, and what the monitor must see.

What comes in time is not guessed: the memory notes when each beat was taken, so each pixel that is shown must have been
there, and the first one that is not must have been late.
"""

from collections.abc import Iterable
from dataclasses import dataclass, field
from random import Random, getrandbits

import cocotb
import numpy as np
from cocotb.clock import Clock
from cocotb.handle import HierarchyObject
from cocotb.triggers import RisingEdge
from cocotb.utils import get_sim_time

from golden.frame_source import Places, frame_of, shown
from tb.common.run import parameter, where
from tb.common.stream import PulseCounter
from tb.frame_source.axi_read_memory import AxiReadMemory, ReadBurst

CLK_NS = 10.0
PLACES = Places(
    *(
        parameter(name.upper(), getattr(Places(), name))
        for name in ("width", "h_front", "h_sync", "h_total", "height", "v_front", "v_sync", "v_total")
    )
)
FIFO_DEPTH = parameter("FIFO_DEPTH", 1024)
MAX_OUTSTANDING = parameter("MAX_OUTSTANDING", 4)
PIXELS = PLACES.width * PLACES.height
BEATS = (PIXELS + 1) // 2
BURSTS = (BEATS + 15) // 16
FRAME_CYCLES = PLACES.h_total * PLACES.v_total
LATE_PIX, LATE_CLK = 8, 3
"""A beat is in time if it is taken so many cycles of each clock before its pixel is on out_*; it may be if less."""
FIRST = 5.5
"""Cycles of clk, after the last pixel was seen: an address that comes sooner is of the frame that ended."""
BASES = (0x0000_0000, 0x1000_0000, 0x1FFF_F000, 0xFFF0_0000)


@dataclass
class Shown:
    """One frame at the monitor: its pixels, and when each was seen, in ns."""

    pixels: list[int] = field(default_factory=list)
    seen_ns: list[float] = field(default_factory=list)


@dataclass
class Verdict:
    """What one frame turned out to be: how many pixels were shown; `off` if it is black, `base` where it was read."""

    whole: int
    off: bool
    base: int | None

    @property
    def complete(self) -> bool:
        """Whether all of it was shown, or it is black by intention."""
        return self.off or self.whole == PIXELS


class Bench:
    """Both clocks, memory and monitor."""

    def __init__(self, dut: HierarchyObject, pix_ns: float = 13.468) -> None:
        self.dut, self.rng = dut, Random(getrandbits(64))
        self.pix_ns = round(pix_ns / 2, 3) * 2
        dut.rst.value = 1
        self.memory = AxiReadMemory(dut, "m_axi", dut.clk, dut.rst, self.rng)
        # A picture ends where memory does.
        top = (1 << 32) - (-(-BEATS * 8 // 4096) * 4096)
        self.bases = [*BASES[:-1], min(BASES[-1], top)]
        for base in self.bases:
            self.memory.regions[base] = self.rng.randbytes(BEATS * 8)
        self.settings: list[tuple[float, int, int]] = []
        self.configure(1, self.bases[1])
        cocotb.start_soon(Clock(dut.clk, CLK_NS, unit="ns").start())
        self._pix_clock = Clock(dut.pix_clk, self.pix_ns, unit="ns")
        self._pix_clock.start(start_high=False)
        self.underflows = PulseCounter(dut.underflow, dut.clk, dut.rst)
        self.errors = PulseCounter(dut.read_error, dut.clk, dut.rst)
        self.frames: list[Shown] = []
        self.syncs = 0
        self._quiet: int | None = None
        cocotb.start_soon(self._watch())

    def configure(self, enable: int, base: int) -> None:
        """Change cfg_*; the low bits of the base are random."""
        self.dut.cfg_enable.value = enable
        self.dut.cfg_base.value = base | self.rng.getrandbits(12)
        self.settings.append((get_sim_time("ns"), enable, base))

    async def clocks(self, count: int) -> None:
        """Wait for so many cycles of clk."""
        for _ in range(count):
            await RisingEdge(self.dut.clk)

    async def reset(self, cycles: int = 4) -> None:
        """Reset core and memory."""
        await RisingEdge(self.dut.clk)
        self.dut.rst.value = 1
        self._quiet = None
        await self.clocks(cycles)
        self.dut.rst.value = 0
        self._forget()
        await self.clocks(1)

    def _forget(self) -> None:
        self.underflows.count = self.errors.count = 0
        self.frames, self.syncs, self._quiet = [], 0, 0
        self.settings = self.settings[-1:]

    async def until(self, frames: int) -> None:
        """Wait until so many frames, that after reset included, have ended, and what they tell has arrived."""
        limit = (frames - len(self.frames) + 2) * FRAME_CYCLES
        while len(self.frames) < frames or len(self.frames[frames - 1].pixels) < PIXELS:
            await RisingEdge(self.dut.pix_clk)
            limit -= 1
            assert limit, f"{len(self.frames)} frames came of {frames}; {where()}"
        await self.clocks(6)

    async def stop_clock(self, cycles: int) -> None:
        """Let pix_clk stand still for so many cycles of clk."""
        self._pix_clock.stop()
        await self.clocks(cycles)
        self._pix_clock.start(start_high=False)

    async def reset_while_the_clock_stands(self) -> None:
        """Reset for one cycle and let go again while pix_clk stands still."""
        self._pix_clock.stop()
        await self.clocks(3)
        await self.reset(1)
        await self.clocks(5)
        out = self.dut.out_de, self.dut.out_hsync, self.dut.out_vsync
        text = "".join(str(signal.value) for signal in out)
        assert text == "000", f"de, hsync, vsync are {text} in reset, with pix_clk at rest; {where()}"
        self._forget()
        self._pix_clock.start(start_high=False)

    async def _watch(self) -> None:
        """Compare every cycle of pix_clk from the first pixel after a reset on with its place, and keep the pixels."""
        edge = RisingEdge(self.dut.pix_clk)
        out = self.dut.out_de, self.dut.out_hsync, self.dut.out_vsync, self.dut.out_data
        while True:
            await edge
            if self._quiet is None:
                continue
            text = [str(signal.value) for signal in out]
            assert not set("".join(text[:3])) - {"0", "1"}, f"de, hsync, vsync are {text[:3]}; {where()}"
            if not self.syncs and text[:3] == ["0", "0", "0"]:
                self._quiet += 1
                assert self._quiet <= 10, f"no pixel comes after reset; {where()}"
                continue
            assert not set(text[3]) - {"0", "1"}, f"out_data is {text[3]}; {where()}"
            places = PLACES.at(self.syncs)
            got = tuple(int(bits) for bits in text[:3])
            assert got == places, f"de, hsync, vsync {got} in cycle {self.syncs}, expected {places}; {where()}"
            data = int(text[3], 2)
            if self.syncs % FRAME_CYCLES == 0:
                self.frames.append(Shown())
            if got[0]:
                self.frames[-1].pixels.append(data)
                self.frames[-1].seen_ns.append(get_sim_time("ns"))
            else:
                assert data == 0, f"{data:06X} in blanking, in cycle {self.syncs}; {where()}"
            self.syncs += 1

    def runs(self) -> list[list[ReadBurst]]:
        """The bursts of each frame that was asked for; each run begins at a base, and goes on without a hole."""
        found: list[list[ReadBurst]] = []
        for burst in self.memory.bursts:
            if burst.address in self.bases:
                found.append([burst])
                continue
            before = found[-1][-1]
            assert burst.address == before.address + 8 * before.beats, f"0x{burst.address:x} was read next; {where()}"
            found[-1].append(burst)
        for run in found:
            wanted = [16] * (BURSTS - 1) + [BEATS - 16 * (BURSTS - 1)]
            lengths = [burst.beats for burst in run]
            assert lengths == wanted[: len(run)], f"bursts of {lengths} beats, expected {wanted}; {where()}"
        return found

    def _settings_between(self, start_ns: float, end_ns: float) -> set[tuple[int, int]]:
        """(enable, base) that were there at any time of an interval."""
        times = [time for time, _, _ in self.settings[1:]] + [float("inf")]
        pairs = zip(self.settings, times, strict=True)
        return {(enable, base) for (start, enable, base), end in pairs if start < end_ns and end > start_ns}

    def check(self) -> list[Verdict]:
        """Assert that each frame is what memory gave in time, then blank, and that underflow and read_error say so.

        Returns:
            One verdict a frame that has ended.
        """
        frames = [frame for frame in self.frames if len(frame.pixels) == PIXELS]
        runs = self.runs()
        verdicts: list[Verdict] = []
        for index, frame in enumerate(frames):
            if index == 0:
                assert not any(frame.pixels), f"the first frame after reset is not black; {where()}"
                verdicts.append(Verdict(0, True, None))
                continue
            start = frames[index - 1].seen_ns[-1] + FIRST * CLK_NS
            end = frame.seen_ns[-1]
            own = [run for run in runs if start <= run[0].offered_ns < end + FIRST * CLK_NS]
            assert len(own) <= 1, f"frame {index} was read {len(own)} times; {where()}"
            verdicts.append(self._verdict(index, frame, own[0] if own else [], self._settings_between(start - 60, end)))
        late = sum(not verdict.complete for verdict in verdicts)
        assert self.underflows.count == late, f"underflow came {self.underflows.count} times, not {late}; {where()}"
        failed = sum(any(burst.failed for burst in run) for run in runs)
        assert self.errors.count == failed, f"read_error came {self.errors.count} times, not {failed}; {where()}"
        assert self.memory.most <= MAX_OUTSTANDING, f"{self.memory.most} bursts were under way; {where()}"
        return verdicts

    def _verdict(self, index: int, frame: Shown, run: list[ReadBurst], settings: set[tuple[int, int]]) -> Verdict:
        name = f"frame {index}"
        if not any(frame.pixels):
            assert 0 in {enable for enable, _ in settings}, f"{name} is black, but was not disabled; {where()}"
            assert not run, f"{name} is black, but was read; {where()}"
            return Verdict(0, True, None)
        assert 1 in {enable for enable, _ in settings}, f"{name} is not black, but was disabled; {where()}"
        base = run[0].address if run else None
        taken: list[float] = []
        for burst in run:
            bad = burst.bad if burst.failed else None
            taken += burst.taken_ns[:bad]
            if bad is not None:
                break
        picture = frame_of(self.memory.regions[base if run else self.bases[0]], PLACES.width, PLACES.height)
        if run:
            assert base in {there for _, there in settings}, f"{name} is that at 0x{base:x}; {where()}"
        good = shown(picture).tolist()
        count = next((at for at, pixel in enumerate(frame.pixels) if pixel != good[at]), PIXELS) if run else 0
        expected = shown(picture, count).tolist()
        wrong = [at for at, pair in enumerate(zip(frame.pixels, expected, strict=True)) if pair[0] != pair[1]]
        assert not wrong, (
            f"{name}, pixel {wrong[0]}: expected {expected[wrong[0]]:06X}, got {frame.pixels[wrong[0]]:06X} "
            f"after {count} pixels of the picture; {where()}"
        )
        there = [time < seen for time, seen in zip(np.repeat(taken, 2), frame.seen_ns, strict=False)]
        assert len(there) >= count and all(there[:count]), f"{name} shows pixels before memory gave them; {where()}"
        if count < PIXELS and count // 2 < len(taken):
            spare = frame.seen_ns[count] - taken[count // 2] - LATE_PIX * self.pix_ns - LATE_CLK * CLK_NS
            assert spare < 0, f"{name} is blank from pixel {count} on, which was there in time; {where()}"
        return Verdict(count, False, base)


def all_whole(verdicts: Iterable[Verdict]) -> None:
    """Assert that each frame but that after reset was shown, whole."""
    wrong = [index for index, verdict in enumerate(verdicts) if index and verdict.whole != PIXELS]
    assert not wrong, f"frames {wrong} are not whole; {where()}"

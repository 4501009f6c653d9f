# SPDX-License-Identifier: Apache-2.0
"""AXI4-Stream source, sink with protocol checker, and the conversion between frames and beats.

Built on the drivers and monitors of cocotb-bus rather than on the source of cocotbext-axi, because a test here must be
able to send lines without an end, change `cfg_width` together with a start of frame, and drive X while idle.
All classes work for any width of `tdata`; `tuser` and `tlast` are optional.
"""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from random import Random
from typing import Any, NamedTuple

import cocotb
import numpy as np
from cocotb.clock import Clock
from cocotb.handle import HierarchyObject
from cocotb.triggers import RisingEdge
from cocotb.types import LogicArray
from cocotb_bus.drivers import BusDriver
from cocotb_bus.monitors import BusMonitor

from tb.common.run import four_state, where

CLOCK_NS = 10


class Beat(NamedTuple):
    """One beat to send. `size` (width, height) is put on `cfg_width`, `cfg_height` together with the beat."""

    data: int
    user: int = 0
    last: int = 0
    size: tuple[int, int] | None = None


@dataclass(frozen=True)
class Taken:
    """One beat that was handed over, and the number of the clock edge at which it was."""

    data: int
    user: int
    last: int
    cycle: int


def pack(values: Sequence[int], bits: int, ppc: int) -> list[int]:
    """Put `ppc` values of `bits` bits side by side into each word, the first in the low bits."""
    if ppc == 1:
        return list(values)
    return [
        sum(value << bits * place for place, value in enumerate(values[first : first + ppc]))
        for first in range(0, len(values), ppc)
    ]


def unpack(words: Sequence[int], bits: int, ppc: int) -> list[int]:
    """Take apart what `pack` put together."""
    if ppc == 1:
        return list(words)
    return [word >> bits * place & ((1 << bits) - 1) for word in words for place in range(ppc)]


def frame_beats(frame: np.ndarray, bits: int = 0, ppc: int = 1) -> list[Beat]:
    """Return the beats of one frame: integer array (height, width) of `bits` bits, `ppc` values a beat."""
    height, width = frame.shape
    line = width // ppc
    return [
        Beat(word, int(index == 0), int(index % line == line - 1), (width, height) if index == 0 else None)
        for index, word in enumerate(pack(frame.ravel().tolist(), bits, ppc))
    ]


def split_frames(beats: list[Taken]) -> list[list[Taken]]:
    """Cut received beats at each start of frame. Beats before the first one are an error.

    Raises:
        AssertionError: the first beat carries no start of frame.
    """
    frames: list[list[Taken]] = []
    for beat in beats:
        if beat.user & 1:
            frames.append([])
        assert frames, f"beat {beat} came before any start of frame; {where()}"
        frames[-1].append(beat)
    return frames


def stalls(rng: Random, fraction: float) -> Iterator[bool]:
    """Yield for each cycle whether to pause: runs of random length, `fraction` of the cycles in the mean."""
    while True:
        if fraction <= 0:
            yield False
        elif rng.random() < 0.5:
            pause = rng.random() < fraction
            for _ in range(rng.randint(1, 8)):
                yield pause
        else:
            yield rng.random() < fraction


class StreamSource(BusDriver):
    """Drives `<name>_tdata`, `tvalid`, `tuser`, `tlast`; the payload is X while `tvalid` is 0 (random in Verilator).

    `append(list_of_beats)` queues beats; lists follow one another without a gap unless `pause` says so.
    `on_beat` is called as a beat is put on the bus.
    """

    _signals = ["tvalid", "tready", "tdata"]  # noqa: RUF012
    _optional_signals = ["tuser", "tlast"]  # noqa: RUF012

    def __init__(self, dut: HierarchyObject, name: str, clock: Any, rng: Random) -> None:
        super().__init__(dut, name, clock)
        self.pause: Iterator[bool] = stalls(rng, 0)
        self.on_beat: Callable[[Beat], None] | None = None
        self._rng = rng
        self._pending_beats = 0
        self._idle()

    @property
    def empty(self) -> bool:
        """Whether all beats were handed over."""
        return self._pending_beats == 0

    def send_beats(self, beats: list[Beat]) -> None:
        """Queue beats."""
        self._pending_beats += len(beats)
        self.append(beats)

    def stop(self) -> None:
        """Drop what is queued and let the bus go idle, as in a reset."""
        self.kill()
        self.clear()
        self._pending_beats = 0
        self._idle()
        self._thread = cocotb.start_soon(self._send_thread())

    async def _driver_send(self, transaction: list[Beat], sync: bool = True, **_: Any) -> None:
        edge = RisingEdge(self.clock)
        if sync:
            await edge
        for beat in transaction:
            while next(self.pause):
                self._idle()
                await edge
            if self.on_beat:
                self.on_beat(beat)
            self._drive(1, beat.data, beat.user, beat.last)
            await edge
            while not int(self.bus.tready.value):
                await edge
            self._pending_beats -= 1
        self._idle()

    def _idle(self) -> None:
        if four_state():
            self._drive(0, "X" * len(self.bus.tdata), "X", "X")
        else:
            bits = self._rng.getrandbits
            self._drive(0, bits(len(self.bus.tdata)), bits(1), bits(1))

    def _drive(self, valid: int, data: int | str, user: int | str, last: int | str) -> None:
        self.bus.tvalid.value = valid
        self.bus.tdata.value = LogicArray(data) if isinstance(data, str) else data
        if hasattr(self.bus, "tuser"):
            self.bus.tuser.value = LogicArray(user * len(self.bus.tuser)) if isinstance(user, str) else user
        if hasattr(self.bus, "tlast"):
            self.bus.tlast.value = LogicArray(last) if isinstance(last, str) else last


class StreamMonitor(BusMonitor):
    """Records the beats of a stream in `taken` and fails the test at the first break of the protocol.

    Checked: `tvalid` and `tready` are never X after the first reset; payload is never X while valid; a beat that was
    offered stays, unchanged, until it is taken.
    """

    _signals = ["tvalid", "tready", "tdata"]  # noqa: RUF012
    _optional_signals = ["tuser", "tlast"]  # noqa: RUF012

    def __init__(self, dut: HierarchyObject, name: str, clock: Any, reset: Any) -> None:
        self.taken: list[Taken] = []
        self.cycle = 0
        self.last_active = 0
        super().__init__(dut, name, clock, reset=reset)

    def _fail(self, what: str) -> None:
        raise AssertionError(f"{self.name}: {what} in cycle {self.cycle}; {where()}")

    async def _monitor_recv(self) -> None:
        bus, edge = self.bus, RisingEdge(self.clock)
        payload = [getattr(bus, name) for name in ("tdata", "tuser", "tlast") if hasattr(bus, name)]
        has_user, has_last = hasattr(bus, "tuser"), hasattr(bus, "tlast")
        offered: list[str] | None = None
        was_reset = False
        while True:
            await edge
            self.cycle += 1
            if str(self._reset.value) != "0":
                was_reset, offered = True, None
                continue
            if not was_reset:
                continue
            valid, ready = str(bus.tvalid.value), str(bus.tready.value)
            if valid not in "01" or ready not in "01":
                self._fail(f"tvalid is {valid} and tready is {ready}")
            if valid == "0":
                if offered is not None:
                    self._fail("tvalid fell before the beat was taken")
                continue
            now = [str(signal.value) for signal in payload]
            if any(set(text) - {"0", "1"} for text in now):
                self._fail(f"payload (tdata, tuser, tlast) {now} is undefined while tvalid is 1")
            if offered is not None and now != offered:
                self._fail(f"payload changed from {offered} to {now} while stalled")
            offered = now if ready == "0" else None
            self.last_active = self.cycle
            if ready == "1":
                values = [int(text, 2) for text in now]
                user = values[1] if has_user else 0
                self.taken.append(Taken(values[0], user, values[-1] if has_last else 0, self.cycle))


class StreamSink:
    """Drives `<name>_tready`, paused by `pause`; `monitor` records and checks the beats."""

    def __init__(self, dut: HierarchyObject, name: str, clock: Any, reset: Any, rng: Random) -> None:
        self.monitor = StreamMonitor(dut, name, clock, reset)
        self.pause: Iterator[bool] = stalls(rng, 0)
        self._ready = getattr(dut, f"{name}_tready")
        self._clock = clock
        self._ready.value = 0
        cocotb.start_soon(self._run())

    @property
    def taken(self) -> list[Taken]:
        """Beats taken so far."""
        return self.monitor.taken

    async def _run(self) -> None:
        edge = RisingEdge(self._clock)
        while True:
            await edge
            self._ready.value = int(not next(self.pause))


class PulseCounter:
    """Counts the cycles in which a one-bit output is 1; X after the first reset fails the test."""

    def __init__(self, signal: Any, clock: Any, reset: Any) -> None:
        self.count = 0
        self._signal, self._clock, self._reset = signal, clock, reset
        cocotb.start_soon(self._run())

    async def _run(self) -> None:
        edge, was_reset = RisingEdge(self._clock), False
        while True:
            await edge
            if str(self._reset.value) != "0":
                was_reset = True
            elif was_reset:
                value = str(self._signal.value)
                assert value in "01", f"{self._signal._name} is {value}; {where()}"
                self.count += value == "1"


class StreamBench:
    """Clock, reset, one `s_axis` source, one `m_axis` sink, both checked, and `frame_error` counted.

    A core with more streams adds its own `StreamSource`, `StreamSink` or `StreamMonitor` beside `source` and `sink`,
    and their `taken` to `logs`.
    Beats with a `size` set `cfg_width`/`cfg_height` as they are offered.
    """

    def __init__(self, dut: HierarchyObject, rng: Random, sink: str = "m_axis", source: str = "s_axis") -> None:
        self.dut, self.rng = dut, rng
        dut.rst.value = 1
        cocotb.start_soon(Clock(dut.clk, CLOCK_NS, unit="ns").start())
        self.source = StreamSource(dut, source, dut.clk, rng)
        self.input = StreamMonitor(dut, source, dut.clk, dut.rst)
        self.sink = StreamSink(dut, sink, dut.clk, dut.rst, rng)
        has_error = hasattr(dut, "frame_error")
        self.errors = PulseCounter(dut.frame_error, dut.clk, dut.rst) if has_error else None
        self.logs: list[list[Any]] = [self.input.taken, self.sink.taken]
        if hasattr(dut, "cfg_width"):
            dut.cfg_width.value = 0
            dut.cfg_height.value = 0
            self.source.on_beat = self._set_size

    def _set_size(self, beat: Beat) -> None:
        if beat.size is not None:
            self.dut.cfg_width.value, self.dut.cfg_height.value = beat.size

    async def cycles(self, count: int) -> None:
        """Wait for some clock edges."""
        for _ in range(count):
            await RisingEdge(self.dut.clk)

    async def reset(self, cycles: int = 3) -> None:
        """Reset the core; the source drops what it had.

        `logs` and the count of `frame_error` end up empty, but for what the first clock after the reset brings.
        """
        await RisingEdge(self.dut.clk)
        self.dut.rst.value = 1
        self.source.stop()
        await self.cycles(cycles)
        for log in self.logs:
            log.clear()
        if self.errors:
            self.errors.count = 0
        self.dut.rst.value = 0
        await RisingEdge(self.dut.clk)

    async def drain(self, quiet: int, limit: int) -> None:
        """Wait until everything is sent and no stream has been active for `quiet` cycles.

        Raises:
            AssertionError: that did not happen within `limit` cycles.
        """
        start = self.input.cycle
        while not self.source.empty or self.input.cycle - self._last_active(start) < quiet:
            assert self.input.cycle - start < limit, f"the core still holds beats after {limit} cycles; {where()}"
            await RisingEdge(self.dut.clk)

    def _last_active(self, start: int) -> int:
        return max(self.input.last_active, self.sink.monitor.last_active, start)

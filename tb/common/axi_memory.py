# SPDX-License-Identifier: Apache-2.0
"""Memory behind an AXI write master without IDs (`m_axi_aw*`, `w*`, `b*`), with latency, stalls and injected errors.

The channels are streams of cocotbext-axi. Its ready-made RAM is not used because it needs ID ports, answers OKAY only,
and shows data in order: here a burst becomes visible at a random time between its last beat and its response, so that
a master that relies on order without waiting for responses is found out.
"""

from collections import deque
from collections.abc import Callable
from dataclasses import dataclass
from random import Random
from typing import Any

import cocotb
from cocotb.handle import HierarchyObject
from cocotb.triggers import RisingEdge
from cocotbext.axi.stream import define_stream

from tb.common.run import where
from tb.common.stream import stalls

OKAY, SLVERR = 0, 2
PAGE_BYTES = 4096
BEAT_BYTES = 8
MAX_BEATS = 16  # AXI3

AddressBus, _, _, AddressSink, _ = define_stream(
    "Address", signals=["awaddr", "awlen", "awsize", "awburst", "awvalid", "awready"]
)
DataBus, _, _, DataSink, _ = define_stream("Data", signals=["wdata", "wstrb", "wlast", "wvalid", "wready"])
ResponseBus, _, ResponseSource, _, _ = define_stream("Response", signals=["bresp", "bvalid", "bready"])


@dataclass
class Burst:
    """One write burst.

    `cycle` is the number of the clock edge at which its address was taken, `answered_before` how many responses the
    master had seen by then.
    """

    number: int
    address: int
    beats: int
    cycle: int
    answered_before: int
    data: bytes = b""
    visible: bool = False
    failed: bool = False
    due: int = 0


class AxiMemory:
    """Takes every write to `dut.<prefix>_*` and checks the protocol.

    Args:
        dut: the master.
        prefix: of its ports.
        clock: clock signal.
        reset: active-high reset; bursts under way are forgotten.
        rng: source of stalls, latencies and times of visibility.

    `latency` is the range of clocks between the last beat and the response. `fails(burst)` tells whether a burst, whose
    `data` is complete, is answered with an error and not stored. `on_change(address)` is called when data becomes
    visible.
    """

    def __init__(self, dut: HierarchyObject, prefix: str, clock: Any, reset: Any, rng: Random) -> None:
        self.bytes: dict[int, int] = {}
        self.bursts: list[Burst] = []
        self.answered = 0
        self.cycle = 0
        self.latency = (1, 1)
        self.fails: Callable[[Burst], bool] = lambda _: False
        self.on_change: Callable[[int], None] = lambda _: None
        self._rng, self._clock, self._reset = rng, clock, reset
        self._address = AddressSink(AddressBus.from_prefix(dut, prefix), clock, reset)
        self._data = DataSink(DataBus.from_prefix(dut, prefix), clock, reset)
        self._response = ResponseSource(ResponseBus.from_prefix(dut, prefix), clock, reset)
        self._pending: deque[Burst] = deque()
        self._beats: list[Any] = []
        names = {"aw": ("awaddr", "awlen", "awsize", "awburst"), "w": ("wdata", "wstrb", "wlast")}
        self._channels = [
            (
                getattr(dut, f"{prefix}_{channel}valid"),
                getattr(dut, f"{prefix}_{channel}ready"),
                [getattr(dut, f"{prefix}_{name}") for name in signals],
            )
            for channel, signals in names.items()
        ]
        self._bvalid = getattr(dut, f"{prefix}_bvalid")
        self._bready = getattr(dut, f"{prefix}_bready")
        cocotb.start_soon(self._check_stable())
        cocotb.start_soon(self._run())

    def stall(self, fraction: float) -> None:
        """Keep AW and W back in `fraction` of the cycles."""
        self._address.set_pause_generator(stalls(self._rng, fraction))
        self._data.set_pause_generator(stalls(self._rng, fraction))

    def read(self, address: int, size: int) -> bytes:
        """Return what software would read now; bytes never written are 0xA5."""
        return bytes(self.bytes.get(address + offset, 0xA5) for offset in range(size))

    def fail(self, what: str) -> None:
        """Fail the test."""
        raise AssertionError(f"memory port: {what} in cycle {self.cycle}; {where()}")

    async def _check_stable(self) -> None:
        edge = RisingEdge(self._clock)
        offered: list[list[str] | None] = [None, None]
        was_reset = False
        while True:
            await edge
            self.cycle += 1
            if str(self._reset.value) != "0":
                was_reset, offered = True, [None, None]
                continue
            if not was_reset:
                continue
            if str(self._bvalid.value) == "1" and str(self._bready.value) == "1":
                self.answered += 1
            for index, (valid, ready, payload) in enumerate(self._channels):
                if str(valid.value) not in "01":
                    self.fail(f"{valid._name} is {valid.value}")
                if str(valid.value) == "0":
                    if offered[index] is not None:
                        self.fail(f"{valid._name} fell before ready")
                    continue
                now = [str(signal.value) for signal in payload]
                if any(set(text) - {"0", "1"} for text in now):
                    self.fail(f"payload of {valid._name} is undefined: {now}")
                before = offered[index]
                if before is not None and before != now:
                    self.fail(f"payload of {valid._name} changed while stalled")
                offered[index] = None if str(ready.value) == "1" else now

    def _forget(self) -> None:
        self.bursts.clear()
        self.answered = 0
        self._pending.clear()
        self._beats.clear()
        for channel in (self._address, self._data, self._response):
            channel.clear()

    def _take_address(self) -> None:
        while not self._address.empty():
            item = self._address.recv_nowait()
            burst = Burst(len(self.bursts), int(item.awaddr), int(item.awlen) + 1, self.cycle, self.answered)
            if (int(item.awsize), int(item.awburst)) != (3, 1):
                self.fail(f"awsize {int(item.awsize)}, awburst {int(item.awburst)}; expected 3 and 1")
            if burst.address % BEAT_BYTES:
                self.fail(f"address 0x{burst.address:x} is not aligned")
            if burst.beats > MAX_BEATS:
                self.fail(f"a burst of {burst.beats} beats")
            if burst.address % PAGE_BYTES + burst.beats * BEAT_BYTES > PAGE_BYTES:
                self.fail(f"the burst of {burst.beats} beats at 0x{burst.address:x} crosses 4 KiB")
            self.bursts.append(burst)
            self._pending.append(burst)

    def _take_data(self) -> None:
        while not self._data.empty():
            self._beats.append(self._data.recv_nowait())
        waiting = next((burst for burst in self._pending if not burst.due), None)
        if waiting is None or len(self._beats) < waiting.beats:
            return
        beats, self._beats = self._beats[: waiting.beats], self._beats[waiting.beats :]
        if [int(beat.wlast) for beat in beats] != [0] * (waiting.beats - 1) + [1]:
            self.fail("wlast is not on the last beat of the burst, and on no other")
        if any(int(beat.wstrb) != 0xFF for beat in beats):
            self.fail("a byte strobe is 0")
        waiting.data = b"".join(int(beat.wdata).to_bytes(BEAT_BYTES, "little") for beat in beats)
        waiting.failed = self.fails(waiting)
        waiting.due = self.cycle + self._rng.randint(*self.latency)

    def _show(self, burst: Burst) -> None:
        if not burst.visible and not burst.failed:
            self.bytes.update(enumerate(burst.data, burst.address))
            self.on_change(burst.address)
        burst.visible = True

    async def _run(self) -> None:
        edge = RisingEdge(self._clock)
        while True:
            await edge
            if str(self._reset.value) != "0":
                self._forget()
                continue
            self._take_address()
            self._take_data()
            for burst in self._pending:
                if burst.due and self._rng.random() < 0.1:
                    self._show(burst)
            while self._pending and self._pending[0].due and self._pending[0].due <= self.cycle:
                burst = self._pending.popleft()
                self._show(burst)
                self._response.send_nowait(self._response._transaction_obj(bresp=SLVERR if burst.failed else OKAY))

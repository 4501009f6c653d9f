# SPDX-License-Identifier: Apache-2.0
"""Memory behind an AXI read master without IDs (`m_axi_ar*`, `r*`), with latency, stalls, sleep and injected errors.

It answers bursts in their order, drives X between beats where the simulator knows it, and checks the protocol.
"""

from collections import deque
from collections.abc import Callable
from dataclasses import dataclass
from random import Random, getrandbits
from typing import Any

import cocotb
from cocotb.handle import HierarchyObject
from cocotb.triggers import RisingEdge
from cocotb.types import LogicArray
from cocotb.utils import get_sim_time

from tb.common.run import four_state, where
from tb.common.stream import stalls

OKAY, SLVERR = 0, 2
PAGE_BYTES = 4096
BEAT_BYTES = 8
MAX_BEATS = 16  # AXI3


@dataclass
class ReadBurst:
    """One read burst. Times are in ns: when its address was first seen, and when each beat was taken.

    `bad` says which beat is answered with an error; None = none.
    """

    number: int
    address: int
    beats: int
    offered_ns: float
    due: int
    bad: int | None = None
    taken_ns: tuple[float, ...] = ()

    @property
    def failed(self) -> bool:
        """Whether the master has taken a beat with an error."""
        return self.bad is not None and len(self.taken_ns) > self.bad


class AxiReadMemory:
    """Answers every read of `dut.<prefix>_*`.

    Args:
        dut: the master.
        prefix: of its ports.
        clock: clock signal.
        reset: active-high reset; bursts under way are forgotten.
        rng: source of stalls and latencies.

    `regions` are the bytes from each address; a read of anything else fails the test. `latency` is the range of clocks
    from an address to its first beat. While `asleep` no beat comes, and no address is taken if `deaf` too.
    `bad_beat(burst)` gives the beat that is answered with an error. `most` is the greatest number of bursts that was
    under way.
    """

    def __init__(self, dut: HierarchyObject, prefix: str, clock: Any, reset: Any, rng: Random) -> None:
        self.regions: dict[int, bytes] = {}
        self.bursts: list[ReadBurst] = []
        self.cycle = 0
        self.most = 0
        self.latency = (1, 1)
        self.asleep = self.deaf = False
        self.bad_beat: Callable[[ReadBurst], int | None] = lambda _: None
        self._rng, self._clock, self._reset = rng, clock, reset
        self._waiting: deque[ReadBurst] = deque()
        names = ("araddr", "arlen", "arsize", "arburst", "arcache", "arprot")
        self._payload = [getattr(dut, f"{prefix}_{name}") for name in names]
        self._arvalid, self._arready = getattr(dut, f"{prefix}_arvalid"), getattr(dut, f"{prefix}_arready")
        self._rvalid, self._rready = getattr(dut, f"{prefix}_rvalid"), getattr(dut, f"{prefix}_rready")
        self._rdata, self._rresp = getattr(dut, f"{prefix}_rdata"), getattr(dut, f"{prefix}_rresp")
        self._rlast = getattr(dut, f"{prefix}_rlast")
        self.stall(0.0)
        self._idle()
        self._arready.value = 0
        cocotb.start_soon(self._run())

    def stall(self, fraction: float) -> None:
        """Keep addresses and beats back in `fraction` of the cycles."""
        self._address_stalls, self._data_stalls = stalls(self._rng, fraction), stalls(self._rng, fraction)

    def fail(self, what: str) -> None:
        """Fail the test."""
        raise AssertionError(f"memory port: {what} in cycle {self.cycle}; {where()}")

    def _idle(self) -> None:
        self._rvalid.value = 0
        unknown = four_state()
        self._rdata.value = LogicArray("X" * 64) if unknown else getrandbits(64)
        self._rresp.value = LogicArray("XX") if unknown else getrandbits(2)
        self._rlast.value = LogicArray("X") if unknown else getrandbits(1)

    def _beat(self, address: int) -> int:
        for base, data in self.regions.items():
            if base <= address < base + len(data):
                return int.from_bytes(
                    data[address - base : address - base + BEAT_BYTES].ljust(BEAT_BYTES, b"\xa5"), "little"
                )
        self.fail(f"0x{address:x} was read, which is no part of a picture")
        return 0

    def _take(self, fields: list[int], offered_ns: float) -> None:
        address, length, *constant = fields
        beats = length + 1
        if constant != [3, 1, 0b0011, 0]:
            self.fail(f"arsize, arburst, arcache, arprot are {constant}; expected [3, 1, 3, 0]")
        if address % BEAT_BYTES:
            self.fail(f"address 0x{address:x} is not aligned")
        if beats > MAX_BEATS:
            self.fail(f"a burst of {beats} beats")
        if address % PAGE_BYTES + beats * BEAT_BYTES > PAGE_BYTES:
            self.fail(f"the burst of {beats} beats at 0x{address:x} crosses 4 KiB")
        for beat in range(beats):
            self._beat(address + BEAT_BYTES * beat)
        due = self.cycle + self._rng.randint(*self.latency)
        burst = ReadBurst(len(self.bursts), address, beats, offered_ns, due)
        burst.bad = self.bad_beat(burst)
        self.bursts.append(burst)
        self._waiting.append(burst)
        self.most = max(self.most, len(self._waiting))

    def _show(self, burst: ReadBurst) -> None:
        at = len(burst.taken_ns)
        self._rvalid.value = 1
        self._rdata.value = self._beat(burst.address + BEAT_BYTES * at)
        self._rresp.value = SLVERR if burst.bad == at else OKAY
        self._rlast.value = int(at == burst.beats - 1)

    async def _run(self) -> None:
        edge = RisingEdge(self._clock)
        was_reset, showing, ready, offered, offered_ns = False, False, False, None, 0.0
        while True:
            await edge
            self.cycle += 1
            now = get_sim_time("ns")
            if str(self._reset.value) != "0":
                was_reset, showing, ready, offered = True, False, False, None
                self.bursts.clear()
                self._waiting.clear()
                self._idle()
                self._arready.value = 0
                continue
            if not was_reset:
                continue
            flags = str(self._arvalid.value) + str(self._rready.value)
            if set(flags) - {"0", "1"}:
                self.fail(f"arvalid, rready are {flags}")
            if flags[0] == "1":
                text = [str(signal.value) for signal in self._payload]
                if set("".join(text)) - {"0", "1"}:
                    self.fail(f"the address is undefined: {text}")
                if offered is None:
                    offered_ns = now
                elif offered != text:
                    self.fail(f"the address changed while it waited, from {offered} to {text}")
                offered = None if ready else text
                if ready:
                    self._take([int(bits, 2) for bits in text], offered_ns)
            elif offered is not None:
                self.fail("arvalid fell before arready")
            if showing and flags[1] == "1":
                burst = self._waiting[0]
                burst.taken_ns = (*burst.taken_ns, now)
                showing = False
                if len(burst.taken_ns) == burst.beats:
                    self._waiting.popleft()
            ready = not next(self._address_stalls) and not (self.asleep and self.deaf)
            self._arready.value = int(ready)
            if showing:
                continue
            due = bool(self._waiting) and self._waiting[0].due <= self.cycle
            showing = due and not self.asleep and not next(self._data_stalls)
            if showing:
                self._show(self._waiting[0])
            else:
                self._idle()

# SPDX-License-Identifier: Apache-2.0
"""Clocks that stop, the vendor's clock switch as its data sheet has it, and what must hold at every moment."""

from random import Random, getrandbits

import cocotb
from cocotb.handle import HierarchyObject
from cocotb.triggers import Event, RisingEdge, Timer, ValueChange
from cocotb.utils import get_sim_time

from tb.common.run import parameter

CLK_PS = 10_000
PIX_PS = 13_468
US = parameter("CLK_PER_US", 10)
QUIET = parameter("QUIET_US", 3) * US
HOLD = parameter("HOLD_US", 12) * US
"""Cycles of clk."""
CAMERA, PATTERN, STORED = 0, 1, 2
VIDEO = 0b100
"""de = 1, no sync, beneath a colour that names the source."""


class PixelClock:
    """A clock that can stand still at either level; its lock follows."""

    def __init__(self, lock: object, name: str) -> None:
        self.lock, self.name = lock, name
        self.level, self.running, self.changed = 0, False, Event()
        self.stop_at: int | None = None

    def start(self) -> None:
        """Let it run, with a lock."""
        self.running, self.stop_at = True, None
        self.lock.value = 1

    def stop(self, level: int, *, tell: bool = True) -> None:
        """Let it stand still at a level; without `tell` the lock does not notice."""
        self.stop_at = level
        self.running = False
        if tell:
            self.lock.value = 0


class Bench:
    """Clocks, the switch between them, and checks that run along."""

    def __init__(self, dut: HierarchyObject) -> None:
        self.dut, self.rng = dut, Random(getrandbits(64))
        self.camera = PixelClock(dut.camera_locked, "camera")
        self.local = PixelClock(dut.local_locked, "local")
        self.enabled = [1, 0]
        self.edges: list[tuple[int, int]] = []
        self.short: list[str] = []
        self.seen: set[int] = set()
        dut.rst.value, dut.want.value, dut.pix_clk.value = 1, CAMERA, 0
        dut.camera_locked.value, dut.local_locked.value = 0, 0
        for index, port in enumerate((dut.camera, dut.pattern, dut.stored)):
            port.value = ((index + 1) << 3) | VIDEO

    async def begin(self) -> None:
        """Start everything and reset."""
        cocotb.start_soon(self._clk())
        for clock, phase in ((self.camera, 0), (self.local, 3_100)):
            cocotb.start_soon(self._toggle(clock, phase))
        cocotb.start_soon(self._watch_orders())
        await self.cycles(4)
        self.dut.rst.value = 0
        cocotb.start_soon(self._check_clk())
        cocotb.start_soon(self._check_pixels())

    async def cycles(self, count: int) -> None:
        """Wait."""
        for _ in range(count):
            await RisingEdge(self.dut.clk)

    async def until_free(self, limit: int = QUIET + HOLD + 30) -> int:
        """Wait until hold is 0; returns cycles of clk."""
        for cycle in range(limit):
            await RisingEdge(self.dut.clk)
            if not int(self.dut.hold.value):
                return cycle
        raise AssertionError(f"hold is 1 for more than {limit} cycles")

    async def pixels(self, count: int) -> None:
        """Wait for edges of pix_clk, not for ever."""
        before = len(self.edges)
        await self.cycles(4 * count + 4)
        assert len(self.edges) - before >= 2 * count, "pix_clk stands still"

    # ---- The clock switch: it leaves a clock, and takes one, with its falling edge, or at once if that is ignored.

    def _orders(self) -> tuple[list[int], list[int]]:
        select = int(self.dut.select_local.value)
        return [1 - select, select], [int(self.dut.ignore_camera.value), int(self.dut.ignore_local.value)]

    def _step(self, falling: int | None) -> None:
        select, ignore = self._orders()
        for index in (0, 1):
            if (falling == index or ignore[index]) and self.enabled[index] and not select[index]:
                self.enabled[index] = 0
        for index in (0, 1):
            free = not self.enabled[1 - index]
            if (falling == index or ignore[index]) and select[index] and free:
                self.enabled[index] = 1
        level = (self.enabled[0] & self.camera.level) | (self.enabled[1] & self.local.level)
        now = int(get_sim_time("ps"))
        if level != (self.edges[-1][1] if self.edges else 0):
            trusted = self.camera.running and self.local.running
            if trusted and self.edges and now - self.edges[-1][0] < PIX_PS // 2 - 1:
                self.short.append(f"pix_clk is {1 - level} for {now - self.edges[-1][0]} ps at {now} ps")
            self.edges.append((now, level))
            self.dut.pix_clk.value = level

    async def _toggle(self, clock: PixelClock, phase: int) -> None:
        await Timer(phase + 1, "ps")
        index = 0 if clock is self.camera else 1
        while True:
            await Timer(PIX_PS // 2, "ps")
            if not clock.running and clock.level == (clock.stop_at or 0):
                continue
            clock.level = 1 - clock.level
            self._step(index if clock.level == 0 else None)

    async def _watch_orders(self) -> None:
        while True:
            await ValueChange(self.dut.clk)
            await Timer(1, "ps")
            if self.dut.select_local.value.is_resolvable and self.dut.ignore_camera.value.is_resolvable:
                self._step(None)

    async def _clk(self) -> None:
        while True:
            self.dut.clk.value = 0
            await Timer(CLK_PS // 2, "ps")
            self.dut.clk.value = 1
            await Timer(CLK_PS // 2, "ps")

    # ---- What must hold.

    async def _check_clk(self) -> None:
        held, before, wanted, locks = 0, None, [], []
        while True:
            await RisingEdge(self.dut.clk)
            hold, source = int(self.dut.hold.value), int(self.dut.source.value)
            select = int(self.dut.select_local.value)
            if before is not None and before != (source, select):
                assert held >= QUIET, f"source or clock changes {held} cycles after hold rose"
            assert select == int(source != CAMERA), "the clock is not that of the source"
            wanted = [*wanted[-1:], int(self.dut.want.value)]
            locks = [*locks[-4:], int((self.dut.local_locked if select else self.dut.camera_locked).value)]
            if not hold:
                assert source == wanted[0], f"source {source} without hold, wanted {wanted[0]}"
                assert any(locks[-4:]), "no hold although the lock is lost"
            held = held + 1 if hold else 0
            before = (source, select)

    async def _check_pixels(self) -> None:
        while True:
            await RisingEdge(self.dut.pix_clk)
            await Timer(1, "ps")
            if not self.dut.de.value.is_resolvable or not int(self.dut.de.value):
                continue
            colour = int(self.dut.data.value)
            self.seen.add(colour - 1)
            assert colour == int(self.dut.source.value) + 1, f"a pixel of source {colour - 1}"

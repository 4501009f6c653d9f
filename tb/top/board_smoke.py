# SPDX-License-Identifier: Apache-2.0
"""board_video, small: from the drawn pad to records in memory and frames at the monitor; a camera that is not there."""

from random import Random, getrandbits

import cocotb
from cocotb.clock import Clock
from cocotb.handle import HierarchyObject
from cocotb.triggers import ClockCycles, RisingEdge
from cocotbext.axi import AxiLiteBus, AxiLiteMaster

from tb.common.axi_memory import AxiMemory
from tb.common.run import parameter

WIDTH, HEIGHT = parameter("WIDTH", 64), parameter("HEIGHT", 40)
FRAME = parameter("H_TOTAL", 90) * parameter("V_TOTAL", 60) * 14 // 10
"""Cycles of clk, and some more."""
RING = 0x02000000
CTRL, FRAME_SIZE, RING_BASE, FRAME_NUMBER, SEEN, MALFORMED, OVERFLOW = 0x08, 0x0C, 0x18, 0x24, 0x30, 0x34, 0x38
SOURCE, STATUS, FRAMES_BLANK = 0x08, 0x40, 0x4C
CAMERA, PATTERN = 0, 1
BLANK = 0x202020
QUIET_INPUTS = ("camera_data", "camera_de", "camera_hsync", "camera_vsync", "lidar_in", "buttons", "switches")
NO_MEMORY = ("rdata", "rresp", "rlast", "rvalid", "arready")


class Monitor:
    """Counts what goes to the transmitter: pixels of each frame, and those that are not blank."""

    def __init__(self, dut: HierarchyObject) -> None:
        self.dut, self.frames = dut, [[0, 0]]
        cocotb.start_soon(self._watch())

    async def _watch(self) -> None:
        before = 0
        while True:
            await RisingEdge(self.dut.pix_clk)
            if not self.dut.out_vsync.value.is_resolvable:
                continue
            vsync = int(self.dut.out_vsync.value)
            if vsync and not before:
                self.frames.append([0, 0])
            before = vsync
            if int(self.dut.out_de.value):
                self.frames[-1][0] += 1
                self.frames[-1][1] += int(self.dut.out_data.value) != BLANK


@cocotb.test
async def from_the_drawn_pad_to_memory_and_monitor(dut: HierarchyObject) -> None:
    """The pattern comes through; a camera without a clock stops everything; the pattern comes back."""
    for name in (*QUIET_INPUTS, *(f"m_axi_frames_{name}" for name in NO_MEMORY)):
        getattr(dut, name).value = 0
    dut.rst.value, dut.camera_locked.value, dut.local_locked.value, dut.monitor_present.value = 1, 0, 1, 1
    cocotb.start_soon(Clock(dut.clk, 10, unit="ns").start())
    cocotb.start_soon(Clock(dut.pix_clk, 13.468, unit="ns").start())
    memory = AxiMemory(dut, "m_axi_results", dut.clk, dut.rst, Random(getrandbits(64)))
    landing = AxiLiteMaster(AxiLiteBus.from_prefix(dut, "s_axil_landing"), dut.clk, dut.rst)
    display = AxiLiteMaster(AxiLiteBus.from_prefix(dut, "s_axil_display"), dut.clk, dut.rst)
    monitor = Monitor(dut)
    await ClockCycles(dut.clk, 10)
    dut.rst.value = 0
    await ClockCycles(dut.clk, 10)
    assert await landing.read_dword(0) == int.from_bytes(b"TDWN")
    assert await landing.read_dword(SEEN) == 0
    for offset, value in ((FRAME_SIZE, HEIGHT << 16 | WIDTH), (RING_BASE, RING), (CTRL, 3)):
        await landing.write_dword(offset, value)

    await display.write_dword(SOURCE, PATTERN)
    await ClockCycles(dut.clk, 8 * FRAME)
    assert int(dut.select_local.value) == 1
    seen = await landing.read_dword(SEEN)
    assert seen >= 5
    assert [await landing.read_dword(offset) for offset in (MALFORMED, OVERFLOW)] == [0, 0]
    assert await landing.read_dword(FRAME_NUMBER) >= seen - 2
    assert await display.read_dword(FRAMES_BLANK) == 0
    assert await display.read_dword(STATUS) & 7 == 7, "the clock runs and is locked, a monitor is there"
    shown = monitor.frames[2:-1]
    assert len(shown) >= 4
    assert all(count == [WIDTH * HEIGHT, WIDTH * HEIGHT] for count in shown), shown
    assert any(memory.read(RING, 64)), "no record in memory"

    await display.write_dword(SOURCE, CAMERA)
    await ClockCycles(dut.clk, FRAME)
    assert int(dut.tx_reset.value) == 1
    before = await landing.read_dword(SEEN)
    await ClockCycles(dut.clk, 3 * FRAME)
    assert await landing.read_dword(SEEN) == before, "frames of another source than the one that is wanted"
    assert await display.read_dword(STATUS) & 2 == 0

    await display.write_dword(SOURCE, PATTERN)
    await ClockCycles(dut.clk, 5 * FRAME)
    assert await landing.read_dword(SEEN) >= before + 2
    assert int(dut.tx_reset.value) == 0

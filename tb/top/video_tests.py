# SPDX-License-Identifier: Apache-2.0
"""board_video: from each source through landing_core and display to the monitor; run by test_board_video.py."""

from random import Random, getrandbits

import cocotb
import numpy as np
from cocotb.clock import Clock
from cocotb.handle import HierarchyObject
from cocotb.triggers import ClockCycles, RisingEdge
from cocotbext.axi import AxiLiteBus, AxiLiteMaster

from golden import frame_source, pattern_source
from golden.chain import Settings, run_chain
from golden.display import VIEWS, display
from golden.generated import display_regs, landing_regs
from golden.overlay import Drawing
from tb.common.axi_memory import AxiMemory
from tb.common.run import parameter, where
from tb.display.tb_display import Monitor, place
from tb.frame_source.axi_read_memory import AxiReadMemory
from tb.landing_core.tb_landing_core import lines_of, picture
from tb.video_in.tb_video_in import Blanking, Raw

CLK_NS, PIX_NS = 10.0, 13.468
WIDTH, HEIGHT = parameter("WIDTH", 1280), parameter("HEIGHT", 720)
DELAY = parameter("DELAY", 13200)
LINE = parameter("H_TOTAL", 1650)
SMALL = WIDTH < 640
BLANKING = Blanking(LINE - WIDTH, LINE * 5, LINE * 5, LINE * 20)
SETTINGS = Settings(min_area=4)
BASE, STORED = 0x0200_0000, 0x0400_0000
BOX = (3, 2, WIDTH // 2, HEIGHT // 2)
SETTLE_US = 40
"""Longer than source_switch holds everything after a change, in the bench's builds."""


class Bench:
    """Clocks, camera, CPU on both register maps, memory, monitor."""

    def __init__(self, dut: HierarchyObject) -> None:
        self.dut, self.rng = dut, Random(getrandbits(64))
        dut.rst.value = 1
        dut.camera_de.value, dut.camera_hsync.value, dut.camera_vsync.value = 0, 0, 0
        dut.camera_locked.value, dut.local_locked.value, dut.monitor_present.value = 1, 1, 1
        dut.lidar_in.value, dut.buttons.value, dut.switches.value = 0, 0, 0
        cocotb.start_soon(Clock(dut.clk, CLK_NS, unit="ns").start())
        cocotb.start_soon(Clock(dut.pix_clk, round(PIX_NS / 2, 3) * 2, unit="ns").start())
        self.landing = AxiLiteMaster(AxiLiteBus.from_prefix(dut, "s_axil_landing"), dut.clk, dut.rst)
        self.display = AxiLiteMaster(AxiLiteBus.from_prefix(dut, "s_axil_display"), dut.clk, dut.rst)
        self.results = AxiMemory(dut, "m_axi_results", dut.clk, dut.rst, Random(self.rng.getrandbits(64)))
        self.pictures = AxiReadMemory(dut, "m_axi_frames", dut.clk, dut.rst, Random(self.rng.getrandbits(64)))
        self.monitor = Monitor(dut)

    async def start(self, source: int = 0, view: int = 0) -> None:
        """Reset, choose what is shown, and let the frames through."""
        await ClockCycles(self.dut.clk, 8)
        self.dut.rst.value = 0
        await ClockCycles(self.dut.clk, 8)
        await self.display.write_dword(display_regs.STORED_BASE_OFFSET, STORED)
        ctrl = source << display_regs.CTRL_SOURCE_SHIFT | view << display_regs.CTRL_VIEW_SHIFT
        await self.display.write_dword(display_regs.CTRL_OFFSET, ctrl | display_regs.CTRL_PATTERN_MOVE_MASK)
        await self.display.write_dword(display_regs.SQUARE_FROM_OFFSET, place(*BOX[:2]))
        await self.display.write_dword(display_regs.SQUARE_TO_OFFSET, place(*BOX[2:]))
        await self.display.write_dword(display_regs.SHOW_OFFSET, 2 << display_regs.SHOW_BOXES_SHIFT)
        landing = {
            landing_regs.FRAME_SIZE_OFFSET: HEIGHT << 16 | WIDTH,
            landing_regs.THRESHOLD_OFFSET: SETTINGS.threshold_register,
            landing_regs.MIN_AREA_OFFSET: SETTINGS.min_area,
            landing_regs.RING_BASE_OFFSET: BASE,
            landing_regs.CTRL_OFFSET: landing_regs.CTRL_ENABLE_MASK | landing_regs.CTRL_DARK_IS_ONE_MASK,
        }
        for offset, value in landing.items():
            await self.landing.write_dword(offset, value)
        await ClockCycles(self.dut.clk, SETTLE_US * parameter("CLK_PER_US", 100))

    async def play(self, frames: list[np.ndarray]) -> None:
        """The camera's frames, and the delay after them."""
        raw = Raw(active=1)
        for rgb in frames:
            raw.frame(lines_of(rgb), BLANKING)
        raw.blank(3, sync=True)
        raw.blank(DELAY + 30)
        for data, de, vsync in zip(raw.data, raw.de, raw.vsync, strict=True):
            self.dut.camera_data.value = data
            self.dut.camera_de.value, self.dut.camera_vsync.value = de, vsync
            await RisingEdge(self.dut.pix_clk)

    async def frames_seen(self, count: int) -> None:
        """Wait until the monitor has got so many whole frames."""
        while len(self.monitor.frames) < count or len(self.monitor.frames[count - 1]) < WIDTH * HEIGHT:
            await ClockCycles(self.dut.pix_clk, LINE)

    async def records(self) -> int:
        """How many frames have left a record."""
        return int(await self.landing.read_dword(landing_regs.FRAME_NUMBER_OFFSET))


def shown(rgbs: list[np.ndarray], view: int) -> list[np.ndarray]:
    """What the monitor gets of these frames."""
    drawing, pictures, stats = Drawing(boxes=(None, BOX, None, None)), [], None
    for rgb in rgbs:
        stages = run_chain(rgb, stats, SETTINGS)
        stats = stages.stats
        words = np.array(lines_of(rgb))
        shapes = (stages.dilated != SETTINGS.label_zeros).astype(np.int64)
        pictures.append(display(view, words, stages.gray.astype(np.int64), shapes, drawing))
    return pictures


@cocotb.test(timeout_time=200, timeout_unit="ms")
@cocotb.parametrize(view=list(range(len(VIEWS))))
async def camera_to_monitor(dut: HierarchyObject, view: int) -> None:
    """Frames of the camera are at the monitor, DELAY later, in each view, and each leaves its record."""
    if not SMALL and view == VIEWS.index("gray"):
        return  # of full size the longest and the shortest way are enough
    bench = Bench(dut)
    await bench.start(view=view)
    frames = [picture(bench.rng, WIDTH, HEIGHT) for _ in range(3 if SMALL else 2)]
    await bench.play(frames)
    bench.monitor.check(shown(frames, view))
    assert await bench.records() == len(frames), f"{await bench.records()} records; {where()}"
    blank = await bench.display.read_dword(display_regs.FRAMES_BLANK_OFFSET)
    assert blank == 0, f"{blank} frames were blank; {where()}"


@cocotb.test(timeout_time=200, timeout_unit="ms", skip=not SMALL)
async def built_in_sources(dut: HierarchyObject) -> None:
    """The pattern moves, then the stored picture is there, then the camera again; each gets to monitor and record."""
    bench = Bench(dut)
    stored = picture(bench.rng, WIDTH, HEIGHT)
    bench.pictures.regions[STORED] = frame_source.memory_of(stored)
    await bench.start(source=1)
    await bench.frames_seen(4)
    drawing = Drawing(boxes=(None, BOX, None, None))
    patterns = [
        display(0, np.array(lines_of(pattern_source.frame(number, True, WIDTH, HEIGHT))), gray, gray, drawing).ravel()
        for number in range(16)
        for gray in [np.zeros((HEIGHT, WIDTH), np.int64)]
    ]
    known = [one.tolist() for one in patterns]
    numbers = [known.index(got) for got in bench.monitor.frames[1:4] if got in known]
    assert len(numbers) == 3 and numbers[2] > numbers[0], f"frames {numbers} of the pattern were seen; {where()}"
    assert await bench.records() >= 3, f"{await bench.records()} records; {where()}"

    await switch_to(bench, 2)
    await bench.frames_seen(2)
    assert bench.monitor.frames[1] == shown([stored], 0)[0].ravel().tolist(), f"not the stored picture; {where()}"

    await switch_to(bench, 0)
    frames = [picture(bench.rng, WIDTH, HEIGHT) for _ in range(2)]
    await bench.play(frames)
    assert bench.monitor.frames[-1] == shown(frames, 0)[-1].ravel().tolist(), f"not the camera; {where()}"
    assert not await bench.display.read_dword(display_regs.EVENTS_OFFSET) & (
        display_regs.EVENTS_STORED_UNDERFLOW_MASK | display_regs.EVENTS_STORED_ERROR_MASK
    ), where()


async def switch_to(bench: Bench, source: int) -> None:
    """Change the source, wait until what is left of the one before has gone, and forget the frames so far."""
    ctrl = await bench.display.read_dword(display_regs.CTRL_OFFSET)
    ctrl = ctrl & ~display_regs.CTRL_SOURCE_MASK | source << display_regs.CTRL_SOURCE_SHIFT
    await bench.display.write_dword(display_regs.CTRL_OFFSET, ctrl)
    await ClockCycles(bench.dut.clk, SETTLE_US * parameter("CLK_PER_US", 100))
    await ClockCycles(bench.dut.pix_clk, 2 * DELAY)
    bench.monitor.frames.clear()


@cocotb.test(timeout_time=200, timeout_unit="ms", skip=not SMALL)
async def a_camera_without_a_clock(dut: HierarchyObject) -> None:
    """It is waited for, the transmitter held; nothing else gets to the firmware in its place; then it comes through."""
    bench = Bench(dut)
    dut.camera_locked.value = 0
    await bench.start()
    await ClockCycles(dut.pix_clk, LINE * parameter("V_TOTAL", 750))
    assert int(dut.tx_reset.value) == 1, f"the transmitter runs; {where()}"
    assert int(dut.select_local.value) == 0, f"the local clock counts; {where()}"
    seen = await bench.landing.read_dword(landing_regs.FRAMES_SEEN_OFFSET)
    assert seen == 0, f"{seen} frames without a camera; {where()}"
    status = await bench.display.read_dword(display_regs.STATUS_OFFSET)
    assert not status & display_regs.STATUS_CLOCK_LOCKED_MASK, f"STATUS {status:#x}; {where()}"
    dut.camera_locked.value = 1
    await ClockCycles(dut.clk, SETTLE_US * parameter("CLK_PER_US", 100))
    assert int(dut.tx_reset.value) == 0, f"the transmitter is still held; {where()}"
    bench.monitor.frames.clear()
    frames = [picture(bench.rng, WIDTH, HEIGHT) for _ in range(2)]
    await bench.play(frames)
    assert bench.monitor.frames[-1] == shown(frames, 0)[-1].ravel().tolist(), f"not the camera; {where()}"
    assert await bench.records() == 2, f"{await bench.records()} records; {where()}"

# SPDX-License-Identifier: Apache-2.0
"""The surroundings of display: a camera, what landing_core shows of it, a CPU, and a monitor."""

from dataclasses import dataclass
from random import Random, getrandbits

import cocotb
import numpy as np
from cocotb.clock import Clock
from cocotb.handle import HierarchyObject
from cocotb.triggers import ClockCycles, RisingEdge
from cocotb.types import LogicArray
from cocotbext.axi import AxiLiteBus, AxiLiteMaster

from golden.generated import display_regs as regs
from golden.overlay import COLUMNS, Drawing
from golden.video_out import BLANK
from tb.common.run import four_state, parameter, where
from tb.video_in.tb_video_in import Blanking, Raw

CLK_NS = 10.0
MAX_WIDTH, MAX_HEIGHT = parameter("MAX_WIDTH", 1280), parameter("MAX_HEIGHT", 720)
DELAY = parameter("DELAY", 13200)
CLK_PER_US = parameter("CLK_PER_US", 100)
BLANKING = Blanking(6, 30, 20, 400)
LAGS = {"rgb": 8, "gray": 12, "binary": 300}
"""Cycles of pix_clk that each stream is behind the camera; shapes end in vertical blanking."""
SHAPES = ("RING", "SQUARE", "RECTANGLE", "SMALL_RING")


@dataclass(frozen=True)
class Pictures:
    """What landing_core shows of one frame: integer arrays (height, width)."""

    rgb: np.ndarray
    gray: np.ndarray
    binary: np.ndarray

    @classmethod
    def random(cls, rng: Random, width: int, height: int) -> "Pictures":
        """Pictures that have nothing to do with one another, so that a mix-up shows."""
        return cls(*(noise(rng, width, height, bits) for bits in (24, 8, 1)))


def noise(rng: Random, width: int, height: int, bits: int) -> np.ndarray:
    """Random pixels."""
    return np.array([[rng.getrandbits(bits) for _ in range(width)] for _ in range(height)])


class Monitor:
    """Takes what comes on `out_*`; after a reset from the first vsync on."""

    def __init__(self, dut: HierarchyObject) -> None:
        self.frames: list[list[int]] = []
        """Pixels of each frame."""
        cocotb.start_soon(self._watch(dut))

    async def _watch(self, dut: HierarchyObject) -> None:
        between = False
        while True:
            await RisingEdge(dut.pix_clk)
            if str(dut.rst.value) != "0":
                between = False
                continue
            de = str(dut.out_de.value) == "1"
            if de and between:
                self.frames.append([])
            if de and self.frames:
                self.frames[-1].append(int(dut.out_data.value))
            between = (between or str(dut.out_vsync.value) == "1") and not de

    def check(self, expected: list[np.ndarray | None]) -> None:
        """Assert what the monitor has got; None stands for a frame without a picture."""
        assert len(self.frames) == len(expected), f"{len(self.frames)} frames, expected {len(expected)}; {where()}"
        for index, (got, picture) in enumerate(zip(self.frames, expected, strict=True)):
            wanted = [BLANK] * len(got) if picture is None else picture.ravel().tolist()
            assert len(got) == len(wanted), f"frame {index}: {len(got)} pixels, expected {len(wanted)}; {where()}"
            bad = [at for at, pair in enumerate(zip(got, wanted, strict=True)) if pair[0] != pair[1]]
            assert not bad, (
                f"frame {index}, pixel {bad[0]}: expected {wanted[bad[0]]:06X}, got {got[bad[0]]:06X}; "
                f"{len(bad)} of {len(got)} differ; {where()}"
            )
        self.frames.clear()


class Bench:
    """All around the core."""

    def __init__(self, dut: HierarchyObject, pix_ns: float = 13.468) -> None:
        self.dut, self.rng = dut, Random(getrandbits(64))
        dut.rst.value = 1
        dut.vid_de.value, dut.vid_hsync.value, dut.vid_vsync.value = 0, 0, 0
        dut.pix_clk_locked.value, dut.monitor_present.value = 0, 0
        dut.buttons.value, dut.switches.value = 0, 0
        dut.stored_underflow.value, dut.stored_error.value = 0, 0
        for name in LAGS:
            self._idle(name)
        cocotb.start_soon(Clock(dut.clk, CLK_NS, unit="ns").start())
        self.pix_clock = Clock(dut.pix_clk, round(pix_ns / 2, 3) * 2, unit="ns")
        self.pix_clock.start(start_high=False)
        self.cpu = AxiLiteMaster(AxiLiteBus.from_prefix(dut, "s_axil"), dut.clk, dut.rst)
        self.monitor = Monitor(dut)
        self._at = 0

    async def reset(self) -> None:
        """Reset; the ring of syncs holds blanking again DELAY cycles later."""
        self.dut.rst.value = 1
        await ClockCycles(self.dut.clk, 5)
        self.dut.rst.value = 0
        self.monitor.frames.clear()
        await ClockCycles(self.dut.clk, 10)

    async def write(self, offset: int, value: int) -> None:
        """Write a register."""
        await self.cpu.write_dword(offset, value)

    async def read(self, offset: int) -> int:
        """Read a register."""
        return int(await self.cpu.read_dword(offset))

    async def draw(self, drawing: Drawing, bank: int = 0) -> None:
        """Write all registers of a drawing, as the firmware does: held meanwhile."""
        ctrl = await self.read(regs.CTRL_OFFSET)
        await self.write(regs.CTRL_OFFSET, ctrl | regs.CTRL_HOLD_MASK)
        for name, box in zip(SHAPES, drawing.boxes, strict=True):
            left, top, right, bottom = box or [self.rng.getrandbits(13) for _ in range(4)]
            await self.write(getattr(regs, f"{name}_FROM_OFFSET"), place(left, top))
            await self.write(getattr(regs, f"{name}_TO_OFFSET"), place(right, bottom))
        await self.write(regs.CENTRE_OFFSET, place(*(drawing.centre or (0, 0))))
        await self.write(regs.TIP_OFFSET, place(*drawing.tip))
        for line, words in enumerate(drawing.text or ()):
            for column, char in enumerate(words.ljust(COLUMNS, "\0")):
                where_to = (
                    column << regs.TEXT_COLUMN_SHIFT | line << regs.TEXT_LINE_SHIFT | bank << regs.TEXT_BANK_SHIFT
                )
                await self.write(regs.TEXT_OFFSET, where_to | ord(char))
        show = sum((box is not None) << regs.SHOW_BOXES_SHIFT + index for index, box in enumerate(drawing.boxes))
        show |= (drawing.centre is not None) << regs.SHOW_PAD_SHIFT
        show |= drawing.crosshair << regs.SHOW_CROSSHAIR_SHIFT
        show |= (drawing.text is not None) << regs.SHOW_TEXT_SHIFT | bank << regs.SHOW_TEXT_BANK_SHIFT
        await self.write(regs.SHOW_OFFSET, show)
        await self.write(regs.CTRL_OFFSET, ctrl)

    async def set_view(self, view: int) -> None:
        """Choose what is shown from the next frame on."""
        ctrl = await self.read(regs.CTRL_OFFSET)
        await self.write(regs.CTRL_OFFSET, ctrl & ~regs.CTRL_VIEW_MASK | view << regs.CTRL_VIEW_SHIFT)

    async def play(self, frames: list[Pictures], missing: tuple[int, ...] = ()) -> None:
        """Play frames of one size to the end of the delay; of those that are missing no stream shows anything."""
        height, width = frames[0].rgb.shape
        self.dut.view_width.value, self.dut.view_height.value = width, height
        raw = Raw(active=1)
        starts = []
        for _ in frames:
            raw.blank(BLANKING.front)
            raw.blank(BLANKING.sync, sync=True)
            raw.blank(BLANKING.back)
            starts.append(len(raw.de))
            for _ in range(height):
                raw.line([0] * width, BLANKING.line)
        raw.blank(3, sync=True)
        raw.blank(DELAY + 30)
        self._at = 0
        self._streams = [cocotb.start_soon(self._show(name, frames, starts, missing)) for name in LAGS]
        for de, vsync in zip(raw.de, raw.vsync, strict=True):
            self.dut.vid_de.value, self.dut.vid_vsync.value = de, vsync
            self.dut.vid_hsync.value = self.rng.getrandbits(1)
            await RisingEdge(self.dut.pix_clk)
            self._at += 1

    def stop(self) -> None:
        """Let camera and streams fall silent, after `play` was cancelled."""
        for stream in self._streams:
            stream.cancel()
        for name in LAGS:
            self._idle(name)
        self.dut.vid_de.value, self.dut.vid_vsync.value = 0, 0

    async def _show(self, name: str, frames: list[Pictures], starts: list[int], missing: tuple[int, ...]) -> None:
        """One of the streams of landing_core, line by line behind the camera."""
        edge, port = RisingEdge(self.dut.clk), f"view_{name}"
        for index, (pictures, start) in enumerate(zip(frames, starts, strict=True)):
            if index in missing:
                continue
            picture = getattr(pictures, name)
            height, width = picture.shape
            for y, x in np.ndindex(height, width):
                while self._at < start + y * (width + BLANKING.line) + x + LAGS[name]:
                    await edge
                getattr(self.dut, f"{port}_tvalid").value = 1
                getattr(self.dut, f"{port}_tdata").value = int(picture[y, x])
                getattr(self.dut, f"{port}_tuser").value = int((x, y) == (0, 0))
                getattr(self.dut, f"{port}_tlast").value = int(x == width - 1)
                await edge
                self._idle(name)

    def _idle(self, name: str) -> None:
        port = f"view_{name}"
        getattr(self.dut, f"{port}_tvalid").value = 0
        for signal in ("tdata", "tuser", "tlast"):
            handle = getattr(self.dut, f"{port}_{signal}")
            handle.value = LogicArray("X" * len(handle)) if four_state() else getrandbits(len(handle))


def place(x: int, y: int) -> int:
    """Word of a register that holds a place."""
    return (y & 0x3FFF) << 16 | (x & 0x3FFF)


def random_drawing(rng: Random) -> Drawing:
    """Boxes and a pad in and around a small frame."""

    def corner() -> int:
        return rng.choice([rng.randint(-3, 30), rng.randint(-80, 90)])

    boxes = tuple(tuple(corner() for _ in range(4)) if rng.random() < 0.7 else None for _ in range(4))
    centre = (corner(), corner()) if rng.random() < 0.5 else None
    return Drawing(boxes, centre, (corner(), corner()), rng.random() < 0.5)

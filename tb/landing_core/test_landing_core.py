# SPDX-License-Identifier: Apache-2.0
"""landing_core through its ports, against the golden chain; every stream between its cores is watched.

sim/test_stages.py compares the streams themselves, and frames of full size.
"""

from dataclasses import replace
from random import Random, getrandbits

import cocotb
import numpy as np
from cocotb.clock import Clock
from cocotb.handle import HierarchyObject
from cocotb.triggers import ClockCycles, RisingEdge
from cocotb.types import LogicArray
from cocotb.utils import get_sim_time
from cocotbext.axi import AxiLiteBus, AxiLiteMaster, AxiResp

from golden.chain import Settings, run_chain
from golden.generated import landing_regs as regs
from golden.result_writer import record
from tb.common.axi_memory import AxiMemory
from tb.common.run import four_state, parameter, where
from tb.common.stream import CLOCK_NS, StreamMonitor
from tb.video_in.tb_video_in import Blanking, Raw, model, spoil

MAX_WIDTH, MAX_HEIGHT = parameter("MAX_WIDTH", 1280), parameter("MAX_HEIGHT", 720)
MAX_OBJECTS = parameter("MAX_OBJECTS", 256)
CLK_PER_US = parameter("CLK_PER_US", 100)
PIX_NS = 13.468
STREAMS = ("rgb", "gray", "smooth", "checked", "stats", "binary", "eroded", "median", "dilated", "objects")
# Lines as far apart as 720p60 has them in proportion; enough between frames to flush the borders.
BLANKING = Blanking(line=14, front=150, sync=60, back=250)
# From docs/cores: a pixel's way through video_in, after 2 more of pix_clk, to where the time is taken; the filter of
# the LiDAR's pin.
VIDEO_IN_CLOCKS = 3
LIDAR_CLOCKS = 103
LIMIT_US = 5000  # of simulated time; no test comes near


class Bench:
    """Both clocks, camera, memory, CPU, LiDAR pin, and a checker on every stream inside."""

    def __init__(self, dut: HierarchyObject) -> None:
        self.dut, self.rng = dut, Random(getrandbits(64))
        self.base = Random(getrandbits(64)).randrange(0, (1 << 32) - regs.RING_BUFFERS * regs.RING_STRIDE_BYTES, 4096)
        self.settings = Settings(min_area=3)
        self.size = (MAX_WIDTH, MAX_HEIGHT)
        self.last_pixel_ns = 0.0
        self.released_ns = 0.0
        self.first_pixels_ns: list[float] = []
        """Of each frame since the reset, when the first pixel was at the pins."""
        self.pulse_end = 0
        """Clock in which the LiDAR's pin fell last."""
        dut.rst.value = 1
        dut.lidar_in.value = 0
        dut.vid_hsync.value = 0
        self._drive(0, 0, 0)
        cocotb.start_soon(Clock(dut.clk, CLOCK_NS, unit="ns").start())
        cocotb.start_soon(Clock(dut.pix_clk, round(PIX_NS / 2, 3) * 2, unit="ns").start())
        self.cpu = AxiLiteMaster(AxiLiteBus.from_prefix(dut, "s_axil"), dut.clk, dut.rst)
        self.memory = AxiMemory(dut, "m_axi", dut.clk, dut.rst, Random(self.rng.getrandbits(64)))
        self.monitors = {name: StreamMonitor(dut, name, dut.clk, dut.rst) for name in STREAMS}

    async def reset(self) -> None:
        """Reset and configure."""
        self.dut.rst.value = 1
        await ClockCycles(self.dut.clk, 8)
        self.dut.rst.value = 0
        self.released_ns = get_sim_time("ns")
        self.first_pixels_ns.clear()
        await ClockCycles(self.dut.clk, 8)
        await self.write(regs.RING_BASE_OFFSET, self.base)
        await self.write(regs.IRQ_ENABLE_OFFSET, regs.IRQ_STATUS_FRAME_DONE_MASK)
        await self.configure(self.settings, self.size)

    async def configure(self, settings: Settings, size: tuple[int, int]) -> None:
        """Write the registers that a frame depends on."""
        self.settings, self.size = settings, size
        await self.write(regs.FRAME_SIZE_OFFSET, size[1] << 16 | size[0])
        await self.write(regs.THRESHOLD_OFFSET, settings.factor)
        await self.write(regs.MIN_AREA_OFFSET, settings.min_area)
        dark = settings.dark_is_one << regs.CTRL_DARK_IS_ONE_SHIFT
        zeros = settings.label_zeros << regs.CTRL_LABEL_ZEROS_SHIFT
        await self.write(regs.CTRL_OFFSET, dark | zeros | regs.CTRL_ENABLE_MASK)
        await ClockCycles(self.dut.clk, 40)

    async def read(self, offset: int) -> int:
        """Read one register."""
        return int.from_bytes((await self.cpu.read(offset, 4)).data, "little")

    async def write(self, offset: int, value: int) -> None:
        """Write one register."""
        await self.cpu.write(offset, value.to_bytes(4, "little"))

    async def play(self, raw: Raw) -> None:
        """Drive the camera."""
        edge = RisingEdge(self.dut.pix_clk)
        await edge
        begins = False
        for data, de, vsync in zip(raw.data, raw.de, raw.vsync, strict=True):
            self._drive(data, de, vsync)
            await edge
            begins = begins or vsync == raw.active
            if de:
                self.last_pixel_ns = get_sim_time("ns")
                if begins:
                    self.first_pixels_ns.append(self.last_pixel_ns)
                begins = False
        self._drive(0, 0, raw.vsync[-1])

    async def lidar_pulse(self, length_us: int) -> None:
        """Drive the LiDAR's pin high for some time."""
        self.dut.lidar_in.value = 1
        await ClockCycles(self.dut.clk, length_us * CLK_PER_US)
        self.dut.lidar_in.value = 0
        self.pulse_end = self.memory.cycle

    def start_us(self, number: int) -> float:
        """When video_in handed out the first pixel of a frame, in microseconds since reset."""
        clocks = (self.first_pixels_ns[number - 1] - self.released_ns + 2 * PIX_NS) / CLOCK_NS
        return (clocks + VIDEO_IN_CLOCKS) / CLK_PER_US

    def age_us(self, buffer_address: int) -> float:
        """How old the last reading was when the header of a buffer was written last."""
        written = [burst.cycle for burst in self.memory.bursts if burst.address == buffer_address]
        return (written[-1] - self.pulse_end - LIDAR_CLOCKS) / CLK_PER_US

    async def settle(self) -> None:
        """Wait until the last record is written."""
        await ClockCycles(self.dut.clk, 1500)

    def _drive(self, data: int, de: int, vsync: int) -> None:
        idle = LogicArray("X" * 24) if four_state() else self.rng.getrandbits(24)
        self.dut.vid_data.value = data if de else idle
        self.dut.vid_de.value, self.dut.vid_vsync.value = de, vsync

    async def check_ring(self, published: list["Expected"], unwritten: int = 0) -> None:
        """Assert that the ring holds the newest of `published`, and that the registers say so."""
        newest = published[-regs.RING_BUFFERS :]
        for index, expected in enumerate(published):
            if expected in newest:
                expected.check(self, index % regs.RING_BUFFERS)
        head = await self.read(regs.RING_HEAD_OFFSET)
        last = (len(published) - 1) % regs.RING_BUFFERS
        assert head == (regs.RING_HEAD_VALID_MASK | last if published else 0), f"RING_HEAD 0x{head:08x}; {where()}"
        number = await self.read(regs.FRAME_NUMBER_OFFSET)
        wanted = published[-1].number if published else 0
        assert number == wanted, f"FRAME_NUMBER {number}, expected {wanted}; {where()}"
        lost = await self.read(regs.FRAMES_UNWRITTEN_OFFSET)
        assert lost == unwritten, f"FRAMES_UNWRITTEN {lost}, expected {unwritten}; {where()}"


class Expected:
    """A frame that must give a record; `before` is the last complete one before it."""

    def __init__(
        self,
        number: int,
        rgb: np.ndarray,
        before: "Expected | None",
        settings: Settings,
        *,
        stale: bool = False,
        malformed: int = 0,
        altitude_mm: int | None = None,
    ) -> None:
        self.number, self.settings = number, settings
        self.stages = run_chain(rgb, before.stages.stats if before else None, settings)
        self.values = {
            "frame_number": number,
            "frame_size_width": rgb.shape[1],
            "frame_size_height": rgb.shape[0],
            "threshold_factor": settings.factor,
            "min_area": settings.min_area,
            "thresholds_missing": int(before is None),
            "thresholds_stale": int(stale),
            "frames_malformed": malformed,
            "altitude_valid": int(altitude_mm is not None),
        }
        self.altitude_mm = altitude_mm

    def check(self, bench: Bench, buffer: int) -> None:
        """Assert that a buffer holds this record, byte for byte; times and altitude within bounds."""
        address = bench.base + buffer * regs.RING_STRIDE_BYTES
        size = regs.HEADER_DTYPE.itemsize + len(self.stages.objects[:MAX_OBJECTS]) * regs.OBJECT_DTYPE.itemsize
        got = bench.memory.read(address, size)
        header = np.frombuffer(got, regs.HEADER_DTYPE, 1)[0]
        name = f"record of frame {self.number} in buffer {buffer}"
        height, width = self.stages.gray.shape
        camera_us = ((width + BLANKING.line) * height - BLANKING.line) * PIX_NS / CLOCK_NS / CLK_PER_US
        flush_us = (7 * width + 200) / CLK_PER_US
        scan_us = int(header["scan_time_us"])
        assert camera_us - 1 < scan_us < camera_us + flush_us, f"{name}: scan_time_us {scan_us}; {where()}"
        if self.altitude_mm is not None:
            assert abs(int(header["altitude_mm"]) - self.altitude_mm) <= 1, f"{name}: {header['altitude_mm']} mm"
            age, wanted_age = int(header["altitude_age_us"]), bench.age_us(address)
            assert age > 0 and abs(age - wanted_age) <= 2, (
                f"{name}: altitude_age_us {age}, expected {wanted_age:.1f}; {where()}"
            )
        # The counter has only whole microseconds: on average it is half of one behind.
        start, wanted_start = int(header["start_time_us"]), bench.start_us(self.number)
        assert abs(start + 0.5 - wanted_start) <= 1, (
            f"{name}: start_time_us {start}, expected {wanted_start:.1f}; {where()}"
        )
        given = ("start_time_us", "scan_time_us", "altitude_mm", "altitude_age_us")
        values = {**self.values, **{key: int(header[key]) for key in given}}
        wanted = record(values, self.stages.objects, MAX_OBJECTS)
        if got == wanted:
            return
        expected = np.frombuffer(wanted, regs.HEADER_DTYPE, 1)[0]
        for key in regs.HEADER_DTYPE.names:
            assert header[key] == expected[key], f"{name}: {key} {header[key]}, expected {expected[key]}; {where()}"
        start = regs.HEADER_DTYPE.itemsize
        objects = (np.frombuffer(data, regs.OBJECT_DTYPE, offset=start) for data in (wanted, got))
        for index, (one, other) in enumerate(zip(*objects, strict=True)):
            assert one == other, f"{name}, object {index}: expected {one}, got {other}; {where()}"


def picture(rng: Random, width: int, height: int) -> np.ndarray:
    """Return RGB with boxes of both polarities on noise; now and then with more objects than fit."""
    noise = np.random.default_rng(rng.getrandbits(64))
    if rng.random() < 0.2:
        return noise.integers(0, 256, (height, width, 3), dtype=np.uint8)
    rgb = noise.integers(150, 190, (height, width, 3), dtype=np.uint8)
    for _ in range(rng.randint(0, 8)):
        x, y = rng.randrange(width), rng.randrange(height)
        rgb[y : y + rng.randint(3, 12), x : x + rng.randint(3, 12)] = rng.choice((20, 250))
    return rgb


def lines_of(rgb: np.ndarray) -> list[list[int]]:
    """Return the words that the camera sends for a picture."""
    words = rgb.astype(int) @ np.array([1 << 16, 1 << 8, 1])
    return words.tolist()


@cocotb.test(timeout_time=LIMIT_US, timeout_unit="us")
async def registers_tell_what_was_built(dut: HierarchyObject) -> None:
    bench = Bench(dut)
    await bench.reset()
    assert await bench.read(regs.ID_OFFSET) == regs.REGISTERS[0].fields[0].reset
    info = await bench.read(regs.RING_INFO_OFFSET)
    assert info == MAX_OBJECTS << regs.RING_INFO_MAX_OBJECTS_SHIFT | regs.RING_BUFFERS
    first, started = await bench.read(regs.TIME_LO_OFFSET), get_sim_time("ns")
    await ClockCycles(dut.clk, 50 * CLK_PER_US)
    second, ended = await bench.read(regs.TIME_LO_OFFSET), get_sim_time("ns")
    passed = (ended - started) / (CLOCK_NS * CLK_PER_US)
    assert abs(second - first - passed) <= 1, f"time went on by {second - first}, expected {passed}; {where()}"


@cocotb.test(timeout_time=LIMIT_US, timeout_unit="us")
async def registers_hold_what_is_written(dut: HierarchyObject) -> None:
    """Any value, in any order; an address beyond the registers is refused."""
    bench = Bench(dut)
    await bench.reset()
    masks = {
        regs.FRAME_SIZE_OFFSET: 0xFFFFFFFF,
        regs.THRESHOLD_OFFSET: regs.THRESHOLD_FACTOR_MASK,
        regs.MIN_AREA_OFFSET: 0xFFFFFFFF,
        regs.RING_BASE_OFFSET: 0xFFFFFFFF,
        regs.SCRATCH_OFFSET: 0xFFFFFFFF,
    }
    written: dict[int, int] = {}
    for _ in range(60):
        offset = bench.rng.choice(list(masks))
        written[offset] = bench.rng.getrandbits(32) & masks[offset]
        await bench.write(offset, written[offset])
        offset = bench.rng.choice(list(written))
        got = await bench.read(offset)
        assert got == written[offset], f"register {offset:#x}: wrote {written[offset]:#x}, read {got:#x}; {where()}"
    for _ in range(10):
        address = bench.rng.randrange(0x80, 0x1000, 4)
        for answer in (await bench.cpu.read(address, 4), await bench.cpu.write(address, bytes(4))):
            assert answer.resp == AxiResp.SLVERR, f"address {address:#x} answers {answer.resp}; {where()}"


@cocotb.test(timeout_time=LIMIT_US, timeout_unit="us")
async def any_least_area(dut: HierarchyObject) -> None:
    """A least area of all 32 bits, with frames of any size, reaches the labelling and the header."""
    bench = Bench(dut)
    await bench.reset()
    published: list[Expected] = []
    for number in range(1, 9):
        size = bench.rng.randint(5, MAX_WIDTH), bench.rng.randint(5, MAX_HEIGHT)
        area = bench.rng.getrandbits(32) >> bench.rng.choice((0, 26))
        await bench.configure(replace(bench.settings, min_area=area, label_zeros=number % 2 == 0), size)
        rgb = picture(bench.rng, *size)
        published.append(Expected(number, rgb, published[-1] if published else None, bench.settings))
        raw = Raw()
        raw.frame(lines_of(rgb), BLANKING)
        raw.blank(2)
        await bench.play(raw)
        await bench.settle()
        await bench.check_ring(published)


@cocotb.test(timeout_time=LIMIT_US, timeout_unit="us")
async def too_little_blanking_overflows(dut: HierarchyObject) -> None:
    """Frames without blanking overflow the FIFO while borders are flushed: counted, told; a later frame is whole."""
    bench = Bench(dut)
    await bench.reset()
    rgbs = [picture(bench.rng, *bench.size) for _ in range(4)]
    raw = Raw()
    for rgb in rgbs:
        raw.frame(lines_of(rgb))
    raw.frame(lines_of(rgbs[0]), BLANKING)
    raw.blank(2)
    await bench.play(raw)
    await bench.settle()
    overflows = await bench.read(regs.FRAMES_OVERFLOW_OFFSET)
    assert 1 <= overflows <= 4, f"{overflows} of 4 frames overflowed; {where()}"
    assert await bench.read(regs.FRAMES_SEEN_OFFSET) == 5
    status = await bench.read(regs.IRQ_STATUS_OFFSET)
    assert status & regs.IRQ_STATUS_FRAME_OVERFLOW_MASK, f"IRQ_STATUS is {status:#x}; {where()}"
    number = await bench.read(regs.FRAME_NUMBER_OFFSET)
    assert number == 5, f"the newest record is of frame {number}, expected 5; {where()}"
    buffer = await bench.read(regs.RING_HEAD_OFFSET) & regs.RING_HEAD_INDEX_MASK
    data = bench.memory.read(bench.base + buffer * regs.RING_STRIDE_BYTES, regs.HEADER_DTYPE.itemsize)
    told = int(np.frombuffer(data, regs.HEADER_DTYPE)[0]["frames_overflow"])
    assert told == overflows, f"the record of frame {number} tells of {told} overflows, not {overflows}; {where()}"


@cocotb.test(timeout_time=LIMIT_US, timeout_unit="us")
async def frames_become_records(dut: HierarchyObject) -> None:
    """More frames than the ring has buffers, with a memory that answers late and unevenly."""
    bench = Bench(dut)
    bench.memory.latency = (1, 60)
    bench.memory.stall(0.3)
    await bench.reset()
    published: list[Expected] = []
    before = None
    for number in range(1, 7):
        rgb = picture(bench.rng, *bench.size)
        expected = Expected(number, rgb, before, bench.settings)
        before = expected
        raw = Raw()
        raw.frame(lines_of(rgb), BLANKING)
        raw.blank(2)
        assert int(dut.irq.value) == 0
        await bench.play(raw)
        await bench.settle()
        published.append(expected)
        assert int(dut.irq.value) == 1, f"no interrupt after frame {number}; {where()}"
        await bench.check_ring(published)
        await bench.write(regs.IRQ_STATUS_OFFSET, regs.IRQ_STATUS_FRAME_DONE_MASK)
        await ClockCycles(dut.clk, 4)


@cocotb.test(timeout_time=LIMIT_US, timeout_unit="us")
async def configuration_counts_from_the_next_frame(dut: HierarchyObject) -> None:
    """Registers are written while a frame passes; size, polarity, factor and least area change for the next one."""
    bench = Bench(dut)
    await bench.reset()
    sizes = [(MAX_WIDTH, MAX_HEIGHT), (16, 16), (33, 17), (MAX_WIDTH, 18)]
    published: list[Expected] = []
    before = None
    for number, size in enumerate(sizes, 1):
        settings, rgb = bench.settings, picture(bench.rng, *size)
        # One window covers every size here, so the thresholds of a frame of another size serve.
        expected = Expected(number, rgb, before, settings)
        published.append(expected)
        before = expected
        raw = Raw()
        raw.frame(lines_of(rgb), BLANKING)
        raw.blank(2)
        frame = cocotb.start_soon(bench.play(raw))
        # Between the frame's first pixel at the camera and its first pixel in ccl, or a little later.
        await RisingEdge(dut.vid_de)
        await ClockCycles(dut.clk, bench.rng.randrange(40, 9 * (size[0] + BLANKING.line)))
        change = replace(
            settings,
            factor=bench.rng.randrange(400),
            min_area=bench.rng.choice((0, 5000)),
            dark_is_one=not settings.dark_is_one,
            label_zeros=bench.rng.random() < 0.5,
        )
        await bench.configure(change, sizes[number % len(sizes)])
        await frame
        await bench.settle()
        await bench.check_ring(published)


@cocotb.test(timeout_time=LIMIT_US, timeout_unit="us")
async def malformed_frames_leave_no_record(dut: HierarchyObject) -> None:
    """Whole and malformed frames in turn: no record of a torn one, the next one right, thresholds marked as stale."""
    bench = Bench(dut)
    await bench.reset()
    width, height = bench.size = (MAX_WIDTH, 24)
    await bench.configure(bench.settings, bench.size)
    raw = Raw()
    pictures = [picture(bench.rng, width, height) for _ in range(8)]
    for index, rgb in enumerate(pictures):
        lines = lines_of(rgb)
        raw.frame(spoil(bench.rng, lines) if index % 3 == 1 else lines, BLANKING)
    raw.blank(40)
    raw.blank(4, sync=True)
    captured = model(raw, width, height)
    await bench.play(raw)
    await bench.settle()
    published: list[Expected] = []
    before = None
    malformed = 0
    for frame, rgb in zip(captured.frames, pictures, strict=True):
        # A header is written before the next frame begins; a frame with a record may have had its fault after its end.
        malformed += frame.malformed
        if frame.pixels.size != width * height:
            continue
        stale = bool(published) and published[-1].number != frame.number - 1
        expected = Expected(frame.number, rgb, before, bench.settings, stale=stale, malformed=malformed)
        before = expected
        published.append(expected)
    counted = await bench.read(regs.FRAMES_MALFORMED_OFFSET)
    assert counted == captured.malformed, f"FRAMES_MALFORMED {counted}, expected {captured.malformed}; {where()}"
    seen = await bench.read(regs.FRAMES_SEEN_OFFSET)
    assert seen == len(pictures), f"FRAMES_SEEN {seen}, expected {len(pictures)}; {where()}"
    lost = await bench.read(regs.FRAMES_UNWRITTEN_OFFSET)
    assert lost <= len(pictures) - len(published), f"FRAMES_UNWRITTEN {lost}; {where()}"
    await bench.check_ring(published, unwritten=lost)


@cocotb.test(timeout_time=LIMIT_US, timeout_unit="us")
async def write_errors_cost_one_frame(dut: HierarchyObject) -> None:
    bench = Bench(dut)
    await bench.reset()
    published: list[Expected] = []
    before = None
    for number in range(1, 4):
        rgb = picture(bench.rng, *bench.size)
        expected = Expected(number, rgb, before, bench.settings)
        before = expected
        bench.memory.fails = lambda _, fails=number == 2: fails
        raw = Raw()
        raw.frame(lines_of(rgb), BLANKING)
        raw.blank(2)
        await bench.play(raw)
        await bench.settle()
        if number != 2:
            published.append(expected)
    await bench.check_ring(published, unwritten=1)
    assert await bench.read(regs.IRQ_STATUS_OFFSET) & regs.IRQ_STATUS_AXI_ERROR_MASK


@cocotb.test(timeout_time=LIMIT_US, timeout_unit="us")
async def altitude_goes_into_the_record(dut: HierarchyObject) -> None:
    """A frame while the LiDAR is on but has said nothing, then one after a reading."""
    bench = Bench(dut)
    await bench.reset()
    await bench.write(regs.LIDAR_CTRL_OFFSET, regs.LIDAR_CTRL_ENABLE_MASK)
    published: list[Expected] = []
    before = None
    for number, altitude_mm in ((1, None), (2, bench.rng.randint(100, 300))):
        if altitude_mm:
            assert int(dut.lidar_drive_low.value) == 1
            await bench.lidar_pulse(altitude_mm)
            await ClockCycles(dut.clk, 200)
            assert await bench.read(regs.LIDAR_STATUS_OFFSET) == regs.LIDAR_STATUS_VALID_MASK
        rgb = picture(bench.rng, *bench.size)
        before = Expected(number, rgb, before, bench.settings, altitude_mm=altitude_mm)
        published.append(before)
        raw = Raw()
        raw.frame(lines_of(rgb), BLANKING)
        raw.blank(2)
        await bench.play(raw)
        await bench.settle()
    await bench.check_ring(published)


@cocotb.test(timeout_time=LIMIT_US, timeout_unit="us")
async def lidar_faults_interrupt(dut: HierarchyObject) -> None:
    """A sensor that says nothing is a fault, one that is switched off is none, one that gives only glitches is."""
    bench = Bench(dut)
    await bench.reset()
    fault = regs.IRQ_STATUS_LIDAR_FAULT_MASK
    await bench.write(regs.IRQ_ENABLE_OFFSET, fault)
    await bench.write(regs.LIDAR_CTRL_OFFSET, regs.LIDAR_CTRL_ENABLE_MASK)

    async def pulse(length_us: int, gap_us: int) -> None:
        dut.lidar_in.value = 1
        await ClockCycles(dut.clk, length_us * CLK_PER_US)
        dut.lidar_in.value = 0
        await ClockCycles(dut.clk, gap_us * CLK_PER_US)

    async def expect(status: int, what: str) -> None:
        got = await bench.read(regs.IRQ_STATUS_OFFSET)
        assert got == status, f"{what}: expected IRQ_STATUS {status:#x}, got {got:#x}; {where()}"
        assert int(dut.irq.value) == (status != 0), f"{what}: irq is {dut.irq.value}; {where()}"
        await bench.write(regs.IRQ_STATUS_OFFSET, status)

    await ClockCycles(dut.clk, 17_900 * CLK_PER_US)
    await expect(0, "before the time-out")
    await ClockCycles(dut.clk, 200 * CLK_PER_US)
    await expect(fault, "after the time-out")
    await ClockCycles(dut.clk, 1_000 * CLK_PER_US)
    await pulse(300, 100)
    assert await bench.read(regs.LIDAR_STATUS_OFFSET) == regs.LIDAR_STATUS_VALID_MASK
    await expect(0, "after a reading")
    await bench.write(regs.LIDAR_CTRL_OFFSET, 0)
    await expect(0, "after it was switched off")
    await bench.write(regs.LIDAR_CTRL_OFFSET, regs.LIDAR_CTRL_ENABLE_MASK)
    await pulse(300, 100)
    for _ in range(7):
        await pulse(40, 9_000)
    await expect(fault, "after 63 ms of glitches")


@cocotb.test(timeout_time=LIMIT_US, timeout_unit="us")
async def reset_in_mid_frame_forgets_everything(dut: HierarchyObject) -> None:
    bench = Bench(dut)
    await bench.reset()
    for _ in range(3):
        raw = Raw()
        raw.frame(lines_of(picture(bench.rng, *bench.size)), BLANKING)
        camera = cocotb.start_soon(bench.play(raw))
        await ClockCycles(dut.clk, bench.rng.randrange(len(raw.data)))
        camera.cancel()
        await bench.reset()
        rgb = picture(bench.rng, *bench.size)
        raw = Raw()
        raw.frame(lines_of(rgb), BLANKING)
        raw.blank(2)
        await bench.play(raw)
        await bench.settle()
        await bench.check_ring([Expected(1, rgb, None, bench.settings)])


@cocotb.test(timeout_time=LIMIT_US, timeout_unit="us")
async def latency_is_as_documented(dut: HierarchyObject) -> None:
    """From the last pixel at the pins to frame_done: lines of flushing, and the header's way to memory."""
    bench = Bench(dut)
    bench.memory.latency = (10, 10)
    await bench.reset()
    rgb = np.full((MAX_HEIGHT, MAX_WIDTH, 3), 200, np.uint8)
    for _ in range(2):
        raw = Raw()
        raw.frame(lines_of(rgb), BLANKING)
        raw.blank(2)
        await bench.play(raw)
        while not int(dut.irq.value):
            await RisingEdge(dut.clk)
        clocks = (get_sim_time("ns") - bench.last_pixel_ns) / CLOCK_NS
        dut._log.info("last pixel to interrupt: %.0f clocks, %d pixels a line", clocks, MAX_WIDTH)
        assert 6 * MAX_WIDTH < clocks < 6 * MAX_WIDTH + 160, f"{clocks} clocks to the interrupt; {where()}"
        await bench.write(regs.IRQ_STATUS_OFFSET, regs.IRQ_STATUS_FRAME_DONE_MASK)
        await ClockCycles(dut.clk, 20)

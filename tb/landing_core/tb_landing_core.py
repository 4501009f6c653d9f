# SPDX-License-Identifier: Apache-2.0
"""The bench of landing_core's tests, and the record that each frame must give."""

from random import Random, getrandbits
from typing import NamedTuple

import cocotb
import numpy as np
from cocotb.clock import Clock
from cocotb.handle import HierarchyObject
from cocotb.triggers import ClockCycles, First, RisingEdge
from cocotb.types import LogicArray
from cocotb.utils import get_sim_time
from cocotbext.axi import AxiLiteBus, AxiLiteMaster

from golden.chain import Settings, run_chain
from golden.generated import landing_regs as regs
from golden.result_writer import record
from tb.common.axi_lite import check_responses
from tb.common.axi_memory import AxiMemory
from tb.common.run import four_state, parameter, where
from tb.common.stream import CLOCK_NS, StreamMonitor, stalls
from tb.video_in.tb_video_in import Blanking, Raw

MAX_WIDTH, MAX_HEIGHT = parameter("MAX_WIDTH", 1280), parameter("MAX_HEIGHT", 720)
MAX_OBJECTS = parameter("MAX_OBJECTS", 256)
CLK_PER_US = parameter("CLK_PER_US", 100)
PIX_NS = 13.468
STREAMS = ("rgb", "dilated", "objects")
CHAIN_STREAMS = ("gray", "smooth", "checked", "stats", "binary", "eroded", "median")
# Lines as far apart as 720p60 has them in proportion; enough between frames to flush the borders.
BLANKING = Blanking(line=14, front=150, sync=60, back=250)
# From docs/cores: a pixel's way through video_in, after 2 more of pix_clk, to where the time is taken; the filter of
# the LiDAR's pin.
VIDEO_IN_CLOCKS = 3
LIDAR_CLOCKS = 103
NUMBER_PLACE = 56  # the last 8 bytes of the header are written alone


class Record(NamedTuple):
    """A record as it was when its frame number was written, with all the room for objects behind it."""

    number: int
    address: int
    data: bytes


class Bench:
    """Both clocks, camera, memory, CPU, LiDAR pin, and a checker on every stream inside."""

    def __init__(self, dut: HierarchyObject, *, watched: bool = True) -> None:
        """Start all of it; without the checkers on the streams where no picture comes and time is long."""
        self.dut, self.rng = dut, Random(getrandbits(64))
        self.base = Random(getrandbits(64)).randrange(0, (1 << 32) - regs.RING_BUFFERS * regs.RING_STRIDE_BYTES, 4096)
        self.settings = Settings(min_area=3)
        self.size = (MAX_WIDTH, MAX_HEIGHT)
        self.last_pixel_ns = 0.0
        self.released_ns = 0.0
        self.first_pixels_ns: list[float] = []
        """Of each frame since the reset, when the first pixel was at the pins."""
        self.records: list[Record] = []
        """All that became visible, in that order."""
        self.released_cycle = 0
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
        self.memory.on_change = self._note_record
        check_responses(dut)
        write, read = self.cpu.write_if, self.cpu.read_if
        for channel in (write.aw_channel, write.w_channel, write.b_channel, read.ar_channel, read.r_channel):
            channel.set_pause_generator(stalls(self.rng, 0.2))
        self.frame_errors = 0
        """Clocks since the reset in which a core between camera and objects told of a frame that was cut off."""
        cocotb.start_soon(self._watch_frame_errors())
        if not watched:
            return
        self.monitors = {name: StreamMonitor(dut, name, dut.clk, dut.rst) for name in STREAMS}
        self.monitors |= {name: StreamMonitor(dut.chain, name, dut.clk, dut.rst) for name in CHAIN_STREAMS}

    async def reset(self) -> None:
        """Reset and configure."""
        self.dut.rst.value = 1
        await ClockCycles(self.dut.clk, 8)
        self.dut.rst.value = 0
        self.released_ns, self.released_cycle = get_sim_time("ns"), self.memory.cycle
        self.first_pixels_ns.clear()
        await ClockCycles(self.dut.clk, 8)
        await self.write(regs.RING_BASE_OFFSET, self.base)
        await self.write(regs.IRQ_ENABLE_OFFSET, regs.IRQ_STATUS_FRAME_DONE_MASK)
        await self.configure(self.settings, self.size)

    async def configure(self, settings: Settings, size: tuple[int, int]) -> None:
        """Write the registers that a frame depends on."""
        self.settings, self.size = settings, size
        await self.write(regs.FRAME_SIZE_OFFSET, size[1] << 16 | size[0])
        await self.write(regs.THRESHOLD_OFFSET, settings.threshold_register)
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

    def time_us(self, cycle: int) -> float:
        """What the counter of microseconds shows in some clock, with fractions."""
        return (cycle - self.released_cycle) / CLK_PER_US

    def record(self, buffer: int) -> Record:
        """What a buffer holds now."""
        address = self.base + buffer * regs.RING_STRIDE_BYTES
        data = self.memory.read(address, regs.HEADER_DTYPE.itemsize + MAX_OBJECTS * regs.OBJECT_DTYPE.itemsize)
        return Record(int(np.frombuffer(data, regs.HEADER_DTYPE, 1)[0]["frame_number"]), address, data)

    def age_us(self, buffer_address: int) -> float:
        """How old the last reading was when the header of a buffer was written last."""
        written = [burst.cycle for burst in self.memory.bursts if burst.address == buffer_address]
        return (written[-1] - self.pulse_end - LIDAR_CLOCKS) / CLK_PER_US

    def invalidated(self) -> int:
        """How many frames result_writer has begun: how often it wrote 0 for a buffer's frame number."""
        places = [self.base + buffer * regs.RING_STRIDE_BYTES + NUMBER_PLACE for buffer in range(regs.RING_BUFFERS)]
        return sum(burst.address in places and not any(burst.data) for burst in self.memory.bursts)

    async def settle(self) -> None:
        """Wait until the last record is written."""
        await ClockCycles(self.dut.clk, 1500)

    def _drive(self, data: int, de: int, vsync: int) -> None:
        idle = LogicArray("X" * 24) if four_state() else self.rng.getrandbits(24)
        self.dut.vid_data.value = data if de else idle
        self.dut.vid_de.value, self.dut.vid_vsync.value = de, vsync

    def _note_record(self, address: int) -> None:
        buffer, offset = divmod(address - self.base, regs.RING_STRIDE_BYTES)
        record = self.record(buffer)
        if offset == NUMBER_PLACE and record.number:
            self.records.append(record)

    async def _watch_frame_errors(self) -> None:
        """Fail where a core finds more frames cut off than the camera side has told of: cores would disagree."""
        dut, counts = self.dut, [0] * 7
        signals = (dut.rst, dut.chain.unused_errors, dut.unused_error)
        errors = ""
        while True:
            if "1" not in errors:
                await First(*(signal.value_change for signal in signals))
            await RisingEdge(dut.clk)
            reset, *values = (str(signal.value) for signal in signals)
            if reset != "0":
                counts, self.frame_errors, errors = [0] * 7, 0, ""
                continue
            errors = "".join(values)
            assert not set(errors) - {"0", "1"}, f"frame_error of the cores is {errors}; {where()}"
            if "1" not in errors:
                continue
            counts = [count + int(bit) for count, bit in zip(counts, errors, strict=True)]
            self.frame_errors += 1
            cut = int(dut.frames_malformed_reg.value) + int(dut.frames_overflow_reg.value)
            assert max(counts) <= cut, f"{max(counts)} pulses of a frame_error, {cut} frames cut off; {where()}"

    async def check_ring(self, published: list["Expected"], unwritten: int = 0) -> None:
        """Assert that the ring holds the newest of `published`, and that the registers say so."""
        newest = published[-regs.RING_BUFFERS :]
        for index, expected in enumerate(published):
            if expected in newest:
                expected.check(self, self.record(index % regs.RING_BUFFERS))
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
        self.overflows = (0, 0)
        self.last_cycle: int | None = None

    def waited(self, last_cycle: int, least_overflow: int, most_overflow: int) -> None:
        """Expect a frame that may have waited for memory.

        Args:
            last_cycle: clock in which ccl took its last pixel.
            least_overflow: frames before it that the camera dropped.
            most_overflow: frames that the camera dropped in all.
        """
        self.last_cycle, self.overflows = last_cycle, (least_overflow, most_overflow)

    def check(self, bench: Bench, written: Record) -> None:
        """Assert that this record was written, byte for byte; times and altitude within bounds."""
        size = regs.HEADER_DTYPE.itemsize + len(self.stages.objects[:MAX_OBJECTS]) * regs.OBJECT_DTYPE.itemsize
        got = written.data[:size]
        header = np.frombuffer(got, regs.HEADER_DTYPE, 1)[0]
        name = f"record of frame {self.number} at {written.address:#x}"
        self._check_times(bench, header, name)
        if self.altitude_mm is not None:
            assert abs(int(header["altitude_mm"]) - self.altitude_mm) <= 1, f"{name}: {header['altitude_mm']} mm"
            age, wanted_age = int(header["altitude_age_us"]), bench.age_us(written.address)
            assert age > 0 and abs(age - wanted_age) <= 2, (
                f"{name}: altitude_age_us {age}, expected {wanted_age:.1f}; {where()}"
            )
        overflows, (least, most) = int(header["frames_overflow"]), self.overflows
        assert least <= overflows <= most, f"{name}: frames_overflow {overflows}, not {least} to {most}; {where()}"
        given = ("start_time_us", "scan_time_us", "altitude_mm", "altitude_age_us", "frames_overflow")
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

    def _check_times(self, bench: Bench, header: np.void, name: str) -> None:
        height, width = self.stages.gray.shape
        start, scan_us = int(header["start_time_us"]), int(header["scan_time_us"])
        # The counter has only whole microseconds: on average it is half of one behind.
        late_us = start + 0.5 - bench.start_us(self.number)
        if self.last_cycle is None:
            camera_us = ((width + BLANKING.line) * height - BLANKING.line) * PIX_NS / CLOCK_NS / CLK_PER_US
            least, most, most_late = camera_us - 1, camera_us + (7 * width + 200) / CLK_PER_US, 1.0
        else:
            scanned_us = bench.time_us(self.last_cycle) - start
            # A first pixel may find others waiting before it, but not for half a frame.
            least, most, most_late = scanned_us - 1.5, scanned_us + 1.5, width * height / 2 / CLK_PER_US
        assert -1 <= late_us <= most_late, f"{name}: start_time_us {start}, {late_us:.1f} too late; {where()}"
        assert least < scan_us < most, f"{name}: scan_time_us {scan_us}, not {least:.1f} to {most:.1f}; {where()}"


def boxes(rng: Random, width: int, height: int, count: int) -> np.ndarray:
    """Return RGB with so many dark boxes of their own on a bright ground, at most one for 8 x 8 pixels."""
    rgb = np.full((height, width, 3), 200, np.uint8)
    places = [(x, y) for y in range(0, height - 7, 8) for x in range(0, width - 7, 8)]
    for x, y in rng.sample(places, count):
        rgb[y : y + rng.randint(6, 7), x : x + rng.randint(6, 7)] = 20
    return rgb


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

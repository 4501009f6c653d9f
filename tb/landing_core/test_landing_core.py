# SPDX-License-Identifier: Apache-2.0
"""landing_core through its ports, against the golden chain; every stream between its cores is watched.

sim/test_stages.py compares the streams themselves, and frames of full size.
"""

from dataclasses import replace

import cocotb
import numpy as np
from cocotb.handle import HierarchyObject
from cocotb.triggers import ClockCycles, RisingEdge
from cocotb.utils import get_sim_time
from cocotbext.axi import AxiResp

from golden.generated import landing_regs as regs
from tb.common.figures import page_figures
from tb.common.run import parameter, where
from tb.common.stream import CLOCK_NS, split_frames
from tb.landing_core.tb_landing_core import (
    BLANKING,
    CLK_PER_US,
    MAX_HEIGHT,
    MAX_OBJECTS,
    MAX_WIDTH,
    PIX_NS,
    Bench,
    Expected,
    boxes,
    lines_of,
    picture,
)
from tb.video_in.tb_video_in import FAULTS, Raw, model, spoil

LIMIT_US = 5000  # of simulated time; no test comes near
WIDE = MAX_WIDTH > 128  # the build with two windows, for what needs them
SMALLEST = MAX_WIDTH == 16  # the build for what takes many milliseconds

# How many times a frame takes the memory sleeps (a whole frame and parts of two others, or more), the greatest number
# of shapes a frame, its size, whether that must cost frames: what waits fits into the queue of ccl, stalls ccl within a
# frame, or fills that queue with trailers alone.
SLEEPS = {
    "one_frame": (2, 6, (MAX_WIDTH, MAX_HEIGHT), False),
    "several_frames": (4, 30, (MAX_WIDTH, MAX_HEIGHT), True),
    "many_empty_frames": (34, 0, (16, 16), True),
}
# The range of clocks until memory answers, and how often it lets the writer wait.
WEATHER = {"calm": ((1, 1), 0.0), "stormy": ((1, 60), 0.3)}


def weather_bench(dut: HierarchyObject, weather: str) -> Bench:
    """Return a bench with that weather at its memory."""
    bench = Bench(dut)
    bench.memory.latency, waits = WEATHER[weather]
    bench.memory.stall(waits)
    return bench


@cocotb.test(timeout_time=LIMIT_US, timeout_unit="us", skip=WIDE or SMALLEST)
async def registers_tell_what_was_built(dut: HierarchyObject) -> None:
    bench = Bench(dut)
    await bench.reset()
    assert await bench.read(regs.ID_OFFSET) == regs.REGISTERS[0].fields[0].reset
    info = await bench.read(regs.RING_INFO_OFFSET)
    assert info == MAX_OBJECTS << regs.RING_INFO_MAX_OBJECTS_SHIFT | regs.RING_BUFFERS
    features = parameter("HAS_DISPLAY", 0) << regs.FEATURES_DISPLAY_SHIFT
    assert await bench.read(regs.FEATURES_OFFSET) == features, f"FEATURES is not {features}; {where()}"
    times_ns = [get_sim_time("ns")]
    first = await bench.read(regs.TIME_LO_OFFSET)
    times_ns.append(get_sim_time("ns"))
    await ClockCycles(dut.clk, 50 * CLK_PER_US)
    times_ns.append(get_sim_time("ns"))
    second = await bench.read(regs.TIME_LO_OFFSET)
    times_ns.append(get_sim_time("ns"))
    before, after, before_next, after_next = (time_ns / (CLOCK_NS * CLK_PER_US) for time_ns in times_ns)
    least, most = before_next - after - 1, after_next - before + 1
    assert least < second - first < most, f"time went on by {second - first}, not {least} to {most}; {where()}"


@cocotb.test(timeout_time=LIMIT_US, timeout_unit="us", skip=WIDE or SMALLEST)
async def registers_hold_what_is_written(dut: HierarchyObject) -> None:
    """Any value, in any order; an address beyond the registers is refused."""
    bench = Bench(dut)
    await bench.reset()
    masks = {
        regs.FRAME_SIZE_OFFSET: 0xFFFFFFFF,
        regs.THRESHOLD_OFFSET: regs.THRESHOLD_FACTOR_MASK | regs.THRESHOLD_FLAT_LIMIT_MASK,
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


@cocotb.test(timeout_time=LIMIT_US, timeout_unit="us", skip=WIDE or SMALLEST)
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


@cocotb.test(timeout_time=LIMIT_US, timeout_unit="us", skip=WIDE or SMALLEST)
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


@cocotb.test(timeout_time=LIMIT_US, timeout_unit="us", skip=WIDE or SMALLEST)
async def frames_become_records(dut: HierarchyObject) -> None:
    """More frames than the ring has buffers, with a memory that answers late and unevenly."""
    bench = weather_bench(dut, "stormy")
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


@cocotb.test(timeout_time=LIMIT_US, timeout_unit="us", skip=WIDE or SMALLEST)
@cocotb.parametrize(sleep=list(SLEEPS))
async def each_record_tells_of_its_own_frame(dut: HierarchyObject, sleep: str) -> None:
    """The memory takes nothing for some frames: those that got through are told of rightly, the others are counted."""
    asleep, shapes, size, drops = SLEEPS[sleep]
    bench = Bench(dut)
    await bench.reset()
    # To the thresholds an even ground is one dark shape.
    settings = bench.settings if shapes else replace(bench.settings, min_area=size[0] * size[1] + 1)
    await bench.configure(settings, size)
    rgbs = [boxes(bench.rng, *size, bench.rng.randint(shapes // 2, shapes)) for _ in range(asleep + 4)]
    raw = Raw()
    for rgb in rgbs:
        raw.frame(lines_of(rgb), BLANKING)
    raw.blank(2)
    frame_clocks = round(len(raw.data) / len(rgbs) * PIX_NS / CLOCK_NS)
    camera = cocotb.start_soon(bench.play(raw))
    # It falls asleep at any time of the second frame.
    await ClockCycles(dut.clk, frame_clocks + bench.rng.randrange(frame_clocks))
    bench.memory.stall(1.0)
    await ClockCycles(dut.clk, asleep * frame_clocks)
    bench.memory.stall(0.0)
    await camera
    await bench.settle()

    seen = await bench.read(regs.FRAMES_SEEN_OFFSET)
    assert seen == len(rgbs), f"FRAMES_SEEN {seen}, expected {len(rgbs)}; {where()}"
    dropped = await bench.read(regs.FRAMES_OVERFLOW_OFFSET)
    assert (dropped > 0) == drops, f"{dropped} frames were dropped; {where()}"
    numbers = [record.number for record in bench.records]
    assert numbers == sorted(set(numbers)), f"records of the frames {numbers}; {where()}"
    assert len(numbers) == seen - dropped, f"records of the frames {numbers} of {seen}, {dropped} dropped; {where()}"
    assert numbers[-1] == seen, f"the newest record is of frame {numbers[-1]}, expected {seen}; {where()}"
    # Frames that end too early for ccl count as dropped, and leave no record.
    frames = [beats for beats in split_frames(bench.monitors["dilated"].taken) if len(beats) == size[0] * size[1]]
    published: list[Expected] = []
    for index, (record, beats) in enumerate(zip(bench.records, frames, strict=True)):
        before = published[-1] if published else None
        stale = before is not None and before.number != record.number - 1
        expected = Expected(record.number, rgbs[record.number - 1], before, bench.settings, stale=stale)
        expected.waited(beats[-1].cycle, least_overflow=record.number - 1 - index, most_overflow=dropped)
        expected.check(bench, record)
        published.append(expected)
    await bench.check_ring(published, unwritten=bench.invalidated() - len(published))


@cocotb.test(timeout_time=LIMIT_US, timeout_unit="us", skip=WIDE or SMALLEST)
async def next_frame_begins_while_one_is_labelled(dut: HierarchyObject) -> None:
    """With a line of blanking a frame begins before the last lines of the one before have left the filters."""
    bench = Bench(dut)
    size = (16, 16)
    await bench.reset()
    await bench.configure(bench.settings, size)
    rgbs = [picture(bench.rng, *size) for _ in range(8)]
    raw = Raw()
    for rgb in rgbs:
        raw.frame(lines_of(rgb), replace(BLANKING, front=6, sync=4, back=6))
    raw.blank(2)
    await bench.play(raw)
    await bench.settle()
    assert await bench.read(regs.FRAMES_OVERFLOW_OFFSET) == 0, f"a frame overflowed; {where()}"
    numbers = [record.number for record in bench.records]
    assert numbers == list(range(1, len(rgbs) + 1)), f"records of the frames {numbers}, expected all 8; {where()}"
    frames = split_frames(bench.monitors["dilated"].taken)
    published: list[Expected] = []
    for record, rgb, beats in zip(bench.records, rgbs, frames, strict=True):
        expected = Expected(record.number, rgb, published[-1] if published else None, bench.settings)
        expected.waited(beats[-1].cycle, least_overflow=0, most_overflow=0)
        expected.check(bench, record)
        published.append(expected)


@cocotb.test(timeout_time=LIMIT_US, timeout_unit="us", skip=WIDE or SMALLEST)
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
            flat_limit=bench.rng.randrange(256),
            min_area=bench.rng.choice((0, 5000)),
            dark_is_one=not settings.dark_is_one,
            label_zeros=bench.rng.random() < 0.5,
        )
        await bench.configure(change, sizes[number % len(sizes)])
        await frame
        await bench.settle()
        await bench.check_ring(published)


@cocotb.test(timeout_time=LIMIT_US, timeout_unit="us", skip=not WIDE)
async def flat_windows_follow_their_neighbour(dut: HierarchyObject) -> None:
    """A faint shape in a window of its own is seen or not, as the limit says that counts from the next frame on."""
    bench = Bench(dut)
    await bench.reset()
    width, height = bench.size
    settings = replace(bench.settings, min_area=5)
    published: list[Expected] = []
    found = []
    for number, limit in enumerate((0, 16, 0, 60, 60, 0), 1):
        settings = replace(settings, flat_limit=limit)
        await bench.configure(settings, bench.size)
        rgb = picture(bench.rng, width, height)
        rgb[:, 128:] = 120
        rgb[3 : height - 3, 132 : width - 3] = 120 - bench.rng.randint(8, 14)
        expected = Expected(number, rgb, published[-1] if published else None, settings)
        published.append(expected)
        found.append(any(int(one["box_min_x"]) >= 128 for one in expected.stages.objects))
        raw = Raw()
        raw.frame(lines_of(rgb), BLANKING)
        raw.blank(2)
        await bench.play(raw)
        await bench.settle()
        await bench.check_ring(published)
    assert any(found) and not all(found[1:]), f"the limit makes no difference: {found}; {where()}"


@cocotb.test(timeout_time=LIMIT_US, timeout_unit="us", skip=WIDE or SMALLEST)
async def malformed_frames_leave_no_record(dut: HierarchyObject) -> None:
    """A malformed frame of each kind between whole ones: no record of it, the next one right, its thresholds stale."""
    bench = Bench(dut)
    await bench.reset()
    width, height = bench.size = (MAX_WIDTH, 24)
    await bench.configure(bench.settings, bench.size)
    raw = Raw()
    faults = [None, *(kind for fault in bench.rng.sample(FAULTS, len(FAULTS)) for kind in (fault, None))]
    pictures = [picture(bench.rng, width, height) for _ in faults]
    for fault, rgb in zip(faults, pictures, strict=True):
        lines = lines_of(rgb)
        raw.frame(spoil(bench.rng, lines, fault) if fault else lines, BLANKING)
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
    assert bench.frame_errors, f"no core told of a frame that was cut off; {where()}"
    await bench.check_ring(published, unwritten=bench.invalidated() - len(published))


@cocotb.test(timeout_time=LIMIT_US, timeout_unit="us", skip=WIDE or SMALLEST)
@cocotb.parametrize(weather=list(WEATHER))
async def write_errors_cost_one_frame(dut: HierarchyObject, weather: str) -> None:
    bench = weather_bench(dut, weather)
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


@cocotb.test(timeout_time=LIMIT_US, timeout_unit="us", skip=WIDE or SMALLEST)
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


@cocotb.test(timeout_time=LIMIT_US, timeout_unit="us", skip=not SMALLEST)
async def lidar_faults_interrupt(dut: HierarchyObject) -> None:
    """A sensor that says nothing is a fault, one that is switched off is none, one that gives only glitches is."""
    bench = Bench(dut, watched=False)
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


@cocotb.test(timeout_time=LIMIT_US, timeout_unit="us", skip=WIDE or SMALLEST)
@cocotb.parametrize(weather=list(WEATHER))
async def reset_in_mid_frame_forgets_everything(dut: HierarchyObject, weather: str) -> None:
    bench = weather_bench(dut, weather)
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
        assert not bench.frame_errors, f"a core told of a frame from before the reset; {where()}"


@cocotb.test(timeout_time=LIMIT_US, timeout_unit="us", skip=WIDE or SMALLEST)
async def latency_is_as_documented(dut: HierarchyObject) -> None:
    """From the last pixel at the pins to the interrupt: a frame without an object, then one with one."""
    _, lines, least, most, an_object, memory_clocks = page_figures("landing_core")
    bench = Bench(dut)
    bench.memory.latency = (memory_clocks, memory_clocks)
    await bench.reset()
    rgb = np.full((MAX_HEIGHT, MAX_WIDTH, 3), 200, np.uint8)
    for objects in (0, 1):
        raw = Raw()
        raw.frame(lines_of(rgb), BLANKING)
        raw.blank(2)
        await bench.play(raw)
        while not int(dut.irq.value):
            await RisingEdge(dut.clk)
        clocks = (get_sim_time("ns") - bench.last_pixel_ns) / CLOCK_NS - lines * MAX_WIDTH - objects * an_object
        told = int(np.frombuffer(bench.records[-1].data, regs.HEADER_DTYPE, 1)[0]["object_count"])
        assert told == objects, f"the record tells of {told} objects, expected {objects}; {where()}"
        assert least <= clocks <= most, f"{lines} lines and {clocks} clocks to the interrupt; {where()}"
        await bench.write(regs.IRQ_STATUS_OFFSET, regs.IRQ_STATUS_FRAME_DONE_MASK)
        await ClockCycles(dut.clk, 20)

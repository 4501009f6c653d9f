# SPDX-License-Identifier: Apache-2.0
"""result_writer against `golden.result_writer`, with a memory that delays, reorders and fails writes."""

from collections import deque
from collections.abc import Callable
from itertools import pairwise
from random import Random, getrandbits

import cocotb
import numpy as np
from cocotb.clock import Clock
from cocotb.handle import HierarchyObject
from cocotb.triggers import RisingEdge

from golden.generated.landing_regs import HEADER_DTYPE, OBJECT_DTYPE, RING_BUFFERS, RING_STRIDE_BYTES
from golden.result_writer import Frame, Published, record, run
from tb.common.axi_memory import AxiMemory, Burst
from tb.common.run import parameter, where
from tb.common.stream import CLOCK_NS, Beat, PulseCounter, StreamMonitor, StreamSource, stalls

MAX_OBJECTS = parameter("MAX_OBJECTS", 256)
MAX_OUTSTANDING = parameter("MAX_OUTSTANDING", 8)
NUMBER_STEP = 0x9E37_79B1  # from frame to frame every bit of the number changes; odd, so no number comes twice
FRAME_NUMBER_OFFSET = 56
LIMIT_US = 2000  # of simulated time; no test comes near
HEADER_LEN = 6  # awlen of the 56 bytes before it

# Port, bits, member of the header; grouped by when the writer samples them.
AT_TRAILER = (
    ("frame_number", 32, "frame_number"),
    ("frame_start_us", 64, "start_time_us"),
    ("frame_width", 16, "frame_size_width"),
    ("frame_height", 16, "frame_size_height"),
    ("threshold_factor", 9, "threshold_factor"),
    ("min_area", 32, "min_area"),
    ("thresholds_missing", 1, "thresholds_missing"),
    ("thresholds_stale", 1, "thresholds_stale"),
    ("scan_time_us", 32, "scan_time_us"),
)
AT_HEADER = (
    ("altitude_mm", 32, "altitude_mm"),
    ("altitude_age_us", 32, "altitude_age_us"),
    ("altitude_valid", 1, "altitude_valid"),
    ("frames_malformed", 32, "frames_malformed"),
    ("frames_overflow", 32, "frames_overflow"),
)
ALL_PORTS = AT_TRAILER + AT_HEADER

# (idle fraction of the objects, stalled fraction of AW and W, latency range of the responses)
WEATHER = {
    "fast": (0.0, 0.0, (1, 1)),
    "slow_memory": (0.0, 0.3, (60, 140)),
    "idle_objects": (0.6, 0.0, (1, 20)),
    "both": (0.4, 0.6, (1, 60)),
}

# Where a memory write fails: by the offset in the buffer and the data.
PLACES: dict[str, Callable[[int, Burst], bool]] = {
    "frame number 0": lambda offset, burst: offset == FRAME_NUMBER_OFFSET and not any(burst.data),
    "first object": lambda offset, _: offset == 64,
    "last object": lambda offset, _: offset == 64 + 2 * 64,
    "header": lambda offset, _: offset == 0,
    "frame number": lambda offset, burst: offset == FRAME_NUMBER_OFFSET and any(burst.data),
    "all": lambda *_: True,
}


def random_objects(rng: Random, count: int) -> np.ndarray:
    """Return `count` objects with random bytes in every member, reserved ones included."""
    return np.frombuffer(rng.randbytes(count * OBJECT_DTYPE.itemsize), OBJECT_DTYPE)


def random_frame(rng: Random, number: int, **options: bool) -> Frame:
    """Return a frame with random values and none, few, all that fit, or more objects than fit."""
    values = {member: rng.getrandbits(bits) for _, bits, member in ALL_PORTS}
    values["frame_number"] = number * NUMBER_STEP % (1 << 32)
    counts = [0, 1, rng.randint(2, 9), MAX_OBJECTS if MAX_OBJECTS < 20 else 12, MAX_OBJECTS + rng.randint(1, 3)]
    weights = [2, 2, 5, 3, 3 if MAX_OBJECTS < 20 else 0]
    count = rng.choices(counts, weights)[0]
    if not options.get("complete", True):
        count = max(count, 1)
    return Frame(values, random_objects(rng, count), **options)


class Bench:
    """The writer between a source of objects and a memory; checks the memory whenever it changes."""

    def __init__(self, dut: HierarchyObject, rng: Random) -> None:
        self.dut, self.rng = dut, rng
        dut.rst.value = 1
        self.base = rng.randrange(0, (1 << 32) - RING_BUFFERS * RING_STRIDE_BYTES, 4096)
        dut.ring_base.value = self.base | rng.getrandbits(12)
        cocotb.start_soon(Clock(dut.clk, CLOCK_NS, unit="ns").start())
        self.source = StreamSource(dut, "s_axis", dut.clk, rng)
        self.source.on_beat = self._on_beat
        self.input = StreamMonitor(dut, "s_axis", dut.clk, dut.rst)
        self.memory = AxiMemory(dut, "m_axi", dut.clk, dut.rst, rng)
        self.memory.on_change = self._check_no_torn_record
        self.errors = PulseCounter(dut.axi_error, dut.clk, dut.rst)
        self.done: list[tuple[int, int, int]] = []
        self.expected: dict[int, bytes] = {}
        self._actions: deque[Callable[[], None] | None] = deque()
        self._without_header: deque[Frame] = deque()
        self._scramble(ALL_PORTS)
        cocotb.start_soon(self._watch_done())
        cocotb.start_soon(self._watch_header())

    async def reset(self) -> None:
        """Reset the writer; the source drops what it had."""
        self.dut.rst.value = 1
        self.source.stop()
        self._actions.clear()
        self._without_header.clear()
        for _ in range(3):
            await RisingEdge(self.dut.clk)
        self.dut.rst.value = 0
        await RisingEdge(self.dut.clk)

    def offset(self, burst: Burst) -> int:
        """Return where in its buffer a burst begins."""
        return (burst.address - self.base) % RING_STRIDE_BYTES

    def weather(self, name: str) -> None:
        """Set idle cycles, stalls and latency."""
        idle, stalled, latency = WEATHER[name]
        self.source.pause = stalls(self.rng, idle)
        self.memory.stall(stalled)
        self.memory.latency = latency

    def send(self, frame: Frame) -> None:
        """Queue the beats of a frame."""
        beats = [Beat(int.from_bytes(item.tobytes(), "little")) for item in frame.objects]
        if frame.complete:
            trailer = int.from_bytes(random_objects(self.rng, 1).tobytes(), "little") & ~0xFFFFFFFF
            beats.append(Beat(trailer, last=1))
            self._without_header.append(frame)
        beats[0] = beats[0]._replace(user=1)
        for beat in beats:
            self._actions.append(lambda beat=beat: self._offer(frame, beat))
        self.source.send_beats(beats)

    def send_garbage(self, count: int) -> None:
        """Queue beats that belong to no frame."""
        self._actions.extend([None] * count)
        self.source.send_beats([Beat(self.rng.getrandbits(512), last=self.rng.getrandbits(1)) for _ in range(count)])

    def forget_unsent_headers(self) -> None:
        """Expect no header any more of the frames that were sent: the writer skips it after an error."""
        self._without_header.clear()

    async def settle(self, limit: int = 25_000) -> None:
        """Wait until everything is sent and nothing has happened for a while."""
        quiet, start = 0, self.memory.cycle
        while quiet < 400:
            await RisingEdge(self.dut.clk)
            active = not self.source.empty or str(self.dut.m_axi_awvalid.value) != "0"
            quiet = 0 if active or str(self.dut.m_axi_bvalid.value) != "0" else quiet + 1
            assert self.memory.cycle - start < limit, f"the writer is stuck after {limit} cycles; {where()}"

    def check(self, frames: list[Frame]) -> None:
        """Assert that records, counters and the last ring state are those of the golden model."""
        outcome = run(frames, MAX_OBJECTS)
        got = [(index, number) for index, number, _ in self.done]
        wanted = [(published.index, published.frame_number) for published in outcome.published]
        assert got == wanted, f"published (buffer, frame): expected {wanted}, got {got}; {where()}"
        for published in outcome.published[-RING_BUFFERS:]:
            self.compare(published)
        unwritten = int(self.dut.frames_unwritten.value)
        assert unwritten == outcome.unwritten, (
            f"frames_unwritten: expected {outcome.unwritten}, got {unwritten}; {where()}"
        )
        assert self.errors.count == outcome.errors, (
            f"axi_error pulses: expected {outcome.errors}, got {self.errors.count}; {where()}"
        )

    def compare(self, published: Published) -> None:
        """Assert that the memory holds a record, byte for byte."""
        got = self.memory.read(self.base + published.offset, len(published.data))
        if got == published.data:
            return
        at = next(i for i, (a, b) in enumerate(zip(got, published.data, strict=True)) if a != b)
        raise AssertionError(
            f"frame {published.frame_number}, buffer {published.index}: first bad byte {at} ({_member(at)}): "
            f"expected 0x{published.data[at]:02x}, got 0x{got[at]:02x}; {where()}"
        )

    def _offer(self, frame: Frame, beat: Beat) -> None:
        self._scramble(AT_TRAILER)
        if beat.last:
            self._drive(AT_TRAILER, frame)

    def _on_beat(self, _: Beat) -> None:
        action = self._actions.popleft()
        if action:
            action()

    def _drive(self, ports: tuple, frame: Frame) -> None:
        for port, _, member in ports:
            getattr(self.dut, port).value = frame.values[member]

    def _scramble(self, ports: tuple) -> None:
        for port, bits, _ in ports:
            getattr(self.dut, port).value = self.rng.getrandbits(bits)

    def _check_no_torn_record(self, address: int) -> None:
        """What a reader sees at any time: frame number 0 (or never written), or a whole record."""
        index = (address - self.base) // RING_STRIDE_BYTES
        assert 0 <= index < RING_BUFFERS, f"a write outside the ring at 0x{address:x}; {where()}"
        start = self.base + index * RING_STRIDE_BYTES
        number = int.from_bytes(self.memory.read(start + 60, 4), "little")
        if number in (0, 0xA5A5A5A5):
            return
        assert number in self.expected, f"buffer {index} names frame {number}, which is none; {where()}"
        self.compare(Published(index * RING_STRIDE_BYTES, index, number, self.expected[number]))

    async def _watch_header(self) -> None:
        """Change the values that are sampled with the header in every clock, and note which ones the header must hold.

        They are those at the clock edge that raised `awvalid` for the header.
        """
        dut, offered, sampled = self.dut, False, {}
        while True:
            await RisingEdge(dut.clk)
            was_offered, offered = offered, str(dut.m_axi_awvalid.value) == "1"
            if str(dut.rst.value) == "0" and offered and not was_offered and int(dut.m_axi_awlen.value) == HEADER_LEN:
                frame = self._without_header.popleft()
                frame.values.update(sampled)
                self.expected[frame.values["frame_number"]] = record(frame.values, frame.objects, MAX_OBJECTS)
            sampled = {member: int(getattr(dut, port).value) for port, _, member in AT_HEADER}
            self._scramble(AT_HEADER)

    async def _watch_done(self) -> None:
        dut = self.dut
        while True:
            await RisingEdge(dut.clk)
            if str(dut.rst.value) == "0" and str(dut.frame_done.value) == "1":
                index, number = int(dut.ring_head_index.value), int(dut.written_frame_number.value)
                assert int(dut.ring_head_valid.value) == 1, f"frame_done while ring_head_valid is 0; {where()}"
                self.done.append((index, number, self.memory.cycle))
                offset = index * RING_STRIDE_BYTES
                self.compare(Published(offset, index, number, self.expected.get(number, b"?")))
                self._check_number_came_last(self.base + offset)

    def _check_number_came_last(self, start: int) -> None:
        last = self.memory.bursts[-1]
        assert (last.address, last.beats) == (start + FRAME_NUMBER_OFFSET, 1), f"last burst {last}; {where()}"
        before = len(self.memory.bursts) - 1
        assert last.answered_before == before, (
            f"the frame number was sent after {last.answered_before} of {before} responses; {where()}"
        )


def _member(offset: int) -> str:
    """Name of the member of the record that a byte offset lies in."""
    dtype, name = (HEADER_DTYPE, "header") if offset < 64 else (OBJECT_DTYPE, f"object {offset // 64 - 1}")
    fields = [member for member in dtype.names if dtype.fields[member][1] <= offset % 64]
    return f"{name}.{fields[-1]}"


@cocotb.test(timeout_time=LIMIT_US, timeout_unit="us")
@cocotb.parametrize(weather=list(WEATHER))
async def frames_in_order(dut: HierarchyObject, weather: str) -> None:
    """Back-to-back frames of all kinds, more than the ring holds."""
    bench = Bench(dut, Random(getrandbits(32)))
    await bench.reset()
    bench.weather(weather)
    frames = [random_frame(bench.rng, number) for number in range(1, 12)]
    for frame in frames:
        bench.send(frame)
    await bench.settle()
    bench.check(frames)


@cocotb.test(timeout_time=LIMIT_US, timeout_unit="us")
async def fullest_frame(dut: HierarchyObject) -> None:
    """Exactly as many objects as fit, then one more, then none."""
    bench = Bench(dut, Random(getrandbits(32)))
    await bench.reset()
    bench.weather("fast")
    frames = []
    for number, count in enumerate((MAX_OBJECTS, MAX_OBJECTS + 1, 0), 1):
        frames.append(Frame(random_frame(bench.rng, number).values, random_objects(bench.rng, count)))
        bench.send(frames[-1])
    await bench.settle()
    bench.check(frames)


@cocotb.test(timeout_time=LIMIT_US, timeout_unit="us")
@cocotb.parametrize(weather=list(WEATHER))
async def cut_off_frames(dut: HierarchyObject, weather: str) -> None:
    """A first beat before the trailer abandons the frame; the next one is whole and takes the same buffer."""
    bench = Bench(dut, Random(getrandbits(32)))
    await bench.reset()
    bench.weather(weather)
    frames = [random_frame(bench.rng, number, complete=bench.rng.random() < 0.5) for number in range(1, 12)]
    frames[3:5] = [random_frame(bench.rng, number, complete=False) for number in (4, 5)]
    frames.append(random_frame(bench.rng, 12))
    for frame in frames:
        bench.send(frame)
    await bench.settle()
    bench.check(frames)


@cocotb.test(timeout_time=LIMIT_US, timeout_unit="us")
@cocotb.parametrize(place=list(PLACES))
async def write_errors(dut: HierarchyObject, place: str) -> None:
    """A write error anywhere in a frame: no record, one pulse, one count; the next frame is whole."""
    bench = Bench(dut, Random(getrandbits(32)))
    await bench.reset()
    bench.weather("both")
    frames = []
    for number in range(1, 9):
        bad = number % 3 == 0
        frame = Frame(random_frame(bench.rng, number).values, random_objects(bench.rng, 3), write_error=bad)
        frames.append(frame)
        fails = PLACES[place] if bad else lambda *_: False
        bench.memory.fails = lambda burst, fails=fails: fails(bench.offset(burst), burst)
        bench.send(frame)
        await bench.settle()
        bench.forget_unsent_headers()
    bench.check(frames)


@cocotb.test(timeout_time=LIMIT_US, timeout_unit="us")
async def error_in_cut_off_frame(dut: HierarchyObject) -> None:
    """A frame that fails and is cut off counts once, pulses once, and does not spoil the next one."""
    bench = Bench(dut, Random(getrandbits(32)))
    await bench.reset()
    bench.weather("slow_memory")
    rng = bench.rng
    frames = [
        Frame(random_frame(rng, 1).values, random_objects(rng, 3), complete=False, write_error=True),
        random_frame(rng, 2),
    ]
    bench.memory.fails = lambda burst: burst.number == 1
    for frame in frames:
        bench.send(frame)
    await bench.settle()
    bench.check(frames)


@cocotb.test(timeout_time=LIMIT_US, timeout_unit="us")
async def beats_without_a_frame(dut: HierarchyObject) -> None:
    """Beats before the first first beat, and between trailer and first beat, are dropped."""
    bench = Bench(dut, Random(getrandbits(32)))
    await bench.reset()
    bench.weather("both")
    frames = [random_frame(bench.rng, number) for number in (1, 2)]
    for frame in frames:
        bench.send_garbage(bench.rng.randint(1, 5))
        bench.send(frame)
    await bench.settle()
    bench.check(frames)


@cocotb.test(timeout_time=LIMIT_US, timeout_unit="us")
@cocotb.parametrize(weather=list(WEATHER))
async def reset_in_mid_frame(dut: HierarchyObject, weather: str) -> None:
    """After a system reset the ring starts at buffer 0 and the next frame is whole."""
    bench = Bench(dut, Random(getrandbits(32)))
    await bench.reset()
    bench.weather(weather)
    for _ in range(4):
        bench.send(Frame(random_frame(bench.rng, 77).values, random_objects(bench.rng, 4)))
        for _ in range(bench.rng.randint(1, 600)):
            await RisingEdge(dut.clk)
        await bench.reset()
        bench.done.clear()
        assert int(dut.ring_head_valid.value) == 0, f"ring_head_valid is 1 after reset; {where()}"
    frames = [random_frame(bench.rng, number) for number in (78, 79)]
    for frame in frames:
        bench.send(frame)
    await bench.settle()
    bench.check(frames)


async def _note_transfers(bench: Bench, cycles: dict[str, list[int]]) -> None:
    """Note the clock edges at which addresses, last beats and responses are handed over."""
    dut = bench.dut
    channels = {
        "address": (dut.m_axi_awvalid, dut.m_axi_awready),
        "data": (dut.m_axi_wvalid, dut.m_axi_wready, dut.m_axi_wlast),
        "response": (dut.m_axi_bvalid, dut.m_axi_bready),
    }
    while True:
        await RisingEdge(dut.clk)
        for name, signals in channels.items():
            if all(int(signal.value) for signal in signals):
                cycles[name].append(bench.memory.cycle)


@cocotb.test(timeout_time=LIMIT_US, timeout_unit="us", skip=MAX_OUTSTANDING < 8)
@cocotb.parametrize(latency=[1, 30, 60])
async def documented_speed(dut: HierarchyObject, latency: int) -> None:
    """The latencies and the throughput of the header comment; a round trip is from the last beat to the response."""
    bench = Bench(dut, Random(getrandbits(32)))
    await bench.reset()
    bench.memory.latency = (latency, latency)
    cycles: dict[str, list[int]] = {"address": [], "data": [], "response": []}
    cocotb.start_soon(_note_transfers(bench, cycles))
    bench.send(Frame(random_frame(bench.rng, 1).values, random_objects(bench.rng, 40)))
    await bench.settle()
    trips = [back - out for out, back in zip(cycles["data"], cycles["response"], strict=True)]
    measured = {
        "first beat to first object": cycles["address"][1] - bench.input.taken[0].cycle - trips[0],
        "trailer to frame_done": bench.done[0][2] - bench.input.taken[-1].cycle - trips[-2] - trips[-1],
        "object to object": {after - before for before, after in pairwise(cycles["address"][1:41])},
        "object to address": cycles["address"][5] - bench.input.taken[4].cycle,
    }
    expected = {
        "first beat to first object": 4,
        "trailer to frame_done": 12,
        "object to object": {9},
        "object to address": 1,
    }
    assert measured == expected, f"clocks: expected {expected}, got {measured}; {where()}"

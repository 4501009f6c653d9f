# SPDX-License-Identifier: Apache-2.0
"""lidar_pwm against `golden.lidar_pwm`: measured pulses, glitches and every fault of a sensor or its cable."""

from collections.abc import Sequence
from random import Random, getrandbits

import cocotb
from cocotb.clock import Clock
from cocotb.handle import HierarchyObject
from cocotb.triggers import RisingEdge, Timer, ValueChange
from cocotb.utils import get_sim_time

from golden.lidar_pwm import Event, Limits, events
from tb.common.figures import page_figures
from tb.common.run import parameter, where
from tb.common.stream import CLOCK_NS

CLOCKS_PER_US = 4  # microseconds of the test are short, to save simulation time
US_NS = CLOCKS_PER_US * CLOCK_NS
FILTER_CYCLES = parameter("FILTER_CYCLES", 100)
FILTER_US = FILTER_CYCLES / CLOCKS_PER_US
LIMITS = Limits(
    parameter("MIN_MM", 50),
    parameter("MAX_MM", 40000),
    parameter("MAX_AGE_US", 60000),
    parameter("START_TIMEOUT_US", 18000),
    parameter("RELEASE_US", 1000),
)
LATENCY_CLOCKS = FILTER_CYCLES + page_figures("lidar_pwm")[0]
STATUS = ("timeout", "too_long", "too_short")
LIMIT_US = 1000 + 20 * LIMITS.max_mm * US_NS // 1000  # of simulated time; no test comes near
NEVER = 0xFFFFFFFF


class Bench:
    """Clock, microsecond tick and pin; records what is reported."""

    def __init__(self, dut: HierarchyObject, rng: Random) -> None:
        self.dut, self.rng = dut, rng
        self.reported: list[Event] = []
        self.start_ns = 0.0
        for port in (dut.enable, dut.lidar_in, dut.tick_us):
            port.value = 0
        dut.rst.value = 1

    async def start(self, pin: int = 0) -> None:
        """Start the clock and the tick, reset the core, leave it disabled."""
        self.dut.lidar_in.value = pin
        cocotb.start_soon(Clock(self.dut.clk, CLOCK_NS, unit="ns").start(start_high=False))
        await RisingEdge(self.dut.clk)
        await Timer(1, "ns")
        cocotb.start_soon(Clock(self.dut.tick_us, US_NS, unit="ns", period_high=CLOCK_NS).start())
        await Timer(3 * CLOCK_NS, "ns")
        self.dut.rst.value = 0
        cocotb.start_soon(self._watch_readings())
        for name in STATUS:
            cocotb.start_soon(self._watch_status(name))
        cocotb.start_soon(self._watch_valid())

    async def enable(self) -> None:
        """Start measuring; microseconds count from here."""
        self.dut.enable.value = 1
        self.start_ns = get_sim_time("ns")

    async def wait_us(self, microseconds: float) -> None:
        """Wait."""
        if microseconds > 0:
            await Timer(round(microseconds * US_NS * 1000), "ps")

    async def until_us(self, time: float) -> None:
        """Wait until `time` microseconds after `enable`."""
        await self.wait_us(time - self.now_us())

    def now_us(self) -> float:
        """Return microseconds since `enable`."""
        return (get_sim_time("ns") - self.start_ns) / US_NS

    async def pulse(self, width_us: float, gap_us: float = 0) -> None:
        """Wait `gap_us`, then drive the pin high for `width_us`."""
        await self.wait_us(gap_us)
        self.dut.lidar_in.value = 1
        await self.wait_us(width_us)
        self.dut.lidar_in.value = 0

    async def play(self, high: Sequence[tuple[float, float]], end_us: float) -> None:
        """Drive the pin high in the given intervals after `enable`."""
        for start, end in high:
            await self.until_us(start)
            self.dut.lidar_in.value = 1
            await self.until_us(end)
            self.dut.lidar_in.value = 0
        await self.until_us(end_us)

    async def settle(self) -> None:
        """Wait until an edge at the pin has had its effect."""
        await self.wait_us(FILTER_US + 4)

    def status(self) -> str:
        """Return the one status bit that is set, or "ok"."""
        bits = [name for name in STATUS if int(getattr(self.dut, name).value)]
        assert len(bits) <= 1, f"status bits {bits} are set together; {where()}"
        return bits[0] if bits else "ok"

    def expect(self, status: str, valid: int, what: str) -> None:
        """Assert status and valid."""
        got = (self.status(), int(self.dut.valid.value))
        assert got == (status, valid), f"{what}: expected (status, valid) {(status, valid)}, got {got}; {where()}"

    def expect_reading(self, width_us: float, count: int, tolerance: float = 0) -> None:
        """Assert the number of readings so far and the last distance."""
        readings = [event for event in self.reported if event.kind == "reading"]
        assert len(readings) == count, f"expected {count} readings, got {readings}; {where()}"
        distance = int(self.dut.distance_mm.value)
        assert abs(distance - width_us) <= tolerance, f"distance: expected {width_us}, got {distance}; {where()}"

    async def _watch_readings(self) -> None:
        while True:
            await RisingEdge(self.dut.updated)
            await Timer(1, "ns")
            # A clock without `updated` lies between two readings, so this is one clock long.
            self.reported.append(Event("reading", self.now_us(), int(self.dut.distance_mm.value)))
            assert int(self.dut.age_us.value) == 0, f"age_us is not 0 with a new reading; {where()}"
            await Timer(CLOCK_NS, "ns")
            assert int(self.dut.updated.value) == 0, f"updated is longer than one clock; {where()}"

    async def _watch_status(self, name: str) -> None:
        while True:
            await RisingEdge(getattr(self.dut, name))
            self.reported.append(Event(name, self.now_us()))

    async def _watch_valid(self) -> None:
        while True:
            await ValueChange(self.dut.valid)
            await Timer(1, "ns")
            age = int(self.dut.age_us.value)
            if int(self.dut.valid.value):
                assert age == 0, f"valid rose at age {age}; {where()}"
            elif int(self.dut.enable.value) and not int(self.dut.rst.value):
                wanted = LIMITS.max_age_us + 1
                assert age == wanted, f"valid fell at age {age}, expected {wanted}; {where()}"


def compare(bench: Bench, expected: list[Event]) -> None:
    """Assert that all was reported, in order and in time; repetitions of a fault show no new edge."""
    wanted: list[Event] = []
    for event in expected:
        if event.kind == "reading" or not wanted or wanted[-1].kind != event.kind:
            wanted.append(event)
    got = bench.reported
    for index, (want, have) in enumerate(zip(wanted, got, strict=False)):
        delay = have.time_us - want.time_us
        good = want.kind == have.kind and abs(want.distance_mm - have.distance_mm) <= 1
        assert good and -1 <= delay <= FILTER_US + 4, f"event {index}: expected {want}, got {have}; {where()}"
    assert len(wanted) == len(got), f"expected {len(wanted)} events, got {len(got)}: {got}; {where()}"


def long_gap() -> float:
    """Return a pause that is surely a timeout."""
    return LIMITS.start_timeout_us + LIMITS.release_us / 2


@cocotb.test(timeout_time=LIMIT_US, timeout_unit="us")
async def measures_whole_microseconds_exactly(dut: HierarchyObject) -> None:
    """Pulses of a whole number of microseconds, from the shortest to the longest, at every phase of the tick."""
    bench = Bench(dut, Random(getrandbits(32)))
    await bench.start()
    assert int(dut.age_us.value) == NEVER, f"age_us before any reading: {int(dut.age_us.value)}; {where()}"
    await bench.enable()
    await bench.settle()
    # Each pulse begins one clock later within the microsecond than the one before.
    widths = [width for width in (LIMITS.min_mm, 123) for _ in range(CLOCKS_PER_US)]
    widths += [LIMITS.max_mm] * (CLOCKS_PER_US if LIMITS.max_mm < 1000 else 1)
    for count, width in enumerate(widths, 1):
        await bench.pulse(width, gap_us=LIMITS.min_mm + FILTER_US + 1 / CLOCKS_PER_US)
        await bench.settle()
        bench.expect_reading(width, count)
        bench.expect("ok", 1, f"after {width} us")


@cocotb.test(timeout_time=LIMIT_US, timeout_unit="us")
async def rejects_pulses_out_of_range(dut: HierarchyObject) -> None:
    """One microsecond beyond either limit is no reading and leaves the last one in place."""
    bench = Bench(dut, Random(getrandbits(32)))
    await bench.start()
    await bench.enable()
    await bench.settle()
    await bench.pulse(100, gap_us=2 * FILTER_US)
    await bench.pulse(LIMITS.min_mm - 1, gap_us=2 * FILTER_US)
    await bench.settle()
    bench.expect_reading(100, 1)
    bench.expect("too_short", 1, "one us too short")
    await bench.pulse(LIMITS.max_mm + 1, gap_us=2 * FILTER_US)
    await bench.settle()
    bench.expect_reading(100, 1)
    bench.expect("too_long", 1, "one us too long")


@cocotb.test(timeout_time=LIMIT_US, timeout_unit="us")
async def asynchronous_edges(dut: HierarchyObject) -> None:
    """Edges at any time within a clock: the error stays below a millimetre plus the sampling of a clock."""
    bench = Bench(dut, Random(getrandbits(32)))
    await bench.start()
    await bench.enable()
    await bench.settle()
    for count in range(1, 30):
        width = bench.rng.uniform(LIMITS.min_mm + 2, 3 * LIMITS.min_mm)
        await bench.pulse(width, gap_us=FILTER_US + bench.rng.uniform(5, 20))
        await bench.settle()
        bench.expect_reading(width, count, tolerance=1 + 1 / CLOCKS_PER_US)


@cocotb.test(timeout_time=LIMIT_US, timeout_unit="us")
async def latency(dut: HierarchyObject) -> None:
    """An edge acts as many clocks later as documented."""
    bench = Bench(dut, Random(getrandbits(32)))
    await bench.start()
    await bench.enable()
    await bench.settle()
    await bench.pulse(100, gap_us=FILTER_US)
    clocks = 0
    while not int(dut.updated.value):
        await RisingEdge(dut.clk)
        await Timer(1, "ns")
        clocks += 1
    assert clocks == LATENCY_CLOCKS, f"latency: expected {LATENCY_CLOCKS} clocks, got {clocks}; {where()}"


@cocotb.test(timeout_time=LIMIT_US, timeout_unit="us")
async def glitches(dut: HierarchyObject) -> None:
    """Levels shorter than the filter change nothing: within a pulse, between pulses, in bursts."""
    bench = Bench(dut, Random(getrandbits(32)))
    await bench.start()
    await bench.enable()
    await bench.settle()
    for count in range(1, 6):
        await bench.wait_us(FILTER_US + 5)
        for level in (0, 1):
            dut.lidar_in.value = level
            await bench.wait_us(FILTER_US + 5)
            for _ in range(4):
                dut.lidar_in.value = 1 - level
                await Timer(bench.rng.randint(1, FILTER_CYCLES - 1) * CLOCK_NS, "ns")
                dut.lidar_in.value = level
                await bench.wait_us(FILTER_US + 5)
            if level == 0:
                begin = get_sim_time("ns")
        width = (get_sim_time("ns") - begin) / US_NS
        dut.lidar_in.value = 0
        await bench.settle()
        bench.expect_reading(width, count, tolerance=1)
        bench.expect("ok", 1, "glitches")


@cocotb.test(timeout_time=LIMIT_US, timeout_unit="us")
@cocotb.parametrize(how=["enable", "reset"])
async def pulse_under_way(dut: HierarchyObject, how: str) -> None:
    """A pulse whose start was not seen is not used; the next one is."""
    bench = Bench(dut, Random(getrandbits(32)))
    if how == "reset":
        dut.enable.value = 1
        await bench.start(pin=1)
    else:
        await bench.start(pin=1)
        await bench.wait_us(2 * FILTER_US)
    await bench.enable()
    await bench.wait_us(LIMITS.min_mm + 40)
    dut.lidar_in.value = 0
    await bench.settle()
    bench.expect_reading(0, 0)
    bench.expect("ok", 0, "pulse under way")
    await bench.pulse(100, gap_us=FILTER_US)
    await bench.settle()
    bench.expect_reading(100, 1)
    bench.expect("ok", 1, "the pulse after")


@cocotb.test(timeout_time=LIMIT_US, timeout_unit="us")
async def disabled_in_mid_pulse(dut: HierarchyObject) -> None:
    """Disabling drops valid and the pulse under way, releases the pin, and keeps distance and age."""
    bench = Bench(dut, Random(getrandbits(32)))
    await bench.start()
    await bench.enable()
    await bench.settle()
    await bench.pulse(100, gap_us=FILTER_US)
    await bench.settle()
    dut.lidar_in.value = 1
    await bench.wait_us(LIMITS.min_mm)
    dut.enable.value = 0
    await bench.wait_us(2)
    bench.expect("ok", 0, "disabled")
    assert int(dut.lidar_drive_low.value) == 0, f"the pin is pulled low while disabled; {where()}"
    dut.enable.value = 1
    await bench.wait_us(LIMITS.min_mm)
    assert int(dut.lidar_drive_low.value) == 1, f"the pin is not pulled low while enabled; {where()}"
    dut.lidar_in.value = 0
    await bench.settle()
    bench.expect_reading(100, 1)
    bench.expect("ok", 0, "enabled again")


@cocotb.test(timeout_time=LIMIT_US, timeout_unit="us")
@cocotb.parametrize(level=[0, 1])
async def stuck_pin(dut: HierarchyObject, level: int) -> None:
    """A stuck pin is reported as soon as the header says, valid falls, the pin is triggered again, readings return."""
    bench = Bench(dut, Random(getrandbits(32)))
    await bench.start()
    await bench.enable()
    await bench.settle()
    await bench.pulse(100, gap_us=FILTER_US)
    dut.lidar_in.value = 0
    await bench.wait_us(FILTER_US + 10)
    dut.lidar_in.value = level
    stuck_at = bench.now_us()
    kind = "too_long" if level else "timeout"
    released = cocotb.start_soon(_released_us(bench))
    await bench.wait_us(LIMITS.max_age_us + FILTER_US)
    bench.expect(kind, 0, f"stuck at {level}")
    seen = next(event for event in bench.reported if event.kind == kind)
    within = (LIMITS.max_mm if level else LIMITS.start_timeout_us) + LIMITS.release_us + 3
    delay = seen.time_us - stuck_at
    assert delay < within, f"reported after {delay} us, documented {within}; {where()}"
    times = await released
    assert abs(times - LIMITS.release_us) <= 3, f"released for {times} us, expected {LIMITS.release_us}; {where()}"
    # The sensor starts to work again in mid-trigger, at any time.
    dut.lidar_in.value = 0
    await bench.wait_us(FILTER_US + LIMITS.release_us + 5)
    while not int(dut.lidar_drive_low.value):
        await bench.wait_us(1)
    await bench.settle()
    await bench.pulse(90, gap_us=FILTER_US)
    await bench.settle()
    bench.expect_reading(90, 2)
    bench.expect("ok", 1, "after the fault")


async def _released_us(bench: Bench) -> float:
    """Return how long the pin was released the next time."""
    drive = bench.dut.lidar_drive_low
    while int(drive.value):
        await ValueChange(drive)
    begin = bench.now_us()
    while not int(drive.value):
        await ValueChange(drive)
    return bench.now_us() - begin


@cocotb.test(timeout_time=LIMIT_US, timeout_unit="us")
async def high_from_the_start(dut: HierarchyObject) -> None:
    """A pin that never falls after enable is too long: the pin is released, and pulled low again."""
    bench = Bench(dut, Random(getrandbits(32)))
    await bench.start(pin=1)
    await bench.enable()
    await bench.settle()
    released = cocotb.start_soon(_released_us(bench))
    await bench.wait_us(LIMITS.max_mm + LIMITS.release_us + 5)
    bench.expect("too_long", 0, "high from the start")
    assert released.done(), f"the pin was not released for {LIMITS.release_us} us; {where()}"
    times = released.result()
    assert abs(times - LIMITS.release_us) <= 3, f"released for {times} us, expected {LIMITS.release_us}; {where()}"
    await disable(bench)


async def disable(bench: Bench) -> None:
    """Disable, and assert that no status is left."""
    bench.dut.enable.value = 0
    await bench.wait_us(2)
    bench.expect("ok", 0, "disabled")


@cocotb.test(timeout_time=LIMIT_US, timeout_unit="us")
async def disabling_clears_the_status(dut: HierarchyObject) -> None:
    """A timeout and a short pulse are forgotten when measuring is switched off."""
    bench = Bench(dut, Random(getrandbits(32)))
    await bench.start()
    await bench.enable()
    await bench.wait_us(FILTER_US + LIMITS.start_timeout_us + 5)
    bench.expect("timeout", 0, "no pulse")
    await disable(bench)
    await bench.enable()
    await bench.settle()
    await bench.pulse(LIMITS.min_mm - 1, gap_us=2 * FILTER_US)
    await bench.settle()
    bench.expect("too_short", 0, "short pulse")
    await disable(bench)


@cocotb.test(timeout_time=LIMIT_US, timeout_unit="us")
async def no_reading(dut: HierarchyObject) -> None:
    """Before the first reading, and again after a reset, the age stays all ones and the distance 0."""
    bench = Bench(dut, Random(getrandbits(32)))
    await bench.start()
    await bench.enable()
    for _ in range(2):
        await bench.settle()
        bench.expect("ok", 0, "no reading")
        got = (int(dut.age_us.value), int(dut.distance_mm.value))
        assert got == (NEVER, 0), f"(age_us, distance_mm) without a reading: {got}; {where()}"
        await bench.pulse(100, gap_us=FILTER_US)
        await bench.settle()
        bench.expect("ok", 1, "a reading")
        dut.rst.value = 1
        await bench.wait_us(1)
        dut.rst.value = 0


@cocotb.test(timeout_time=LIMIT_US, timeout_unit="us")
async def reading_grows_old(dut: HierarchyObject) -> None:
    """The age counts microseconds; valid falls as the age passes the limit (the watcher checks the very clock)."""
    bench = Bench(dut, Random(getrandbits(32)))
    await bench.start()
    await bench.enable()
    await bench.settle()
    await bench.pulse(100, gap_us=FILTER_US)
    await RisingEdge(dut.updated)
    begin = bench.now_us()
    for at in (10, LIMITS.max_age_us // 2, LIMITS.max_age_us - 1, LIMITS.max_age_us + 2):
        await bench.wait_us(begin + at - bench.now_us())
        age = int(dut.age_us.value)
        assert abs(age - at) <= 1, f"age: expected {at}, got {age}; {where()}"
        assert int(dut.valid.value) == (at < LIMITS.max_age_us), f"valid at age {at}; {where()}"
    bench.expect_reading(100, 1)


@cocotb.test(timeout_time=LIMIT_US, timeout_unit="us")
async def random_sensor(dut: HierarchyObject) -> None:
    """Readings, short and long pulses, missing pulses, in random order, against the golden events."""
    bench = Bench(dut, Random(getrandbits(32)))
    rng = bench.rng
    high: list[tuple[float, float]] = []
    time = FILTER_US + 10
    for _ in range(30 if LIMITS.max_mm < 1000 else 6):
        time += rng.choices([FILTER_US + 5 + rng.randint(0, LIMITS.start_timeout_us // 4), long_gap()], [8, 1])[0]
        width = rng.choices(
            [
                rng.randint(LIMITS.min_mm + 2, LIMITS.max_mm - 2),
                rng.randint(int(FILTER_US) + 2, max(int(FILTER_US) + 2, LIMITS.min_mm - 2)),
                LIMITS.max_mm + rng.randint(3, LIMITS.release_us - 5),
            ],
            [6, 2, 1],
        )[0]
        high.append((time, time + width))
        time += width
    end = time + FILTER_US + 20
    await bench.start()
    await bench.enable()
    await bench.play(high, end)
    compare(bench, events(high, end - FILTER_US - 5, LIMITS))

# SPDX-License-Identifier: Apache-2.0
"""source_switch and source_mux: times to the clock, clocks that stop anywhere, locks that come, go and lie."""

import cocotb
from cocotb.handle import HierarchyObject
from cocotb.triggers import FallingEdge, RisingEdge, Timer, with_timeout

from tb.top.tb_switch import CAMERA, CLK_PS, HOLD, PATTERN, QUIET, STORED, Bench


async def begin(dut: HierarchyObject, want: int = CAMERA) -> Bench:
    """Both clocks run, reset is over, hold is 0."""
    bench = Bench(dut)
    dut.want.value = want
    bench.camera.start()
    bench.local.start()
    await bench.begin()
    await bench.until_free()
    return bench


@cocotb.test
async def times_are_as_documented(dut: HierarchyObject) -> None:
    bench = await begin(dut)
    await bench.pixels(8)
    dut.want.value = PATTERN
    await bench.cycles(1)
    await FallingEdge(dut.clk)
    assert int(dut.hold.value) == 1, "hold follows want in one cycle"
    cycles = 0
    while not int(dut.select_local.value):
        await bench.cycles(1)
        await FallingEdge(dut.clk)
        cycles += 1
    assert QUIET <= cycles <= QUIET + 2, f"{cycles} cycles of hold before the change, documented are {QUIET}"
    cycles = 0
    while int(dut.hold.value):
        await bench.cycles(1)
        await FallingEdge(dut.clk)
        cycles += 1
    assert HOLD <= cycles <= HOLD + 2, f"{cycles} cycles of hold after the change, documented are {HOLD}"
    await bench.pixels(8)
    assert bench.seen == {CAMERA, PATTERN}


@cocotb.test
async def each_source_after_each_other(dut: HierarchyObject) -> None:
    bench = await begin(dut)
    for want in (PATTERN, STORED, CAMERA, STORED, PATTERN, CAMERA):
        dut.want.value = want
        await bench.cycles(3)
        await bench.until_free()
        bench.seen.clear()
        await bench.pixels(8)
        assert bench.seen == {want}
    assert not bench.short, bench.short


@cocotb.test
async def a_fourth_source_is_blank(dut: HierarchyObject) -> None:
    bench = await begin(dut, 3)
    bench.seen.clear()
    await bench.pixels(20)
    assert not bench.seen


@cocotb.test
async def loss_of_lock_holds_and_return_frees(dut: HierarchyObject) -> None:
    bench = await begin(dut)
    for level in (0, 1) * 3:
        await Timer(bench.rng.randrange(3 * CLK_PS) + 1, "ps")
        bench.camera.stop(level)
        await bench.cycles(4)
        await FallingEdge(dut.clk)
        assert int(dut.hold.value) == 1, "hold 3 cycles after the lock"
        await bench.cycles(QUIET + 2 * HOLD)
        assert int(dut.hold.value) == 1
        assert int(dut.source.value) == CAMERA
        bench.camera.start()
        # The wait has been long enough for QUIET; HOLD counts from the lock on.
        assert HOLD <= await bench.until_free() <= HOLD + 6
        await bench.pixels(8)


@cocotb.test
async def a_short_loss_starts_the_time_anew(dut: HierarchyObject) -> None:
    bench = await begin(dut)
    dut.want.value = PATTERN
    await RisingEdge(dut.select_local)
    await bench.cycles(HOLD - 10)
    dut.local_locked.value = 0
    await bench.cycles(2)
    dut.local_locked.value = 1
    assert await bench.until_free() >= QUIET + HOLD


@cocotb.test
async def a_stopped_clock_does_not_lock_the_switch(dut: HierarchyObject) -> None:
    bench = await begin(dut)
    for stopped, other, want in ((bench.camera, bench.local, PATTERN), (bench.local, bench.camera, CAMERA)) * 2:
        for tell in (True, False):
            for level in (0, 1):
                await Timer(bench.rng.randrange(3 * CLK_PS) + 1, "ps")
                stopped.stop(level, tell=tell)
                await bench.cycles(bench.rng.choice((0, 1, 2, 5, QUIET)))
                dut.want.value = want
                await bench.cycles(3)
                await bench.until_free()
                await bench.pixels(8)
                assert bench.enabled == [int(want == CAMERA), int(want != CAMERA)]
                stopped.start()
                dut.want.value = CAMERA if want != CAMERA else PATTERN
                await bench.cycles(3)
                await bench.until_free()
        stopped.start()
        dut.want.value = want
        await bench.cycles(3)
        await bench.until_free()
        assert other.running


@cocotb.test
async def a_camera_that_is_not_there_is_waited_for(dut: HierarchyObject) -> None:
    bench = await begin(dut, STORED)
    bench.camera.stop(0)
    dut.want.value = CAMERA
    await bench.cycles(3)
    bench.seen.clear()
    await bench.cycles(3 * (QUIET + HOLD))
    assert int(dut.hold.value) == 1, "no picture of another source in its place"
    assert int(dut.select_local.value) == 1, "no change to a clock that stands still"
    assert not bench.seen
    bench.camera.start()
    await bench.until_free()
    await bench.pixels(8)
    assert bench.seen == {CAMERA}


@cocotb.test
async def a_camera_that_never_was_there(dut: HierarchyObject) -> None:
    bench = Bench(dut)
    bench.local.start()
    dut.want.value = PATTERN
    await bench.begin()
    await bench.until_free()
    await bench.pixels(8)
    assert bench.seen == {PATTERN}


@cocotb.test
async def reset_holds(dut: HierarchyObject) -> None:
    bench = await begin(dut, PATTERN)
    dut.rst.value = 1
    await bench.cycles(1)
    await FallingEdge(dut.clk)
    assert (int(dut.hold.value), int(dut.source.value), int(dut.select_local.value)) == (1, CAMERA, 0)


@cocotb.test
async def anything_at_any_time(dut: HierarchyObject) -> None:
    bench = await begin(dut)
    for _ in range(12):
        for _ in range(bench.rng.randrange(1, 6)):
            act = bench.rng.randrange(4)
            clock = bench.rng.choice((bench.camera, bench.local))
            if act == 0:
                clock.stop(bench.rng.randrange(2), tell=bench.rng.random() < 0.8)
            elif act == 1:
                clock.start()
            else:
                dut.want.value = bench.rng.randrange(3)
            await Timer(bench.rng.randrange(1, 2 * (QUIET + HOLD) * CLK_PS), "ps")
        # In the end all is well again by itself.
        bench.camera.start()
        bench.local.start()
        await with_timeout(bench.cycles(6), 10, "us")
        await bench.until_free(2 * (QUIET + HOLD))
        await bench.pixels(4)

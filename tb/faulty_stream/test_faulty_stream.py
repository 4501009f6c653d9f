# SPDX-License-Identifier: Apache-2.0
"""The protocol checker must fail each broken stream, and pass the sound one."""

from random import Random

import cocotb
from cocotb.handle import HierarchyObject

from tb.common.compare import check_frame
from tb.common.matrix import named, start
from tb.common.patterns import random_frame
from tb.common.stream import frame_beats

FAULTS = {
    "drop_valid": 1,
    "change_data": 2,
    "change_last": 3,
    "undefined_data": 4,
    "undefined_valid": 5,
    "undefined_ready": 6,
}


async def pass_a_frame(dut: HierarchyObject, fault: int) -> None:
    dut.fault.value = fault
    bench = await start(dut, Random(1), "idle_backpressure")
    frame = random_frame(bench.rng, 20, 10, 8)
    bench.source.send_beats(frame_beats(frame))
    await bench.drain(quiet=20, limit=4000)
    check_frame(bench.sink.taken, frame, "frame")


@cocotb.test()
async def sound(dut: HierarchyObject) -> None:
    await pass_a_frame(dut, 0)


@cocotb.test(expect_fail=True)
@cocotb.parametrize(fault=named(FAULTS))
async def broken(dut: HierarchyObject, fault: str) -> None:
    await pass_a_frame(dut, FAULTS[fault])

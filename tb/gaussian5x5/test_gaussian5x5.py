# SPDX-License-Identifier: Apache-2.0
"""gaussian5x5: the frame contract matrix, resets, and latency."""

from random import Random, getrandbits

import cocotb
from cocotb.handle import HierarchyObject
from cocotb.triggers import ClockCycles, RisingEdge

from golden.gaussian5x5 import gaussian5x5
from tb.common.contract import SizeLimits
from tb.common.matrix import SCENES, STALLS, VideoCore, check_latency, named, run_reset, run_scene, start
from tb.common.run import parameter, where

PPC = parameter("PPC", 1)
LIMITS = SizeLimits(max(3, 2 * PPC), 3, parameter("MAX_WIDTH", 1280), parameter("MAX_HEIGHT", 720))
CORE = VideoCore(golden=gaussian5x5, bits_in=8, reach=2, limits=LIMITS, ppc=PPC)


@cocotb.test()
@cocotb.parametrize(scene=named(SCENES), stall=named(STALLS))
async def frame_contract(dut: HierarchyObject, scene: str, stall: str) -> None:
    await run_scene(dut, CORE, scene, stall)


@cocotb.test()
@cocotb.parametrize(stall=named(STALLS))
async def reset_within_a_frame(dut: HierarchyObject, stall: str) -> None:
    await run_reset(dut, CORE, stall)


@cocotb.test()
async def latency_and_throughput(dut: HierarchyObject) -> None:
    await check_latency(dut, CORE)


@cocotb.test()
async def reset_takes_nothing(dut: HierarchyObject) -> None:
    """From the clock after the first one of a reset on, no pixel is taken and none is shown."""
    await start(dut, Random(getrandbits(64)), "full_speed")
    for _ in range(3):
        dut.rst.value = 1
        await ClockCycles(dut.clk, 2)
        for _ in range(5):
            await RisingEdge(dut.clk)
            handshakes = int(dut.s_axis_tready.value), int(dut.m_axis_tvalid.value)
            assert handshakes == (0, 0), f"(s_axis_tready, m_axis_tvalid) in reset: {handshakes}; {where()}"
        dut.rst.value = 0
        await ClockCycles(dut.clk, 20)
        assert int(dut.s_axis_tready.value) == 1, f"s_axis_tready is 0 after reset; {where()}"

# SPDX-License-Identifier: Apache-2.0
"""median5x5: the frame contract matrix, resets, and latency."""

import cocotb
from cocotb.handle import HierarchyObject

from golden.median5x5 import median5x5
from tb.common.contract import SizeLimits
from tb.common.matrix import SCENES, STALLS, VideoCore, check_latency, named, run_reset, run_scene
from tb.common.run import parameter

PPC = parameter("PPC", 1)
LIMITS = SizeLimits(max(2, 2 * PPC), 1, parameter("MAX_WIDTH", 1280), parameter("MAX_HEIGHT", 720))
CORE = VideoCore(golden=median5x5, bits_in=1, reach=2, limits=LIMITS, ppc=PPC)


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

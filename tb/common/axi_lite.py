# SPDX-License-Identifier: Apache-2.0
"""Checker of the response channels of an AXI4-Lite slave."""

import cocotb
from cocotb.handle import HierarchyObject
from cocotb.triggers import RisingEdge

from tb.common.run import four_state, where

RESPONSES = {"b": ("bresp",), "r": ("rdata", "rresp")}


def check_responses(dut: HierarchyObject, prefix: str = "s_axil") -> None:
    """From now on fail at a response that changes or vanishes while stalled, or has an unknown bit."""
    for channel, payload in RESPONSES.items():
        cocotb.start_soon(_check(dut, prefix, channel, payload))


async def _check(dut: HierarchyObject, prefix: str, channel: str, payload: tuple[str, ...]) -> None:
    valid, ready = getattr(dut, f"{prefix}_{channel}valid"), getattr(dut, f"{prefix}_{channel}ready")
    signals = [getattr(dut, f"{prefix}_{name}") for name in payload]
    offered = None
    while True:
        await RisingEdge(dut.clk)
        if str(dut.rst.value) != "0":
            offered = None
            continue
        is_valid = str(valid.value)
        assert is_valid in "01", f"{channel}valid is {is_valid}; {where()}"
        now = [str(signal.value) for signal in signals] if is_valid == "1" else None
        assert offered is None or now == offered, (
            f"{channel} channel changed from {offered} to {now} while stalled; {where()}"
        )
        assert now is None or not four_state() or not any(set(text) - {"0", "1"} for text in now), (
            f"{channel} channel offers {now}; {where()}"
        )
        offered = now if str(ready.value) == "0" else None

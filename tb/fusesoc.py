# SPDX-License-Identifier: Apache-2.0
"""The tests of whatever core FuseSoC simulates, as one cocotb module: `fusesoc run --target=sim touchdown:rtl:<core>`.

What `tb.common.runner` tells a test through the environment comes from the simulated core here, before its tests load.
"""

import importlib
import json
import os

import cocotb

KEY = "TOUCHDOWN_RUN"


def told() -> str:
    """What the runner would say of this simulation: core, simulator and parameters of the build."""
    top = cocotb.top
    parameters = {item._name: int(item.value) for item in top if item._name.isupper()}
    return json.dumps(
        {
            "core": top._name,
            "sim": "icarus" if cocotb.SIM_NAME.startswith("Icarus") else "verilator",
            "config": 0,
            "parameters": parameters,
            "seed": cocotb.RANDOM_SEED,
        }
    )


os.environ.setdefault(KEY, told())
globals().update(vars(importlib.import_module(f"tb.{cocotb.top._name}.test_{cocotb.top._name}")))

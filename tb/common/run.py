# SPDX-License-Identifier: Apache-2.0
"""What a test knows about the run it is part of; the runner passes it through the environment."""

import json
import os

from tb.common.runner import replay_command

_RUN = json.loads(os.environ.get("TOUCHDOWN_RUN", "{}"))


def parameter(name: str, default: int) -> int:
    """Return the value of a Verilog parameter in this build."""
    return int(_RUN.get("parameters", {}).get(name, default))


def core_name() -> str:
    """Return the name of the core that is tested."""
    return str(_RUN["core"])


def four_state() -> bool:
    """Return whether the simulator knows X."""
    return _RUN.get("sim") == "icarus"


def where() -> str:
    """Return seed and replay command for the message of a failure."""
    if not _RUN:
        return "(not in a run)"
    seed = _RUN["seed"]
    return f"seed {seed}, config {_RUN['config']}; replay: {replay_command(_RUN['core'], _RUN['sim'], seed)}"

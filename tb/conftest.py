# SPDX-License-Identifier: Apache-2.0
"""Keeps pytest out of the cocotb test modules: they run inside a simulator, through `tb/test_cores.py`."""

from pathlib import Path

collect_ignore = [
    str(path)
    for path in Path(__file__).parent.glob("*/test_*.py")
    if path.stem == f"test_{path.parent.name}" and path.parent.name != "common"
]

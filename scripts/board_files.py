# SPDX-License-Identifier: Apache-2.0
"""The board's Verilog for tests: what rtl/ has of it, and ports only of what it does not have yet, or of the vendor."""

from pathlib import Path

from scripts.board import own_sources
from scripts.errors import UserError
from tb.common.cores import ROOT, load_core

VENDOR = ROOT / "tb/top/vendor"
PENDING = ROOT / "tb/top/pending"
SHARED = tuple(ROOT / f"rtl/video_in/{name}.v" for name in ("sync_bits", "reset_sync"))
NEEDS = {"landing_core": "view_label_tlast"}
"""A port without which a core counts as not there yet."""


def core_sources(name: str) -> tuple[Path, ...]:
    """The files of a core, or those that stand in for it."""
    try:
        sources = load_core(name).sources
    except UserError:
        sources = ()
    if sources and NEEDS.get(name, "") in sources[-1].read_text():
        return sources
    # The stand-in of landing_core has the one cell that constraints name.
    inner = (ROOT / "rtl/lidar_pwm/lidar_pwm.v",) if name == "landing_core" else ()
    return (*inner, PENDING / f"{name}.v")


def board_files() -> list[Path]:
    """Everything but the vendor's cells, each file once, top level last."""
    names = ("landing_core", "display", "pattern_source", "frame_source")
    files = dict.fromkeys(SHARED)
    for name in names:
        files.update(dict.fromkeys(core_sources(name)))
    files.update(dict.fromkeys(own_sources()))
    return list(files)


def vendor_files() -> list[Path]:
    """Ports of the vendor's cells."""
    return sorted(VENDOR.glob("*.v"))

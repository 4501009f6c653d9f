# SPDX-License-Identifier: Apache-2.0
"""Which exporter makes which file."""

from functools import partial
from pathlib import Path

from scripts.regmap import c_header, markdown, python_module, record_header, slave
from scripts.regmap.model import Source, load

LANDING = Source("rtl/landing_regs/landing_core.rdl", "landing_regs", "result_ring")
DISPLAY = Source("rtl/display/display.rdl", "display_regs")

LANDING_PAGE = "docs/registers.md"
DISPLAY_PAGE = "docs/display_registers.md"

EXPORTERS = {
    "rtl/landing_regs/landing_regs.v": (LANDING, partial(slave.export, page=LANDING_PAGE)),
    "rtl/generated/result_record.vh": (LANDING, record_header.export),
    "firmware/generated/landing_regs.h": (LANDING, c_header.export),
    "golden/generated/landing_regs.py": (LANDING, python_module.export),
    LANDING_PAGE: (LANDING, markdown.export),
    "rtl/display/display_regs.v": (DISPLAY, partial(slave.export, page=DISPLAY_PAGE)),
    "firmware/generated/display_regs.h": (DISPLAY, c_header.export),
    "golden/generated/display_regs.py": (DISPLAY, python_module.export),
    DISPLAY_PAGE: (DISPLAY, markdown.export),
}


def write_all(root: Path, out: Path) -> list[Path]:
    """Read the sources below `root`, write all files below `out`; returns their paths."""
    maps = {source: load(root, source) for source in (LANDING, DISPLAY)}
    paths = []
    for name, (source, export) in EXPORTERS.items():
        path = out / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(export(maps[source]), encoding="utf-8")
        paths.append(path)
    return paths

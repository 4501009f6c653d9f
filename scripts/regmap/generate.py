# SPDX-License-Identifier: Apache-2.0
"""Which exporter makes which file."""

from pathlib import Path

from scripts.regmap import c_header, markdown, python_module, record_header, slave
from scripts.regmap.model import SOURCE, load

EXPORTERS = {
    "rtl/landing_regs/landing_regs.v": slave.export,
    "rtl/generated/result_record.vh": record_header.export,
    "firmware/generated/landing_regs.h": c_header.export,
    "golden/generated/landing_regs.py": python_module.export,
    "docs/registers.md": markdown.export,
}


def write_all(root: Path, out: Path) -> list[Path]:
    """Read the source below `root`, write all files below `out`; returns their paths."""
    register_map = load(root / SOURCE)
    paths = []
    for name, export in EXPORTERS.items():
        path = out / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(export(register_map), encoding="utf-8")
        paths.append(path)
    return paths

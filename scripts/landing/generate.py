# SPDX-License-Identifier: Apache-2.0
"""Writes what is generated."""

from pathlib import Path

from scripts.landing import c_table, page
from scripts.landing.model import SOURCE, load
from scripts.page_block import with_block

HEADER = "firmware/generated/landing_table.h"
C_SOURCE = "firmware/generated/landing_table.c"
PARAMETERS = "firmware/generated/landing_parameters.h"
PAGE = "docs/landing.md"
FILES = (HEADER, C_SOURCE, PARAMETERS, PAGE)


def write_all(root: Path, out: Path) -> list[Path]:
    """Read the table and the page below `root`, write all files below `out`; returns their paths."""
    landing = load(root / SOURCE)
    text = (root / PAGE).read_text(encoding="utf-8")
    for name, content in page.blocks(landing).items():
        text = with_block(text, name, content, PAGE)
    texts = {
        HEADER: c_table.header(landing),
        C_SOURCE: c_table.source(landing),
        PARAMETERS: c_table.parameters(landing),
        PAGE: text,
    }
    for name, content in texts.items():
        path = out / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(content, encoding="utf-8")
    return [out / name for name in texts]

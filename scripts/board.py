# SPDX-License-Identifier: Apache-2.0
"""What the whole design for the board is made of: `rtl/top/board.toml`, and the `core.toml` of the cores it names."""

import re
import tomllib
from dataclasses import dataclass
from pathlib import Path

from scripts.errors import UserError
from tb.common.cores import ROOT, load_core

TABLE = ROOT / "rtl/top/board.toml"
VENDOR = ROOT / "tb/top/vendor"
INCLUDES = ROOT / "rtl/generated"


@dataclass(frozen=True)
class Board:
    """Part, top level, Verilog files (each once, top level last), constraints in the order of reading."""

    part: str
    toplevel: str
    sources: tuple[Path, ...]
    constraints: tuple[Path, ...]


def part() -> str:
    """The device, without a look at the cores."""
    return tomllib.loads(TABLE.read_text(encoding="utf-8"))["part"]


def vendor_files() -> list[Path]:
    """Ports of the vendor's cells, for tools that do not have those."""
    return sorted(VENDOR.glob("*.v"))


def own_sources() -> tuple[Path, ...]:
    """The files of `rtl/top`, top level last."""
    return tuple(ROOT / name for name in tomllib.loads(TABLE.read_text(encoding="utf-8"))["sources"])


def load_board() -> Board:
    """Read the board.

    Raises:
        UserError: A core that it names is not there, or a file.
    """
    table = tomllib.loads(TABLE.read_text(encoding="utf-8"))
    sources: dict[Path, None] = {}
    for name in table["cores"]:
        sources.update(dict.fromkeys(load_core(name).sources))
    sources.update(dict.fromkeys(own_sources()))
    constraints = tuple(ROOT / name for name in table["constraints"])
    for path in (*sources, *constraints):
        if not path.is_file():
            raise UserError(f"rtl/top/board.toml needs {path.relative_to(ROOT)}, which does not exist.")
    return Board(table["part"], table["toplevel"], tuple(sources), constraints)


def headers_of(sources: tuple[Path, ...]) -> tuple[Path, ...]:
    """The generated headers that some of the sources include."""
    names = {name for source in sources for name in re.findall(r'`include\s+"([^"]+)"', source.read_text())}
    return tuple(INCLUDES / name for name in sorted(names))

# SPDX-License-Identifier: Apache-2.0
"""What `rtl/<core>/core.toml` says: the sources of a core and the builds in which it is tested."""

import tomllib
from dataclasses import dataclass
from pathlib import Path

from scripts.errors import UserError

ROOT = Path(__file__).resolve().parents[2]
KNOWN_KEYS = {"sources", "toplevel", "configs", "quick"}


@dataclass(frozen=True)
class Core:
    """One core: Verilog sources from the project root (top level last), top module, parameter table of each config.

    `quick` are the configs of `make test`: the first, and with it those in which a test runs that the first skips.
    """

    name: str
    sources: tuple[Path, ...]
    toplevel: str
    configs: tuple[dict[str, int], ...]
    quick: tuple[int, ...] = (0,)

    @property
    def test_module(self) -> str:
        """Dotted name of the cocotb test module."""
        return f"tb.{self.name}.test_{self.name}"

    def config_name(self, index: int) -> str:
        """Short name of a config for folders and messages, e.g. `0-MAX_WIDTH=32-MAX_HEIGHT=24`."""
        return "-".join([str(index), *(f"{key}={value}" for key, value in self.configs[index].items())])


def core_names() -> list[str]:
    """Names of all cores that have a `core.toml`, sorted."""
    return sorted(path.parent.name for path in (ROOT / "rtl").glob("*/core.toml"))


def load_core(name: str) -> Core:
    """Read one core.

    Raises:
        UserError: the core is unknown, its `core.toml` is wrong, or a source or the test module does not exist.
    """
    if name not in core_names():
        what = f"unknown core '{name}'; choose" if name else "no core was named; give CORE="
        raise UserError(f"{what} one of: {', '.join(core_names())}.")
    where = f"rtl/{name}/core.toml"
    try:
        table = tomllib.loads((ROOT / where).read_text(encoding="utf-8"))
    except tomllib.TOMLDecodeError as error:
        raise UserError(f"{where} is not valid TOML: {error}.") from error
    unknown = sorted(set(table) - KNOWN_KEYS)
    if unknown:
        raise UserError(f"{where} has unknown keys: {', '.join(unknown)}; known are {', '.join(sorted(KNOWN_KEYS))}.")
    if not table.get("sources"):
        raise UserError(f"{where} names no sources; list the Verilog files, top level last.")
    sources = tuple(ROOT / source for source in table["sources"])
    configs = tuple(table.get("configs", [{}]))
    quick = tuple(table.get("quick", [0]))
    if not {0} <= set(quick) <= set(range(len(configs))):
        raise UserError(f"{where}: 'quick' must list config 0 and may list others up to {len(configs) - 1}.")
    core = Core(name, sources, table.get("toplevel", sources[-1].stem), configs, quick)
    for source in sources:
        if not source.is_file():
            raise UserError(f"{where} names {source.relative_to(ROOT)}, which does not exist.")
    test = ROOT / f"{core.test_module.replace('.', '/')}.py"
    if not test.is_file():
        raise UserError(f"{where} exists but {test.relative_to(ROOT)} does not; write the tests of the core there.")
    return core

# SPDX-License-Identifier: Apache-2.0
"""Chooses the mutants of a core: the same ones for the same seed, spread over its lines, each of which compiles.

The choice is by hashes of the lines, so a change of one line leaves the mutants of the others as they are.
"""

import hashlib
import re
import resource
import subprocess
import tempfile
import tomllib
from collections.abc import Iterator
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from scripts.errors import UserError
from tb.common.cores import ROOT, Core
from tb.mutation.operators import Mutant, mutants

HERE = Path(__file__).parent
DEFAULT_SEED = 1
COMPILE_CPU_SECONDS = 20


@dataclass(frozen=True)
class Fault:
    """One mutant of one file of a core."""

    path: Path
    mutant: Mutant

    @property
    def key(self) -> tuple[str, str, str]:
        """File from the project root, line as it is, line as it becomes."""
        return (str(self.path.relative_to(ROOT)), self.mutant.before, self.mutant.after)

    @property
    def text(self) -> str:
        """Text of the file with the fault in it."""
        return self.mutant.apply(self.path.read_text(encoding="utf-8"))

    def sources(self, core: Core, folder: Path) -> tuple[Path, ...]:
        """Return the sources of the core with the mutated file, which is written into folder, in its place."""
        folder.mkdir(parents=True, exist_ok=True)
        copy = folder / self.path.name
        copy.write_text(self.text, encoding="utf-8")
        return tuple(copy if source == self.path else source for source in core.sources)


def settings(core_name: str) -> dict[str, Any]:
    """Return the table of a core in cores.toml.

    Raises:
        UserError: the core has no table in cores.toml.
    """
    table = tomllib.loads((HERE / "cores.toml").read_text(encoding="utf-8"))
    if core_name not in table:
        raise UserError(f"tb/mutation/cores.toml has no table [{core_name}]; add one.")
    return table[core_name]


def plan(core_name: str) -> tuple[int, list[int]]:
    """Return the number of mutants of a core and the order of its configs."""
    table = settings(core_name)
    return table["mutants"], table["configs"]


def own_sources(core: Core) -> list[Path]:
    """Return the files of the core and the common ones; of a core made of other cores only its own."""
    folder, common = ROOT / "rtl" / core.name, ROOT / "rtl/common"
    if any(source.parent not in (folder, common) for source in core.sources):
        return [source for source in core.sources if source.parent == folder]
    return list(core.sources)


def compiled(core: Core, config: int) -> str | None:
    """Return what Icarus makes of the sources, without addresses and paths, or None if it complains."""
    parameters = [f"-P{core.toplevel}.{name}={value}" for name, value in core.configs[config].items()]
    with tempfile.TemporaryDirectory() as folder:
        program = Path(folder) / "program.vvp"
        command = ["iverilog", "-g2005", "-Wall", f"-I{ROOT / 'rtl/generated'}", "-s", core.toplevel]
        result = subprocess.run(
            [*command, "-o", str(program), *parameters, *map(str, core.sources)],
            capture_output=True,
            text=True,
            check=False,
            preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_CPU, (COMPILE_CPU_SECONDS, COMPILE_CPU_SECONDS)),
        )
        if result.returncode != 0 or result.stdout + result.stderr:
            return None
        text = program.read_text(encoding="utf-8").partition(":file_names")[0]
    names: dict[str, str] = {}
    return re.sub(r"0x[0-9a-f]{6,}", lambda match: names.setdefault(match[0], f"n{len(names)}"), text)


def candidates(core: Core, seed: int) -> list[Fault]:
    """Return every mutant of the core: one of each line in the order of their hashes, then the second of each.

    Lines of the files that cores.toml wants first come before others.
    """
    wanted = settings(core.name).get("first", [])
    lines: dict[tuple[str, str, int], list[tuple[str, Fault]]] = {}
    for path in own_sources(core):
        name = str(path.relative_to(ROOT))
        for mutant in mutants(path.read_text(encoding="utf-8")):
            digest = hashlib.sha256(f"{seed}/{core.name}/{name}/{mutant.before}/{mutant.after}".encode()).hexdigest()
            lines.setdefault((name, mutant.before, mutant.line), []).append((digest, Fault(path, mutant)))
    ranked: list[tuple[int, bool, str, Fault]] = []
    for (name, _, _), found in lines.items():
        for rank, (digest, fault) in enumerate(sorted(found, key=lambda pair: pair[0])):
            ranked.append((rank, name not in wanted, digest, fault))
    return [fault for _, _, _, fault in sorted(ranked, key=lambda entry: entry[:3])]


def chosen(core: Core, count: int, seed: int) -> Iterator[Fault]:
    """Yield the first `count` candidates that compile and change what is simulated in at least one config.

    A fault in a generate branch that no config of this core elaborates changes nothing and is passed over.

    Raises:
        UserError: the core does not compile, or there are fewer candidates.
    """
    indices = range(len(core.configs))
    plain = [compiled(core, index) for index in indices]
    if None in plain:
        raise UserError(f"{core.name} does not compile without warnings; run make lint.")
    seen = set()
    with tempfile.TemporaryDirectory() as folder:
        for fault in candidates(core, seed):
            if len(seen) == count:
                return
            if fault.key in seen:
                continue
            changed = replace(core, sources=fault.sources(core, Path(folder)))
            programs = [compiled(changed, index) for index in indices]
            if None not in programs and programs != plain:
                seen.add(fault.key)
                yield fault
    if len(seen) < count:
        raise UserError(f"{core.name} has only {len(seen)} mutants; lower its number in tb/mutation/cores.toml.")

# SPDX-License-Identifier: Apache-2.0
"""What the result of a check depends on, and the hash of it: a result counts while its hash is that of the files."""

import hashlib
import json
import re
import tomllib
from collections.abc import Iterable
from pathlib import Path

from tb.common.cores import ROOT, core_names, load_core

WHOLE = "landing_core"
SUFFIXES = {".py", ".v", ".sv", ".vh", ".cpp", ".h", ".mk", ".toml", ".vlt", ".rules"}
BY_CORE = {
    "mutation": ("tb/mutation/cores.toml", "tb/mutation/equivalent.toml"),
    "coverage": ("tb/coverage/waivers.toml",),
    "area": ("constraints/budgets.toml",),
}
"""Tables that all cores share: of these only what is said of the core counts."""


def files_in(*places: str, tests: bool = False) -> list[Path]:
    """Sources at some places, files or whole folders from the project root; pytest's own tests only if wanted."""
    found = []
    for place in places:
        path = ROOT / place
        found += [path] if path.is_file() else [file for file in path.rglob("*") if file.suffix in SUFFIXES]
    return [file for file in found if tests or not file.name.startswith("test_")]


def rtl_of(core: str) -> list[Path]:
    """Files that make a core, and the table that names them; of a module that cores share, its one file."""
    if core not in core_names():
        return sorted((ROOT / "rtl").glob(f"*/{core}.v"))
    sources = load_core(core).sources
    headers = {name for source in sources for name in re.findall(r'`include "(\S+)"', source.read_text("utf-8"))}
    return [ROOT / "rtl" / core / "core.toml", *sources, *(ROOT / "rtl/generated" / name for name in headers)]


def golden_of(core: str, *users: Path) -> list[Path]:
    """The golden model of a core, the models that some files import, and those that these are made of."""
    models = [ROOT / "golden" / f"{'chain' if core == WHOLE else core}.py"]
    for file in (queue := [*models, *users]):
        for name in re.findall(r"^from golden\.([\w.]+) import", file.read_text("utf-8"), re.M):
            place = ROOT / "golden" / name.replace(".", "/")
            new = sorted(place.glob("*.py")) if place.is_dir() else [place.with_suffix(".py")]
            models += (added := [model for model in new if model not in models])
            queue += added
    return models


def bench_of(core: str) -> list[Path]:
    """The tests of a core, what they share with those of others, and the models that they compare with."""
    own = files_in(f"tb/{core}", tests=True)
    return [*own, *files_in("tb/common"), *golden_of(core, *own)]


def dependencies(core: str, check: str) -> list[Path]:
    """Every file that the result of a check of a core depends on."""
    if check == "frames":
        sim = [*(ROOT / "sim").glob("*.py"), *files_in("sim/icarus", "sim/verilated", "sim/world")]
        sim += files_in("sim/cosim/frame_list.py", "sim/cosim/cosim.mk")
        return [*rtl_of(WHOLE), *golden_of(WHOLE), *(file for file in sim if not file.name.startswith("test_"))]
    rtl = rtl_of(core)
    if check == "matrix":
        return [*rtl, *bench_of(core)]
    if check == "exhaustive":
        return [*rtl, *bench_of(core), *files_in("tb/exhaustive", tests=True)]
    if check in ("mutation", "coverage"):
        tool = [file for file in files_in(f"tb/{check}") if file.suffix == ".py"]
        return [*rtl, *bench_of(core), *tool]
    if check == "formal":
        return [*rtl, *files_in(f"formal/{core}", "formal/common", "formal/solve.py", "formal/tasks.py")]
    return [*rtl, *files_in(*{"lint": ("scripts/lint", "scripts/lint.py"), "area": ("scripts/synth.py",)}[check])]


def said_of(core: str, table: str) -> str:
    """What a shared table says of a core: its own part, the limits of all, and the entries that name it."""
    content = tomllib.loads((ROOT / table).read_text("utf-8"))
    entries = [entry for part in content.values() if isinstance(part, list) for entry in part]
    named = [entry for entry in entries if core in entry.get("cores", ())]
    return json.dumps([content.get(core), content.get("half_of_paper"), named], sort_keys=True)


def digest(core: str, check: str) -> str:
    """Hash over names and contents of all that a result depends on; times and places of the files do not count."""
    parts = {str(path.relative_to(ROOT)): path.read_bytes() for path in dependencies(core, check)}
    parts |= {table: said_of(core, table).encode() for table in BY_CORE.get(check, ())}
    return hash_of(f"{name} {hashlib.sha256(parts[name]).hexdigest()}" for name in sorted(parts))


def hash_of(lines: Iterable[str]) -> str:
    """Hash of some lines in their order."""
    return hashlib.sha256("\n".join(lines).encode()).hexdigest()

# SPDX-License-Identifier: Apache-2.0
"""Names in elaborated RTL, as Vivado writes them: ports, cells, pins, nets of a top level. Yosys elaborates."""

import json
import subprocess
import sys
import tempfile
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from pathlib import Path

from scripts.lint import YOSYS, include_flags
from tb.common.cores import ROOT


@dataclass
class Facts:
    """Names, each with its place in the hierarchy (`a/b/c`), bits in brackets.

    `widths` has the ports of the top level, `blackboxes` the modules that have ports and nothing else.
    """

    top: str
    widths: dict[str, tuple[str, int]]
    ports: list[str] = field(default_factory=list)
    cells: list[str] = field(default_factory=list)
    pins: list[str] = field(default_factory=list)
    nets: list[str] = field(default_factory=list)
    blackboxes: list[str] = field(default_factory=list)


def elaborate(top: str, sources: Iterable[Path]) -> dict[str, dict]:
    """Yosys's modules of a design, memories and processes turned into cells, hierarchy kept.

    Raises:
        ValueError: Yosys refuses it.
    """
    with tempfile.TemporaryDirectory() as folder:
        out = Path(folder) / "design.json"
        files = " ".join(str(source) for source in sources)
        steps = [f"read_verilog {' '.join(include_flags())} {files}", f"hierarchy -check -top {top}", "proc"]
        script = "; ".join([f"tee -q -o /dev/null {step}" for step in steps] + [f"write_json {out}"])
        run = subprocess.run(
            [sys.executable, "-c", YOSYS, script], cwd=ROOT, capture_output=True, text=True, check=False
        )
        if run.returncode != 0:
            raise ValueError(f"yosys refuses {top}: {(run.stdout + run.stderr).strip().splitlines()[-1]}")
        return json.loads(out.read_text())["modules"]


def bits_of(name: str, width: int) -> Iterator[str]:
    """The names of the bits of a vector, or its own."""
    yield from (name,) if width == 1 else (f"{name}[{bit}]" for bit in range(width))


def _registers(module: dict) -> Iterator[str]:
    """Flip-flops of a module: `x_reg`, or `x_reg[i]`, for the register x; not for wires that only pass it on."""
    held = {bit for cell in module["cells"].values() if "dff" in cell["type"] for bit in cell["connections"]["Q"]}
    names: dict[tuple, list[str]] = {}
    for name, net in module["netnames"].items():
        if not net.get("hide_name") and held.intersection(net["bits"]):
            names.setdefault(tuple(net["bits"]), []).append(name)
    for bits, same in names.items():
        for name in [name for name in same if name.endswith("_reg")] or same:
            yield from bits_of(f"{name}_reg", len(bits))


def _walk(modules: dict[str, dict], kind: str, prefix: str, facts: Facts) -> None:
    module = modules[kind]
    facts.cells += [prefix + name for name in _registers(module)]
    for name, net in module["netnames"].items():
        if not net.get("hide_name"):
            facts.nets += [prefix + bit for bit in bits_of(name, len(net["bits"]))]
    for name, cell in module["cells"].items():
        if cell["type"] not in modules:
            continue
        inner = modules[cell["type"]]
        facts.cells.append(prefix + name)
        if "blackbox" in inner["attributes"]:
            facts.blackboxes.append(cell["type"])
            for port, shape in inner["ports"].items():
                facts.pins += [f"{prefix}{name}/{bit}" for bit in bits_of(port, len(shape["bits"]))]
        else:
            _walk(modules, cell["type"], f"{prefix}{name}/", facts)


def facts_of(top: str, sources: Iterable[Path]) -> Facts:
    """All names of a design.

    Raises:
        ValueError: Yosys refuses it.
    """
    modules = elaborate(top, sources)
    widths = {name: (port["direction"], len(port["bits"])) for name, port in modules[top]["ports"].items()}
    facts = Facts(top, widths, [bit for name, (_, width) in widths.items() for bit in bits_of(name, width)])
    _walk(modules, top, "", facts)
    facts.blackboxes = sorted(set(facts.blackboxes))
    return facts

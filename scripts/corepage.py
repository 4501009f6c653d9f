# SPDX-License-Identifier: Apache-2.0
"""docs/cores: its shape, its tables against the RTL, its pictures: `python -m scripts.corepage [--write]`.

Every page has the sections of `SECTIONS`, in that order, with others anywhere between. The port and parameter tables
name what the RTL has, with its directions, widths and defaults. The timing picture is drawn from JSON in the page.
"""

import json
import re
import subprocess
import sys
import tempfile
from dataclasses import dataclass
from functools import cache
from pathlib import Path

import wavedrom

from scripts.errors import ArgumentParser, UserError, run_main
from scripts.lint import YOSYS, include_flags
from tb.common.cores import ROOT, core_names, load_core

PAGES = ROOT / "docs/cores"
PICTURES = ROOT / "docs/pictures/cores"
SECTIONS = (
    "Ports",
    "Parameters",
    "Latency",
    "Throughput",
    "Border",
    "Rounding",
    "Overflow",
    "Limits",
    "Timing",
    "Resources",
    "Commands",
)
PORT_HEAD = "| port | direction | width | |"
PARAMETER_HEAD = "| parameter | default | |"

ROW = re.compile(r"^\| (.*) \|$", re.MULTILINE)


@dataclass(frozen=True)
class Interface:
    """Ports of a top level (name to direction and width) and its parameters (name to default), in the RTL's order."""

    ports: dict[str, tuple[str, int]]
    parameters: dict[str, int]


def interface_of(module: dict[str, object]) -> Interface:
    """Interface of a module in the JSON of yosys."""
    ports = {name: (port["direction"].removesuffix("put"), len(port["bits"])) for name, port in module["ports"].items()}
    defaults = module.get("parameter_default_values", {})
    return Interface(ports, {name: int(value, 2) for name, value in defaults.items()})


@cache
def interfaces() -> dict[str, Interface]:
    """Interface of each core, as yosys reads its top level with the defaults of its parameters."""
    tops = {name: load_core(name) for name in core_names()}
    with tempfile.TemporaryDirectory() as folder:
        netlist = Path(folder) / "tops.json"
        files = " ".join(str(core.sources[-1].relative_to(ROOT)) for core in tops.values())
        script = f"read_verilog {' '.join(include_flags())} {files}; proc; write_json {netlist}"
        subprocess.run([sys.executable, "-c", YOSYS, script], cwd=ROOT, capture_output=True, check=True)
        modules = json.loads(netlist.read_text())["modules"]
    return {name: interface_of(modules[core.toplevel]) for name, core in tops.items()}


def page_path(core: str) -> Path:
    """Page of a core."""
    return PAGES / f"{core}.md"


def sections(text: str) -> dict[str, str]:
    """Second-level sections of a page: title to body."""
    parts = re.split(r"^## (.*)$", text, flags=re.MULTILINE)
    return dict(zip(parts[1::2], parts[2::2], strict=True))


def rows_below(head: str, body: str) -> list[list[str]]:
    """Cells of the rows below the first table with this head; no row if there is none."""
    _, found, rest = body.partition(f"{head}\n")
    table = rest.split("\n\n")[0] if found else ""
    return [re.split(r" *(?<!\\)\| *", row) for row in ROW.findall(table)]


def interface_faults(core: str, text: str, interface: Interface) -> list[str]:
    """Where the tables of a page differ from the RTL."""
    body = sections(text)
    want = [[f"`{name}`", way, str(width)] for name, (way, width) in interface.ports.items()]
    have = [row[:3] for row in rows_below(PORT_HEAD, body.get("Ports", ""))]
    want += [[f"`{name}`", str(value)] for name, value in interface.parameters.items()]
    have += [row[:2] for row in rows_below(PARAMETER_HEAD, body.get("Parameters", ""))]
    found = [f"{core}: the RTL has {' '.join(row)}, the page has not" for row in want if row not in have]
    found += [f"{core}: the page has {' '.join(row)}, the RTL has not" for row in have if row not in want]
    return found or ([] if want == have else [f"{core}: the tables are not in the order of the RTL"])


def shape_faults(core: str, text: str) -> list[str]:
    """Which sections a page lacks, or has empty or out of order."""
    body = sections(text)
    found = [f"{core}: no section '{name}'" for name in SECTIONS if not body.get(name, "").strip()]
    order = [name for name in body if name in SECTIONS]
    if not found and order != list(SECTIONS):
        found.append(f"{core}: sections are not in the order {', '.join(SECTIONS)}")
    return found


def block_of(core: str, text: str, name: str) -> re.Match[str]:
    """The place between `<!-- name -->` and `<!-- /name -->` in a page.

    Raises:
        UserError: The page has no such markers.
    """
    found = re.search(rf"(?<=<!-- {name} -->\n).*?(?=<!-- /{name} -->)", text, flags=re.DOTALL)
    if found is None:
        raise UserError(f"docs/cores/{core}.md has no lines <!-- {name} --> and <!-- /{name} -->; put them in.")
    return found


def put_block(core: str, name: str, content: str) -> None:
    """Replace what stands between two markers of a page."""
    text = page_path(core).read_text(encoding="utf-8")
    place = block_of(core, text, name)
    page_path(core).write_text(f"{text[: place.start()]}{content}\n{text[place.end() :]}", encoding="utf-8")


def draw(core: str, text: str) -> str:
    """SVG of the WaveDrom JSON in the section Timing of a page.

    Raises:
        UserError: There is none, or it is not JSON.
    """
    source = re.search(r"```json\n(.*?)```", sections(text).get("Timing", ""), flags=re.DOTALL)
    if source is None:
        raise UserError(f"docs/cores/{core}.md has no ```json block in its section Timing; put WaveDrom JSON there.")
    try:
        json.loads(source[1])
    except json.JSONDecodeError as error:
        raise UserError(f"the timing of docs/cores/{core}.md is not JSON: {error}.") from error
    return wavedrom.render(source[1]).tostring() + "\n"


def picture_faults(core: str, text: str) -> list[str]:
    """Whether the picture is the one that the page's JSON gives, and the page shows it."""
    path = PICTURES / f"{core}.svg"
    found = [] if f"](../pictures/cores/{core}.svg)" in sections(text)["Timing"] else [f"{core}: shows no picture"]
    if not path.is_file() or path.read_text(encoding="utf-8") != draw(core, text):
        found.append(f"{core}: the picture is not what its JSON gives; run `python -m scripts.corepage --write`")
    return found


def page_faults(core: str) -> list[str]:
    """Everything that is wrong with a page, its resources aside (see scripts/synth.py)."""
    if not page_path(core).is_file():
        return [f"{core}: docs/cores/{core}.md does not exist"]
    text = page_path(core).read_text(encoding="utf-8")
    return shape_faults(core, text) or interface_faults(core, text, interfaces()[core]) + picture_faults(core, text)


def main() -> int:
    """Check the pages, or draw their pictures anew."""
    parser = ArgumentParser(prog="python -m scripts.corepage", description=__doc__)
    parser.add_argument("--write", action="store_true", help="draw the pictures of docs/pictures/cores")
    arguments = parser.parse_args()
    if arguments.write:
        PICTURES.mkdir(parents=True, exist_ok=True)
        for core in core_names():
            picture = draw(core, page_path(core).read_text(encoding="utf-8"))
            (PICTURES / f"{core}.svg").write_text(picture, encoding="utf-8")
    found = [fault for core in core_names() for fault in page_faults(core)]
    print("\n".join(found) if found else f"{len(core_names())} pages agree with the RTL.")
    return int(bool(found))


if __name__ == "__main__":
    run_main(main)

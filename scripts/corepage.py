# SPDX-License-Identifier: Apache-2.0
"""docs/cores: its shape, its tables against the RTL, its pictures: `python -m scripts.corepage [--write]`.

Every page has the sections of `SECTIONS`, in that order, with others anywhere between. The port and parameter tables
name what the RTL has, with its directions, widths and defaults. The timing picture is drawn from JSON in the page,
whose inputs are played into the RTL and whose outputs are what it answers (scripts/corepage_timing.py). The header of
the RTL speaks of the same matters, and its latency is that of the page, which the tests assert.
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
from lxml import etree

from scripts.corepage_timing import as_text, simulate
from scripts.errors import ArgumentParser, UserError, run_main
from scripts.lint import YOSYS, include_flags
from scripts.page_block import find_block, with_block
from tb.common.cores import ROOT, core_names, load_core
from tb.common.figures import PAGES, numbers, sections

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
HEADER_WORDS = ("Latency", "Throughput", "Border", "Rounding", "Overflow", "Limit")
PORT_HEAD = "| port | direction | width | |"
PARAMETER_HEAD = "| parameter | default | |"

SVG = "{http://www.w3.org/2000/svg}"
LINK = "{http://www.w3.org/1999/xlink}href"
HEADER_LATENCY = re.compile(r"^// Latency\b(.*?)(?=\n// [A-Z]\w+(?::|  )|\. [A-Z]\w+:|\Z)", re.DOTALL | re.MULTILINE)
ROW = re.compile(r"^\| (.*) \|$", re.MULTILINE)


@dataclass(frozen=True)
class Interface:
    """Ports of a top level in its order (name to direction and width); its parameters by name (name to default)."""

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
    """Whether a page begins with its purpose; which sections it lacks, or has empty or out of order."""
    body = sections(text)
    found = [] if re.match(rf"# {core}\n\n(?!#)\S", text) else [f"{core}: does not begin with its name and purpose"]
    found += [f"{core}: no section '{name}'" for name in SECTIONS if not body.get(name, "").strip()]
    order = [name for name in body if name in SECTIONS]
    if not found and order != list(SECTIONS):
        found.append(f"{core}: sections are not in the order {', '.join(SECTIONS)}")
    return found


def block_of(core: str, text: str, name: str) -> re.Match[str]:
    """The place between `<!-- name -->` and `<!-- /name -->` in a page.

    Raises:
        UserError: The page has no such markers.
    """
    return find_block(text, name, f"docs/cores/{core}.md")


def put_block(core: str, name: str, content: str) -> None:
    """Replace what stands between two markers of a page."""
    page_path(core).write_text(with_block(read_page(core), name, content, f"docs/cores/{core}.md"), encoding="utf-8")


def timing_source(core: str, text: str) -> re.Match[str]:
    """The WaveDrom JSON in the section Timing of a page.

    Raises:
        UserError: There is none.
    """
    found = re.search(r"(?<=```json\n){.*?}\n(?=```)", text, flags=re.DOTALL)
    if found is None or found[0] not in sections(text).get("Timing", ""):
        raise UserError(f"docs/cores/{core}.md has no ```json block in its section Timing; put WaveDrom JSON there.")
    return found


def simulated(core: str, source: str) -> str:
    """The JSON of a picture with the outputs that the RTL gives.

    Raises:
        UserError: It is not JSON, or no stimulus for the core.
    """
    try:
        return as_text(simulate(core, json.loads(source), interfaces()[core].ports))
    except (ValueError, KeyError, IndexError, StopIteration) as error:
        raise UserError(f"the timing of docs/cores/{core}.md cannot be played ({error!r}); mend its JSON.") from error


def draw(source: str) -> str:
    """SVG of WaveDrom JSON, on white, without the symbols that it does not use."""
    svg = etree.fromstring(wavedrom.render(source).tostring().encode())
    used = {use.get(LINK).removeprefix("#") for use in svg.iter(f"{SVG}use")}
    for symbol in svg.findall(f".//{SVG}defs/{SVG}g"):
        if symbol.get("id") not in used:
            symbol.getparent().remove(symbol)
    svg.insert(0, etree.Element(f"{SVG}rect", width="100%", height="100%", fill="white"))
    return etree.tostring(svg, encoding="unicode") + "\n"


def picture_faults(core: str, text: str) -> list[str]:
    """Whether the waves are those of the RTL, the picture is that of the waves, and the page shows it."""
    path, source = PICTURES / f"{core}.svg", timing_source(core, text)[0]
    found = [] if f"](../pictures/cores/{core}.svg)" in sections(text)["Timing"] else [f"{core}: shows no picture"]
    if source != simulated(core, source):
        found.append(f"{core}: the waves are not those of the RTL; run `python -m scripts.corepage --write`")
    if not path.is_file() or path.read_text(encoding="utf-8") != draw(source):
        found.append(f"{core}: the picture is not that of its JSON; run `python -m scripts.corepage --write`")
    return found


def header_of(core: str) -> str:
    """Comment above the top level of a core."""
    return load_core(core).sources[-1].read_text(encoding="utf-8").partition("`default_nettype")[0]


def header_faults(core: str, text: str, header: str) -> list[str]:
    """Of what a header says nothing, and where its latency is not that of the page."""
    lacking = [word for word in HEADER_WORDS if not re.search(rf"\b{word}s?\b", header, re.IGNORECASE)]
    found = [f"{core}: the header says nothing of '{word}'" for word in lacking]
    latency = HEADER_LATENCY.search(header)
    if latency is None or not (numbers(latency[1]) or f"docs/cores/{core}.md" in latency[1]):
        return [*found, f"{core}: the header gives no latency"]
    page = iter(numbers(sections(text)["Latency"]))
    if not all(number in page for number in numbers(latency[1])):
        found.append(f"{core}: the latency of the header is not that of the page")
    return found


def page_faults(core: str, text: str) -> list[str]:
    """Everything that is wrong with the text of a page, its resources aside (see scripts/synth.py)."""
    shape = shape_faults(core, text)
    if shape:
        return shape
    found = header_faults(core, text, header_of(core))
    return found + interface_faults(core, text, interfaces()[core]) + picture_faults(core, text)


def read_page(core: str) -> str:
    """Text of the page of a core.

    Raises:
        UserError: There is none.
    """
    if not page_path(core).is_file():
        raise UserError(f"docs/cores/{core}.md does not exist; write the page of the core.")
    return page_path(core).read_text(encoding="utf-8")


def main() -> int:
    """Check the pages, or simulate and draw their timing anew."""
    parser = ArgumentParser(prog="python -m scripts.corepage", description=__doc__)
    parser.add_argument("--write", action="store_true", help="simulate and draw the timing anew")
    arguments = parser.parse_args()
    if arguments.write:
        PICTURES.mkdir(parents=True, exist_ok=True)
        for core in core_names():
            text = read_page(core)
            place = timing_source(core, text)
            source = simulated(core, place[0])
            page_path(core).write_text(text[: place.start()] + source + text[place.end() :], encoding="utf-8")
            (PICTURES / f"{core}.svg").write_text(draw(source), encoding="utf-8")
    found = [fault for core in core_names() for fault in page_faults(core, read_page(core))]
    print("\n".join(found) if found else f"{len(core_names())} pages agree with the RTL.")
    return int(bool(found))


if __name__ == "__main__":
    run_main(main)

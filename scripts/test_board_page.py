# SPDX-License-Identifier: Apache-2.0
"""docs/board.md says what the constraints, the registers and the scripts say."""

import re
import tomllib

import pytest

from scripts import vivado
from scripts.board import TABLE
from scripts.test_vivado_scripts import FAULTS
from tb.common.cores import ROOT

PAGE = (ROOT / "docs/board.md").read_text(encoding="utf-8")
XDC = (ROOT / "constraints/arty_z7.xdc").read_text(encoding="utf-8")


def pins() -> dict[str, str]:
    """Pin of each port in the constraints."""
    found = re.findall(r"PACKAGE_PIN (\w+) .*\[get_ports \{?([\w\[\]]+?)\}?\]$", XDC, re.MULTILINE)
    return {port: pin for pin, port in found}


def expand(text: str) -> list[str]:
    """Ports that a cell of the table names: `a, b`, `a_p`, `_n`, `a[0..3]`."""
    names = re.findall(r"`([^`]+)`", text)
    if len(names) == 2 and names[1] == "_n":
        return [names[0], names[0].replace("_p", "_n")]
    if match := re.fullmatch(r"(\w+)\[0\.\.(\d)\]", names[0]) if names else None:
        return [f"{match[1]}[{index}]" for index in range(int(match[2]) + 1)]
    return names


def test_pins_of_the_page_are_those_of_the_constraints() -> None:
    told: dict[str, str] = {}
    table = PAGE.split("### Everything on pins")[1].split("\n## ")[0]
    for row in re.findall(r"^\| `.*$", table, re.MULTILINE):
        cells = [cell.strip() for cell in row.strip("|").split("|")]
        for names, places in (cells[0:2], cells[3:5]):
            told.update(zip(expand(names), re.findall(r"\b[A-Y]\d{1,2}\b", places), strict=False))
    for row in re.findall(r"^\| `\w+` \| .* \| (?:in|out) \|$", PAGE, re.MULTILINE):
        cells = [cell.strip() for cell in row.strip("|").split("|")]
        told[cells[0].strip("`")] = cells[3]
    for name in ("lidar_mode", "lidar_pull"):
        told[name] = re.search(rf"`{name}` \| (\w+) \|", PAGE)[1]
    assert told == pins()


def test_addresses_and_version_are_those_of_the_scripts() -> None:
    for base in vivado.register_bases().values():
        assert base.upper().replace("0X", "0x") in PAGE
    assert f"Vivado and Vitis **{vivado.VERSION}**" in PAGE
    assert f"{len(FAULTS)} kinds of planted fault" in PAGE


@pytest.mark.parametrize("page", ["registers", "display_registers"])
def test_registers_that_are_read_or_written_by_hand_exist(page: str) -> None:
    base = vivado.register_bases()["m_axil_landing" if page == "registers" else "m_axil_display"].upper()[2:7]
    offsets = {f"{int(offset, 16):03X}" for offset in re.findall(rf"0x{base}(\w{{3}})\b", PAGE)}
    known = set(re.findall(r"^\| `0x(\w+)` \|", (ROOT / f"docs/{page}.md").read_text(), re.MULTILINE))
    assert offsets, page
    assert {offset.lstrip("0").zfill(2) for offset in offsets} <= known


def test_each_file_that_the_page_names_exists() -> None:
    names = re.findall(r"`((?:rtl|scripts|constraints|tb|firmware)/[\w./]+)`", PAGE)
    links = [link.split("#")[0] for link in re.findall(r"\]\(([^)#][^)]*)\)", PAGE)]
    missing = [name for name in names if not (ROOT / name).exists()]
    missing += [link for link in links if not (ROOT / "docs" / link).is_file()]
    assert not missing
    assert set(tomllib.loads(TABLE.read_text())["constraints"]) == {
        "constraints/arty_z7.xdc",
        "constraints/video_in.xdc",
    }

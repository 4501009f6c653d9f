# SPDX-License-Identifier: Apache-2.0
"""The board lints as the cores do; its vendor's cells stay in one file; its parts are joined without a gap."""

import re
import subprocess
import sys
from pathlib import Path

import pytest

from scripts.board import VENDOR, load_board, own_sources, vendor_files
from scripts.errors import UserError
from scripts.lint import VERIBLE_RULES, WAIVERS, YOSYS, include_flags, yosys_script
from scripts.lint_run import need
from scripts.rtl_facts import elaborate
from tb.common.cores import ROOT

TOP = "arty_z7_top"
VERILATOR = ("--lint-only", "--quiet", "-Wall", "--language", "1364-2005", *include_flags())


def lint(*command: str) -> str:
    run = subprocess.run([need(command[0]), *command[1:]], cwd=ROOT, capture_output=True, text=True, check=False)
    return (run.stdout + run.stderr).strip()


def verilator(top: str, *files: Path) -> str:
    waivers = (str(WAIVERS), str(VENDOR / "vendor.vlt"))
    return lint("verilator", *VERILATOR, "--top-module", top, *waivers, *map(str, files))


@pytest.fixture(scope="module")
def modules() -> dict[str, dict]:
    return elaborate(TOP, [*load_board().sources, *vendor_files()])


@pytest.mark.parametrize("top", [TOP, "board_video"])
def test_verilator_is_content(top: str) -> None:
    assert verilator(top, *load_board().sources, *vendor_files()) == ""


def test_icarus_is_content() -> None:
    files = map(str, [*load_board().sources, *vendor_files()])
    assert lint("iverilog", "-g2005", "-Wall", *include_flags(), "-s", TOP, "-o", "/dev/null", *files) == ""


def test_yosys_finds_no_latch_and_no_second_driver() -> None:
    # Module by module: `make lint` has the cores flat.
    files = [str(path) for path in [*load_board().sources, *vendor_files()]]
    script = yosys_script(TOP, files).replace("flatten", "select -list-mod")
    subprocess.run([sys.executable, "-c", YOSYS, script], cwd=ROOT, capture_output=True, check=True)


def test_verible_is_content() -> None:
    files = [*own_sources(), *vendor_files()]
    assert lint("verible-verilog-lint", f"--rules_config={VERIBLE_RULES}", *map(str, files)) == ""


@pytest.mark.parametrize(
    ("before", "after"),
    [
        (".S1     (select_local)", ".S1     (select_locl)"),
        (".aRst       (tx_reset),", ""),
        ("wire clk_200;", "wire [1:0] clk_200;"),
    ],
)
def test_a_slip_in_the_top_level_is_seen(before: str, after: str, tmp_path: Path) -> None:
    text = re.sub(r" +", " ", (ROOT / "rtl/top/arty_z7_top.v").read_text())
    before = re.sub(r" +", " ", before)
    assert before in text
    spoilt = tmp_path / f"{TOP}.v"
    spoilt.write_text(text.replace(before, after))
    assert verilator(TOP, *load_board().sources[:-1], spoilt, *vendor_files()) != ""


def test_cells_of_the_vendor_are_in_one_file_only() -> None:
    cells = {path.stem for path in vendor_files()}
    for path in ROOT.glob("rtl/**/*.v"):
        found = set(re.findall(r"^\s*(\w+)\s+(?:#\(|\w+\s*\()", path.read_text(), re.MULTILINE))
        assert path.stem == TOP or not found & cells, path


def test_nothing_of_the_board_is_left_open(modules: dict[str, dict]) -> None:
    for name in (TOP, "board_video"):
        (module,) = [found for kind, found in modules.items() if kind == name or f"\\{name}\\" in kind]
        for cell_name, cell in module["cells"].items():
            if cell["type"].startswith("$") and cell["type"] not in modules:
                continue
            ports = modules[cell["type"]]["ports"]
            missing = {port for port, bits in cell["connections"].items() if len(bits) != len(ports[port]["bits"])}
            assert not missing, f"{name}.{cell_name}: {missing}"
            assert set(ports) == set(cell["connections"]), f"{name}.{cell_name}"


def test_the_lidar_is_heard_at_a_pin_that_the_board_does_not_pull(modules: dict[str, dict]) -> None:
    """The core pulls while it measures: a pin that does both reads its own end of the resistor."""
    top = modules[TOP]
    assert {name: top["ports"][name]["direction"] for name in ("lidar_mode", "lidar_pull")} == {
        "lidar_mode": "input",
        "lidar_pull": "output",
    }
    assert top["cells"]["board"]["connections"]["lidar_in"] == top["ports"]["lidar_mode"]["bits"]


def test_a_core_that_is_missing_is_one_sentence(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    table = tmp_path / "board.toml"
    table.write_text('part = "x"\ntoplevel = "y"\ncores = ["rgb2gray", "nonsense"]\nsources = []\nconstraints = []\n')
    monkeypatch.setattr("scripts.board.TABLE", table)
    with pytest.raises(UserError, match="unknown core 'nonsense'"):
        load_board()
    table.write_text('part = "x"\ntoplevel = "y"\ncores = ["rgb2gray"]\nsources = ["rtl/top/no.v"]\nconstraints = []\n')
    with pytest.raises(UserError, match=r"rtl/top/no\.v, which does not exist"):
        load_board()

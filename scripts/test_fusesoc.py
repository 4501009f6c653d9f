# SPDX-License-Identifier: Apache-2.0
"""FuseSoC finds every core and lints, simulates and synthesises it; what is wrong in a core ends it with an error."""

import os
import shutil
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path

import pytest

from scripts.fusesoc import VERSION, contents, write_all
from tb.common.cores import ROOT, core_names

FOLDERS = ("rtl", "tb", "golden", "docs", "scripts")
QUICKEST = "rgb2gray"
SIMULATED = (QUICKEST, "erode3x3", "landing_regs", "result_writer")
"""Of each kind one: a core of its own, with shared modules, generated, with a generated header."""


def run(
    target: str, core: str, build: Path, *options: str, behind: Sequence[str] = (), root: Path = ROOT
) -> subprocess.CompletedProcess[str]:
    """Run a target of a core in a build folder of its own; options of the core stand behind its name."""
    path = os.pathsep.join([str(Path(sys.executable).parent), os.environ["PATH"]])
    environment = {key: value for key, value in os.environ.items() if key != "PYTHONPATH"} | {"PATH": path}
    roots = [f"--cores-root={root / folder}" for folder in FOLDERS]
    command = [
        "fusesoc",
        *roots,
        "run",
        "--clean",
        f"--target={target}",
        f"--build-root={build}",
        *options,
        f"touchdown:rtl:{core}",
        *behind,
    ]
    return subprocess.run(command, cwd=build, env=environment, capture_output=True, text=True, check=False)


@pytest.fixture
def copy(tmp_path: Path) -> Path:
    """The quickest core and what it needs, to be spoilt."""
    for folder in ("rtl/common", "rtl/generated", f"rtl/{QUICKEST}", *FOLDERS[1:]):
        shutil.copytree(ROOT / folder, tmp_path / folder, ignore=shutil.ignore_patterns("__pycache__"))
    return tmp_path


def spoil(root: Path, old: str, new: str) -> None:
    """Plant a fault into the quickest core."""
    path = root / f"rtl/{QUICKEST}/{QUICKEST}.v"
    text = path.read_text("utf-8")
    assert old in text
    path.write_text(text.replace(old, new), encoding="utf-8")


def test_core_files_are_current(tmp_path: Path) -> None:
    paths = [str(path.relative_to(tmp_path)) for path in write_all(tmp_path)]
    there = [str(path.relative_to(ROOT)) for folder in FOLDERS for path in (ROOT / folder).rglob("*.core")]
    assert sorted(paths) == sorted(there)
    old = [name for name in paths if (ROOT / name).read_text() != (tmp_path / name).read_text()]
    assert not old, f"{', '.join(old)} are not what core.toml says; run make fusesoc and commit"


def test_every_core_says_what_it_is_for() -> None:
    for name, content in contents().items():
        assert content["name"].endswith(f":{VERSION}")
        assert 10 < len(content["description"]) < 120, name
        assert not content["description"].startswith("Generated"), name
    assert {f"rtl/{name}/{name}.core" for name in core_names()} < set(contents())


@pytest.mark.parametrize("core", core_names())
def test_lint(core: str, tmp_path: Path) -> None:
    done = run("lint", core, tmp_path)
    assert done.returncode == 0, done.stderr[-2000:]
    assert "not within the directory" not in done.stderr


@pytest.mark.parametrize(
    "core", [pytest.param(core, marks=[] if core == QUICKEST else [pytest.mark.full]) for core in SIMULATED]
)
def test_simulation(core: str, tmp_path: Path) -> None:
    done = run("sim", core, tmp_path)
    assert done.returncode == 0, (done.stdout + done.stderr)[-3000:]
    assert "FAIL=0" in done.stdout + done.stderr


@pytest.mark.full
@pytest.mark.parametrize("core", core_names())
def test_every_simulation_is_built(core: str, tmp_path: Path) -> None:
    done = run("sim", core, tmp_path, "--build")
    assert done.returncode == 0, done.stderr[-2000:]


@pytest.mark.parametrize(
    "core", [pytest.param(core, marks=[] if core == QUICKEST else [pytest.mark.full]) for core in SIMULATED]
)
def test_synthesis(core: str, tmp_path: Path) -> None:
    done = run("synth", core, tmp_path)
    assert done.returncode == 0, (done.stdout + done.stderr)[-2000:]
    (netlist,) = tmp_path.rglob(f"*{core}*.json")
    assert '"FDRE"' in netlist.read_text()


def test_a_parameter_is_an_option(tmp_path: Path) -> None:
    """Zero is a width that the core refuses."""
    for line, code in (("--MAX_WIDTH=64", 0), ("--MAX_WIDTH=0", 1)):
        done = run("lint", "erode3x3", tmp_path, behind=[line])
        assert done.returncode == code, done.stderr[-2000:]


def test_a_core_that_fails_its_tests_ends_with_an_error(copy: Path) -> None:
    spoil(copy, "9798", "9797")
    done = run("sim", QUICKEST, copy, root=copy)
    assert done.returncode != 0
    assert "expected" in done.stdout + done.stderr


def test_a_core_that_verilator_warns_of_ends_with_an_error(copy: Path) -> None:
    spoil(copy, "endmodule", "wire spare = 1'b1;\nendmodule")
    done = run("lint", QUICKEST, copy, root=copy)
    assert done.returncode != 0
    assert "UNUSED" in done.stdout + done.stderr

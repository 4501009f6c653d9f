# SPDX-License-Identifier: Apache-2.0
"""What a user types: `make help`, `make doctor`, and mistakes, each of which is one sentence and a non-zero exit."""

import os
import shutil
import subprocess
from pathlib import Path

import pytest

from scripts import doctor

ROOT = Path(__file__).resolve().parent.parent


def run(*command: str, **environment: str) -> subprocess.CompletedProcess[str]:
    """Run a command from the project root, as if no `make` were running already."""
    outside = {name: value for name, value in os.environ.items() if not name.startswith("MAKE") and name != "MFLAGS"}
    return subprocess.run(
        command,
        cwd=ROOT,
        env={**outside, "TOUCHDOWN_SKIP_APT": "1", **environment},
        capture_output=True,
        text=True,
        check=False,
    )


def test_help_names_every_command() -> None:
    output = run("make", "help").stdout
    for command in ("demo", "test", "test-full", "sim", "vectors", "lint", "synth", "signoff", "doctor"):
        assert f"make {command} " in output


def test_doctor_is_content_with_the_tested_tools() -> None:
    result = run("make", "doctor")
    assert result.returncode == 0, result.stdout + result.stderr


def test_doctor_sees_a_missing_and_a_wrong_tool(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture) -> None:
    absent = doctor.Tool("absent", ("touchdown-no-such-tool",), "1.0", "nothing")
    other = doctor.Tool("make", ("make", "--version"), "99.9", "make")
    monkeypatch.setattr(doctor, "tools", lambda: [absent, other])
    assert doctor.main() == 1
    output = capsys.readouterr().out
    assert "BAD  absent" in output
    assert "wanted 99.9" in output


def test_doctor_sees_an_absent_and_a_wrong_debian_package(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(doctor, "apt_series", lambda: {"make": "4.3", "g++": "99", "touchdown-no-such-package": "1"})
    wrong, absent = doctor.debian_problems()
    assert "g++ is 12" in wrong
    assert "99 is tested" in wrong
    assert "touchdown-no-such-package is absent" in absent


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["sim", "CORE=nonsense"], ["nonsense", "gaussian5x5"]),
        (["sim", "CORE="], ["no core was named; give core= one of", "gaussian5x5"]),
        (["sim", "CORE=rgb2gray", "SIM=modelsim"], ["modelsim", "icarus", "verilator"]),
        (["sim", "CORE=rgb2gray", "SEED=abc"], ["seed"]),
        (["vectors", "CORE=nonsense"], ["nonsense", "gaussian5x5"]),
        (["vectors"], ["no core was named; give core= one of", "gaussian5x5"]),
        (["demo", "ALTITUDE=docs"], ["docs cannot be read: is a directory"]),
        (["demo", "FRAMES=no/such/folder"], ["no/such/folder"]),
        (["demo", "FIRMWARE=nonsense"], ["nonsense", "qemu", "host"]),
    ],
)
def test_a_mistake_is_one_sentence(arguments: list[str], words: list[str]) -> None:
    result = run("make", "--no-print-directory", *arguments)
    assert result.returncode != 0
    lines = [line for line in result.stderr.splitlines() if not line.startswith("make: ***")]
    assert len(lines) == 1, result.stderr
    assert lines[0].startswith("touchdown: ")
    for word in words:
        assert word in lines[0].lower()


def test_setup_without_root_prints_the_line_to_run(tmp_path: Path) -> None:
    """As an ordinary user without sudo, on a system where a package is missing."""
    project = tmp_path / "project"
    (project / "scripts").mkdir(parents=True)
    shutil.copy(ROOT / "scripts/setup.sh", project / "scripts")
    (project / "scripts/apt-packages.txt").write_text("touchdown-no-such-package 1.0\n")
    tools = tmp_path / "tools"
    tools.mkdir()
    for name in ("bash", "env", "sed", "awk", "grep", "dirname", "dpkg-query"):
        path = shutil.which(name)
        assert path is not None
        (tools / name).symlink_to(path)
    (tools / "id").write_text("#!/bin/sh\necho 1000\n")
    (tools / "id").chmod(0o755)
    result = run(str(project / "scripts/setup.sh"), PATH=str(tools), TOUCHDOWN_SKIP_APT="0")
    assert result.returncode == 1
    assert result.stderr.startswith("touchdown: ")
    assert "apt-get install -y --no-install-recommends touchdown-no-such-package" in result.stderr
    assert len(result.stderr.splitlines()) == 1

# SPDX-License-Identifier: Apache-2.0
"""The sign-off table tells passed from failed, missing, stale and exempt, and only all passed gives exit code 0."""

import os
import time
from pathlib import Path

import pytest

from scripts import signoff
from scripts.errors import UserError
from scripts.signoff import CHECKS, combine, leave, leave_part
from tb.common.cores import core_names
from tb.testplan import load_plan


@pytest.fixture
def results(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder of results in which everything passed."""
    monkeypatch.setattr(signoff, "FOLDER", tmp_path / "signoff")
    monkeypatch.setattr(signoff, "ROOT", tmp_path)
    monkeypatch.setattr(signoff, "PAGE", tmp_path / "signoff.md")
    monkeypatch.setattr("sys.argv", ["signoff"])
    sources = {core: [tmp_path / f"{core}.v"] for core in [*core_names(), "axis_skid"]}
    for source in sources.values():
        source[0].write_text("module\n")
        os.utime(source[0], (1_000_000_000, 1_000_000_000))
    monkeypatch.setattr(signoff, "sources_of", sources.__getitem__)
    for core in core_names():
        for check in CHECKS:
            if check not in load_plan()[core].get("exempt", {}):
                leave(core, check, True, f"{core} {check}", {})
    return tmp_path


def test_all_passed(results: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert signoff.main() == 0
    assert "0 failed, 0 stale, 0 missing" in capsys.readouterr().out


def test_a_failure_is_seen(results: Path, capsys: pytest.CaptureFixture[str]) -> None:
    leave("ccl", "area", False, "9999 LUT", {})
    assert signoff.main() == 1
    assert "area       FAILED: 9999 LUT" in capsys.readouterr().out


def test_a_missing_check_is_seen(results: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (results / "signoff/area/ccl.json").unlink()
    assert signoff.main() == 1
    assert "area       missing" in capsys.readouterr().out


def test_a_change_after_the_check_is_seen(results: Path, capsys: pytest.CaptureFixture[str]) -> None:
    later = time.time() + 100
    os.utime(results / "ccl.v", (later, later))
    assert signoff.main() == 1
    assert "area       stale: ccl area" in capsys.readouterr().out


@pytest.mark.parametrize("text", ["", "[]", '{"core": "ccl"}'])
def test_an_unreadable_result_is_one_sentence(results: Path, text: str) -> None:
    (results / "signoff/area/ccl.json").write_text(text)
    with pytest.raises(UserError, match=r"ccl\.json is no result"):
        signoff.main()


def test_the_result_of_another_core_is_refused(results: Path) -> None:
    source = results / "signoff/area/erode3x3.json"
    (results / "signoff/area/ccl.json").write_text(source.read_text())
    with pytest.raises(UserError, match="something else"):
        signoff.main()


def test_an_unknown_check_is_refused(results: Path) -> None:
    with pytest.raises(ValueError, match="unknown check"):
        leave("ccl", "weather", True, "fine", {})


def test_a_shared_module_has_a_row_of_its_own(results: Path) -> None:
    leave("axis_skid", "formal", False, "1 proof", {})
    assert signoff.read_table()["axis_skid"]["formal"].state == "failed"
    assert signoff.read_table()["axis_skid"]["area"].state == "exempt"


def test_the_page_has_every_row(results: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("sys.argv", ["signoff", "--write"])
    assert signoff.main() == 0
    text = (results / "signoff.md").read_text()
    for core in core_names():
        assert f"| {core} | {core} matrix |" in text


def test_parts_are_summed_up_when_all_are_there(results: Path) -> None:
    def state() -> tuple[str, str]:
        combine("ccl", "exhaustive", ["a", "b"], "{count} frames")
        cell = signoff.read_cell("ccl", "exhaustive", {})
        return cell.state, cell.text

    leave_part("ccl", "exhaustive", "a", True, 1000)
    assert state() == ("missing", "incomplete: 1,000 frames (1 of 2 runs)")
    leave_part("ccl", "exhaustive", "b", False, 1)
    assert state() == ("failed", "FAILED: 1,001 frames")
    (results / "signoff/parts/exhaustive/ccl/a.json").unlink()
    assert state() == ("failed", "FAILED: 1 frames (1 of 2 runs)")
    leave_part("ccl", "exhaustive", "a", True, 1000)
    leave_part("ccl", "exhaustive", "b", True, 500)
    assert state() == ("passed", "1,500 frames")
    old = results / "signoff/parts/exhaustive/ccl/a.json"
    os.utime(old, (900_000_000, 900_000_000))
    assert state() == ("missing", "incomplete: 500 frames (1 of 2 runs)")

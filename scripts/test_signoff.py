# SPDX-License-Identifier: Apache-2.0
"""The sign-off table tells passed from failed, missing, stale and exempt, and only all passed gives exit code 0."""

from pathlib import Path

import pytest

from scripts import signoff
from scripts.errors import UserError
from scripts.signoff import CHECKS, Cell, combine, leave, leave_part

ROOT = signoff.ROOT


@pytest.fixture
def results(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder of results in which everything passed; the one file that a core depends on is <core>.v beside it."""

    def digest(core: str, _: str) -> str:
        return (tmp_path / f"{core}.v").read_text()

    monkeypatch.setattr(signoff, "FOLDER", tmp_path / "signoff")
    monkeypatch.setattr(signoff, "ROOT", tmp_path)
    monkeypatch.setattr(signoff, "PAGE", tmp_path / "signoff.md")
    monkeypatch.setattr(signoff, "digest", digest)
    monkeypatch.setattr("sys.argv", ["signoff"])
    for core, exempt in signoff.rows().items():
        (tmp_path / f"{core}.v").write_text("module")
        for check in CHECKS:
            if check not in exempt:
                leave(core, check, True, f"{core} {check}", {})
    return tmp_path


def test_all_passed(results: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert signoff.main() == 0
    assert "0 failed, 0 stale, 0 missing" in capsys.readouterr().out


def test_a_failure_is_seen(results: Path, capsys: pytest.CaptureFixture[str]) -> None:
    leave("ccl", "area", False, "9999 LUT", {})
    assert signoff.main() == 1
    assert "area       FAILED: 9999 LUT" in capsys.readouterr().out


@pytest.mark.parametrize(("core", "check"), [("ccl", "area"), ("axis_skid", "formal")])
def test_a_missing_check_is_seen(results: Path, core: str, check: str) -> None:
    (results / f"signoff/{check}/{core}.json").unlink()
    assert signoff.main() == 1
    assert signoff.read_table()[core][check] == Cell("missing", "missing")


def test_a_check_that_was_not_finished_is_missing(results: Path) -> None:
    leave("ccl", "mutation", False, "3 of 9", {}, incomplete=True)
    assert signoff.read_table()["ccl"]["mutation"] == Cell("missing", "incomplete: 3 of 9")


def test_a_change_after_the_check_is_seen(results: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (results / "ccl.v").write_text("other")
    assert signoff.main() == 1
    assert "area       stale: ccl area" in capsys.readouterr().out
    (results / "ccl.v").write_text("module")
    assert signoff.main() == 0


def test_a_change_during_the_check_is_seen(results: Path) -> None:
    leave("ccl", "area", True, "9 LUT", {}, inputs="hash of before")
    assert signoff.read_table()["ccl"]["area"] == Cell("stale", "stale: 9 LUT")


def test_a_result_without_a_hash_does_not_count(results: Path) -> None:
    path = results / "signoff/area/ccl.json"
    path.write_text(path.read_text().replace('"inputs"', '"other"'))
    assert signoff.read_table()["ccl"]["area"].state == "stale"


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
    (results / "ccl.v").write_text("other")
    leave_part("ccl", "exhaustive", "b", True, 400)
    assert state() == ("missing", "incomplete: 400 frames (1 of 2 runs)")


def cells_of(page: str) -> dict[str, dict[str, str]]:
    """The table of a page: row and column to text."""
    lines = [line.strip("| ").split(" | ") for line in page.splitlines() if line.startswith("| ")]
    head, _, *body = lines
    return {row[0]: dict(zip(head[1:], row[1:], strict=True)) for row in body}


def test_the_page_has_every_result(results: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("sys.argv", ["signoff", "--write"])
    assert signoff.main() == 0
    table = cells_of((results / "signoff.md").read_text())
    for core, exempt in signoff.rows().items():
        assert table[core] == {check: "-" if check in exempt else f"{core} {check}" for check in CHECKS}


def test_the_page_of_the_project_has_every_core_and_check() -> None:
    """Nor more than these, and '-' only for what the plan exempts: figures may be old, rows and columns not."""
    page = ROOT / "docs/signoff.md"
    assert page.is_file(), "docs/signoff.md is missing: run `python -m scripts.signoff --write` and commit it"
    table = cells_of(page.read_text(encoding="utf-8"))
    expected = {(core, check): check in exempt for core, exempt in signoff.rows().items() for check in CHECKS}
    written = {(core, check): text == "-" for core, line in table.items() for check, text in line.items()}
    wrong = sorted(set(expected.items()) ^ set(written.items()))
    assert not wrong, f"docs/signoff.md is old at {wrong}; run `python -m scripts.signoff --write`"

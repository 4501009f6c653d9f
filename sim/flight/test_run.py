# SPDX-License-Identifier: Apache-2.0
"""The command that flies one landing."""

from pathlib import Path
from xml.etree import ElementTree

import pytest

from scripts.errors import UserError
from sim.flight.picture import landing_svg
from sim.flight.run import main


def test_a_landing_is_told_and_drawn(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["--profile", "px4", "--gusts", "0.3", "--seed", "2", "--out", str(tmp_path)]) == 0
    said = capsys.readouterr().out
    assert "down, motors off" in said
    assert "cm from the pad's centre" in said
    texts = [element.text for element in ElementTree.parse(tmp_path / "landing.svg").iter() if element.text]
    for phase in ("STANDBY", "CENTRE", "DESCEND", "ALIGN", "LAND", "LANDED"):
        assert phase in texts


def test_a_landing_that_does_not_end_is_an_error(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("sim.flight.run._LIMIT_S", 6.0)
    assert main(["--out", str(tmp_path)]) == 1


@pytest.mark.parametrize(
    ("arguments", "message"), [(["--gusts", "9"], "too many"), (["--profile", "x"], "invalid choice")]
)
def test_what_is_wrong_is_one_sentence(arguments: list[str], message: str) -> None:
    with pytest.raises(UserError, match=message):
        main(arguments)


def test_picture_has_a_band_for_each_phase() -> None:
    track = [(0.1 * index, 1.0, 0.0, 2.0 - 0.1 * index, 0.0) for index in range(20)]
    svg = landing_svg("title <", track, [(0.0, "ONE"), (1.0, "TWO")])
    root = ElementTree.fromstring(svg)
    bands = [element for element in root if element.get("class") in ("band", "other")]
    assert len(bands) == 2
    assert float(bands[0].get("width")) > float(bands[1].get("width")) > 0

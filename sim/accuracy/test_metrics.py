# SPDX-License-Identifier: Apache-2.0
"""Figures, intervals and goals on rows made by hand."""

from pathlib import Path

import numpy as np
import pytest

from scripts.demo_results import Pad
from scripts.errors import UserError
from sim.accuracy.goals import MET, NOT_MET, OPEN, Goal, judge, load_goals
from sim.accuracy.metrics import bootstrap_mean, curve, ends_at, summarise, wilson
from sim.accuracy.rows import Reference, Row, read_rows, write_rows
from sim.accuracy.run import PHOTOS, choose
from sim.accuracy.tables import HEAD, as_html, as_markdown, as_text, set_lines

TRUTH = Reference(True, True, 100.0, 50.0, 170.0, 0.5, -0.25, 1.0)
NO_PAD = Reference(present=False)


def row(
    name: str = "a",
    pad: Pad | None = None,
    reference: Reference = TRUTH,
    set_name: str = "s",
    strength: float | None = None,
) -> Row:
    return Row(set_name, name, "-", strength, reference, pad, 1.0, 10, 0, 100)


def pad(dx: float = 0.0, dy: float = 0.0, turn: float = 0.0, right_m: float = 0.0) -> Pad:
    return Pad(100.0 + dx, 50.0 + dy, 170.0 + turn, 0.5 + right_m, -0.25)


def test_errors_of_one_row() -> None:
    seen = row(pad=pad(0.3, -0.4, 20.0 - 360.0 - 16.0, 0.003))
    assert seen.error_x_px == pytest.approx(0.3)
    assert seen.error_y_px == pytest.approx(-0.4)
    assert seen.error_px == pytest.approx(0.5)
    assert seen.error_deg == pytest.approx(4.0)
    assert seen.error_m == pytest.approx(0.003)
    assert seen.position_share == pytest.approx(0.003 / 0.015)


@pytest.mark.parametrize(
    ("seen", "found", "false", "missed"),
    [
        (row(pad=pad(3.0, 3.9)), True, False, False),
        (row(pad=pad(3.1, 4.0)), False, True, True),
        (row(pad=pad(turn=4.9)), True, False, False),
        (row(pad=pad(turn=5.1)), False, True, True),
        (row(), False, False, True),
        (row(reference=NO_PAD), False, False, False),
        (row(pad=pad(), reference=NO_PAD), False, True, False),
        (row(reference=Reference()), False, False, False),
        (row(pad=pad(), reference=Reference()), True, False, False),
        (row(reference=Reference(True, False, 100.0, 50.0, 170.0)), False, False, False),
    ],
)
def test_found_false_or_missed(seen: Row, found: bool, false: bool, missed: bool) -> None:
    assert (seen.found, seen.false, seen.missed) == (found, false, missed)


def test_summary() -> None:
    rows = [
        row("a", pad(0.1, 0.2, 1.0)),
        row("b", pad(-0.3, 0.0, -2.0)),
        row("far", pad(40.0)),
        row("none"),
        row("empty", reference=NO_PAD),
    ]
    figures = summarise(rows)
    assert (figures.frames, figures.required, figures.found, figures.false) == (5, 4, 2, 1)
    assert figures.missed == ("far", "none")
    assert figures.longest_gap == 2
    assert figures.mean_x_px == pytest.approx(0.2)
    assert figures.mean_y_px == pytest.approx(0.1)
    assert figures.max_px == pytest.approx(0.3)
    assert figures.mean_deg == pytest.approx(1.5)
    assert figures.max_deg == pytest.approx(2.0)
    nothing = summarise([row("empty", reference=NO_PAD)])
    assert nothing.mean_x_px is None
    assert nothing.max_share is None


def test_wilson_is_that_of_the_textbook() -> None:
    # Newcombe 1998, table I: 81 of 263, 15 of 148, 0 of 20, 1 of 29.
    for successes, trials, low, high in ((81, 263, 0.2553, 0.3662), (15, 148, 0.0624, 0.1605), (0, 20, 0, 0.1611)):
        assert wilson(successes, trials) == pytest.approx((low, high), abs=5e-5)
    assert wilson(29, 29)[1] == 1.0
    for successes, trials in ((0, 0), (3, 2), (-1, 2)):
        with pytest.raises(ValueError, match="is no rate"):
            wilson(successes, trials)


def test_bootstrap_covers_the_mean_as_often_as_it_says() -> None:
    random = np.random.default_rng(3)
    intervals = [bootstrap_mean(random.exponential(1.0, 60), seed) for seed in range(200)]
    covered = sum(low <= 1.0 <= high for low, high in intervals)
    assert 176 <= covered <= 198
    assert bootstrap_mean([0.5, 0.5]) == (0.5, 0.5)
    assert bootstrap_mean([1.0, 2.0, 4.0]) == bootstrap_mean([1.0, 2.0, 4.0])
    with pytest.raises(ValueError, match="no mean"):
        bootstrap_mean([])


def sweep(rates: list[int]) -> list[Row]:
    """Ten frames a strength 0, 1, ..., of which so many are found."""
    return [
        row(f"{strength}-{index}", pad(0.1 * strength) if index < rate else None, strength=float(strength))
        for strength, rate in enumerate(rates)
        for index in range(10)
    ]


def test_curve_and_where_it_ends() -> None:
    points = curve(sweep([10, 10, 6, 0]))
    assert [point.strength for point in points] == [0, 1, 2, 3]
    assert [point.rate for point in points] == [1, 1, 0.6, 0]
    assert points[1].error_px == pytest.approx(0.1)
    assert points[3].error_px is None
    assert points[2].rate_low < 0.6 < points[2].rate_high
    assert ends_at(points, 0.95) == pytest.approx(1 + 0.05 / 0.4)
    assert ends_at(points, 0.5) == pytest.approx(2 + 0.1 / 0.6)
    assert ends_at(points[:2], 0.95) is None
    assert ends_at(points[3:], 0.5) == 3


def test_rows_come_back_from_their_file(tmp_path: Path) -> None:
    rows = [row("a", pad(0.1)), row("b", reference=NO_PAD, strength=2.5), row("c", reference=Reference())]
    write_rows(tmp_path / "deep" / "rows.jsonl", rows)
    assert read_rows(tmp_path / "deep" / "rows.jsonl") == rows


@pytest.mark.parametrize("text", ['{"set": "s"}\n', "no json\n", "[]\n"])
def test_a_file_of_other_rows_is_one_sentence(text: str, tmp_path: Path) -> None:
    (tmp_path / "rows.jsonl").write_text(text)
    with pytest.raises(UserError, match="run `make accuracy` again"):
        read_rows(tmp_path / "rows.jsonl")


def test_goals_are_met_not_met_or_open() -> None:
    rows = [
        row("a", pad(0.1), set_name="photos:x"),
        row("b", pad(0.3), set_name="photos:y"),
        row("c", None, set_name="other"),
    ]

    def state(**fields: object) -> str:
        return judge(
            [Goal(**{"name": "g", "sets": ("photos:*",), "metric": "mean_x_px", "most": 0.2, **fields})], rows
        )[0].state

    assert state(most=0.2001) == MET
    assert state(most=0.1999) == NOT_MET
    assert state(sets=("photos:x",), most=0.1999) == MET
    assert state(most=0.2001, frames=3) == OPEN
    assert state(most=0.1999, frames=3) == NOT_MET
    assert state(sets=("absent",)) == OPEN
    assert state(metric="missing", most=0) == MET
    assert state(metric="missing", most=0, sets=("*",)) == NOT_MET
    with pytest.raises(ValueError, match="does not exist"):
        state(metric="beauty")


def test_every_goal_speaks_of_sets_that_exist() -> None:
    from sim.accuracy.rendered import SETS

    assert load_goals()
    for goal in load_goals():
        for pattern in goal.sets:
            assert pattern in {"photos:*", "sweep:*", *SETS}, f"{goal.name}: {pattern}"


def test_one_table_as_text_markdown_and_html() -> None:
    rows = [row("a", pad(0.1), set_name="photos:x"), row("<b>", None, set_name="photos:y")]
    lines = set_lines(rows, "photos:")
    assert [line[0] for line in lines] == ["photos:x", "photos:y", "photos:* together", "  difficulty -"]
    text = as_text(HEAD, lines).splitlines()
    assert len({line.index("frames") for line in text[:1]}) == 1
    assert text[2].startswith("photos:x ")
    assert as_markdown(HEAD, lines).count("\n") == len(lines) + 1
    assert "&lt;b&gt;" in as_html(HEAD, lines)


def test_wrong_choices_are_one_sentence() -> None:
    for arguments, words in (
        ((["sahrp"], None, None, None), "there is no rendered set 'sahrp'; choose from: sharp"),
        (([PHOTOS], None, None, None), "give FRAMES=folder"),
        ((["sharp"], None, None, 0), "COUNT is 0"),
    ):
        with pytest.raises(UserError, match=words):
            choose(*arguments)

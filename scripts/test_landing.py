# SPDX-License-Identifier: Apache-2.0
"""The landing's table: what is generated from it is current, and it has an answer for everything."""

from pathlib import Path

import pytest

from scripts.errors import UserError
from scripts.landing.generate import FILES, write_all
from scripts.landing.model import SOURCE, Landing, load
from scripts.landing.page import FAILURES, answer

ROOT = Path(__file__).resolve().parents[1]


@pytest.fixture(scope="module")
def landing() -> Landing:
    return load(ROOT / SOURCE)


def test_generated_files_are_current(tmp_path: Path) -> None:
    write_all(ROOT, tmp_path)
    old = [name for name in FILES if (ROOT / name).read_text() != (tmp_path / name).read_text()]
    assert not old, f"{', '.join(old)} differ from {SOURCE}; run make landing and commit"


def test_every_phase_can_be_reached_and_left(landing: Landing) -> None:
    reached = {"STANDBY"}
    for _ in landing.phases:
        reached |= {rule.to for rule in landing.rules if reached & set(rule.sources)}
    assert reached == {phase.name for phase in landing.phases}
    for phase in landing.phases:
        assert any(rule.to != phase.name for rule in landing.rules if phase.name in rule.sources), phase.name


def test_no_rule_is_hidden_by_those_before_it(landing: Landing) -> None:
    """With just its own facts each rule counts, in each of its phases."""
    for rule in landing.rules:
        for phase in rule.sources:
            armed = set() if "ARMED" in rule.unless else {"ARMED"}
            assert landing.next(phase, frozenset(armed | set(rule.when))) == rule, f"{phase}: {rule.reason}"


def test_a_phase_that_commands_lets_go_of_pilot_and_silent_autopilot_first(landing: Landing) -> None:
    """Whatever else holds, but that it is down with its motors off: then nothing is commanded either."""
    everything = frozenset(fact.name for fact in landing.facts)
    for phase in landing.phases:
        if phase.mode != "none":
            assert landing.next(phase.name, everything).to == "STANDBY", phase.name
            assert landing.next(phase.name, everything - {"PILOT"}).to == "STANDBY", phase.name
            assert landing.phase(landing.next(phase.name, everything - {"ARMED"}).to).mode == "none", phase.name


@pytest.mark.parametrize("phase", ["LAND", "TOUCHDOWN"])
@pytest.mark.parametrize("down", ["ON_GROUND", "COMMITTED"])
def test_down_with_motors_off_is_landed_whatever_mode_comes_with_it(landing: Landing, phase: str, down: str) -> None:
    """An autopilot may leave its landing mode as it disarms."""
    assert landing.next(phase, frozenset({down, "PILOT", "AUTOPILOT_SILENT"})).to == "LANDED"
    assert landing.next(phase, frozenset({down, "PILOT", "ARMED"})).to == "STANDBY"
    assert landing.next(phase, frozenset({"PILOT"})).to == "STANDBY"


@pytest.mark.parametrize("failure", FAILURES)
def test_a_phase_that_steers_answers_each_failure(landing: Landing, failure: str) -> None:
    """ENGAGE does not steer yet; SEARCH and CLIMB look for a pad that is lost; HOLD and WAIT stand still already."""
    for phase in landing.phases:
        if phase.steer in ("centre", "descend", "align"):
            assert answer(landing, phase, failure) not in ("goes on", "stays"), f"{phase.name}: {failure}"


def test_every_phase_that_commands_has_a_limit_and_an_end(landing: Landing) -> None:
    """Or it waits for a mode alone: test_waits_for_a_mode in test_flight.c says how long that takes."""
    for phase in landing.phases:
        if phase.mode != "none" and phase.limit_s > 0:
            assert landing.next(phase.name, frozenset({"ARMED", "TIME_OUT"})) is not None, phase.name
        elif phase.mode != "none":
            for ends in ("IN_MODE", "REFUSED"):
                assert landing.next(phase.name, frozenset({"ARMED", ends})) is not None, phase.name
    for rule in landing.rules:
        if "TIME_OUT" in rule.when:
            assert all(landing.phase(phase).limit_s > 0 for phase in rule.sources), rule.reason


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ('to = "ENGAGE"', 'to = "ENGAGED"', "which is not defined"),
        ('mode = "hold"', 'mode = "sleep"', "there is not"),
        ('mode = "hold", steer = "stop"', 'mode = "hold", steer = "climb"', "does not take"),
        ('mode = "none", steer = "none"', 'mode = "none", steer = "stop"', "does not take"),
        ('mode = "steer", steer = "stop"', 'mode = "steer", steer = "none"', "does not take"),
        ('reason = "start"', 'reason = "a reason that is too long to be read on the ground"', "longer than"),
        ("phases = [", "phases = [[", "is no TOML"),
        ("says =", "tells =", "lacks or misspells"),
    ],
)
def test_a_wrong_table_is_one_sentence(tmp_path: Path, old: str, new: str, message: str) -> None:
    path = tmp_path / "landing.toml"
    path.write_text((ROOT / SOURCE).read_text().replace(old, new))
    with pytest.raises(UserError, match=message):
        load(path)


def test_no_table_is_one_sentence(tmp_path: Path) -> None:
    with pytest.raises(UserError, match="is not there"):
        load(tmp_path / "nothing.toml")

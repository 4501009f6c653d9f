# SPDX-License-Identifier: Apache-2.0
"""The golden path says what the RTL path says; what settles before a picture counts; attitude; the variants."""

import math
from dataclasses import replace
from functools import partial
from pathlib import Path

import cv2
import numpy as np
import pytest

from firmware.library import make
from golden.chain import PAPER, Settings, run_chain
from scripts.demo_decode import Line
from scripts.demo_results import Pad
from scripts.errors import UserError
from sim.accuracy.measure import measure_golden, rows_of
from sim.accuracy.options import compare, lines, load_variants
from sim.accuracy.paper_rules import find_pad, ring_width_px
from sim.accuracy.paths import Answer, golden, rtl, settled
from sim.accuracy.photos import photo_units
from sim.accuracy.rendered import rendered_units
from sim.accuracy.rows import Reference, Row
from sim.accuracy.shots import SHOWINGS_LEAST, SHOWINGS_MOST, SHOWINGS_STEADY, Film, Shot, Unit, develop
from sim.cosim.build import build_host
from sim.views import views
from sim.world.camera import Camera
from sim.world.clip import demo_clip
from sim.world.pose import Pose, truth_of
from sim.world.renderer import Look, render

SHADOW = 0.5
UNTRACKED = "production without the tracker"
TIMES = {"start_time_us", "scan_time_us", "altitude_age_us"}


@pytest.fixture(scope="module", autouse=True)
def built() -> None:
    make("host")


def drawn(pose: Pose, look: Look, seed: int) -> tuple[np.ndarray, Reference]:
    image, truth = render(pose, look, seed=seed)
    return image, Reference(True, True, truth.x_px, truth.y_px, truth.angle_deg)


def shot(name: str, pose: Pose, look: Look, seed: int) -> Shot:
    attitude_rad = (math.radians(pose.roll_deg), math.radians(pose.pitch_deg))
    return Shot(name, partial(drawn, pose, look, seed), truth_of(Camera(), pose).lidar_m, attitude_rad=attitude_rad)


def descent() -> Film:
    """Three frames of a descent, so near to each other that the pad is followed from one to the next."""
    frames = demo_clip(16)[:3]
    shots = tuple(shot(str(index), frame.pose, frame.look, frame.seed) for index, frame in enumerate(frames))
    return develop(Unit("descent", shots, clip=True))


def said(line: Line) -> list[tuple[str, dict]]:
    """What answers frames, but for the time."""
    fields = [(message.kind, {**message.fields, "time_usec": 0}) for message in line.messages]
    return [
        (kind, values)
        for kind, values in fields
        if kind == "LANDING_TARGET" or (kind == "DEBUG_FLOAT_ARRAY" and values["name"].startswith("PAD"))
    ]


def assert_same(one: Answer, other: Answer) -> None:
    """Both paths gave the same records and messages, but for times."""
    assert said(one.ground) == said(other.ground)
    assert said(one.autopilot) == said(other.autopilot)
    for a, b in zip(one.frames, other.frames, strict=True):
        different = [
            name for name in a.record["header"].dtype.names if a.record["header"][name] != b.record["header"][name]
        ]
        assert set(different) <= TIMES
        count = int(a.record["header"]["object_count"])
        assert (a.record["objects"][:count] == b.record["objects"][:count]).all()


def test_golden_and_rtl_say_the_same_of_a_clip(tmp_path: Path) -> None:
    build_host()
    film = descent()
    one, other = golden(film), rtl(film, tmp_path)
    assert len(said(one.ground)) == 4
    assert len(said(one.autopilot)) == 3
    assert len({int(frame.record["header"]["min_area"]) for frame in one.frames}) > 1, "MIN_AREA never moved"
    assert_same(one, other)


@pytest.mark.full
def test_golden_and_rtl_say_the_same_while_factors_are_tried(tmp_path: Path) -> None:
    build_host()
    film = settled(shadowed(26))
    one, other = golden(film), rtl(film, tmp_path)
    assert len(set(factors(one))) > 1
    assert factors(one) == factors(other)
    assert_same(one, other)


@pytest.mark.full
@pytest.mark.parametrize("index", range(4))
def test_golden_and_rtl_say_the_same_of_a_picture(index: int, tmp_path: Path) -> None:
    build_host()
    view = views(4, seed=5)[index]
    film = settled(develop(Unit("view", (shot("view", view.pose, view.look, view.seed),))))
    one, other = golden(film), rtl(film, tmp_path)
    # As many as it takes: two of the four are seen with another threshold factor than the usual one.
    assert len(one.frames) >= SHOWINGS_LEAST
    assert_same(one, other)


@pytest.mark.parametrize("image", [np.full((720, 1280, 3), 90, np.uint8), None])
def test_min_area_has_settled_when_a_picture_counts(image: np.ndarray | None) -> None:
    if image is None:
        # Specks of 160 px, more than a record holds: MIN_AREA goes the other way.
        image = np.full((720, 1280, 3), 220, np.uint8)
        for x in range(20, 1260, 40):
            for y in range(20, 700, 40):
                image[y : y + 13, x : x + 13] = 30
    film = develop(Unit("s", (Shot("a", lambda: (image, Reference()), 1.0),), showings=SHOWINGS_LEAST + 3))
    seen = [int(frame.record["header"]["min_area"]) for frame in golden(film).frames]
    assert len(set(seen)) > 1
    assert len(set(seen[SHOWINGS_LEAST - 1 :])) == 1, seen


def shadowed(showings: int) -> Film:
    """A pad half of which lies in a shadow that the usual threshold factor does not see through."""
    (unit,) = (one for one in rendered_units("sweep:shadow_edge", 1) if one.shots[0].strength == SHADOW)
    return develop(replace(unit, showings=showings))


def factors(answer: Answer) -> list[int]:
    """What the frames were told."""
    return [int(frame.record["header"]["threshold_factor"]) for frame in answer.frames]


def test_the_golden_path_takes_the_factor_that_the_firmware_asks_for() -> None:
    film = shadowed(SHOWINGS_MOST)
    answer = golden(film)
    told = factors(answer)
    change = told.index(160)
    assert set(told[:change]) == {128}
    assert 19 <= change <= 23, "after 18 frames with thresholds, once the search has looked at all places"
    assert answer.seen[0].pad is not None
    assert told[-1] != 128
    assert [one.pad is not None for one in answer.before[-SHOWINGS_STEADY:]] == [False] + [True] * (SHOWINGS_STEADY - 1)
    assert golden(replace(film, unit=replace(film.unit, showings=SHOWINGS_LEAST))).seen[0].pad is None
    assert set(factors(golden(film, Settings(factor=64)))) == {64}


def test_a_second_shows_every_factor_and_the_usual_one_again() -> None:
    blank = Shot("a", lambda: (np.full((720, 1280, 3), 90, np.uint8), Reference()), 1.0)
    told = factors(golden(develop(Unit("s", (blank,)))))
    assert set(told[:54]) == {128, 160, 208, 96, 72, 200}
    assert told[54:] == [128] * 6


def test_rendered_frames_have_an_attitude_that_is_nearly_right_and_photographs_none(tmp_path: Path) -> None:

    def errors_deg(name: str, count: int) -> np.ndarray:
        shots = [one for unit in rendered_units(name, count) for one in unit.shots]
        poses = [one.draw.args[0].pose for one in shots]
        return np.degrees([one.attitude_rad for one in shots]) - [(pose.roll_deg, pose.pitch_deg) for pose in poses]

    off = errors_deg("sharp", 80)
    assert abs(off.mean()) < 0.12
    assert off.std() == pytest.approx(0.4, rel=0.2)
    assert errors_deg("descent", 3)[0] != pytest.approx(errors_deg("descent", 3)[1])
    assert np.ptp(errors_deg("sweep:tilt", 1), axis=0) == pytest.approx(0.0)
    cv2.imwrite(str(tmp_path / "a.png"), np.zeros((720, 1280, 3), np.uint8))
    assert photo_units(str(tmp_path), "1.0")[0].shots[0].attitude_rad is None


def test_attitude_reaches_the_firmware() -> None:
    """An attitude that is wrong by 20 degrees moves the centre, and is left out where it is to be."""
    film = descent()
    shots = tuple(replace(one, attitude_rad=(0.35, 0.0)) for one in film.unit.shots)
    wrong = replace(film, unit=replace(film.unit, shots=shots))
    assert said(golden(film).ground) != said(golden(wrong).ground)
    assert said(golden(film, attitude=False).ground) == said(golden(wrong, attitude=False).ground)


def test_a_blinded_clip_is_bridged_by_the_tracker() -> None:
    (unit,) = rendered_units("blinded")
    unit = replace(unit, shots=unit.shots[:16])
    variants = [variant for variant in load_variants() if variant.name in ("production", UNTRACKED)]
    tracked, untracked = ([row.name for row in rows if row.missed] for rows in compare(unit, variants))
    assert tracked == []
    # Without the tracker each frame is searched anew, and a search may take two.
    assert {"0011", "0012"} < set(untracked)
    assert len(untracked) <= 8


def test_after_a_step_of_light_one_frame_is_missed() -> None:
    (unit,) = rendered_units("light_step")
    unit = replace(unit, shots=unit.shots[9:18])
    (production,) = [variant for variant in load_variants() if variant.name == "production"]
    (rows,) = compare(unit, [production])
    # 0009 is the first of all and has no thresholds; at 0010 and 0015 the light steps.
    assert [row.name for row in rows if row.missed] == ["0010", "0015"]


def test_a_picture_counts_after_it_has_settled_and_a_clip_frame_by_frame() -> None:
    film = descent()
    answer = golden(film)
    assert [one.name for one in answer.seen] == ["0", "1", "2"]
    assert [int(one.record["header"]["frame_number"]) for one in answer.seen] == [2, 3, 4]
    for one, known in zip(answer.seen, film.references, strict=True):
        assert one.pad is not None
        assert abs(one.pad.x_px - known.x_px) < 0.5
    picture = develop(Unit("s", film.unit.shots[2:]))
    assert [int(one.record["header"]["frame_number"]) for one in golden(picture).seen] == [SHOWINGS_LEAST]


def test_a_false_pad_counts_in_any_showing() -> None:
    pose = Pose(1.0, 0.2, -0.1, 30.0)

    def unlike() -> tuple[np.ndarray, Reference]:
        image, reference = drawn(pose, Look(), 3)
        return image, replace(reference, present=False)

    film = develop(Unit("s", (Shot("a", unlike, 1.0),)))
    answer = golden(film)
    pads = [one.pad is not None for one in (*answer.before, *answer.seen)]
    (row,) = rows_of(film, answer)
    assert row.strays == sum(pads) - 1 >= SHOWINGS_STEADY - 1
    # The last showing without one does not make it good.
    (late,) = rows_of(film, replace(answer, seen=[replace(answer.seen[0], pad=None)]))
    assert late.pad is None
    assert late.false
    (clean,) = rows_of(film, replace(answer, seen=[replace(answer.seen[0], pad=None)], before=answer.before[:1]))
    assert (clean.strays, clean.false) == (0, False)


def test_the_papers_rules() -> None:
    pose = Pose(altitude_m=1.0, right_m=0.2, forward_m=-0.1, pad_yaw_deg=30.0)
    image, truth = render(pose, Look(noise_sigma=0.5))
    objects = run_chain(image, run_chain(image, None, PAPER).stats, PAPER).objects
    found = find_pad(objects, pose.altitude_m)
    assert found is not None
    assert np.hypot(found.x_px - truth.x_px, found.y_px - truth.y_px) < 3
    assert abs(found.angle_deg - truth.angle_deg) < 3
    assert (found.right_m, found.forward_m) == pytest.approx((0.2, -0.1), abs=0.02)
    # An altitude that is wrong by three makes all shapes too small.
    assert find_pad(objects, pose.altitude_m / 3) is None
    assert find_pad(objects[:0], pose.altitude_m) is None


def test_width_of_the_ring_is_that_of_the_camera() -> None:
    for altitude_m in (0.3, 1.0, 3.0):
        left, right = Camera().project(np.array([[-0.125, 0.0, altitude_m], [0.125, 0.0, altitude_m]]))
        assert ring_width_px(altitude_m) == pytest.approx(right[0] - left[0])


def test_variants_name_options_of_the_firmware_and_registers(tmp_path: Path) -> None:
    variants = {variant.name: variant for variant in load_variants()}
    production = variants["production"]
    assert (production.paper, production.settings, production.options) == (False, Settings(), None)
    assert [variant.name for variant in variants.values() if variant.paper and variant.settings == PAPER]
    for text, words in (
        ('[[variant]]\nname = "x"\nwithout = ["DETECT_LUCK"]\n', "DETECT_LUCK, which firmware/core/detect.h"),
        ('[[variant]]\nname = "x"\nfaktor = 3\n', "faktor, which is no register"),
    ):
        (tmp_path / "o.toml").write_text(text)
        with pytest.raises(UserError, match=words):
            load_variants(tmp_path / "o.toml")


def test_table_of_variants() -> None:
    def row(set_name: str, pad: Pad | None, reference: Reference) -> Row:
        return Row(set_name, "a", "-", None, reference, pad, 1.0, 0, 0, 30)

    truth = Reference(True, True, 10.0, 20.0, 0.0)
    good = row("photos:a", Pad(10.5, 20.25, 0.0, 0.0, 0.0), truth)
    false = row("negatives", Pad(1.0, 2.0, 3.0, 0.0, 0.0), Reference(False))
    missed = row("photos:b", None, truth)
    head, table = lines([("one", [good, missed, false]), ("two", [missed])])
    assert head[1:] == ("photos", "negatives")
    assert table[0] == ("one", "1 of 2; 0 false; 0.50 / 0.25", "1 false")
    assert table[1] == ("two", "0 of 1; 0 false", "0 false")


def test_variants_of_one_unit_are_what_each_gives_alone() -> None:
    unit = Unit("s", (shot("a", Pose(1.0, 0.2, -0.1, 30.0), Look(noise_sigma=0.5), 3),))
    variants = load_variants()
    by_name = {variant.name: rows for variant, rows in zip(variants, compare(unit, variants), strict=True)}
    assert by_name["production"] == measure_golden(unit)
    (paper,) = next(rows for variant, rows in zip(variants, by_name.values(), strict=True) if variant.paper)
    assert paper.found
    assert paper.pad.x_px == int(paper.pad.x_px)
    assert paper.pad != by_name["production"][0].pad

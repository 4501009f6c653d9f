# SPDX-License-Identifier: Apache-2.0
"""What the record of a missed frame says of the pad's shapes."""

import dataclasses

import numpy as np
import pytest

from golden.chain import Settings, run_chain
from sim.accuracy.causes import shapes_seen
from sim.accuracy.rendered import draw
from sim.accuracy.rows import Reference
from sim.world.look import Look
from sim.world.pose import Pose
from sim.world.scene import Scene

SCENE = Scene(Pose(0.8, 0.05, -0.03, pad_yaw_deg=130.0), Look(ground_gain=0.0, noise_sigma=0.5))


def objects_of(image: np.ndarray) -> np.ndarray:
    settings = Settings(min_area=30)
    return run_chain(image, run_chain(image, None, settings).stats, settings).objects


@pytest.fixture(scope="module")
def seen() -> tuple[np.ndarray, Reference]:
    return draw(SCENE)


def test_a_whole_pad_is_seen(seen: tuple[np.ndarray, Reference]) -> None:
    image, truth = seen
    expected = "ring seen, square seen, rectangle seen, small ring seen"
    assert shapes_seen(objects_of(image), truth, 0.8, 30) == expected
    assert shapes_seen(objects_of(image), dataclasses.replace(truth, altitude_m=None), 0.8, 30) == expected


def test_what_is_gone_joined_or_broken(seen: tuple[np.ndarray, Reference]) -> None:
    image, truth = seen
    scale = 552.0 / 800.0
    x, y = round(truth.x_px), round(truth.y_px)
    gone = image.copy()
    reach = round(25 * scale)
    gone[y - reach : y + reach, x - reach : x + reach] = 214
    words = shapes_seen(objects_of(gone), truth, 0.8, 30)
    assert words.endswith("small ring absent")
    # 785 mm2 at 0.69 px a millimetre.
    small = objects_of(image)
    small = small[small["area"] >= 400]
    assert shapes_seen(small, truth, 0.8, 400).endswith("small ring absent (its 374 px are less than MIN_AREA)")
    joined = image.copy()
    turn = np.radians(truth.angle_deg)
    for step in np.linspace(-60, 60, 200) * scale:
        row, column = round(y + step * np.cos(turn)), round(x - step * np.sin(turn))
        joined[row - 5 : row + 6, column - 5 : column + 6] = 65
    words = shapes_seen(objects_of(joined), truth, 0.8, 30)
    assert "square joined" in words
    assert "small ring joined" in words or "small ring absent" in words
    broken = image.copy()
    broken[y - 4 : y + 5, :] = 214
    broken[:, x - 4 : x + 5] = 214
    assert shapes_seen(objects_of(broken), truth, 0.8, 30).startswith("ring absent or in pieces")


def test_without_a_truth_there_is_nothing_to_say(seen: tuple[np.ndarray, Reference]) -> None:
    assert shapes_seen(objects_of(seen[0]), Reference(True, True), 0.8, 30) == ""

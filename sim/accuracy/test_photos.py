# SPDX-License-Identifier: Apache-2.0
"""Folders of photographs: what can be used, and one sentence for what cannot."""

from pathlib import Path

import cv2
import numpy as np
import pytest

from scripts.errors import UserError
from sim.accuracy.photos import photo_units
from sim.accuracy.rows import Reference

HEAD = "image,centre_x,centre_y,angle_deg,difficulty\n"


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """Two sets of one picture each."""
    for name in ("one", "two"):
        (tmp_path / name).mkdir()
        cv2.imwrite(str(tmp_path / name / "image_1.png"), np.zeros((720, 1280, 3), np.uint8))
        (tmp_path / name / "altitude.csv").write_text("frame,altitude_m\nimage_1.png,1.5\n")
    return tmp_path


def test_reference_altitude_and_difficulty(folder: Path) -> None:
    (folder / "reference.csv").write_text(HEAD + "one/image_1.png,10.5,20.25,-90,3\ntwo/image_1.png,,,,\n")
    first, second = photo_units(str(folder))
    assert (first.set, second.set) == ("photos:one", "photos:two")
    assert first.shots[0].lidar_m == 1.5
    assert first.shots[0].difficulty == "3"
    assert first.shots[0].draw()[1] == Reference(True, True, 10.5, 20.25, -90.0)
    assert second.shots[0].draw()[1] == Reference(present=False)


def test_without_a_reference_nothing_is_known(folder: Path) -> None:
    image, reference = photo_units(str(folder))[1].shots[0].draw()
    assert image.shape == (720, 1280, 3)
    assert reference == Reference()


def test_a_folder_of_pictures_is_one_set(folder: Path) -> None:
    (unit,) = photo_units(str(folder / "two"), "2.5")
    assert unit.set == "photos:two"
    assert unit.shots[0].lidar_m == 2.5


@pytest.mark.parametrize(
    ("reference", "words"),
    [
        (HEAD + "one/image_9.png,1,2,3,0\n", "names one/image_9.png, which is not there"),
        (HEAD + "one/image_1.png,1,,3,0\n", "line 2 of .* gives one coordinate"),
        (HEAD + "one/image_1.png,1,x,3,0\n", "line 2 of .* is no number"),
        ("image,x,y\none/image_1.png,1,2\n", "needs a first line with the columns image, centre_x"),
        ("", "needs a first line"),
    ],
)
def test_a_wrong_reference_is_one_sentence(reference: str, words: str, folder: Path) -> None:
    (folder / "reference.csv").write_text(reference)
    with pytest.raises(UserError, match=words):
        photo_units(str(folder))


def test_a_folder_that_is_not_there_or_empty(tmp_path: Path) -> None:
    with pytest.raises(UserError, match="is not a folder; give FRAMES=folder"):
        photo_units(str(tmp_path / "absent"))
    with pytest.raises(UserError, match="holds no PNG or JPEG"):
        photo_units(str(tmp_path))

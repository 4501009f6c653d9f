# SPDX-License-Identifier: Apache-2.0
"""A camera that is known is measured from pictures that it took."""

import subprocess
from pathlib import Path

import numpy as np
import pytest

from scripts import calibrate, calibrate_rendered
from scripts.calibrate_pad import find_pad
from scripts.calibrate_rendered import render_pad
from scripts.camera_file import read_camera, text_of
from scripts.errors import UserError
from sim.world.camera import Camera
from sim.world.pose import Pose

ROOT = Path(__file__).resolve().parent.parent
LENS = Camera(focal_px=571.0, centre_x=652.0, centre_y=349.0, radial_2=-0.03, radial_4=0.004)
PLAIN = Camera(focal_px=600.0, centre_x=675.0, centre_y=330.0)


def taken(folder: Path, target: str, count: int, camera: Camera) -> Path:
    """Photos by a camera."""
    file = folder / "truth.toml"
    file.write_text(text_of(camera, []))
    photos = folder / "photos"
    calibrate_rendered.main(["--target", target, "--count", str(count), "--camera", str(file), "--out", str(photos)])
    return photos


@pytest.fixture(scope="module")
def boards(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Photos of a chessboard by `LENS`."""
    return taken(tmp_path_factory.mktemp("boards"), "board", 12, LENS)


@pytest.fixture(scope="module")
def pads(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Photos of the pad on grass by `PLAIN`."""
    return taken(tmp_path_factory.mktemp("pads"), "pad", 20, PLAIN)


def worst_px(camera: Camera, truth: Camera) -> float:
    """How far apart two cameras see the same thing, at worst, within 60 degrees of the axis."""
    turn, off_axis = np.meshgrid(np.linspace(0, 2 * np.pi, 24), np.radians(np.linspace(0, 60, 13)))
    rays = np.stack([np.sin(off_axis) * np.cos(turn), np.sin(off_axis) * np.sin(turn), np.cos(off_axis)], axis=-1)
    return float(np.linalg.norm(camera.project(rays) - truth.project(rays), axis=-1).max())


def check_errors(fit: calibrate.Fit, truth: Camera) -> None:
    for name, error in fit.errors.items():
        assert abs(getattr(fit.camera, name) - getattr(truth, name)) < 4 * error, (name, fit.camera, error)


def test_chessboards_give_the_camera_back(boards: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    calibrate.main(["--frames", str(boards), "--out", str(tmp_path)])
    printed = capsys.readouterr().out
    found = read_camera(tmp_path / "camera.toml")
    assert worst_px(Camera(), LENS) > 10.0
    assert worst_px(found, LENS) < 0.6
    assert found.focal_px == pytest.approx(LENS.focal_px, abs=0.5)
    assert (found.centre_x, found.centre_y) == pytest.approx((LENS.centre_x, LENS.centre_y), abs=0.3)
    assert "focal_px" in printed
    assert printed.count("board") >= 8
    assert (tmp_path / "residuals.svg").read_text().count("<circle") == 54 * printed.count(".png ")


def test_chessboards_say_how_well_they_know(boards: Path) -> None:
    """The standard errors hold, the squares' size changes distances alone, and without radial terms it fits worse."""
    files = calibrate.photos(str(boards))
    fit = calibrate.calibrate(files, "9x6", 25.0, 2)
    check_errors(fit, LENS)
    assert fit.errors["focal_px"] < 0.3
    assert calibrate.total_rms_px(fit) < 0.06
    twice = calibrate.calibrate(files, "9x6", 50.0, 2)
    assert twice.camera.focal_px == pytest.approx(fit.camera.focal_px, abs=1e-3)
    assert twice.distances_m() == pytest.approx([2 * distance for distance in fit.distances_m()], rel=1e-4)
    assert 0.2 < min(fit.distances_m()) < max(fit.distances_m()) < 0.4
    plain = calibrate.calibrate(files, "9x6", 25.0, 0)
    assert (plain.camera.radial_2, plain.camera.radial_4) == (0.0, 0.0)
    assert calibrate.total_rms_px(plain) > 2 * calibrate.total_rms_px(fit)


def test_pads_give_the_camera_back(pads: Path) -> None:
    fit = calibrate.calibrate(calibrate.photos(str(pads)), calibrate.PAD, 25.0, 0)
    check_errors(fit, PLAIN)
    assert max(fit.errors.values()) < 8.0
    assert fit.camera.focal_px == pytest.approx(PLAIN.focal_px, rel=0.03)
    assert (fit.camera.centre_x, fit.camera.centre_y) == pytest.approx((PLAIN.centre_x, PLAIN.centre_y), abs=12.0)
    assert calibrate.total_rms_px(fit) < 0.12


def test_a_pad_counts_with_a_whole_ring() -> None:
    whole = render_pad(Pose(0.5), Camera(), 1)
    broken = whole.copy()
    broken[350:371, 490:540] = broken[350:371, 740:790] = 214
    no_small_ring = whole.copy()
    no_small_ring[335:386, 615:666] = 214
    assert find_pad(whole, "whole", Camera()).pixels == 8
    assert find_pad(no_small_ring, "three", Camera()).pixels == 6
    assert find_pad(broken, "broken", Camera()) is None


def some(folder: Path, source: Path, count: int) -> str:
    for file in sorted(source.iterdir())[:count]:
        (folder / file.name).symlink_to(file)
    return str(folder)


def test_too_few_or_the_wrong_photos(boards: Path, pads: Path, tmp_path: Path) -> None:
    few = tmp_path / "few"
    few.mkdir()
    with pytest.raises(UserError, match="there are 4 photos; 5 or more are needed"):
        calibrate.main(["--frames", some(few, boards, 4)])
    five = tmp_path / "five"
    five.mkdir()
    with pytest.raises(UserError, match="a whole board of 9x6 inner corners is seen in 0 of 5 photos"):
        calibrate.main(["--frames", some(five, pads, 5)])
    ten = tmp_path / "ten"
    ten.mkdir()
    with pytest.raises(UserError, match="the whole pad is seen in 0 of 10 photos"):
        calibrate.main(["--frames", some(ten, boards, 10), "--board", "pad"])


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ([], "no photos are named"),
        (["--frames", "/no/such/folder"], "/no/such/folder is not a folder"),
        (["--frames", "empty"], "holds no PNG or JPEG"),
        (["--frames", "boards", "--board", "9by6"], "give its inner corners"),
        (["--frames", "boards", "--board", "2x6"], "3 or more each way"),
        (["--frames", "boards", "--square-mm", "-1"], "above 0"),
        (["--frames", "boards", "--square-mm", "nan"], "above 0"),
        (["--frames", "boards", "--radial", "3"], "invalid choice"),
    ],
)
def test_wrong_options_are_one_sentence(arguments: list[str], words: str, boards: Path, tmp_path: Path) -> None:
    places = {"empty": str(tmp_path), "boards": str(boards)}
    with pytest.raises(UserError, match=words) as raised:
        calibrate.main([places.get(argument, argument) for argument in arguments])
    assert "\n" not in str(raised.value)


def test_make_calibrate_says_what_is_missing() -> None:
    run = subprocess.run(
        [".venv/bin/python", "-m", "scripts.calibrate"], cwd=ROOT, capture_output=True, text=True, check=False
    )
    assert run.returncode == 1
    assert run.stderr == "touchdown: no photos are named; give their folder as FRAMES=folder.\n"

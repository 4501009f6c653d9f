# SPDX-License-Identifier: Apache-2.0
"""The least squares of the calibration on points without an image, and the file that a camera is kept in."""

from pathlib import Path

import numpy as np
import pytest

from scripts import camera_file
from scripts.calibrate_fit import PARAMETERS, View, fit, fit_without_outliers, pose_points, start_pose
from scripts.camera_file import DEFAULT, header_of, read_camera, text_of
from scripts.errors import UserError
from sim.world.camera import Camera

TRUTH = Camera(focal_px=560.0, centre_x=630.0, centre_y=371.0, radial_2=-0.02, radial_4=0.003)
POINTS_MM = 30.0 * np.array([(x, y) for y in range(-3, 4) for x in range(-4, 5)], float)


def view(pose: np.ndarray, noise_px: float = 0.0, seed: int = 0, start: Camera | None = None) -> View:
    seen = TRUTH.project(pose_points(POINTS_MM, pose))
    seen = seen + np.random.default_rng(seed).normal(0.0, noise_px, seen.shape)

    def predict(camera: Camera, unknowns: np.ndarray) -> np.ndarray:
        return camera.project(pose_points(POINTS_MM, unknowns)).ravel()

    return View(f"{seed}", seen.ravel(), predict, start_pose(start or Camera(), POINTS_MM, seen), seen.size)


def poses(count: int) -> list[np.ndarray]:
    random = np.random.default_rng(5)
    return [
        np.array([*random.uniform(-0.5, 0.5, 2), random.uniform(-3, 3), *random.uniform(-80, 80, 2), 260.0])
        for _ in range(count)
    ]


def test_without_noise_it_is_exact() -> None:
    result = fit(Camera(), [view(pose, seed=index) for index, pose in enumerate(poses(8))], PARAMETERS)
    for name in PARAMETERS:
        assert getattr(result.camera, name) == pytest.approx(getattr(TRUTH, name), abs=1e-5)
    assert max(result.rms_px()) < 1e-5
    for pose, truth in zip(result.poses, poses(8), strict=True):
        assert pose_points(POINTS_MM, pose) == pytest.approx(pose_points(POINTS_MM, truth), abs=1e-3)


def test_the_start_is_exact_for_the_right_camera() -> None:
    for pose in poses(4):
        start = view(pose, start=TRUTH).start
        assert pose_points(POINTS_MM, start) == pytest.approx(pose_points(POINTS_MM, pose), abs=1e-3)


def test_standard_errors_are_those_of_repeated_measurements() -> None:
    rounds = [
        fit(Camera(), [view(pose, 0.2, 100 * index + number) for number, pose in enumerate(poses(6))], PARAMETERS[:3])
        for index in range(30)
    ]
    # With the radial terms held at 0 the fit is biased; what repeats is the spread.
    for name in PARAMETERS[:3]:
        spread = np.std([getattr(result.camera, name) for result in rounds], ddof=1)
        said = np.median([result.errors[name] for result in rounds])
        assert 0.5 < spread / said < 1.6, name


def test_what_is_not_fitted_stays() -> None:
    result = fit(Camera(), [view(pose) for pose in poses(4)], ("focal_px",))
    assert result.camera == Camera(focal_px=result.camera.focal_px)
    assert set(result.errors) == {"focal_px"}


def test_a_photo_far_worse_than_the_others_is_left_out() -> None:
    views = [view(pose, 0.05, index) for index, pose in enumerate(poses(7))]
    views.append(view(poses(8)[-1], 2.0, 99))
    result = fit_without_outliers(Camera(), views, PARAMETERS)
    assert result.left_out == ("99",)
    assert len(result.views) == 7
    assert result.camera.focal_px == pytest.approx(TRUTH.focal_px, abs=1.0)


@pytest.mark.parametrize(
    ("points", "free"),
    [pytest.param(3, PARAMETERS, id="fewer numbers than unknowns"), pytest.param(4, PARAMETERS[:2], id="as many")],
)
def test_too_little_to_determine_a_camera(points: int, free: tuple[str, ...]) -> None:
    some = POINTS_MM[[0, 8, 54, 62][:points]]

    def predict(camera: Camera, unknowns: np.ndarray) -> np.ndarray:
        return camera.project(pose_points(some, unknowns)).ravel()

    pose = poses(1)[0]
    with pytest.raises(UserError, match="do not determine the camera"):
        fit(Camera(), [View("few points", predict(TRUTH, pose) + 0.1, predict, pose, 2 * points)], free)


def test_the_firmwares_camera_is_the_renderers() -> None:
    assert read_camera(DEFAULT) == Camera()


def test_a_camera_survives_its_file(tmp_path: Path) -> None:
    file = tmp_path / "camera.toml"
    file.write_text(text_of(TRUTH, ["a note"]))
    assert read_camera(file) == TRUTH
    header = tmp_path / "deep" / "camera_default.h"
    camera_file.main(["--camera", str(file), "--header", str(header)])
    assert header.read_text() == header_of(TRUTH)
    assert "#define CAMERA_RADIAL_2 (-0.02)\n" in header.read_text()
    before = header.stat().st_mtime_ns
    camera_file.main(["--camera", str(file), "--header", str(header)])
    assert header.stat().st_mtime_ns == before


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ("focal_px = 560.0", "", "missing or unknown: focal_px"),
        ("radial_4", "radial_6", "missing or unknown: radial_4, radial_6"),
        ("= 560.0", "= nan", "focal_px in .* is nan; give a number"),
        ("= 560.0", '= "wide"', "focal_px in .* is wide; give a number"),
        ("= 560.0", "= true", "focal_px in .* is True; give a number"),
        ("= 560.0", "= -560.0", "must be above 0"),
        ("= 560.0", "=", "cannot be read as TOML"),
        ("= -0.02", "= -0.3", "describes no camera"),
    ],
)
def test_a_file_that_is_no_camera(tmp_path: Path, old: str, new: str, words: str) -> None:
    file = tmp_path / "camera.toml"
    file.write_text(text_of(TRUTH, []).replace(old, new))
    with pytest.raises(UserError, match=words) as raised:
        read_camera(file)
    assert "\n" not in str(raised.value)

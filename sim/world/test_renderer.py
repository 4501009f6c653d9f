# SPDX-License-Identifier: Apache-2.0
"""The renderer against arithmetic done another way: projected outlines, and moments measured in the image."""

import hashlib
import math
import subprocess
import sys
import time

import cv2
import numpy as np
import pytest

from golden import pad_geometry as pad
from sim.world.camera import Camera
from sim.world.clip import demo_clip
from sim.world.measuring import area_and_centroid, box, circle, measured
from sim.world.pose import Pose, project_pad, truth_of, wrap_degrees
from sim.world.renderer import CLEAN, Look, render

POSES = [
    Pose(altitude_m=0.6),
    Pose(altitude_m=0.9, right_m=0.2, forward_m=0.15, pad_yaw_deg=30.0),
    Pose(altitude_m=1.3, right_m=-0.6, forward_m=0.2, pad_yaw_deg=-140.0, roll_deg=8.0, pitch_deg=-5.0),
    Pose(altitude_m=1.5, right_m=0.9, forward_m=-0.4, pad_yaw_deg=100.0, roll_deg=-6.0, pitch_deg=9.0),
]
PIXEL_TOLERANCE = 0.02

SHAPES = {
    "square": (pad.SQUARE_CENTRE_X_MM, pad.SQUARE_CENTRE_Y_MM, pad.SQUARE_SIDE_MM, pad.SQUARE_SIDE_MM, 10.0),
    "rectangle": (
        pad.RECTANGLE_CENTRE_X_MM,
        pad.RECTANGLE_CENTRE_Y_MM,
        pad.RECTANGLE_WIDTH_MM,
        pad.RECTANGLE_HEIGHT_MM,
        6.0,
    ),
}


@pytest.mark.parametrize("pose", POSES)
@pytest.mark.parametrize("shape", SHAPES)
def test_rendered_shapes_lie_where_their_outlines_project(pose: Pose, shape: str) -> None:
    camera = Camera()
    image, _ = render(pose, CLEAN)
    x, y, width, height, margin = SHAPES[shape]
    area, centre = area_and_centroid(project_pad(camera, pose, box(x, y, width, height)))
    window = project_pad(camera, pose, box(x, y, width + margin, height + margin))
    found_area, found_centre = measured(image, window, CLEAN)
    assert found_area == pytest.approx(area, rel=0.005)
    assert np.abs(found_centre - centre).max() < PIXEL_TOLERANCE


@pytest.mark.parametrize("pose", POSES)
@pytest.mark.parametrize(
    ("outer", "inner", "window"),
    [
        (pad.SMALL_RING_OUTER_RADIUS_MM, pad.SMALL_RING_INNER_RADIUS_MM, 21.5),
        (pad.RING_OUTER_RADIUS_MM, pad.RING_INNER_RADIUS_MM, 136.0),
    ],
)
def test_rendered_rings_lie_where_their_outlines_project(pose: Pose, outer: float, inner: float, window: float) -> None:
    camera = Camera()
    image, _ = render(pose, CLEAN)
    outlines = [(circle(outer), 1), (circle(inner), -1)]
    if outer == pad.RING_OUTER_RADIUS_MM:
        outlines += [(box(*dimensions[:4]), 1) for dimensions in SHAPES.values()]
        outlines += [(circle(pad.SMALL_RING_OUTER_RADIUS_MM), 1), (circle(pad.SMALL_RING_INNER_RADIUS_MM), -1)]
    area, weighted = 0.0, np.zeros(2)
    for polygon, sign in outlines:
        part, centre = area_and_centroid(project_pad(camera, pose, polygon))
        area += sign * part
        weighted += sign * part * centre
    found_area, found_centre = measured(image, project_pad(camera, pose, circle(window)), CLEAN)
    assert found_area == pytest.approx(area, rel=0.005)
    assert np.abs(found_centre - weighted / area).max() < PIXEL_TOLERANCE


def test_projection_by_hand() -> None:
    camera = Camera()
    # 45 degrees off axis: r = 2 * 552 * tan(22.5 degrees) = 457.29 px.
    truth = truth_of(camera, Pose(altitude_m=1.0, right_m=1.0))
    assert (truth.x_px, truth.y_px) == (pytest.approx(640 + 457.2918, abs=1e-3), pytest.approx(360))
    # Ahead of the drone is the image's top.
    truth = truth_of(camera, Pose(altitude_m=1.0, forward_m=1.0))
    assert (truth.x_px, truth.y_px) == (pytest.approx(640), pytest.approx(360 - 457.2918, abs=1e-3))
    assert not truth.visible


def test_tilt_moves_the_image_as_it_moves_a_camera() -> None:
    camera = Camera()
    ten = 2 * 552 * math.tan(math.radians(5))
    # Right side down: the camera looks to the left, so what is below appears on the right.
    truth = truth_of(camera, Pose(altitude_m=1.0, roll_deg=10.0))
    assert (truth.x_px, truth.y_px) == (pytest.approx(640 + ten), pytest.approx(360))
    # Nose up: the camera looks ahead, so what is below appears towards the tail.
    truth = truth_of(camera, Pose(altitude_m=1.0, pitch_deg=10.0))
    assert (truth.x_px, truth.y_px) == (pytest.approx(640), pytest.approx(360 + ten))
    assert truth.lidar_m == pytest.approx(1 / math.cos(math.radians(10)))


@pytest.mark.parametrize("angle", [-179.0, -90.0, -33.0, 0.0, 45.0, 90.0, 180.0])
def test_angle_turns_clockwise_from_square_above_rectangle(angle: float) -> None:
    truth = truth_of(Camera(), Pose(altitude_m=1.0, pad_yaw_deg=angle))
    assert truth.angle_deg == pytest.approx(angle, abs=1e-6)


def test_quarter_turn_shows_the_square_on_the_right() -> None:
    pose = Pose(altitude_m=0.5, pad_yaw_deg=90.0)
    image, _ = render(pose, CLEAN)
    side = round(552 * 52.771 / 500)
    assert image[360, 640 + side, 0] == 65
    assert image[360 - side, 640, 0] == 214


@pytest.mark.parametrize(("angle", "expected"), [(180.0, 180.0), (-180.0, 180.0), (190.0, -170.0), (-540.0, 180.0)])
def test_wrap(angle: float, expected: float) -> None:
    assert wrap_degrees(angle) == expected


def test_rays_invert_projection() -> None:
    camera = Camera()
    columns, lines = np.meshgrid(np.arange(camera.width), np.arange(camera.height))
    back = camera.project(camera.rays())
    assert np.abs(back - np.stack([columns, lines], axis=-1)).max() < 1e-3


def test_same_arguments_give_the_same_bytes_in_another_process() -> None:
    program = (
        "import hashlib;from sim.world.clip import demo_clip;from sim.world.camera import Camera;"
        "print(hashlib.sha256(demo_clip(2, Camera().scaled(4))[1].image().tobytes()).hexdigest())"
    )
    other = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True).stdout.strip()
    here = demo_clip(2, Camera().scaled(4))[1].image()
    assert hashlib.sha256(here.tobytes()).hexdigest() == other


def test_seed_changes_ground_and_noise_but_not_truth() -> None:
    camera = Camera().scaled(4)
    (first, truth), (second, same_truth) = (render(POSES[1], camera=camera, seed=seed) for seed in (1, 2))
    assert truth == same_truth
    assert (first != second).mean() > 0.5


@pytest.mark.parametrize("altitude", [0.4, 0.8, 1.5, 2.5])
@pytest.mark.parametrize("seed", [0, 1, 2])
def test_grass_has_the_statistics_of_grass(altitude: float, seed: int) -> None:
    image, _ = render(Pose(altitude_m=altitude, right_m=50.0), seed=seed)
    gray = cv2.cvtColor(image, cv2.COLOR_RGB2GRAY)
    assert 81 <= gray.mean() <= 100
    assert 23 <= gray.std() <= 36


def test_ground_stays_where_it_is_while_the_drone_moves() -> None:
    look = Look(noise_sigma=0.0)
    first, truth = render(Pose(altitude_m=1.0), look)
    second, moved = render(Pose(altitude_m=1.0, right_m=0.02), look)
    shift = round(moved.x_px - truth.x_px)
    assert shift == 11
    patch = first[100:200, 600:680].astype(float)
    still = np.abs(patch - second[100:200, 600:680]).mean()
    followed = np.abs(patch - second[100:200, 600 + shift : 680 + shift]).mean()
    assert followed < 0.35 * still


def test_edges_are_as_wide_as_asked_and_overshoot() -> None:
    look = Look(noise_sigma=0.0)
    profile = _edge_profile(look)
    assert 0.9 <= _width_10_90(profile) <= 1.5
    low, high = profile[:200].mean(), profile[-200:].mean()
    assert 0.08 <= (profile.max() - high) / (high - low) <= 0.16
    plain = Look(noise_sigma=0.0, overshoot=0.0, edge_px=1.2)
    assert _width_10_90(_edge_profile(plain)) == pytest.approx(1.2, abs=0.12)


def _edge_profile(look: Look) -> np.ndarray:
    """Levels across the square's left edge at 1/100 px, from the slanted edge of many lines."""
    pose = Pose(altitude_m=0.4, pad_yaw_deg=6.0)
    image, _ = render(pose, look)
    middle_y = pad.SQUARE_CENTRE_Y_MM
    top, bottom = project_pad(Camera(), pose, np.array([[-25.0, middle_y - 12], [-25.0, middle_y + 12]]))
    along = (bottom - top) / np.linalg.norm(bottom - top)
    lines, columns = np.mgrid[math.ceil(top[1]) : math.floor(bottom[1]), 560:640]
    # Left of the edge is paper; turn the sign so that the profile rises.
    distance = -((columns - top[0]) * along[1] - (lines - top[1]) * along[0])
    near = np.abs(distance) < 6
    order = np.argsort(distance[near])
    return np.interp(np.arange(-5, 5, 0.01), distance[near][order], image[lines, columns, 0][near][order])


def _width_10_90(profile: np.ndarray) -> float:
    low, high = profile[:200].mean(), profile[-200:].mean()
    smooth = np.convolve(profile, np.ones(9) / 9, mode="same")[10:-10]
    crossings = [np.argmax(smooth > low + share * (high - low)) for share in (0.1, 0.9)]
    return (crossings[1] - crossings[0]) * 0.01


def test_motion_blur_keeps_the_centre() -> None:
    pose = POSES[1]
    look = Look(ground_gain=0.0, overshoot=0.0, noise_sigma=0.0, motion_px=4.0, motion_deg=25.0)
    window = project_pad(Camera(), pose, box(*SHAPES["square"][:2], 66, 66))
    sharp, blurred = (measured(render(pose, one)[0], window, one) for one in (CLEAN, look))
    assert np.abs(sharp[1] - blurred[1]).max() < PIXEL_TOLERANCE
    assert np.abs(render(pose, look)[0].astype(int) - render(pose, CLEAN)[0]).max() > 40


def test_noise_gradient_and_shadow_do_what_they_say() -> None:
    pose = Pose(altitude_m=0.25)
    plain, _ = render(pose, CLEAN)
    noisy, _ = render(pose, Look(ground_gain=0, overshoot=0, noise_sigma=2.0))
    paper = plain[..., 0] == 214
    assert (noisy[..., 0].astype(float) - plain[..., 0])[paper].std() == pytest.approx(2.0, abs=0.1)
    sloped, _ = render(pose, Look(ground_gain=0, overshoot=0, noise_sigma=0, gradient=0.2, gradient_deg=90.0))
    column = int(np.argmax(paper.all(axis=0)))
    assert sloped[0, column, 0] == pytest.approx(214 * 1.1, abs=1)
    assert sloped[-1, column, 0] == pytest.approx(214 * 0.9, abs=1)
    shadowed, _ = render(pose, Look(ground_gain=0, overshoot=0, noise_sigma=0, shadow=0.4))
    assert shadowed[paper].min() == pytest.approx(214 * 0.6, abs=8)
    assert shadowed[paper].max() > 205


def test_noise_differs_between_seeds_and_between_frames_of_a_clip() -> None:
    camera = Camera().scaled(4)
    look = Look(ground_gain=0.0, noise_sigma=3.0)

    def paper(altitude: float, seed: int) -> np.ndarray:
        """Levels around the ring's edge-free top, which are alike but for the noise."""
        return render(Pose(altitude_m=altitude), look, camera, seed)[0][5:9, 150:170, 0].astype(int)

    first = paper(0.25, 1)
    assert np.array_equal(first, paper(0.25, 1))
    assert (first != paper(0.25, 2)).mean() > 0.5
    assert (first != paper(0.2501, 1)).mean() > 0.5


def test_poses_out_of_the_ordinary() -> None:
    camera = Camera().scaled(4)
    for pose in (Pose(1.0, right_m=30.0), Pose(30.0), Pose(0.05), Pose(1.0, roll_deg=45.0, pitch_deg=30.0)):
        image, truth = render(pose, camera=camera)
        assert image.shape == (180, 320, 3)
        assert not truth.visible or pose.altitude_m == 30.0
    for bad in (0.0, -1.0, math.nan, math.inf):
        with pytest.raises(ValueError, match="altitude_m"):
            Pose(altitude_m=bad)
    with pytest.raises(ValueError, match="45 degrees"):
        Pose(altitude_m=1.0, roll_deg=60.0)


def test_a_frame_takes_about_a_second_at_most() -> None:
    render(POSES[0])
    start = time.process_time()
    render(POSES[1])
    assert time.process_time() - start < 1.5

# SPDX-License-Identifier: Apache-2.0
"""Scenes: each disturbance does what it says and nothing else, and the truth is true."""

import dataclasses
import math

import cv2
import numpy as np
import pytest

from golden import pad_geometry as pad
from sim.world.camera import Camera
from sim.world.curl import Curl
from sim.world.decal import OCCLUDERS
from sim.world.disturbances import Disturbances
from sim.world.ground import GROUNDS
from sim.world.light import shadow_edge_line
from sim.world.look import CLEAN, Look
from sim.world.measuring import area_and_centroid, box, circle, measured
from sim.world.pose import Pose, project_pad, truth_of
from sim.world.scene import Scene, SceneTruth, render_scene

POSE = Pose(altitude_m=0.5, right_m=0.03, forward_m=-0.02, pad_yaw_deg=25.0, roll_deg=3.0, pitch_deg=-4.0)
QUIET = Look(noise_sigma=0.0, overshoot=0.0)
LENS = Camera(focal_px=548.0, centre_x=655.0, centre_y=341.0, radial_2=-0.04, radial_4=0.005)
SHAPES = {
    "square": (box(pad.SQUARE_CENTRE_X_MM, pad.SQUARE_CENTRE_Y_MM, pad.SQUARE_SIDE_MM, pad.SQUARE_SIDE_MM), 1.12),
    "rectangle": (
        box(pad.RECTANGLE_CENTRE_X_MM, pad.RECTANGLE_CENTRE_Y_MM, pad.RECTANGLE_WIDTH_MM, pad.RECTANGLE_HEIGHT_MM),
        1.06,
    ),
}
# More than blur and sharpening reach.
FAR_PX = 12


def drawn(
    pose: Pose = POSE, look: Look = QUIET, seed: int = 0, **disturbances: float | str
) -> tuple[np.ndarray, SceneTruth]:
    """Picture in float and truth."""
    image, truth = render_scene(Scene(pose, look, seed, disturbances=Disturbances(**disturbances)))
    return image.astype(float), truth


def area_of(outline_mm: np.ndarray, pose: Pose = POSE, margin_px: int = 0) -> np.ndarray:
    """(height, width) bool: pixels inside an outline of the sheet, grown or shrunk (below 0) by some pixels."""
    mask = np.zeros((720, 1280), np.uint8)
    cv2.fillPoly(mask, [np.rint(project_pad(Camera(), pose, outline_mm)).astype(np.int32)], 1)
    kernel = np.ones((2 * abs(margin_px) + 1,) * 2, np.uint8)
    return (cv2.dilate(mask, kernel) if margin_px >= 0 else cv2.erode(mask, kernel)).astype(bool)


def paper() -> np.ndarray:
    """Outline of the paper in mm."""
    return box(
        pad.PAPER_LEFT_MM + pad.PAPER_WIDTH_MM / 2,
        pad.PAPER_TOP_MM + pad.PAPER_HEIGHT_MM / 2,
        pad.PAPER_WIDTH_MM,
        pad.PAPER_HEIGHT_MM,
    )


@pytest.mark.parametrize("shape", SHAPES)
@pytest.mark.parametrize(
    "scene",
    [
        Scene(POSE, CLEAN),
        Scene(POSE, CLEAN, camera=LENS),
        Scene(dataclasses.replace(POSE, right_m=0.4), CLEAN, camera=Camera(radial_2=0.02)),
        Scene(POSE, CLEAN, seed=3, disturbances=Disturbances(curl_per_m=0.8)),
        Scene(POSE, CLEAN, seed=8, camera=LENS, disturbances=Disturbances(curl_per_m=0.5)),
    ],
)
def test_shapes_lie_where_lens_and_curl_put_them(scene: Scene, shape: str) -> None:
    image, truth = render_scene(scene)
    edge, margin = SHAPES[shape]
    area, centre = area_and_centroid(project_pad(scene.camera, scene.pose, edge, scene.curl))
    middle = edge.mean(axis=0)
    window = project_pad(scene.camera, scene.pose, middle + margin * (edge - middle), scene.curl)
    found_area, found = measured(image, window, CLEAN)
    assert np.abs(found - centre).max() < 0.02
    assert found_area == pytest.approx(area, rel=0.005)
    assert truth.shapes[shape].area_px == pytest.approx(area, rel=1e-3)


@pytest.mark.parametrize("camera", [Camera(), LENS])
@pytest.mark.parametrize("curl", [0.0, 0.8])
# The image of a circle's centre is not its image's centre; the farther off the axis the less.
@pytest.mark.parametrize(("aside", "bias_px"), [(0.01, 0.02), (0.1, 0.15)])
def test_the_small_ring_is_where_the_truth_says(camera: Camera, curl: float, aside: float, bias_px: float) -> None:
    scene = Scene(Pose(0.5, aside, 0.5 * aside, 40.0), CLEAN, 2, camera, disturbances=Disturbances(curl_per_m=curl))
    image, truth = render_scene(scene)
    _, found = measured(image, project_pad(camera, scene.pose, circle(21.5), scene.curl), CLEAN)
    outer, inner = (
        area_and_centroid(project_pad(camera, scene.pose, circle(radius), scene.curl))
        for radius in (pad.SMALL_RING_OUTER_RADIUS_MM, pad.SMALL_RING_INNER_RADIUS_MM)
    )
    centroid = (outer[0] * outer[1] - inner[0] * inner[1]) / (outer[0] - inner[0])
    assert np.abs(found - centroid).max() < 0.02
    assert math.hypot(*(found - (truth.truth.x_px, truth.truth.y_px))) < bias_px


def test_rays_invert_projection_with_distortion() -> None:
    for camera in (LENS, Camera(radial_2=0.05), Camera(radial_2=-0.05).scaled(4)):
        columns, lines = np.meshgrid(np.arange(camera.width), np.arange(camera.height))
        assert np.abs(camera.project(camera.rays()) - np.stack([columns, lines], axis=-1)).max() < 2e-3


def test_a_barrel_draws_in_and_stays_outside_past_its_turning_point() -> None:
    barrel, plain = Camera(radial_2=-0.05), Camera()
    points = np.array([[0.5, 0.0, 1.0], [-1.0, 0.0, -0.9]])
    near, past = barrel.project(points) - (640.0, 360.0)
    straight = plain.project(points)[0, 0] - 640
    assert near[0] == pytest.approx(straight * (1 - 0.05 * (straight / 552) ** 2))
    assert past[0] < -640
    with pytest.raises(ValueError, match="corners"):
        Camera(radial_2=-0.2)


def test_curl_raises_the_edges_and_keeps_lengths() -> None:
    points = np.array([[0.0, 0.0], [200.0, 0.0], [0.0, 150.0]])
    over, height = Curl(1.0, 0.0).raise_sheet(points)
    assert over[0].tolist() == [0, 0]
    assert over[1, 0] == pytest.approx(1000 * math.sin(0.2))
    assert height == pytest.approx([0, 1000 * (1 - math.cos(0.2)), 0])
    with pytest.raises(ValueError, match="half way"):
        Scene(Pose(0.1), disturbances=Disturbances(curl_per_m=2.0))


def test_the_same_scene_gives_the_same_bytes_and_another_seed_does_not() -> None:
    bad = Disturbances(0.5, 12.0, 0.1, "leaf", 0.1, 0.4, 0.1, 0.2, 0.3, 0.4, 0.6)
    scene = Scene(POSE, Look(motion_px=3.0), 5, Camera().scaled(4), ground="leaves", disturbances=bad)
    (first, truth), (second, same) = render_scene(scene), render_scene(dataclasses.replace(scene))
    assert np.array_equal(first, second)
    assert truth == same
    other, _ = render_scene(dataclasses.replace(scene, seed=6))
    assert (first != other).mean() > 0.5


def test_shadow_edge_darkens_one_side_only() -> None:
    look = dataclasses.replace(QUIET, ground_gain=0.0)
    level = Pose(0.5)
    plain, _ = drawn(level, look)
    shadowed, _ = drawn(level, look, shadow_edge=0.6, penumbra_mm=10.0)
    across, down, off = shadow_edge_line(0)
    lines, columns = np.mgrid[:720, :1280]
    # Level and near the middle, a pixel is nearly 500 / 552 mm.
    beyond = (across * (columns - 640) + down * (lines - 360)) * (500 / 552) - off
    near = area_of(circle(120.0), level)
    light, dark = near & (beyond < -14), near & (beyond > 14)
    assert light.sum() > 5000
    assert dark.sum() > 5000
    assert np.array_equal(shadowed[light], plain[light])
    assert np.abs(shadowed[dark] - 0.4 * plain[dark]).max() <= 1.0
    soft = (near & (np.abs(beyond) < 0.5) & (plain[..., 0] == 214))[..., None] * shadowed
    assert soft[soft > 0].mean() == pytest.approx(214 * 0.7, rel=0.05)


@pytest.mark.parametrize("kind", OCCLUDERS)
@pytest.mark.parametrize("share", [0.05, 0.2, 0.5])
def test_an_occluder_covers_the_share_it_says(kind: str, share: float) -> None:
    look = dataclasses.replace(QUIET, ground_gain=0.0, edge_px=0.5, black=255.0, white=255.0)
    image, truth = drawn(POSE, look, 4, occlusion=share, occluder=kind)
    plain, _ = drawn(POSE, look, 4)
    disc = area_of(circle(pad.RING_OUTER_RADIUS_MM))
    # Half way from paper to the mean stalk.
    covered = (plain - image).max(axis=2) > 75
    assert covered[disc].mean() == pytest.approx(share, abs=0.04)
    for name, (edge, _) in SHAPES.items():
        assert 1 - covered[area_of(edge)].mean() == pytest.approx(truth.shapes[name].share, abs=0.05)
    away = ~area_of(box(0, 0, 700, 700), margin_px=FAR_PX)
    assert np.array_equal(image[away], plain[away])


def test_a_boot_on_the_ring_leaves_square_and_rectangle_alone() -> None:
    _, truth = drawn(Pose(0.5), QUIET, 4, occlusion=0.06, occluder="foot")
    assert truth.shapes["ring"].share < 0.95
    assert truth.visible_at_all
    _, deep = drawn(Pose(0.5), QUIET, 4, occlusion=0.5, occluder="foot")
    assert not deep.visible_at_all


def test_dirt_breaks_the_ring_and_spares_the_shapes_inside() -> None:
    look = dataclasses.replace(CLEAN, edge_px=0.5)
    image, truth = drawn(POSE, look, 7, dirt=0.3)
    plain, clean_truth = drawn(POSE, look, 7)
    assert (clean_truth.ring_broken, truth.shapes) == (0.0, clean_truth.shapes)
    ring = area_of(circle(124.0)) & ~area_of(circle(101.0))
    assert (image[ring] > 140).mean() == pytest.approx(truth.ring_broken, abs=0.02)
    assert 0.1 < truth.ring_broken <= 0.3
    for edge in (SHAPES["square"][0], SHAPES["rectangle"][0], circle(pad.SMALL_RING_OUTER_RADIUS_MM)):
        inside = area_of(edge, margin_px=2)
        assert np.array_equal(image[inside], plain[inside])
    changed = (image != plain).any(axis=2)
    assert (image[changed & (plain[..., 0] == 214)] < 140).any()
    assert not changed[~area_of(paper(), margin_px=2)].any()


def test_a_wet_patch_lifts_black_and_darkens_nothing() -> None:
    plain, _ = drawn(POSE, dataclasses.replace(QUIET, edge_px=0.5), 2)
    image, _ = drawn(POSE, dataclasses.replace(QUIET, edge_px=0.5), 2, wet=0.8)
    change = image - plain
    assert change.min() >= 0
    assert change[area_of(circle(125.0))].max() > 0.7 * (250 - 65)
    assert change[~area_of(circle(450.0))].max() == 0


def test_contrast_loss_draws_the_levels_together_and_leaves_the_ground() -> None:
    plain, _ = drawn()
    image, _ = drawn(contrast_loss=0.7)
    inside = area_of(SHAPES["square"][0], margin_px=-8)
    blank = area_of(circle(145.0), margin_px=-4) & ~area_of(circle(130.0), margin_px=4)
    middle, half = (65 + 214) / 2, (214 - 65) / 2
    assert image[inside] == pytest.approx(middle - 0.3 * half, abs=0.6)
    assert image[blank] == pytest.approx(middle + 0.3 * half, abs=0.6)
    away = ~area_of(paper(), margin_px=FAR_PX)
    assert np.array_equal(image[away], plain[away])


def test_glare_lifts_black_and_burns_white_out() -> None:
    image, _ = drawn(glare=0.5)
    black = image[area_of(SHAPES["square"][0], margin_px=-8)].mean()
    # As measured in bright sun: black at 106 to 188, paper at 254.
    assert 106 <= black <= 188
    assert (image[area_of(circle(145.0), margin_px=-4) & ~area_of(circle(130.0), margin_px=4)] >= 254).all()


@pytest.mark.parametrize("steps", [-2.0, -1.0, 0.5])
def test_exposure_scales_every_level_and_stops_at_the_sensors_end(steps: float) -> None:
    plain, _ = drawn()
    image, _ = drawn(exposure_ev=steps)
    expected = np.minimum(plain * 2.0**steps, 255)
    assert np.abs(image - expected).max() <= 0.5 + 0.5 * 2.0**steps + 1e-6


def test_legs_stand_at_the_sides_and_cover_what_is_behind() -> None:
    plain, _ = drawn()
    image, truth = drawn(legs=0.7)
    columns = np.flatnonzero((image != plain).any(axis=(0, 2)))
    assert ((columns < 0.16 * 1280) | (columns > 0.88 * 1280)).all()
    assert (image != plain).any(axis=(1, 2)).nonzero()[0].min() > 0.2 * 720
    assert truth.visible_at_all
    behind = [drawn(Pose(1.2, right), legs=0.7)[1].shapes["ring"].share for right in np.linspace(-1.7, -1.1, 7)]
    assert min(behind) < 0.97


def test_motion_blur_runs_along_its_direction_only() -> None:
    look = dataclasses.replace(CLEAN, motion_px=20.0, motion_deg=0.0)
    level = Pose(0.4)
    image, _ = drawn(level, look)
    square = project_pad(Camera(), level, SHAPES["square"][0])
    middle_x, middle_y = square.mean(axis=0)
    # Down through the square the edges stay sharp; across it they are ramps of 20 px.
    down = image[round(square[:, 1].min()) - 30 : round(middle_y), round(middle_x), 0]
    across = image[round(middle_y), round(square[:, 0].min()) - 30 : round(middle_x), 0]
    assert ((down > 80) & (down < 199)).sum() <= 3
    assert ((across > 80) & (across < 199)).sum() == pytest.approx(20 * 119 / 149, abs=2)


def test_shares_of_a_pad_cut_by_the_frame() -> None:
    camera = Camera()
    # Where the centre is seen half a pixel left of the first column, the frame cuts the pad in two halves.
    right = -2.0 * math.tan(2.0 * math.atan((640.5 / 552) / 2))
    _, truth = render_scene(Scene(Pose(2.0, right), CLEAN))
    assert truth.truth.x_px == pytest.approx(-0.5, abs=1e-6)
    for name in ("ring", "square", "rectangle", "small_ring"):
        assert truth.shapes[name].share == pytest.approx(0.5, abs=0.02)
    assert not truth.visible_at_all
    _, turned = render_scene(Scene(Pose(2.0, right, pad_yaw_deg=90.0), CLEAN))
    assert [round(turned.shapes[name].share, 2) for name in ("square", "rectangle")] == [1.0, 0.0]
    assert not turned.visible_at_all
    _, whole = render_scene(Scene(Pose(2.0), CLEAN))
    assert {shape.share for shape in whole.shapes.values()} == {1.0}
    assert whole.shapes["square"].area_px == pytest.approx((552 * 50 / 2000) ** 2, rel=0.005)
    assert whole.shapes["small_ring"].area_px == pytest.approx(math.pi * (17.5**2 - 7.5**2) * 0.276**2, rel=0.005)
    assert whole.visible_at_all
    assert truth_of(camera, Pose(2.0)) == whole.truth


def test_a_pad_too_small_or_absent_is_not_visible_at_all() -> None:
    camera = Camera().scaled(2)
    near, far = (render_scene(Scene(Pose(altitude), CLEAN, camera=camera))[1] for altitude in (1.9, 2.05))
    # The square is 7 px wide where that is 276 * 50 mm / altitude: 1.97 m.
    assert near.shapes["square"].width_px == pytest.approx(276 * 50 / 1900, rel=0.01)
    assert near.visible_at_all
    assert not far.visible_at_all
    _, absent = render_scene(Scene(POSE, CLEAN, pad=False))
    assert (absent.pad, absent.shapes, absent.visible_at_all) == (False, {}, False)


def test_shapes_that_a_flat_view_makes_thin_are_not_visible_at_all() -> None:
    # 0.6 m up, seen over the side at a slant: long enough and large enough, but too thin to pass the filters.
    steep, slant = (render_scene(Scene(Pose(0.6, right, roll_deg=-40.0), CLEAN))[1] for right in (0.9, 1.7))
    assert steep.visible_at_all
    for shape in (steep.shapes["rectangle"], slant.shapes["rectangle"]):
        assert shape.share == 1.0
        assert shape.area_px > 100
    assert slant.shapes["square"].area_px > 40
    assert slant.shapes["square"].width_px < 7
    assert not slant.visible_at_all


@pytest.mark.parametrize("yaw", [0.0, 30.0, 90.0])
def test_width_is_the_narrower_side_whichever_way_the_shape_lies(yaw: float) -> None:
    _, truth = render_scene(Scene(Pose(1.0, pad_yaw_deg=yaw), CLEAN))
    assert truth.shapes["square"].width_px == pytest.approx(0.552 * pad.SQUARE_SIDE_MM, rel=0.01)
    assert truth.shapes["rectangle"].width_px == pytest.approx(0.552 * pad.RECTANGLE_HEIGHT_MM, rel=0.01)


def test_without_pad_and_drawing_there_is_only_ground() -> None:
    camera = Camera().scaled(4)
    bare, _ = render_scene(Scene(POSE, QUIET, camera=camera, pad=False))
    far, _ = render_scene(Scene(POSE, QUIET, camera=camera))
    assert bare.max() < 214
    assert (bare != far).any()


@pytest.mark.parametrize("kind", GROUNDS)
def test_grounds_have_texture_and_are_their_own(kind: str) -> None:
    camera = Camera().scaled(2)
    image, _ = render_scene(Scene(POSE, QUIET, camera=camera, pad=False, ground=kind))
    other, _ = render_scene(Scene(POSE, QUIET, 1, camera, pad=False, ground=kind))
    assert 40 < image.mean() < 200
    assert 5 < image.std() < 80
    assert np.abs(image.astype(int) - other).mean() > 4


@pytest.mark.parametrize(
    "wrong",
    [
        {"shadow_edge": 1.2},
        {"occlusion": 0.6},
        {"occluder": "cat"},
        {"dirt": -0.1},
        {"wet": math.nan},
        {"legs": 2.0},
        {"exposure_ev": math.nan},
        {"penumbra_mm": 0.0},
    ],
)
def test_disturbances_out_of_range_are_refused(wrong: dict[str, float | str]) -> None:
    with pytest.raises(ValueError, match=next(iter(wrong))):
        Disturbances(**wrong)


def test_scenes_of_what_is_unknown_are_refused() -> None:
    with pytest.raises(ValueError, match="ground is lava"):
        Scene(POSE, ground="lava")
    with pytest.raises(ValueError, match="without a pad"):
        Scene(POSE, drawing="qr")
    with pytest.raises(ValueError, match="drawing is cat"):
        Scene(POSE, pad=False, drawing="cat")

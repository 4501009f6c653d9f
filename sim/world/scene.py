# SPDX-License-Identifier: Apache-2.0
"""One scene, everything that may disturb it, its picture and what is exactly true of it.

    image, truth = render_scene(Scene(Pose(altitude_m=0.8), disturbances=Disturbances(occlusion=0.2), seed=4))

The same scene gives the same bytes.
"""

import functools
from dataclasses import dataclass, field

import cv2
import numpy as np

from sim.world import light
from sim.world.airframe import legs
from sim.world.camera import Camera
from sim.world.curl import FLAT, Curl
from sim.world.decal import SIDE_MM, Decal, dirt, occluder
from sim.world.disturbances import UNDISTURBED, Disturbances
from sim.world.drawings import DRAWINGS, drawing
from sim.world.ground import GROUNDS, ground
from sim.world.lens import blur, sharpen
from sim.world.look import Look
from sim.world.pad import PAD, PAPER, Box, coverage
from sim.world.pose import Pose, Truth, camera_from_level, pad_to_level, project_pad, truth_of
from sim.world.visibility import ShapeTruth, shapes_of

_NARROWEST_RAY_DOWN = 0.03
_MARGIN_PX = 4
_LEAST_AREA_PX = 40.0
_LEAST_WIDTH_PX = 7.0
_WHOLE = 0.999


@dataclass(frozen=True)
class Scene:
    """One frame before it is rendered.

    Attributes:
        pose: Where the drone is; without a pad, where the drawing lies.
        look: Levels, light, blur and noise.
        seed: Chooses the place on the ground, the shapes of the disturbances and the noise.
        camera: The camera.
        pad: False: no pad in view.
        drawing: Without a pad, what lies in its place: one of `drawings.DRAWINGS`, or nothing.
        ground: One of `ground.GROUNDS`.
        disturbances: What else may go wrong.
        corpus: Name of the corpus it comes from.
        strength: In a sweep, how strong the disturbance is, in the unit of its field.
    """

    pose: Pose
    look: Look = field(default_factory=Look)
    seed: int = 0
    camera: Camera = field(default_factory=Camera)
    pad: bool = True
    drawing: str = ""
    ground: str = "grass"
    disturbances: Disturbances = UNDISTURBED
    corpus: str = ""
    strength: float = 0.0

    def __post_init__(self) -> None:
        if self.ground not in GROUNDS:
            raise ValueError(f"ground is {self.ground}; it must be one of {', '.join(GROUNDS)}")
        if self.drawing and (self.pad or self.drawing not in DRAWINGS):
            raise ValueError(f"drawing is {self.drawing}; without a pad it may be one of {', '.join(DRAWINGS)}")
        raised = self.curl.raise_sheet(_rim(PAPER))[1].max()
        if raised > 500.0 * self.pose.altitude_m:
            raise ValueError("the curled paper reaches more than half way up to the camera")

    @property
    def curl(self) -> Curl:
        """How the paper is bent; the direction comes from the seed."""
        if not self.disturbances.curl_per_m:
            return FLAT
        return Curl(self.disturbances.curl_per_m, float(np.random.default_rng([self.seed, 20]).uniform(0, 180)))


@dataclass(frozen=True)
class SceneTruth:
    """What is exactly true of a rendered scene.

    Attributes:
        truth: Position, angle, altitude; without a pad, those of the drawing.
        pad: There is a pad (it may be out of sight).
        shapes: By name (`ring`, `square`, `rectangle`, `small_ring`) what is to be seen of each; empty without a pad.
        ring_broken: Share of the ring's print that dirt has turned to paper; `shapes` leaves dirt alone.
    """

    truth: Truth
    pad: bool
    shapes: dict[str, ShapeTruth]
    ring_broken: float = 0.0

    @property
    def visible_at_all(self) -> bool:
        """Square and rectangle wholly inside the frame, covered by nothing, each at least 40 px large and 7 px wide.

        Less than this no detector can be asked for: without both there is no orientation that a part of another shape
        could not fake. What is thinner than about 6 px does not pass erosion and 5x5 median, however long it is.
        Light, blur, noise and contrast do not count here.
        """
        shapes = [self.shapes[name] for name in ("square", "rectangle")] if self.pad else []
        return self.pad and all(
            shape.share >= _WHOLE and shape.area_px >= _LEAST_AREA_PX and shape.width_px >= _LEAST_WIDTH_PX
            for shape in shapes
        )


def render_scene(scene: Scene) -> tuple[np.ndarray, SceneTruth]:
    """The picture (height, width, 3) uint8 RGB and what is true of it."""
    pose, look, camera, bad = scene.pose, scene.look, scene.camera, scene.disturbances
    x_mm, y_mm, footprint = _plane(camera, pose)
    if look.ground_gain > 0:
        image = ground(x_mm, y_mm, footprint, scene.seed, scene.ground) * np.float32(look.ground_gain)
    else:
        image = np.zeros((camera.height, camera.width, 3), np.float32)

    black, white = light.levels(look, bad.contrast_loss)
    thing = PAD if scene.pad else None
    if scene.drawing:
        thing = drawing(scene.drawing, scene.seed, round(black), round(white))
    cover = occluder(bad.occluder, bad.occlusion, scene.seed) if bad.occlusion else None
    spots = dirt(bad.dirt, scene.seed) if bad.dirt and scene.pad else None
    part = _part(camera, pose, scene.curl, Box(0, 0, SIDE_MM, SIDE_MM) if cover or isinstance(thing, Decal) else PAPER)
    if part:
        sheet_x, sheet_y = scene.curl.sheet_seen_at(x_mm[part], y_mm[part], _nadir(pose), 1000.0 * pose.altitude_m)
        if isinstance(thing, Decal):
            image[part] = thing.lay_over(image[part], sheet_x, sheet_y, footprint[part])
        elif thing:
            paper, ink = coverage(sheet_x, sheet_y, thing)
            if spots:
                texels = (spot.sample(sheet_x, sheet_y, footprint[part]) for spot in spots[:2])
                lighter, darker = (share * np.float32(1 / 255) for share in texels)
                ink = ink * (1 - lighter) + (paper - ink) * darker
            paper, ink = paper[..., None], ink[..., None]
            image[part] = image[part] * (1 - paper) + white * (paper - ink) + black * ink
        if cover:
            image[part] = cover.lay_over(image[part], sheet_x, sheet_y, footprint[part])

    image = light.illuminate(image, (x_mm, y_mm), look, bad, scene.seed)
    if look.motion_px:
        image = cv2.filter2D(image, -1, light.motion_kernel(look), borderType=cv2.BORDER_REFLECT_101)
    frame_mask = None
    if bad.legs:
        image, frame_mask = legs(image, bad.legs, scene.seed)
    image = blur(image, look.edge_px, look.overshoot)
    image = light.expose(image, bad)
    image = sharpen(image, look.edge_px, look.overshoot)
    if look.noise_sigma:
        random = np.random.default_rng([scene.seed, 3, *_pose_key(pose)])
        image += look.noise_sigma * random.standard_normal(image.shape[:2], dtype=np.float32)[..., None]
    picture = np.clip(np.rint(image), 0, 255).astype(np.uint8)

    shapes = shapes_of(camera, pose, scene.curl, cover, frame_mask) if scene.pad else {}
    return picture, SceneTruth(truth_of(camera, pose, scene.curl), scene.pad, shapes, spots[2] if spots else 0.0)


def _plane(camera: Camera, pose: Pose) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Pad coordinates x, y in mm of the point of the ground under each pixel, and the pixel's size there."""
    level = camera.rays() @ camera_from_level(pose).astype(np.float32)
    # Rays that leave above the horizon see the ground far away, where it is one even colour.
    down = np.maximum(level[..., 2], np.float32(_NARROWEST_RAY_DOWN))
    distance = np.float32(1000.0 * pose.altitude_m) / down
    rotation, shift = pad_to_level(pose)
    right = level[..., 0] * distance - np.float32(shift[0])
    back = level[..., 1] * distance - np.float32(shift[1])
    x_mm = np.float32(rotation[0, 0]) * right + np.float32(rotation[1, 0]) * back
    y_mm = np.float32(rotation[0, 1]) * right + np.float32(rotation[1, 1]) * back
    return x_mm, y_mm, distance / (down * np.float32(camera.focal_px))


def _nadir(pose: Pose) -> np.ndarray:
    """Pad coordinates (2,) in mm of the point below the camera."""
    rotation, shift = pad_to_level(pose)
    return -shift @ rotation


@functools.lru_cache(maxsize=4)
def _rim(box: Box) -> np.ndarray:
    """Points (n, 2) along the sides of an upright box."""
    along = np.linspace(-0.5, 0.5, 64)
    x, y = box.x + box.width * along, box.y + box.height * along
    left, top, right, bottom = (np.full_like(x, value) for value in (x[0], y[0], x[-1], y[-1]))
    sides = [(x, top), (x, bottom), (left, y), (right, y)]
    return np.concatenate([np.column_stack(side) for side in sides])


def _part(camera: Camera, pose: Pose, curl: Curl, box: Box) -> tuple[slice, slice] | None:
    """The part of the frame that a box of the sheet can reach; None if it is out of sight."""
    image = project_pad(camera, pose, _rim(box), curl)
    limits = np.array([camera.width, camera.height])
    low = np.clip(np.floor(image.min(axis=0)).astype(int) - _MARGIN_PX, 0, limits)
    high = np.clip(np.ceil(image.max(axis=0)).astype(int) + _MARGIN_PX + 1, 0, limits)
    # Two pixels each way are the least from which a footprint can be measured.
    if (high - low < 2).any():
        return None
    return slice(low[1], high[1]), slice(low[0], high[0])


def _pose_key(pose: Pose) -> list[int]:
    """The pose in micrometres and microdegrees, so that each frame of a clip has its own noise."""
    values = (pose.altitude_m, pose.right_m, pose.forward_m, pose.pad_yaw_deg, pose.roll_deg, pose.pitch_deg)
    return [round(1e6 * value) & 0xFFFFFFFF for value in values]

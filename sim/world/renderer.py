# SPDX-License-Identifier: Apache-2.0
"""Renders what the camera sees: the pad on grass, with the faults of a real camera.

    image, truth = render(Pose(altitude_m=1.2, right_m=0.1, pad_yaw_deg=30.0))

The same arguments give the same bytes.
"""

import math
from dataclasses import dataclass

import cv2
import numpy as np

from golden import pad_geometry as pad
from sim.world.camera import Camera
from sim.world.ground import ground, patches
from sim.world.lens import apply_lens
from sim.world.pad import coverage
from sim.world.pose import Pose, Truth, camera_from_level, pad_to_level, project_pad, truth_of

_NARROWEST_RAY_DOWN = 0.03
_PAD_MARGIN_PX = 4


@dataclass(frozen=True)
class Look:
    """How scene and camera look; the defaults are those of a fair day.

    Attributes:
        black: Level of the print, 0 to 255.
        white: Level of the paper.
        ground_gain: Brightness of the grass; 0 leaves a black ground.
        edge_px: 10-90 % width of a straight edge.
        overshoot: Overshoot beside an edge from the camera's sharpening; 0.12 is 12 % of the step.
        motion_px: Length of the motion blur.
        motion_deg: Its direction in the image, clockwise from the right.
        noise_sigma: Standard deviation of each pixel's noise.
        gradient: Light falls from 1 + gradient / 2 to 1 - gradient / 2 across the frame.
        gradient_deg: Direction towards the dark side, clockwise from the right.
        shadow: How dark the shadows of branches are, 0 (none) to 1.
    """

    black: float = 65.0
    white: float = 214.0
    ground_gain: float = 1.0
    edge_px: float = 1.2
    overshoot: float = 0.12
    motion_px: float = 0.0
    motion_deg: float = 0.0
    noise_sigma: float = 1.0
    gradient: float = 0.0
    gradient_deg: float = 0.0
    shadow: float = 0.0


CLEAN = Look(ground_gain=0.0, overshoot=0.0, noise_sigma=0.0)


def render(
    pose: Pose, look: Look | None = None, camera: Camera | None = None, seed: int = 0
) -> tuple[np.ndarray, Truth]:
    """One frame and its truth.

    Args:
        pose: Where the drone is.
        look: How it looks; the default `Look()`.
        camera: The camera; the default `Camera()` is the 1280 x 720 one.
        seed: Chooses the meadow, the shadows and the noise.

    Returns:
        (height, width, 3) uint8 RGB, and the truth.
    """
    look, camera = look or Look(), camera or Camera()
    level = camera.rays() @ camera_from_level(pose).astype(np.float32)
    # Rays that leave above the horizon see the ground far away, where it is one even colour.
    down = np.maximum(level[..., 2], np.float32(_NARROWEST_RAY_DOWN))
    distance = np.float32(1000.0 * pose.altitude_m) / down
    rotation, shift = pad_to_level(pose)
    right = level[..., 0] * distance - np.float32(shift[0])
    back = level[..., 1] * distance - np.float32(shift[1])
    x_mm = np.float32(rotation[0, 0]) * right + np.float32(rotation[1, 0]) * back
    y_mm = np.float32(rotation[0, 1]) * right + np.float32(rotation[1, 1]) * back

    if look.ground_gain > 0:
        footprint = distance / (down * np.float32(camera.focal_px))
        image = ground(x_mm, y_mm, footprint, seed) * np.float32(look.ground_gain)
    else:
        image = np.zeros((camera.height, camera.width, 3), np.float32)
    box = _pad_box(camera, pose)
    if box:
        paper, black = (layer[..., None] for layer in coverage(x_mm[box], y_mm[box]))
        image[box] = image[box] * (1 - paper) + look.white * (paper - black) + look.black * black
    if look.gradient:
        image *= _gradient(camera, look)[..., None]
    if look.shadow:
        image *= _shadow(x_mm, y_mm, look, seed)[..., None]
    if look.motion_px:
        image = cv2.filter2D(image, -1, _motion_kernel(look), borderType=cv2.BORDER_REFLECT_101)
    image = apply_lens(image, look.edge_px, look.overshoot)
    if look.noise_sigma:
        random = np.random.default_rng([seed, 3, *_pose_key(pose)])
        image += look.noise_sigma * random.standard_normal(image.shape[:2], dtype=np.float32)[..., None]
    return np.clip(np.rint(image), 0, 255).astype(np.uint8), truth_of(camera, pose)


def _pad_box(camera: Camera, pose: Pose) -> tuple[slice, slice] | None:
    """The part of the frame the paper can reach; None if it is out of sight."""
    along = np.linspace(0.0, 1.0, 64)
    left, top = pad.PAPER_LEFT_MM, pad.PAPER_TOP_MM
    x, y = left + pad.PAPER_WIDTH_MM * along, top + pad.PAPER_HEIGHT_MM * along
    rim = np.concatenate(
        [
            np.column_stack([x, np.full_like(x, top)]),
            np.column_stack([x, np.full_like(x, top + pad.PAPER_HEIGHT_MM)]),
            np.column_stack([np.full_like(y, left), y]),
            np.column_stack([np.full_like(y, left + pad.PAPER_WIDTH_MM), y]),
        ]
    )
    image = project_pad(camera, pose, rim)
    limits = np.array([camera.width, camera.height])
    low = np.clip(np.floor(image.min(axis=0)).astype(int) - _PAD_MARGIN_PX, 0, limits)
    high = np.clip(np.ceil(image.max(axis=0)).astype(int) + _PAD_MARGIN_PX + 1, 0, limits)
    # Two pixels each way are the least from which a footprint can be measured.
    if (high - low < 2).any():
        return None
    return slice(low[1], high[1]), slice(low[0], high[0])


def _gradient(camera: Camera, look: Look) -> np.ndarray:
    turn = math.radians(look.gradient_deg)
    across = np.linspace(-0.5, 0.5, camera.width, dtype=np.float32)[None, :]
    down = np.linspace(-0.5, 0.5, camera.height, dtype=np.float32)[:, None]
    return 1 - np.float32(look.gradient) * (math.cos(turn) * across + math.sin(turn) * down)


def _shadow(x_mm: np.ndarray, y_mm: np.ndarray, look: Look, seed: int) -> np.ndarray:
    """Soft bars with ragged edges, fixed to the ground."""
    ragged = 60 * patches(x_mm, y_mm, seed + 5, 900.0)
    bars = np.cos((0.8 * x_mm + 0.6 * y_mm + ragged) * np.float32(2 * np.pi / 520.0))
    return 1 - np.float32(look.shadow) / (1 + np.exp(-6 * (bars - 0.4)))


def _motion_kernel(look: Look) -> np.ndarray:
    """A line of the given length, drawn as many bilinear points; it sums to 1 and is symmetric about its centre."""
    half = math.ceil(look.motion_px / 2) + 1
    kernel = np.zeros((2 * half + 1, 2 * half + 1), np.float32)
    turn = math.radians(look.motion_deg)
    for step in (np.arange(64) + 0.5) / 64 - 0.5:
        x, y = half + step * look.motion_px * math.cos(turn), half + step * look.motion_px * math.sin(turn)
        column, line = math.floor(x), math.floor(y)
        for dx, share_x in ((0, column + 1 - x), (1, x - column)):
            for dy, share_y in ((0, line + 1 - y), (1, y - line)):
                kernel[line + dy, column + dx] += share_x * share_y
    return kernel / kernel.sum()


def _pose_key(pose: Pose) -> list[int]:
    """The pose in micrometres and microdegrees, so that each frame of a clip has its own noise."""
    values = (pose.altitude_m, pose.right_m, pose.forward_m, pose.pad_yaw_deg, pose.roll_deg, pose.pitch_deg)
    return [round(1e6 * value) & 0xFFFFFFFF for value in values]

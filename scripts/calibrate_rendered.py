# SPDX-License-Identifier: Apache-2.0
"""Photos to calibrate with, made by calculation: what the tests and the page of the calibration measure against."""

import math

import numpy as np

from scripts.calibrate_chessboard import Board
from sim.world.camera import Camera
from sim.world.lens import blur
from sim.world.look import Look
from sim.world.pad import Box, Sheet, coverage
from sim.world.pose import Pose, camera_from_level, pad_to_level
from sim.world.scene import Scene, render_scene

_BLACK, _WHITE, _GROUND, _NOISE = 50.0, 205.0, 110.0, 1.0


def board_sheet(board: Board) -> Sheet:
    """The board about its own middle, a square of white around it."""
    side = board.square_mm
    across, down = board.across + 1, board.down + 1
    squares = tuple(
        Box(side * (column - (across - 1) / 2), side * (row - (down - 1) / 2), side, side)
        for row in range(down)
        for column in range(across)
        if (row + column) % 2 == 0
    )
    return Sheet(Box(0.0, 0.0, side * (across + 2), side * (down + 2)), squares)


def render_board(board: Board, pose: Pose, camera: Camera, seed: int) -> np.ndarray:
    """A photo (height, width, 3) uint8 of a board that lies on even ground."""
    level = camera.rays().astype(np.float64) @ camera_from_level(pose)
    plane = level[..., :2] / np.maximum(level[..., 2:], 0.02) * (1000.0 * pose.altitude_m)
    rotation, shift = pad_to_level(pose)
    point = (plane - shift) @ rotation
    paper, ink = coverage(point[..., 0].astype(np.float32), point[..., 1].astype(np.float32), board_sheet(board))
    gray = (_GROUND + (_WHITE - _GROUND) * paper - (_WHITE - _BLACK) * ink).astype(np.float32)
    image = blur(np.repeat(gray[..., None], 3, axis=2), 1.2, 0.0)
    image += np.random.default_rng(seed).normal(0.0, _NOISE, image.shape[:2])[..., None]
    return np.clip(np.rint(image), 0, 255).astype(np.uint8)


def spread_poses(
    count: int, altitude_m: tuple[float, float], off_axis: float, tilt_deg: float, seed: int
) -> list[Pose]:
    """Poses all round: as far off the axis as `off_axis` of the height, tilted by up to `tilt_deg` each way."""
    random = np.random.default_rng(seed)
    poses = []
    for _ in range(count):
        altitude = float(random.uniform(*altitude_m))
        turn, share = random.uniform(0, 2 * math.pi), math.sqrt(random.uniform(0, 1))
        right, forward = (
            off_axis * altitude * share * math.cos(turn),
            0.6 * off_axis * altitude * share * math.sin(turn),
        )
        roll, pitch = (float(value) for value in random.uniform(-tilt_deg, tilt_deg, 2))
        # Turned away from it, the camera sees it elsewhere; so lay it where it stays in view.
        right -= altitude * math.tan(math.radians(roll))
        forward += altitude * math.tan(math.radians(pitch))
        poses.append(Pose(altitude, right, forward, float(random.uniform(-180, 180)), roll, pitch))
    return poses


def render_pad(pose: Pose, camera: Camera, seed: int) -> np.ndarray:
    """A photo (height, width, 3) uint8 of the pad on grass."""
    return render_scene(Scene(pose, Look(), seed=seed, camera=camera))[0]

# SPDX-License-Identifier: Apache-2.0
"""Photos to calibrate with, made by calculation, by a camera that is known.

python -m scripts.calibrate_rendered --target board --camera camera.toml --out FOLDER
"""

import math
from collections.abc import Iterator
from pathlib import Path

import cv2
import numpy as np

from scripts.calibrate_chessboard import Board
from scripts.camera_file import DEFAULT, read_camera
from scripts.errors import ArgumentParser, UserError, run_main
from sim.world.camera import Camera
from sim.world.lens import blur
from sim.world.look import Look
from sim.world.pad import Box, Sheet, coverage
from sim.world.pose import Pose, camera_from_level, pad_to_level
from sim.world.scene import Scene, render_scene

BOARD = Board(9, 6, 25.0)
_SEED = 3
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


def render_all(target: str, count: int, camera: Camera) -> Iterator[np.ndarray]:
    """Photos of a board ("board") or of the pad ("pad"), from all round."""
    if target == "pad":
        poses = spread_poses(count, (0.3, 1.0), 0.7, 8.0, _SEED)
        return (render_pad(pose, camera, index) for index, pose in enumerate(poses))
    poses = spread_poses(count, (0.2, 0.3), 0.5, 25.0, _SEED)
    return (render_board(BOARD, pose, camera, index) for index, pose in enumerate(poses))


def main(arguments: list[str] | None = None) -> None:
    """Entry point."""
    parser = ArgumentParser(prog="python -m scripts.calibrate_rendered", description=__doc__)
    parser.add_argument("--target", choices=("board", "pad"), default="board", help="what lies on the ground")
    parser.add_argument("--count", type=int, default=20, help="photos")
    parser.add_argument("--camera", type=Path, default=DEFAULT, help="the camera that takes them, as a camera.toml")
    parser.add_argument("--out", type=Path, required=True, help="folder for the photos")
    options = parser.parse_args(arguments)
    camera = read_camera(options.camera)
    options.out.mkdir(parents=True, exist_ok=True)
    for index, rgb in enumerate(render_all(options.target, options.count, camera)):
        file = options.out / f"{options.target}{index:02}.png"
        if not cv2.imwrite(str(file), cv2.cvtColor(rgb, cv2.COLOR_RGB2BGR)):
            raise UserError(f"{file} cannot be written; give another folder as --out.")


if __name__ == "__main__":
    run_main(main)

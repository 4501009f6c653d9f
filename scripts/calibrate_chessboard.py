# SPDX-License-Identifier: Apache-2.0
"""Corners of a chessboard, by OpenCV."""

import re
from dataclasses import dataclass

import cv2
import numpy as np

from scripts.calibrate_fit import View, pose_points, start_pose
from scripts.errors import UserError
from sim.world.camera import Camera

_REFINE = (cv2.TERM_CRITERIA_EPS + cv2.TERM_CRITERIA_MAX_ITER, 40, 0.001)


@dataclass(frozen=True)
class Board:
    """A chessboard.

    Attributes:
        across: Inner corners along one side.
        down: Inner corners along the other.
        square_mm: Side of a square.
    """

    across: int
    down: int
    square_mm: float

    @property
    def corners_mm(self) -> np.ndarray:
        """(n, 2) from the board's middle, in the order in which OpenCV finds them."""
        y, x = np.mgrid[: self.down, : self.across]
        middle = ((self.across - 1) / 2, (self.down - 1) / 2)
        return self.square_mm * (np.column_stack([x.ravel(), y.ravel()]) - middle)


def parse_board(text: str, square_mm: float) -> Board:
    """A board written as 9x6.

    Raises:
        UserError: it is not.
    """
    match = re.fullmatch(r"(\d+)x(\d+)", text)
    if not match or min(int(match[1]), int(match[2])) < 3:
        raise UserError(f"the board is {text}; give its inner corners, 3 or more each way, as BOARD=9x6, or BOARD=pad.")
    if not square_mm > 0:
        raise UserError(f"the squares are {square_mm} mm; give SQUARE_MM above 0.")
    return Board(int(match[1]), int(match[2]), square_mm)


def find_board(rgb: np.ndarray, board: Board, name: str, camera: Camera) -> View | None:
    """The view of a board in a picture (height, width, 3); None where it is not seen whole."""
    gray = cv2.cvtColor(rgb, cv2.COLOR_RGB2GRAY)
    found, corners = cv2.findChessboardCorners(gray, (board.across, board.down))
    if not found:
        return None
    corners = corners.reshape(-1, 2).astype(np.float64)
    # Never farther than half a square, or the search runs to the next corner.
    nearest = min(np.linalg.norm(np.diff(corners, axis=0), axis=1).min(), 24.0)
    reach = max(2, int(nearest / 3.0))
    fine = cv2.cornerSubPix(gray, corners.reshape(-1, 1, 2).astype(np.float32), (reach, reach), (-1, -1), _REFINE)
    fine = fine.reshape(-1, 2).astype(np.float64)
    points_mm = board.corners_mm

    def predict(camera: Camera, pose: np.ndarray) -> np.ndarray:
        return camera.project(pose_points(points_mm, pose)).ravel()

    return View(name, fine.ravel(), predict, start_pose(camera, points_mm, fine), fine.size)

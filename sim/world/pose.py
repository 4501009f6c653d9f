# SPDX-License-Identifier: Apache-2.0
"""Where the drone is above the pad, and what a perfect detector would say."""

import math
from dataclasses import dataclass

import numpy as np

from golden import pad_geometry
from sim.world.camera import Camera
from sim.world.curl import FLAT, Curl

_PAD_CENTRE_MM = np.array([[0.0, 0.0]])
_SQUARE_CENTRE_MM = np.array([[pad_geometry.SQUARE_CENTRE_X_MM, pad_geometry.SQUARE_CENTRE_Y_MM]])
_RECTANGLE_CENTRE_MM = np.array([[pad_geometry.RECTANGLE_CENTRE_X_MM, pad_geometry.RECTANGLE_CENTRE_Y_MM]])


@dataclass(frozen=True)
class Pose:
    """Pad and drone in the drone's level heading frame.

    Attributes:
        altitude_m: Height of the camera above the ground.
        right_m: The pad's centre lies this far to the drone's right.
        forward_m: The pad's centre lies this far ahead of the drone.
        pad_yaw_deg: Heading of the pad's upper edge against the drone's nose, clockwise seen from above.
        roll_deg: Right side down is positive.
        pitch_deg: Nose up is positive.
    """

    altitude_m: float
    right_m: float = 0.0
    forward_m: float = 0.0
    pad_yaw_deg: float = 0.0
    roll_deg: float = 0.0
    pitch_deg: float = 0.0

    def __post_init__(self) -> None:
        if not (math.isfinite(self.altitude_m) and self.altitude_m > 0):
            raise ValueError(f"altitude_m is {self.altitude_m}; it must be above 0")
        if max(abs(self.roll_deg), abs(self.pitch_deg)) > 45:
            raise ValueError("roll_deg and pitch_deg must be within 45 degrees")


@dataclass(frozen=True)
class Truth:
    """What is exactly true of a rendered frame.

    Attributes:
        x_px: Column of the image of the ring's physical centre.
        y_px: Line of the image of the ring's physical centre.
        angle_deg: atan2(square - rectangle) + 90 of the imaged centres, in (-180, 180]; 0 = square above rectangle.
        altitude_m: Height of the camera above the ground.
        lidar_m: Distance to the ground along the optical axis; `altitude_m` when level.
        right_m: Pad centre to the right of the drone, level heading frame.
        forward_m: Pad centre ahead of the drone, level heading frame.
        visible: The whole outer edge of the ring is inside the frame.
    """

    x_px: float
    y_px: float
    angle_deg: float
    altitude_m: float
    lidar_m: float
    right_m: float
    forward_m: float
    visible: bool


def camera_from_level(pose: Pose) -> np.ndarray:
    """Rotation (3, 3) that takes vectors from level axes (right, back, down) to camera axes."""
    roll, pitch = math.radians(pose.roll_deg), math.radians(pose.pitch_deg)
    # Body from level in forward-right-down axes, Tait-Bryan order pitch then roll as autopilots have it.
    about_pitch = np.array(
        [[math.cos(pitch), 0, -math.sin(pitch)], [0, 1, 0], [math.sin(pitch), 0, math.cos(pitch)]],
    )
    about_roll = np.array([[1, 0, 0], [0, math.cos(roll), math.sin(roll)], [0, -math.sin(roll), math.cos(roll)]])
    camera_axes = np.array([[0, 1, 0], [-1, 0, 0], [0, 0, 1]])
    return camera_axes @ about_roll @ about_pitch @ camera_axes.T


def pad_to_level(pose: Pose) -> tuple[np.ndarray, np.ndarray]:
    """Rotation (2, 2) and shift (2,) in mm from pad coordinates to the level plane (right, back) below the camera."""
    yaw = math.radians(pose.pad_yaw_deg)
    rotation = np.array([[math.cos(yaw), -math.sin(yaw)], [math.sin(yaw), math.cos(yaw)]])
    return rotation, np.array([1000.0 * pose.right_m, -1000.0 * pose.forward_m])


def project_pad(camera: Camera, pose: Pose, points_mm: np.ndarray, curl: Curl = FLAT) -> np.ndarray:
    """Image of points of the pad.

    Args:
        camera: The camera.
        pose: Where the drone is.
        points_mm: (n, 2) in the pad's coordinates (`golden/pad_geometry.py`).
        curl: How the paper is bent.

    Returns:
        (n, 2) pixel coordinates x, y.
    """
    rotation, shift = pad_to_level(pose)
    over, height = curl.raise_sheet(points_mm)
    level = np.column_stack([over @ rotation.T + shift, 1000.0 * pose.altitude_m - height])
    return camera.project(level @ camera_from_level(pose).T)


def truth_of(camera: Camera, pose: Pose, curl: Curl = FLAT) -> Truth:
    """The truth of a frame rendered with this camera and pose, of paper bent like this."""
    centre = project_pad(camera, pose, _PAD_CENTRE_MM, curl)[0]
    square = project_pad(camera, pose, _SQUARE_CENTRE_MM, curl)[0]
    rectangle = project_pad(camera, pose, _RECTANGLE_CENTRE_MM, curl)[0]
    turn = np.linspace(0.0, 2.0 * np.pi, 360, endpoint=False)
    circle = pad_geometry.RING_OUTER_RADIUS_MM * np.column_stack([np.cos(turn), np.sin(turn)])
    rim = project_pad(camera, pose, circle, curl)
    inside = (rim >= 0).all() and (rim[:, 0] <= camera.width - 1).all() and (rim[:, 1] <= camera.height - 1).all()
    angle = math.degrees(math.atan2(square[1] - rectangle[1], square[0] - rectangle[0])) + 90.0
    return Truth(
        x_px=float(centre[0]),
        y_px=float(centre[1]),
        angle_deg=wrap_degrees(angle),
        altitude_m=pose.altitude_m,
        lidar_m=pose.altitude_m / float(camera_from_level(pose)[2, 2]),
        right_m=pose.right_m,
        forward_m=pose.forward_m,
        visible=bool(inside),
    )


def wrap_degrees(angle: float) -> float:
    """The same direction in (-180, 180]."""
    return 180.0 - (180.0 - angle) % 360.0

# SPDX-License-Identifier: Apache-2.0
"""Least squares over a camera and where the target lay in each photo.

Gauss-Newton with Levenberg's damping. A photo's pose concerns that photo alone,
so the poses are eliminated and one small system for the camera remains.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import cv2
import numpy as np

from scripts.errors import UserError
from sim.world.camera import Camera

PARAMETERS = ("focal_px", "centre_x", "centre_y", "radial_2", "radial_4")
_STEPS = {"focal_px": 1e-3, "centre_x": 1e-3, "centre_y": 1e-3, "radial_2": 1e-6, "radial_4": 1e-6}
_POSE_STEP = 1e-6
_ITERATIONS = 60
_CONVERGED = 1e-10

Predict = Callable[[Camera, np.ndarray], np.ndarray]
"""From a camera and a photo's unknowns to what should be measured, in the order of `View.seen`."""


@dataclass(frozen=True)
class View:
    """One photo.

    Attributes:
        name: The file.
        seen: (n,) what was measured; a pixel is 1, as is whatever else a standard deviation of one pixel would be.
        predict: What the model says of it.
        start: (m,) where the search for the photo's unknowns starts.
        pixels: The first so many of `seen` are x and y of points in turn; the rest are not drawn.
    """

    name: str
    seen: np.ndarray
    predict: Predict
    start: np.ndarray
    pixels: int


@dataclass(frozen=True)
class Fit:
    """What came out.

    Attributes:
        camera: The camera.
        errors: Standard error of each parameter that was fitted.
        views: The photos that count.
        poses: The unknowns of each.
        left_out: Names of photos whose error was far above the others'.
    """

    camera: Camera
    errors: dict[str, float]
    views: tuple[View, ...]
    poses: tuple[np.ndarray, ...]
    left_out: tuple[str, ...] = ()

    def residuals(self) -> list[np.ndarray]:
        """What was seen less what the model says, a photo each."""
        return [view.seen - view.predict(self.camera, pose) for view, pose in zip(self.views, self.poses, strict=True)]

    def distances_m(self) -> list[float]:
        """From the camera to the target's middle, a photo each."""
        return [float(np.linalg.norm(pose[3:6])) / 1000.0 for pose in self.poses]

    def rms_px(self) -> list[float]:
        """Root mean square of the distance between point and model, a photo each."""
        pairs = (left[: view.pixels].reshape(-1, 2) for view, left in zip(self.views, self.residuals(), strict=True))
        return [float(np.sqrt((pair**2).sum(axis=1).mean())) for pair in pairs]


def pose_points(points_mm: np.ndarray, pose: np.ndarray) -> np.ndarray:
    """Points (n, 2) of a plane in camera axes, mm; a pose is a rotation vector and a shift in mm."""
    rotation, _ = cv2.Rodrigues(pose[:3])
    return points_mm @ rotation[:, :2].T + pose[3:6]


def start_pose(camera: Camera, points_mm: np.ndarray, pixels: np.ndarray) -> np.ndarray:
    """A pose for points (n, 2) of a plane that are seen at pixels (n, 2)."""
    ideal = (pixels - (camera.centre_x, camera.centre_y)) / camera.focal_px
    ideal = ideal * camera.undistorted(np.linalg.norm(ideal, axis=1))[:, None]
    # t = tan(theta / 2), as in sim/world/camera.py; the plane one unit before the camera.
    squared = (ideal**2).sum(axis=1) / 4.0
    flat = ideal / np.maximum(1.0 - squared, 0.05)[:, None]
    solid = np.column_stack([points_mm, np.zeros(len(points_mm))])
    _, rotation, shift = cv2.solvePnP(solid, flat, np.eye(3), None, flags=cv2.SOLVEPNP_IPPE)
    return np.concatenate([rotation.ravel(), shift.ravel()])


def fit(camera: Camera, views: Sequence[View], free: Sequence[str]) -> Fit:
    """Fit the parameters `free` of the camera, starting from `camera`, and every photo's unknowns.

    Raises:
        UserError: the photos do not determine them.
    """
    poses = [view.start for view in views]
    damping = 1e-3
    cost = _cost(camera, views, poses)
    for _ in range(_ITERATIONS):
        system = [_linear(camera, view, pose, free) for view, pose in zip(views, poses, strict=True)]
        while damping < 1e12:
            moved = _step(camera, poses, system, free, damping)
            moved_cost = _cost(moved[0], views, moved[1]) if moved else np.inf
            if moved_cost <= cost:
                break
            damping *= 10.0
        else:
            break
        camera, poses = moved
        gain, cost, damping = cost - moved_cost, moved_cost, max(damping / 10.0, 1e-12)
        if gain <= _CONVERGED * cost:
            break
    return Fit(camera, _errors(camera, views, poses, free, cost), tuple(views), tuple(poses))


def fit_without_outliers(camera: Camera, views: Sequence[View], free: Sequence[str], times: float = 3.0) -> Fit:
    """`fit`, then again without the photos whose error is more than `times` the median."""
    first = fit(camera, views, free)
    rms_px = np.array(first.rms_px())
    good = rms_px <= times * np.median(rms_px)
    if good.all():
        return first
    kept = [replace(view, start=pose) for view, pose, ok in zip(views, first.poses, good, strict=True) if ok]
    left_out = tuple(view.name for view, ok in zip(views, good, strict=True) if not ok)
    return replace(fit(first.camera, kept, free), left_out=left_out)


def _cost(camera: Camera, views: Sequence[View], poses: Sequence[np.ndarray]) -> float:
    cost = sum(
        float(((view.seen - view.predict(camera, pose)) ** 2).sum()) for view, pose in zip(views, poses, strict=True)
    )
    return cost if np.isfinite(cost) else np.inf


def _linear(camera: Camera, view: View, pose: np.ndarray, free: Sequence[str]) -> tuple[np.ndarray, ...]:
    """Derivatives by the camera (n, k) and by the pose (n, m), and what is left over (n,)."""
    now = view.predict(camera, pose)
    by_camera = np.empty((len(now), len(free)))
    for column, name in enumerate(free):
        step = _STEPS[name]
        by_camera[:, column] = (
            view.predict(replace(camera, **{name: getattr(camera, name) + step}), pose) - now
        ) / step
    by_pose = np.empty((len(now), len(pose)))
    for column in range(len(pose)):
        step = _POSE_STEP * max(1.0, abs(pose[column]))
        moved = pose.copy()
        moved[column] += step
        by_pose[:, column] = (view.predict(camera, moved) - now) / step
    return by_camera, by_pose, view.seen - now


def _reduced(system: list[tuple[np.ndarray, ...]], damping: float) -> tuple[np.ndarray, np.ndarray]:
    """The camera's own normal equations, the poses eliminated."""
    size = system[0][0].shape[1]
    matrix, right = np.zeros((size, size)), np.zeros(size)
    for by_camera, by_pose, left in system:
        inner = _damped(by_pose.T @ by_pose, damping)
        across = np.linalg.solve(inner, by_pose.T @ np.column_stack([by_camera, left]))
        matrix += by_camera.T @ by_camera - by_camera.T @ by_pose @ across[:, :-1]
        right += by_camera.T @ left - by_camera.T @ by_pose @ across[:, -1]
    return matrix, right


def _damped(matrix: np.ndarray, damping: float) -> np.ndarray:
    return matrix + damping * np.diag(np.diag(matrix))


def _step(
    camera: Camera, poses: list[np.ndarray], system: list[tuple[np.ndarray, ...]], free: Sequence[str], damping: float
) -> tuple[Camera, list[np.ndarray]] | None:
    """Camera and poses one step on; None where that is no camera."""
    try:
        matrix, right = _reduced(system, damping)
        change = np.linalg.solve(_damped(matrix, damping), right)
        moved = replace(
            camera, **{name: getattr(camera, name) + float(much) for name, much in zip(free, change, strict=True)}
        )
        after = [
            pose + np.linalg.solve(_damped(by_pose.T @ by_pose, damping), by_pose.T @ (left - by_camera @ change))
            for pose, (by_camera, by_pose, left) in zip(poses, system, strict=True)
        ]
    except (np.linalg.LinAlgError, ValueError):
        return None
    return (moved, after) if moved.focal_px > 0 else None


def _errors(
    camera: Camera, views: Sequence[View], poses: Sequence[np.ndarray], free: Sequence[str], cost: float
) -> dict[str, float]:
    system = [_linear(camera, view, pose, free) for view, pose in zip(views, poses, strict=True)]
    freedom = sum(len(view.seen) - len(view.start) for view in views) - len(free)
    try:
        covariance = np.linalg.inv(_reduced(system, 0.0)[0]) * cost / max(freedom, 1)
    except np.linalg.LinAlgError:
        covariance = np.full((len(free), len(free)), np.nan)
    spread = np.diag(covariance)
    if freedom <= 0 or not np.isfinite(spread).all() or (spread < 0).any():
        raise UserError(
            "these photos do not determine the camera; take more, with the target tilted and near the edges."
        )
    return dict(zip(free, np.sqrt(spread).tolist(), strict=True))

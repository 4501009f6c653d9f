# SPDX-License-Identifier: Apache-2.0
"""The camera of the rendered world: r = 2 f tan(theta / 2), with a polynomial for a lens that differs; looking down.

Camera axes: x right, y down in the image, z along the optical axis. A level
camera looks straight down, with the image's top towards the drone's nose, so
camera x is the drone's right, camera -y its forward and camera z is down.
Integer pixel coordinates are pixel centres.
"""

import functools
import math
from dataclasses import dataclass

import numpy as np

_NEWTON_STEPS = 8


@dataclass(frozen=True)
class Camera:
    """Geometry of the camera; the same model as `firmware/core/camera.c`, whose inverse is here.

    With u = 2 tan(theta / 2) and q = u^2 a ray meets the image at r = f u (1 + radial_2 q + radial_4 q^2) from the
    principal point.

    Attributes:
        width: Pixels a line.
        height: Lines a frame.
        focal_px: f in pixels.
        centre_x: Column of the principal point.
        centre_y: Line of the principal point.
        radial_2: Distortion; below 0 is a barrel, above 0 a pincushion.
        radial_4: The same, farther out.
    """

    width: int = 1280
    height: int = 720
    focal_px: float = 552.0
    centre_x: float = 640.0
    centre_y: float = 360.0
    radial_2: float = 0.0
    radial_4: float = 0.0

    def __post_init__(self) -> None:
        turn = self._turning_point()
        if math.isfinite(turn) and self._corner() >= turn * self._factor(turn**2):
            raise ValueError("with radial_2 and radial_4 like this the lens does not reach the corners of the frame")

    def scaled(self, divisor: int) -> "Camera":
        """The same field of view in a frame `divisor` times smaller, for quick tests."""
        return Camera(
            self.width // divisor,
            self.height // divisor,
            self.focal_px / divisor,
            self.centre_x / divisor,
            self.centre_y / divisor,
            self.radial_2,
            self.radial_4,
        )

    def project(self, points: np.ndarray) -> np.ndarray:
        """Image of points in camera axes.

        Args:
            points: (..., 3), any unit of length; not all zero, not on the negative optical axis.

        Returns:
            (..., 2) pixel coordinates x, y; may lie outside the frame.
        """
        points = np.asarray(points, dtype=np.float64)
        axial = points[..., 2]
        distance = np.linalg.norm(points, axis=-1)
        # 2 tan(theta / 2) = 2 sin(theta) / (1 + cos(theta)): no arc tangent, and exact on the axis.
        scale = 2.0 / (distance + axial)
        if self.distorts:
            # Past the turning point the image would come back into the frame; there it stays outside.
            off_axis = np.minimum(scale * np.hypot(points[..., 0], points[..., 1]), self._turning_point())
            scale = scale * self._factor(off_axis**2)
        scale = self.focal_px * scale
        return np.stack([self.centre_x + scale * points[..., 0], self.centre_y + scale * points[..., 1]], axis=-1)

    def rays(self) -> np.ndarray:
        """Unit vectors in camera axes through every pixel centre: (height, width, 3) float32, read only."""
        return _rays(self)

    @property
    def distorts(self) -> bool:
        """The lens differs from r = 2 f tan(theta / 2)."""
        return self.radial_2 != 0 or self.radial_4 != 0

    def _factor(self, q: np.ndarray | float) -> np.ndarray | float:
        return 1.0 + q * (self.radial_2 + q * self.radial_4)

    def _slope(self, q: np.ndarray | float) -> np.ndarray | float:
        """Of u times the factor."""
        return 1.0 + q * (3.0 * self.radial_2 + q * 5.0 * self.radial_4)

    def undistorted(self, r: np.ndarray) -> np.ndarray:
        """The u / r for each r = u times the factor, by Newton's method."""
        u = r.copy()
        for _ in range(_NEWTON_STEPS):
            u -= (u * self._factor(u**2) - r) / self._slope(u**2)
        return np.divide(u, r, out=np.ones_like(r), where=r > 0)

    def _corner(self) -> float:
        """The farthest corner's r / f."""
        across = max(self.centre_x, self.width - 1 - self.centre_x)
        down = max(self.centre_y, self.height - 1 - self.centre_y)
        return math.hypot(across, down) / self.focal_px

    def _turning_point(self) -> float:
        """The u at which r stops growing."""
        roots = np.roots([5.0 * self.radial_4, 3.0 * self.radial_2, 1.0])
        squares = [float(root.real) for root in roots if abs(root.imag) < 1e-12 and root.real > 0]
        return math.sqrt(min(squares, default=math.inf))


@functools.lru_cache(maxsize=4)
def _rays(camera: Camera) -> np.ndarray:
    across = (np.arange(camera.width) - camera.centre_x)[None, :] / (2.0 * camera.focal_px)
    down = (np.arange(camera.height) - camera.centre_y)[:, None] / (2.0 * camera.focal_px)
    if camera.distorts:
        straight = camera.undistorted(2.0 * np.hypot(across, down))
        across, down = across * straight, down * straight
    # t = tan(theta / 2): sin(theta) = 2 t / (1 + t^2), cos(theta) = (1 - t^2) / (1 + t^2).
    squared = across**2 + down**2
    rays = np.empty((camera.height, camera.width, 3), np.float32)
    rays[..., 0] = 2.0 * across / (1.0 + squared)
    rays[..., 1] = 2.0 * down / (1.0 + squared)
    rays[..., 2] = (1.0 - squared) / (1.0 + squared)
    rays.flags.writeable = False
    return rays

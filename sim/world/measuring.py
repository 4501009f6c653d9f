# SPDX-License-Identifier: Apache-2.0
"""Where shapes are, found in other ways than the renderer draws them; for its tests."""

import cv2
import numpy as np

from sim.world.look import Look


def outline(points_mm: np.ndarray) -> np.ndarray:
    """Closed outline (4 n, 2) with n points on each side of a polygon."""
    share = np.linspace(0, 1, 200, endpoint=False)[:, None]
    following = np.roll(points_mm, -1, axis=0)
    return np.concatenate([a + share * (b - a) for a, b in zip(points_mm, following, strict=True)])


def box(x: float, y: float, width: float, height: float) -> np.ndarray:
    """Outline of an upright rectangle about x, y."""
    half = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]]) * (width / 2, height / 2)
    return outline(half + np.array([x, y]))


def circle(radius: float) -> np.ndarray:
    """Outline about the origin."""
    turn = np.linspace(0, 2 * np.pi, 2000, endpoint=False)
    return radius * np.column_stack([np.cos(turn), np.sin(turn)])


def area_and_centroid(polygon: np.ndarray) -> tuple[float, np.ndarray]:
    """By the shoelace formula."""
    following = np.roll(polygon, -1, axis=0)
    cross = polygon[:, 0] * following[:, 1] - following[:, 0] * polygon[:, 1]
    area = cross.sum() / 2
    return abs(area), ((polygon + following) * cross[:, None]).sum(axis=0) / (6 * area)


def measured(image: np.ndarray, window: np.ndarray, look: Look) -> tuple[float, np.ndarray]:
    """Area and centroid of what is dark inside a window given by its outline in pixels."""
    mask = np.zeros(image.shape[:2], np.uint8)
    cv2.fillPoly(mask, [np.rint(window).astype(np.int32)], 1)
    weight = mask * (look.white - image[..., 0].astype(float)) / (look.white - look.black)
    moments = cv2.moments(weight)
    return moments["m00"], np.array([moments["m10"], moments["m01"]]) / moments["m00"]

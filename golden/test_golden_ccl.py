# SPDX-License-Identifier: Apache-2.0
"""The golden labelling against OpenCV's, whose labels give area, box, centroid and, summed here, the moments."""

import cv2
import numpy as np
import pytest

from golden.ccl import ccl

SIZES = [(1, 1), (1, 17), (17, 1), (2, 2), (5, 4), (16, 16), (33, 31), (96, 64)]


def from_opencv(binary: np.ndarray) -> dict[str, np.ndarray]:
    """Return the features of all components in raster order of their last pixels, through OpenCV's label map."""
    count, labels, stats, centroids = cv2.connectedComponentsWithStats(binary.astype(np.uint8), connectivity=8)
    place = np.full(count, -1)
    np.maximum.at(place, labels.ravel(), np.arange(labels.size))
    order = np.argsort(place[1:]) + 1
    y, x = np.mgrid[0 : binary.shape[0], 0 : binary.shape[1]]
    features = {
        "area": stats[:, cv2.CC_STAT_AREA],
        "box_min_x": stats[:, cv2.CC_STAT_LEFT],
        "box_min_y": stats[:, cv2.CC_STAT_TOP],
        "box_max_x": stats[:, cv2.CC_STAT_LEFT] + stats[:, cv2.CC_STAT_WIDTH] - 1,
        "box_max_y": stats[:, cv2.CC_STAT_TOP] + stats[:, cv2.CC_STAT_HEIGHT] - 1,
        "centroid_x": centroids[:, 0],
        "centroid_y": centroids[:, 1],
    }
    for name, value in {"sum_x": x, "sum_y": y, "sum_xx": x * x, "sum_yy": y * y, "sum_xy": x * y}.items():
        total = np.zeros(count, np.int64)
        np.add.at(total, labels.ravel(), value.ravel())
        features[name] = total
    return {name: value[order] for name, value in features.items()}


def check(binary: np.ndarray) -> None:
    """Assert that both labellings agree in every feature."""
    objects, expected = ccl(binary), from_opencv(binary)
    assert objects.size == expected["area"].size
    np.testing.assert_allclose(objects["sum_x"] / objects["area"], expected.pop("centroid_x"), rtol=0, atol=1e-9)
    np.testing.assert_allclose(objects["sum_y"] / objects["area"], expected.pop("centroid_y"), rtol=0, atol=1e-9)
    for name, value in expected.items():
        np.testing.assert_array_equal(objects[name].astype(np.int64), value, err_msg=name)


def spiral(height: int, width: int) -> np.ndarray:
    """One wall of 1 pixel winding to the centre, a way of 1 pixel between its turns."""
    image = np.zeros((height, width), np.uint8)
    image[0, 0] = 1
    y = x = turn = 0
    across, down = width - 1, height - 1
    while across > 0 and down > 0:
        dy, dx = [(0, 1), (1, 0), (0, -1), (-1, 0)][turn % 4]
        for _ in range(across if dx else down):
            y, x = y + dy, x + dx
            image[y, x] = 1
        across -= 2 * (dx != 0 and turn > 0)
        down -= 2 * (dy != 0)
        turn += 1
    return image


def structured(height: int, width: int) -> dict[str, np.ndarray]:
    """Return pictures that are hard for a labeller."""
    y, x = np.mgrid[0:height, 0:width]
    side = np.minimum(x, width - 1 - x)
    up = height - 1 - y
    return {
        "black": np.zeros((height, width)),
        "white": np.ones((height, width)),
        "checkerboard": (x + y) % 2,
        "dots": (x % 2 == 0) & (y % 2 == 0),
        "comb down": (x % 2 == 0) | (y == 0),
        "comb up": (x % 2 == 0) | (up == 0),
        "nested U": np.where(side <= up, side % 2 == 0, up % 2 == 0),
        "nested caps": np.where(side <= y, side % 2 == 0, y % 2 == 0),
        "nested frames": np.minimum(side, np.minimum(y, up)) % 2 == 0,
        "stairs": (x + y) % 3 == 0,
        "spiral": spiral(height, width),
    }


@pytest.mark.parametrize(("height", "width"), SIZES)
@pytest.mark.parametrize("percent", [1, 5, 20, 35, 41, 50, 65, 80, 95, 99])
def test_random_pictures_agree_with_opencv(height: int, width: int, percent: int) -> None:
    rng = np.random.default_rng(height * 1000 + width * 100 + percent)
    for _ in range(5):
        check(rng.random((height, width)) * 100 < percent)


@pytest.mark.parametrize(("height", "width"), SIZES)
def test_structured_pictures_agree_with_opencv(height: int, width: int) -> None:
    for name, image in structured(height, width).items():
        try:
            check(image)
        except AssertionError as error:
            raise AssertionError(f"{name} {width}x{height}: {error}") from error


def test_whole_frames_agree_with_opencv() -> None:
    rng = np.random.default_rng(1)
    check(np.ones((720, 1280)))
    check(rng.random((720, 1280)) < 0.4)


def test_min_area_and_zeros() -> None:
    image = np.array([[1, 1, 0, 0, 1], [0, 0, 0, 0, 0], [1, 0, 1, 1, 1]])
    assert ccl(image)["area"].tolist() == [2, 1, 1, 3]
    assert ccl(image, min_area=2)["area"].tolist() == [2, 3]
    assert ccl(image, label_zeros=True)["area"].tolist() == [8]
    assert ccl(np.zeros((2, 3), int)).size == 0

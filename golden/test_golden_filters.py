# SPDX-License-Identifier: Apache-2.0
"""The integer models of the stream filters against OpenCV, bit for bit."""

from collections.abc import Callable
from random import Random

import cv2
import numpy as np
import pytest

from golden.dilate3x3 import dilate3x3
from golden.erode3x3 import erode3x3
from golden.gaussian5x5 import gaussian5x5
from golden.median5x5 import median5x5
from golden.rgb2gray import rgb2gray
from tb.common.patterns import random_frame, structured_frames

BOX = np.ones((3, 3), np.uint8)


def on_0_255(cv2_filter: Callable[[np.ndarray], np.ndarray]) -> Callable[[np.ndarray], np.ndarray]:
    """Return a filter on 0 and 1 made from a filter of cv2 on 0 and 255."""
    return lambda binary: cv2_filter(binary * np.uint8(255)) // 255


FILTERS = {
    # name: model, cv2, bits of a pixel, least width, least height
    "gaussian5x5": (gaussian5x5, lambda gray: cv2.GaussianBlur(gray, (5, 5), 0.65), 8, 3, 3),
    "erode3x3": (erode3x3, on_0_255(lambda binary: cv2.erode(binary, BOX)), 1, 2, 1),
    "dilate3x3": (dilate3x3, on_0_255(lambda binary: cv2.dilate(binary, BOX)), 1, 2, 1),
    "median5x5": (median5x5, on_0_255(lambda binary: cv2.medianBlur(binary, 5)), 1, 2, 1),
}


def assert_equal(name: str, frame: np.ndarray, what: str) -> None:
    model, reference, *_ = FILTERS[name]
    frame = frame.astype(np.uint8)
    got, expected = model(frame), reference(frame)
    assert got.dtype == np.uint8
    bad = np.argwhere(got != expected)
    assert not bad.size, f"{name}, {what}, {frame.shape}: {len(bad)} pixels differ, the first at (y, x) {bad[0]}"


def test_rgb2gray_all_colours() -> None:
    green, blue = np.mgrid[0:256, 0:256].astype(np.uint8)
    for red in range(256):
        rgb = np.dstack([np.full_like(green, red), green, blue])
        assert np.array_equal(rgb2gray(rgb), cv2.cvtColor(rgb, cv2.COLOR_RGB2GRAY)), f"red {red}"


@pytest.mark.parametrize("name", FILTERS)
def test_every_small_size(name: str) -> None:
    rng = Random(1)
    _, _, bits, least_width, least_height = FILTERS[name]
    for height in range(least_height, 12):
        for width in range(least_width, 12):
            for _ in range(20):
                assert_equal(name, random_frame(rng, width, height, bits), "random")


@pytest.mark.parametrize("name", FILTERS)
@pytest.mark.parametrize("size", [(16, 9), (31, 17), (64, 48), (257, 63)])
def test_structured(name: str, size: tuple[int, int]) -> None:
    for what, frame in structured_frames(Random(2), *size, FILTERS[name][2]).items():
        assert_equal(name, frame, what)


@pytest.mark.parametrize("name", FILTERS)
def test_full_size(name: str) -> None:
    rng = Random(3)
    for _ in range(3):
        assert_equal(name, random_frame(rng, 1280, 720, FILTERS[name][2]), "random 720p")


@pytest.mark.parametrize("name", ["erode3x3", "dilate3x3", "median5x5"])
def test_every_binary_neighbourhood(name: str) -> None:
    """All 2^12 contents of 4x3 frames; for the median too, whose window then is all border."""
    for value in range(1 << 12):
        bits = np.array([value >> bit & 1 for bit in range(12)], np.uint8).reshape(3, 4)
        assert_equal(name, bits, f"content {value:#x}")

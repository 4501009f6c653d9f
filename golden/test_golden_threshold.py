# SPDX-License-Identifier: Apache-2.0
"""The threshold models against plain loops and against float64 interpolation."""

import numpy as np
import numpy.typing as npt
import pytest

from golden.threshold_apply import threshold_apply, threshold_map
from golden.threshold_stats import threshold_stats, window_count

SIZES = [(1, 1), (2, 3), (127, 129), (128, 128), (129, 127), (129, 1), (1, 257), (255, 256), (300, 511), (1280, 720)]


def _float_levels(thresholds: npt.NDArray[np.float64], width: int, height: int, side: int) -> npt.NDArray[np.float64]:
    """Return bilinear thresholds by `np.interp` along both axes.

    float64 is exact here: a threshold has 16 bits, `np.interp` forms slope * distance with a slope that is a 17-bit
    integer over a power of two and a distance of at most `window_log2 + 1` bits, so the results of both passes have at
    most 34 significant bits of the 53 there are.
    """
    rows = np.arange(thresholds.shape[0]) * side + (side - 1) / 2
    columns = np.arange(thresholds.shape[1]) * side + (side - 1) / 2
    tall = np.stack([np.interp(np.arange(height), rows, column) for column in thresholds.T], axis=1)
    return np.stack([np.interp(np.arange(width), columns, line) for line in tall])


def _random_frame(rng: np.random.Generator, width: int, height: int) -> npt.NDArray[np.uint8]:
    """Return noise around a level that wanders, so that the decision is close in many places."""
    level = rng.integers(0, 256, (window_count(height), window_count(width)), dtype=np.uint8)
    base = np.kron(level, np.ones((128, 128), dtype=np.uint8))[:height, :width].astype(np.int64)
    return np.clip(base + rng.integers(-40, 41, (height, width)), 0, 255).astype(np.uint8)


@pytest.mark.parametrize(("width", "height"), SIZES)
def test_stats_equal_plain_loops(width: int, height: int) -> None:
    """Every window, cut ones too, against minimum and maximum of a slice."""
    rng = np.random.default_rng(width * 1000 + height)
    gray = _random_frame(rng, width, height)
    for window_log2 in (3, 7):
        side = 1 << window_log2
        stats = threshold_stats(gray, 77, window_log2)
        assert stats.minimum.shape == (-(-height // side), -(-width // side))
        for row in range(stats.minimum.shape[0]):
            for column in range(stats.minimum.shape[1]):
                window = gray[row * side : (row + 1) * side, column * side : (column + 1) * side]
                low, high = int(window.min()), int(window.max())
                threshold = (low << 8) + 77 * (high - low)
                assert stats.beats()[row, column] == (high << 24 | low << 16 | threshold)


@pytest.mark.parametrize(("width", "height"), [(8, 8), (9, 9), (37, 41), (64, 7), (7, 64), (64, 64)])
def test_flat_windows_equal_a_search(width: int, height: int) -> None:
    """The window that a flat one takes its threshold from, found by walking left and up instead of passing it on."""
    rng = np.random.default_rng(width * 100 + height)
    for flat_limit in (0, 1, 16, 40, 120, 255):
        amplitude = rng.choice([1, 16, 17, 41, 200], (window_count(height, 3), window_count(width, 3)))
        noise = rng.integers(0, np.kron(amplitude, np.ones((8, 8), dtype=np.int64))[:height, :width])
        gray = (noise + rng.integers(0, 56)).astype(np.uint8)
        own, got = threshold_stats(gray, 77, 3), threshold_stats(gray, 77, 3, flat_limit)
        np.testing.assert_array_equal(got.minimum, own.minimum)
        np.testing.assert_array_equal(got.maximum, own.maximum)
        flat = own.maximum.astype(np.int64) - own.minimum < flat_limit
        for place, threshold in np.ndenumerate(got.threshold):
            source = place
            while flat[source] and source != (0, 0):
                row, column = source
                source = (row, column - 1) if column else (row - 1, 0)
            assert threshold == own.threshold[source]


def test_flat_windows_by_hand() -> None:
    """Windows of 2x2, limit 10: 9 is flat, 10 is not; each flat one with the threshold that is written beside it."""
    minimum = np.array([[50, 10, 20], [30, 90, 60], [70, 80, 100]])
    spread = np.array([[9, 10, 9], [9, 9, 40], [0, 20, 9]])
    gray = np.kron(minimum, np.ones((2, 2), dtype=np.int64))
    gray[1::2, 1::2] += spread
    stats = threshold_stats(gray.astype(np.uint8), 128, 1, 10)
    expected = np.array([[54.5, 15, 15], [54.5, 54.5, 80], [54.5, 90, 90]])
    np.testing.assert_array_equal(stats.threshold, expected * 256)
    np.testing.assert_array_equal(stats.minimum, minimum)
    np.testing.assert_array_equal(stats.maximum, minimum + spread)


@pytest.mark.parametrize("factor", range(257))
def test_every_factor_and_spread(factor: int) -> None:
    """All pairs of least and greatest pixel at each factor."""
    low, high = np.triu_indices(256)
    gray = np.stack([low, high], axis=1).astype(np.uint8)  # A window of one line and two pixels holds each pair.
    spreads = threshold_stats(gray.reshape(1, -1), factor, window_log2=1)
    expected = low * 256 + factor * (high - low)
    np.testing.assert_array_equal(spreads.threshold[0], expected)
    assert int(expected.max()) <= 0xFF00


def test_factors_above_one_act_as_one() -> None:
    """The register holds nine bits; 257 to 511 have no meaning of their own."""
    gray = np.array([[10, 200]], dtype=np.uint8)
    for factor in (256, 257, 511):
        assert threshold_stats(gray, factor).threshold[0, 0] == 200 << 8


@pytest.mark.parametrize(("width", "height"), SIZES)
@pytest.mark.parametrize("factor", [0, 1, 64, 128, 255, 256])
def test_decision_equals_float64_bilinear(width: int, height: int, factor: int) -> None:
    """Real windows, from one pixel to 1280x720."""
    rng = np.random.default_rng(width * 7919 + height * 31 + factor)
    before, frame = _random_frame(rng, width, height), _random_frame(rng, width, height)
    thresholds = threshold_stats(before, factor).threshold
    levels = _float_levels(thresholds / 256, width, height, 128)
    np.testing.assert_array_equal(threshold_map(thresholds, width, height), levels * 2**24)
    np.testing.assert_array_equal(threshold_apply(frame, thresholds), frame > levels)
    np.testing.assert_array_equal(threshold_apply(frame, thresholds, dark_is_one=True), frame <= levels)


@pytest.mark.parametrize("window_log2", [1, 2, 3, 5])
def test_small_windows_equal_float64_bilinear(window_log2: int) -> None:
    """The windows that the simulations use."""
    rng = np.random.default_rng(window_log2)
    side = 1 << window_log2
    for _ in range(50):
        height, width = (int(n) for n in rng.integers(1, 4 * side + 2, 2))
        shape = (window_count(height, window_log2), window_count(width, window_log2))
        thresholds = rng.integers(0, 0xFF01, shape, dtype=np.uint16)
        levels = _float_levels(thresholds / 256, width, height, side)
        scale = 2 ** (10 + 2 * window_log2)
        np.testing.assert_array_equal(threshold_map(thresholds, width, height, window_log2), levels * scale)


def test_a_threshold_on_a_pixel_value_is_dark() -> None:
    """The comparison is strict."""
    gray = np.array([[99, 100, 101]], dtype=np.uint8)
    np.testing.assert_array_equal(threshold_apply(gray, np.array([[100 << 8]], dtype=np.uint16)), [[0, 0, 1]])


def test_without_thresholds_all_is_background() -> None:
    """Background is what bright pixels become."""
    gray = np.array([[0, 255]], dtype=np.uint8)
    np.testing.assert_array_equal(threshold_apply(gray, None), [[1, 1]])
    np.testing.assert_array_equal(threshold_apply(gray, None, dark_is_one=True), [[0, 0]])


def test_wrong_shapes_are_refused() -> None:
    """A set of another frame size is an error, not a guess."""
    with pytest.raises(ValueError, match="shape"):
        threshold_apply(np.zeros((720, 1280), dtype=np.uint8), np.zeros((5, 10), dtype=np.uint16))
    with pytest.raises(ValueError, match="non-empty"):
        threshold_stats(np.zeros((0, 4), dtype=np.uint8), 64)
    with pytest.raises(ValueError, match="factor"):
        threshold_stats(np.zeros((1, 4), dtype=np.uint8), -1)
    for flat_limit in (-1, 256):
        with pytest.raises(ValueError, match="flat limit"):
            threshold_stats(np.zeros((1, 4), dtype=np.uint8), 64, flat_limit=flat_limit)

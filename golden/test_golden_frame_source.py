# SPDX-License-Identifier: Apache-2.0
"""The bytes of a picture are those that Pillow calls BGRX; a frame with its rest blank; the places of 720p."""

import numpy as np
import pytest

from golden.frame_source import BLANK, Places, frame_of, memory_of, shown

RNG = np.random.default_rng(1)


@pytest.mark.parametrize(("width", "height"), [(1, 1), (3, 5), (1280, 720)])
def test_a_picture_comes_back(width: int, height: int) -> None:
    rgb = RNG.integers(0, 256, (height, width, 3), np.uint8)
    memory = memory_of(rgb)
    assert len(memory) == 4 * width * height
    assert memory[:4] == bytes([*rgb[0, 0, ::-1], 0])
    wide = rgb.astype(np.uint32)
    assert np.array_equal(frame_of(memory, width, height), wide[..., 0] << 16 | wide[..., 1] << 8 | wide[..., 2])


def test_the_fourth_byte_is_not_looked_at() -> None:
    assert frame_of(bytes([1, 2, 3, 255]), 1, 1)[0, 0] == 0x030201


@pytest.mark.parametrize("in_time", [0, 7, 15, None])
def test_the_rest_is_blank(in_time: int | None) -> None:
    frame = RNG.integers(0, 1 << 24, (3, 5), np.uint32)
    count = 15 if in_time is None else in_time
    assert shown(frame, in_time).tolist() == [*frame.ravel()[:count].tolist(), *[BLANK] * (15 - count)]


def test_the_places_of_720p() -> None:
    """As CTA-861 has them (VIC 4): 1280 pixels, 110, 40, 220; 720 lines, 5, 5, 20."""
    places = Places()
    line = [places.at(cycle) for cycle in range(1650)]
    assert sum(de for de, _, _ in line) == 1280
    assert [cycle for cycle, (_, hsync, _) in enumerate(line) if hsync] == list(range(1390, 1430))
    column = [places.at(1650 * y) for y in range(750)]
    assert sum(de for de, _, _ in column) == 720
    assert [y for y, (_, _, vsync) in enumerate(column) if vsync] == list(range(725, 730))

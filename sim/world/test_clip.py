# SPDX-License-Identifier: Apache-2.0
"""The bundled clip is a descent that ends over the pad."""

import itertools

import numpy as np
import pytest

from sim.world.camera import Camera
from sim.world.clip import demo_clip, images


@pytest.mark.parametrize("count", [2, 4, 6, 9])
def test_the_clip_descends_from_two_metres_to_half_a_metre(count: int) -> None:
    clip = demo_clip(count)
    truths = [frame.truth for frame in clip]
    altitudes = [truth.altitude_m for truth in truths]
    assert len(clip) == count
    assert (altitudes[0], altitudes[-1]) == (2.0, 0.5)
    assert altitudes == sorted(altitudes, reverse=True)
    assert all(truth.visible for truth in truths)
    assert abs(truths[0].right_m) > 0.3
    assert abs(truths[-1].right_m) < 0.05


def test_altitudes_are_whole_millimetres() -> None:
    for frame in demo_clip(7):
        assert 1000 * frame.truth.altitude_m == pytest.approx(round(1000 * frame.truth.altitude_m), abs=1e-9)


def test_one_frame_is_no_clip() -> None:
    with pytest.raises(ValueError, match="2 frames"):
        demo_clip(1)


def test_frames_differ_and_have_the_cameras_size() -> None:
    frames = list(images(demo_clip(3, Camera().scaled(4))))
    assert [frame.shape for frame in frames] == [(180, 320, 3)] * 3
    assert all(np.any(a != b) for a, b in itertools.pairwise(frames))

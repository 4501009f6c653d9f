# SPDX-License-Identifier: Apache-2.0
"""Verilated cores with random frames of full size, back to back, under random gaps: nothing is lost or doubled."""

import numpy as np
import pytest

from golden.threshold_stats import threshold_stats
from tb.exhaustive.test_every_input import as_beats, build, first_difference, model, play

pytestmark = pytest.mark.full

WIDTH, HEIGHT, FRAMES, FACTOR = 1280, 720, 3, 77
GAPS = [(0, 0), (50, 0), (0, 50), (40, 40)]
"""Per cent of idle and of stalled cycles."""
BITS = {
    "dilate3x3": 1,
    "erode3x3": 1,
    "gaussian5x5": 8,
    "median5x5": 1,
    "rgb2gray": 24,
    "threshold_apply": 8,
    "threshold_stats": 8,
}


def expected_beats(core: str, frames: np.ndarray) -> np.ndarray:
    """What a core makes of frames (count, height, width); threshold_apply has no thresholds: all pixels are bright."""
    if core == "rgb2gray":
        frames = np.stack([frames >> 16, frames >> 8 & 255, frames & 255], axis=-1)
    planes = frames.astype(np.uint8)
    if core == "threshold_stats":
        return np.concatenate([as_beats(threshold_stats(plane, FACTOR).beats()[None]) for plane in planes])
    if core == "threshold_apply":
        return as_beats(np.ones_like(planes))
    return as_beats(np.stack([model(core)(plane) for plane in planes]))


@pytest.mark.parametrize("core", BITS)
def test_whole_frames_with_gaps(core: str) -> None:
    defines = {"rgb2gray": "", "threshold_stats": "-DSIZED -DSTATS"}.get(core, "-DSIZED")
    player = build(core, *(("-CFLAGS", defines) if defines else ()), kind="whole_frames")
    frames = np.random.default_rng(1).integers(0, 1 << BITS[core], (FRAMES, HEIGHT, WIDTH), dtype=np.int64)
    wanted = expected_beats(core, frames)
    for gaps in GAPS:
        got = play(player, as_beats(frames), WIDTH, HEIGHT, FACTOR, gaps=gaps)
        difference = first_difference(got, wanted)
        assert not difference, f"{core}, {gaps[0]} % idle, {gaps[1]} % stalled: {difference}"

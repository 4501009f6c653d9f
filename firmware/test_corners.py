# SPDX-License-Identifier: Apache-2.0
"""How much of a square the PL's filters leave: the constant of firmware/core/pad_fit.c, measured."""

import re
from pathlib import Path

import cv2
import numpy as np
import pytest

from golden.dilate3x3 import dilate3x3
from golden.erode3x3 import erode3x3
from golden.median5x5 import median5x5

SOURCE = Path(__file__).with_name("core") / "pad_fit.c"
OVERSAMPLING, FRAME_PX, BLUR_PX, TURNS = 4, 80, 0.85, 24


@pytest.mark.parametrize("side_px", [12, 20, 30, 50])
def test_corners_lose_what_the_fit_expects(side_px: int) -> None:
    found = re.search(r"#define CORNERS_LOST_PX ([0-9.]+)", SOURCE.read_text(encoding="utf-8"))
    assert found is not None, f"{SOURCE} has no CORNERS_LOST_PX"
    random = np.random.default_rng(side_px)
    fine = (np.arange(FRAME_PX * OVERSAMPLING) + 0.5) / OVERSAMPLING - 0.5
    lost = []
    for turn in np.linspace(0.0, np.pi / 2, TURNS, endpoint=False):
        x, y = np.meshgrid(*(fine - (FRAME_PX / 2 + shift) for shift in random.uniform(-0.5, 0.5, 2)))
        along, across = x * np.cos(turn) + y * np.sin(turn), y * np.cos(turn) - x * np.sin(turn)
        sharp = ((np.abs(along) < side_px / 2) & (np.abs(across) < side_px / 2)).astype(np.float32)
        seen = cv2.GaussianBlur(cv2.resize(sharp, (FRAME_PX, FRAME_PX), interpolation=cv2.INTER_AREA), (0, 0), BLUR_PX)
        left = dilate3x3(median5x5(erode3x3((seen > 0.5).astype(np.uint8))))
        lost.append(side_px**2 - int(left.sum()))
    assert abs(np.mean(lost) - float(found[1])) < 2.5, f"{np.mean(lost):.1f} px of {side_px}x{side_px}"

# SPDX-License-Identifier: Apache-2.0
"""All golden models in a row: what every stage makes of a frame, given the thresholds of the frame before."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field

import numpy as np

from golden.ccl import ccl
from golden.dilate3x3 import dilate3x3
from golden.erode3x3 import erode3x3
from golden.gaussian5x5 import gaussian5x5
from golden.generated.landing_regs import OBJECT_DTYPE, THRESHOLD_FACTOR_SHIFT, THRESHOLD_FLAT_LIMIT_SHIFT
from golden.median5x5 import median5x5
from golden.rgb2gray import rgb2gray
from golden.threshold_apply import threshold_apply
from golden.threshold_stats import WindowStats, threshold_stats


@dataclass(frozen=True)
class Settings:
    """Registers that decide what the chain does; the defaults are what the firmware starts with.

    Attributes:
        factor: THRESHOLD.factor, Q1.8.
        flat_limit: THRESHOLD.flat_limit, gray levels.
        dark_is_one: CTRL.dark_is_one.
        label_zeros: CTRL.label_zeros.
        min_area: MIN_AREA, pixels.
    """

    factor: int = 128
    flat_limit: int = 16
    dark_is_one: bool = True
    label_zeros: bool = False
    min_area: int = 100

    @property
    def threshold_register(self) -> int:
        """The register THRESHOLD."""
        return self.flat_limit << THRESHOLD_FLAT_LIMIT_SHIFT | self.factor << THRESHOLD_FACTOR_SHIFT


PAPER = Settings(factor=64, flat_limit=0, dark_is_one=False, label_zeros=True, min_area=30)
"""The paper's order of things, which the registers hold after reset."""


@dataclass(frozen=True)
class BinaryStages:
    """What leaves each stage behind the threshold; pictures are uint8 (height, width) of 0 and 1.

    Attributes:
        binary: From `threshold_apply`.
        eroded: From `erode3x3`.
        median: From `median5x5`.
        dilated: From `dilate3x3`.
        objects: `OBJECT_DTYPE`, from `ccl`, in the order of `golden.ccl`.
    """

    binary: np.ndarray = field(repr=False)
    eroded: np.ndarray = field(repr=False)
    median: np.ndarray = field(repr=False)
    dilated: np.ndarray = field(repr=False)
    objects: np.ndarray = field(repr=False)


@dataclass(frozen=True)
class Stages(BinaryStages):
    """What leaves each stage for one frame; pictures are uint8 (height, width).

    Attributes:
        rgb: uint8 (height, width, 3), what the camera sent.
        gray: From `rgb2gray`.
        smooth: From `gaussian5x5` and again from `threshold_stats`.
        stats: Of this frame, from `threshold_stats`; they serve the next one.
        stats_before: Of the frame before, whose thresholds `threshold_apply` used; None = none yet.
    """

    rgb: np.ndarray = field(repr=False)
    gray: np.ndarray = field(repr=False)
    smooth: np.ndarray = field(repr=False)
    stats: WindowStats = field(repr=False)
    stats_before: WindowStats | None = field(repr=False)


def binary_stages(smooth: np.ndarray, stats_before: WindowStats | None, settings: Settings) -> BinaryStages:
    """Run the stages behind `gaussian5x5`.

    Args:
        smooth: uint8 (height, width).
        stats_before: `stats` of the frame before; None before the first complete frame.
        settings: Registers.
    """
    binary = threshold_apply(smooth, stats_before.threshold if stats_before else None, settings.dark_is_one)
    eroded = erode3x3(binary)
    median = median5x5(eroded)
    dilated = dilate3x3(median)
    objects = np.asarray(ccl(dilated, settings.min_area, settings.label_zeros), OBJECT_DTYPE)
    return BinaryStages(binary, eroded, median, dilated, objects)


def run_chain(rgb: np.ndarray, stats_before: WindowStats | None, settings: Settings | None = None) -> Stages:
    """Run one frame.

    Args:
        rgb: uint8 (height, width, 3).
        stats_before: `stats` of the frame before; None before the first complete frame.
        settings: Registers; default those of the firmware.
    """
    settings = settings or Settings()
    gray = rgb2gray(rgb)
    smooth = gaussian5x5(gray)
    return Stages(
        rgb=rgb,
        gray=gray,
        smooth=smooth,
        stats=threshold_stats(smooth, settings.factor, flat_limit=settings.flat_limit),
        stats_before=stats_before,
        **vars(binary_stages(smooth, stats_before, settings)),
    )


def run_frames(frames: Iterable[np.ndarray], settings: Settings | None = None) -> Iterator[Stages]:
    """Run frames one after another, each with the thresholds of the one before."""
    before = None
    for rgb in frames:
        stages = run_chain(rgb, before, settings)
        yield stages
        before = stages.stats

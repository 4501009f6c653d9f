# SPDX-License-Identifier: Apache-2.0
"""Illegal parameters must fail elaboration, with a sentence in the name of the module that is missing."""

import re
import subprocess
from typing import NamedTuple

import pytest

from tb.common.cores import ROOT, load_core

WIDTH = "ERROR_max_width_must_be_at_least_the_least_width_and_at_most_32768"
HEIGHT = "ERROR_max_height_must_be_at_least_the_least_height_and_at_most_32768"


class Limit(NamedTuple):
    """Values on both sides of a limit, of a parameter of a core or of a module in it, and what refuses the bad one."""

    core: str
    parameter: str
    illegal: int
    legal: int
    error: str
    module: str = ""
    also: tuple[str, int] | None = None

    def __str__(self) -> str:
        return f"{self.module or self.core}-{self.parameter}={self.illegal}"


def limits(core: str, parameter: str, span: tuple[int, int], error: str, module: str = "") -> list[Limit]:
    """Both ends of a range."""
    least, most = span
    return [
        Limit(core, parameter, least - 1, least, error, module),
        Limit(core, parameter, most + 1, most, error, module),
    ]


LIMITS = [
    *limits("gaussian5x5", "MAX_WIDTH", (3, 32768), WIDTH),
    *limits("gaussian5x5", "MAX_HEIGHT", (3, 32768), HEIGHT),
    *(
        limit
        for core in ("erode3x3", "dilate3x3", "median5x5")
        for limit in limits(core, "MAX_WIDTH", (2, 32768), WIDTH)
    ),
    *(
        limit
        for core in ("erode3x3", "dilate3x3", "median5x5")
        for limit in limits(core, "MAX_HEIGHT", (1, 32768), HEIGHT)
    ),
    *limits("erode3x3", "DILATE", (0, 1), "ERROR_dilate_must_be_0_or_1", "morphology3x3"),
    *(
        Limit(core, "PPC", illegal, legal, "ERROR_ppc_must_be_1_or_2_or_4")
        for core in ("rgb2gray", "gaussian5x5", "erode3x3", "median5x5", "dilate3x3")
        for illegal, legal in ((0, 1), (3, 2), (5, 4), (8, 4))
    ),
    Limit("erode3x3", "MAX_WIDTH", 1278, 1280, "ERROR_max_width_must_be_a_multiple_of_ppc", also=("PPC", 4)),
    Limit("rgb2gray", "WIDTH", 0, 1, "ERROR_width_must_be_at_least_1", "axis_skid"),
    Limit("median5x5", "TAPS", 4, 3, "ERROR_taps_must_be_3_or_5", "border_mux"),
    Limit("median5x5", "TAPS", 7, 5, "ERROR_taps_must_be_3_or_5", "border_mux"),
    *limits("median5x5", "BORDER", (0, 2), "ERROR_border_must_be_0_or_1_or_2", "border_mux"),
    *limits("threshold_stats", "WINDOW_LOG2", (1, 15), "ERROR_window_log2_must_be_1_to_15"),
    *limits("threshold_apply", "WINDOW_LOG2", (1, 7), "ERROR_window_log2_must_be_1_to_7"),
    *limits("ccl", "MAX_WIDTH", (4, 32768), "ERROR_max_width_must_be_4_to_32768"),
    *limits("ccl", "MAX_HEIGHT", (4, 32768), "ERROR_max_height_must_be_4_to_32768"),
    *limits("ccl", "MOMENTS", (0, 2), "ERROR_moments_must_be_0_to_2"),
    *(Limit("ccl", "AREA", illegal, 1, "ERROR_area_must_be_1_or_without_moments_0") for illegal in (0, 2)),
    *limits("result_writer", "MAX_OBJECTS", (1, 256), "ERROR_max_objects_must_be_1_to_256"),
    *limits("result_writer", "MAX_OUTSTANDING", (1, 255), "ERROR_max_outstanding_must_be_1_to_255"),
    Limit("lidar_pwm", "MIN_MM", 0, 1, "ERROR_min_mm_must_be_at_least_1_and_below_max_mm"),
    Limit("lidar_pwm", "MIN_MM", 40000, 39999, "ERROR_min_mm_must_be_at_least_1_and_below_max_mm"),
    Limit("lidar_pwm", "MAX_MM", 1000001, 1000000, "ERROR_min_mm_must_be_at_least_1_and_below_max_mm"),
    *(
        Limit("lidar_pwm", name, 0, 1, "ERROR_times_must_be_at_least_1_us")
        for name in ("MAX_AGE_US", "START_TIMEOUT_US", "RELEASE_US")
    ),
    *limits("lidar_pwm", "FILTER_CYCLES", (1, 65535), "ERROR_filter_cycles_must_be_1_to_65535"),
    Limit("video_in", "DEPTH_LOG2", 1, 2, "ERROR_depth_log2_must_be_at_least_2", "async_fifo"),
    Limit("video_in", "FIFO_DEPTH", 2, 4, "ERROR_fifo_depth_must_be_a_power_of_two_of_at_least_4"),
    Limit("video_in", "FIFO_DEPTH", 1000, 1024, "ERROR_fifo_depth_must_be_a_power_of_two_of_at_least_4"),
    *(
        limit
        for name in ("MAX_WIDTH", "MAX_HEIGHT")
        for limit in limits("video_in", name, (1, 32767), "ERROR_max_width_and_max_height_must_be_1_to_32767")
    ),
    *(
        Limit("overlay", name, 8192, 8191, "ERROR_max_width_and_max_height_must_be_at_most_8191")
        for name in ("MAX_WIDTH", "MAX_HEIGHT")
    ),
    *limits("video_out", "DELAY", (16, 65538), "ERROR_delay_must_be_16_to_65538_cycles"),
    *(
        Limit("frame_source", "FIFO_DEPTH", illegal, legal, "ERROR_fifo_depth_must_be_a_power_of_two_of_at_least_4")
        for illegal, legal in ((2, 4), (1000, 1024))
    ),
    *limits(
        "frame_source", "PIXELS", (1, 268435456), "ERROR_a_picture_must_have_1_to_268435456_pixels", "frame_reader"
    ),
    *limits("frame_source", "MAX_OUTSTANDING", (1, 8), "ERROR_max_outstanding_must_be_1_to_8"),
    Limit("video_out", "FIFO_DEPTH", 2, 4, "ERROR_fifo_depth_must_be_a_power_of_two_of_at_least_4"),
    Limit("video_out", "FIFO_DEPTH", 1000, 1024, "ERROR_fifo_depth_must_be_a_power_of_two_of_at_least_4"),
    *limits(
        "pattern_source",
        "H_TOTAL",
        (1430, 65535),
        "ERROR_a_line_must_hold_its_pixels_and_its_sync_in_at_most_65535_cycles",
    ),
    *limits(
        "pattern_source",
        "V_TOTAL",
        (730, 65535),
        "ERROR_a_frame_must_hold_its_lines_and_its_sync_in_at_most_65535_lines",
    ),
    *limits("landing_core", "CLK_PER_US", (2, 1023), "ERROR_clk_per_us_must_be_2_to_1023"),
]


def elaborate(limit: Limit, value: int) -> subprocess.CompletedProcess[str]:
    """Elaborate a core, or one module of it, with one parameter set."""
    core = load_core(limit.core)
    top = limit.module or core.toplevel
    command = ["iverilog", "-g2005", "-t", "null", "-I", "rtl/generated", "-s", top]
    settings = [(limit.parameter, value), *([limit.also] if limit.also else [])]
    command += [f"-P{top}.{name}={setting}" for name, setting in settings]
    command += map(str, core.sources)
    return subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)


@pytest.mark.parametrize("limit", LIMITS, ids=str)
def test_parameter_limits(limit: Limit) -> None:
    assert limit.error in elaborate(limit, limit.illegal).stderr
    result = elaborate(limit, limit.legal)
    assert result.returncode == 0, result.stderr


def test_every_guard_has_its_limits() -> None:
    # rtl/top is no core: tb/top/test_source_switch.py has its limits.
    paths = [path for path in (ROOT / "rtl").glob("*/*.v") if path.parent.name != "top"]
    sources = [path.read_text(encoding="utf-8") for path in paths]
    guards = {error for source in sources for error in re.findall(r"\bERROR_\w+", source)}
    assert guards == {limit.error for limit in LIMITS}

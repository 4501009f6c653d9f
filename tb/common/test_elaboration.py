# SPDX-License-Identifier: Apache-2.0
"""Illegal parameters must fail elaboration, with a sentence in the name of the module that is missing."""

import subprocess

import pytest

from tb.common.cores import ROOT, load_core

WIDTH = "ERROR_max_width_must_be_at_least_the_least_width_and_at_most_32768"
HEIGHT = "ERROR_max_height_must_be_at_least_the_least_height_and_at_most_32768"


def elaborate(core: str, name: str, value: int, module: str = "") -> subprocess.CompletedProcess[str]:
    """Elaborate a core, or one module of it, with one parameter set."""
    loaded = load_core(core)
    top = module or loaded.toplevel
    command = ["iverilog", "-g2001", "-t", "null", "-s", top, f"-P{top}.{name}={value}", *map(str, loaded.sources)]
    return subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)


@pytest.mark.parametrize(("core", "least"), [("gaussian5x5", 3), ("erode3x3", 2), ("dilate3x3", 2), ("median5x5", 2)])
def test_width_limits(core: str, least: int) -> None:
    assert WIDTH in elaborate(core, "MAX_WIDTH", least - 1).stderr
    assert WIDTH in elaborate(core, "MAX_WIDTH", 32769).stderr
    for legal in (least, 32768):
        result = elaborate(core, "MAX_WIDTH", legal)
        assert result.returncode == 0, result.stderr


@pytest.mark.parametrize(("core", "least"), [("gaussian5x5", 3), ("erode3x3", 1), ("dilate3x3", 1), ("median5x5", 1)])
def test_height_limits(core: str, least: int) -> None:
    assert HEIGHT in elaborate(core, "MAX_HEIGHT", least - 1).stderr
    assert HEIGHT in elaborate(core, "MAX_HEIGHT", 32769).stderr
    for legal in (least, 32768):
        result = elaborate(core, "MAX_HEIGHT", legal)
        assert result.returncode == 0, result.stderr


def test_morphology_erodes_or_dilates() -> None:
    assert "ERROR_dilate_must_be_0_or_1" in elaborate("erode3x3", "DILATE", 2, "morphology3x3").stderr
    for legal in (0, 1):
        result = elaborate("erode3x3", "DILATE", legal, "morphology3x3")
        assert result.returncode == 0, result.stderr

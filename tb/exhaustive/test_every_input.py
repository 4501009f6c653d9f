# SPDX-License-Identifier: Apache-2.0
"""Verilated cores against their models for every input there is: colours, small images, neighbourhoods, spreads.

`ccl` has a bench of its own, tb/ccl/test_exhaustive.py.
"""

import os
import subprocess
from collections.abc import Callable
from importlib import import_module
from pathlib import Path

import numpy as np
import pytest

from golden.rgb2gray import rgb2gray
from golden.threshold_stats import threshold_stats
from scripts.signoff import combine, leave_part
from tb.common.cores import ROOT, load_core
from tb.common.lock import locked
from tb.common.runner import check_simulator

pytestmark = pytest.mark.full

SIZES = [(4, 4), (5, 3), (3, 5)]
"""Width and height; of each every image is sent."""
IMAGES = [f"{width}x{height}" for width, height in SIZES]
FRAMES = "{count} frames: every image of 4x4, 5x3 and 3x5"
PARTS = {
    "dilate3x3": (IMAGES, FRAMES),
    "erode3x3": (IMAGES, FRAMES),
    "median5x5": ([*IMAGES, "neighbourhoods"], f"{FRAMES}, and every 5x5 neighbourhood"),
    "rgb2gray": (["colours"], "{count} colours: all"),
    "threshold_stats": (
        ["factors", "flat limits"],
        "{count} windows: every factor and flat limit, all pairs of extremes",
    ),
}
"""Runs of each core, and the figure of all of them."""
WINDOW_BITS = 25
"""Pixels that one pixel of the median depends on."""
MEDIAN_WIDTH = 4096


def build(core_name: str, *arguments: str, kind: str = "every_input") -> Path:
    """Verilate a core with the player and return the program; `kind` names the folder."""
    check_simulator("verilator")
    core = load_core(core_name)
    folder = ROOT / "build/sim" / core_name / kind
    command = ["verilator", "--cc", "--exe", "--build", "-O3", "--prefix", "Vtop", "--top-module", core.toplevel]
    command += [*arguments, "-CFLAGS", "-O2 -std=c++17 -Wall -Wextra -Werror", "--Mdir", str(folder), "-o", "player"]
    command += [*map(str, core.sources), str(ROOT / "tb/exhaustive/player.cpp")]
    environment = {"OBJCACHE": "ccache", **os.environ}
    with locked(folder):
        result = subprocess.run(command, capture_output=True, text=True, check=False, env=environment)
    assert result.returncode == 0, result.stdout + result.stderr
    return folder / "player"


def build_filter(core: str) -> Path:
    """Player of a filter of binary images."""
    return build(core, "-CFLAGS", "-DSIZED", f"-GMAX_WIDTH={MEDIAN_WIDTH}", "-GMAX_HEIGHT=8")


def play(player: Path, beats: np.ndarray, *settings: int, gaps: tuple[int, int] = (0, 0)) -> np.ndarray:
    """Send beats (uint64) and return what comes out.

    Args:
        player: of the core.
        beats: uint64, as the player describes them.
        settings: width, height, factor, flat limit; by default 0.
        gaps: per cent of idle and of stalled cycles.
    """
    command = [str(player), *(str(value) for value in (*(*settings, 0, 0, 0, 0)[:4], *gaps))]
    result = subprocess.run(command, input=beats.astype("<u8").tobytes(), capture_output=True, check=False)
    assert result.returncode == 0, result.stderr.decode()
    return np.frombuffer(result.stdout, dtype="<u8")


def as_beats(frames: np.ndarray) -> np.ndarray:
    """Beats of frames of shape (count, height, width), with their markers."""
    beats = frames.astype(np.uint64)
    beats[:, 0, 0] |= np.uint64(1 << 32)
    beats[:, :, -1] |= np.uint64(1 << 33)
    return beats.reshape(-1)


def first_difference(got: np.ndarray, expected: np.ndarray) -> str:
    """A sentence that says where two streams of beats differ; empty if nowhere."""
    if got.size != expected.size:
        return f"{got.size} beats came out, {expected.size} were expected"
    places = np.flatnonzero(got != expected)
    return f"beat {places[0]}: {got[places[0]]:X}, expected {expected[places[0]]:X}" if places.size else ""


def judge(core: str, part: str, count: int, difference: str) -> None:
    """Leave the result for signoff, and fail on a difference."""
    leave_part(core, "exhaustive", part, not difference, count)
    combine(core, "exhaustive", *PARTS[core])
    assert not difference, f"{core}, {part}: {difference}"


def test_every_colour() -> None:
    player = build("rgb2gray")
    difference = ""
    for red in range(256):
        codes = np.arange(1 << 16, dtype=np.uint64)[None, None, :] | np.uint64(red << 16)
        rgb = np.stack([codes >> 16, codes >> 8 & 0xFF, codes & 0xFF], axis=-1).astype(np.uint8)
        got = play(player, as_beats(codes))
        difference = difference or first_difference(got, as_beats(rgb2gray(rgb)))
    judge("rgb2gray", "colours", 1 << 24, difference)


def every_image(width: int, height: int) -> np.ndarray:
    """All binary images of a size, shape (2 ** (width * height), height, width)."""
    codes = np.arange(1 << (width * height), dtype=np.uint32)[:, None]
    bits = codes >> np.arange(width * height, dtype=np.uint32) & 1
    return bits.astype(np.uint8).reshape(-1, height, width)


def model(core: str) -> Callable[[np.ndarray], np.ndarray]:
    """The golden function of a filter."""
    return getattr(import_module(f"golden.{core}"), core)


@pytest.fixture(scope="module", params=["dilate3x3", "erode3x3", "median5x5"])
def binary_filter(request: pytest.FixtureRequest) -> tuple[str, Path]:
    """Name and player of a filter of binary images."""
    return request.param, build_filter(request.param)


def test_a_wrong_core_is_seen(binary_filter: tuple[str, Path]) -> None:
    core, player = binary_filter
    other = "dilate3x3" if core == "erode3x3" else "erode3x3"
    images = every_image(4, 4)
    got = play(player, as_beats(images), 4, 4)
    assert first_difference(got, as_beats(np.stack([model(other)(image) for image in images])))
    assert "beats came out" in first_difference(got, got[:-1])
    moved = got.copy()
    moved[7] ^= np.uint64(1 << 33)
    assert first_difference(moved, got).startswith("beat 7")


@pytest.mark.parametrize("size", SIZES)
def test_every_small_image(binary_filter: tuple[str, Path], size: tuple[int, int]) -> None:
    core, player = binary_filter
    images = every_image(*size)
    got = play(player, as_beats(images), *size)
    expected = np.stack([model(core)(image) for image in images])
    judge(core, f"{size[0]}x{size[1]}", len(images), first_difference(got, as_beats(expected)))


def every_neighbourhood() -> np.ndarray:
    """A strip of 5 lines in which each of the 2**25 neighbourhoods but the empty one lies exactly once.

    The bits of a maximal sequence (x^25 + x^3 + 1), five to a column: 25 in a row are one state of its register, and
    as 5 does not divide its period, every fifth state is every state.
    """
    period = (1 << WINDOW_BITS) - 1
    bits = np.zeros(period + WINDOW_BITS, dtype=np.uint8)
    bits[0] = 1
    have, scale = WINDOW_BITS, 1
    while have < bits.size:
        # The square of the polynomial holds too: s[n + 50] = s[n + 6] ^ s[n].
        while WINDOW_BITS * scale * 2 <= have:
            scale *= 2
        start = have - WINDOW_BITS * scale
        step = min((WINDOW_BITS - 3) * scale, bits.size - have)
        shifted = bits[start + 3 * scale : start + 3 * scale + step]
        bits[have : have + step] = bits[start : start + step] ^ shifted
        have += step
    columns = np.arange(period + 4, dtype=np.int64) * 5 % period
    return np.stack([bits[(columns + line) % period] for line in range(5)])


def test_the_strip_has_every_neighbourhood() -> None:
    strip = every_neighbourhood()
    codes = np.zeros(strip.shape[1] - 4, dtype=np.uint32)
    for column in range(5):
        for line in range(5):
            place = np.uint32(5 * column + line)
            codes |= strip[line, column : column + codes.size].astype(np.uint32) << place
    seen = np.zeros(1 << WINDOW_BITS, dtype=bool)
    seen[codes] = True
    assert np.flatnonzero(~seen).tolist() == [0]


def test_every_neighbourhood_of_the_median() -> None:
    core, player = "median5x5", build_filter("median5x5")
    strip = every_neighbourhood()
    useful = MEDIAN_WIDTH - 4
    difference, count = "", 0
    batch: list[np.ndarray] = [np.zeros((5, MEDIAN_WIDTH), dtype=np.uint8)]
    for start in range(0, strip.shape[1] - 4, useful):
        piece = strip[:, start : start + MEDIAN_WIDTH]
        batch.append(np.pad(piece, ((0, 0), (0, MEDIAN_WIDTH - piece.shape[1]))))
        if len(batch) < 256 and start + useful < strip.shape[1] - 4:
            continue
        frames = np.stack(batch)
        got = play(player, as_beats(frames), MEDIAN_WIDTH, 5)
        expected = as_beats(np.stack([model(core)(frame) for frame in frames]))
        difference = difference or first_difference(got, expected)
        count += len(batch)
        batch = []
    judge(core, "neighbourhoods", count, difference)


def judge_spreads(part: str, settings: list[tuple[int, int]]) -> None:
    """Every pair of extremes, in windows of 2x2, with each of these factors and flat limits."""
    side = 512
    arguments = ("-CFLAGS", "-DSIZED -DSTATS", f"-GMAX_WIDTH={side}", f"-GMAX_HEIGHT={side}", "-GWINDOW_LOG2=1")
    player = build("threshold_stats", *arguments)
    values = np.arange(256, dtype=np.uint8)
    # The first line gives one extreme, the second the other, in either order.
    frame = np.empty((side, side), dtype=np.uint8)
    frame[0::2], frame[1::2] = np.repeat(values, 2)[None, :], values[:, None]
    difference = ""
    for factor, flat_limit in settings:
        got = play(player, as_beats(frame[None]), side, side, factor, flat_limit)
        expected = as_beats(threshold_stats(frame, factor, 1, flat_limit).beats()[None])
        difference = difference or first_difference(got, expected)
    judge("threshold_stats", part, len(settings) * 256 * 256, difference)


def test_every_factor_and_spread() -> None:
    judge_spreads("factors", [(factor, 0) for factor in range(512)])


def test_every_flat_limit_and_spread() -> None:
    judge_spreads("flat limits", [(77, flat_limit) for flat_limit in range(256)])

# SPDX-License-Identifier: Apache-2.0
"""Shows frames to landing_core and compares what passes between its stages, and its records, with the golden models."""

import itertools
import re
import subprocess
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from functools import partial
from pathlib import Path

import numpy as np
import numpy.typing as npt

from golden.chain import PAPER, Settings, Stages, run_frames
from golden.generated.landing_regs import (
    CTRL_DARK_IS_ONE_SHIFT,
    CTRL_ENABLE_MASK,
    CTRL_LABEL_ZEROS_SHIFT,
    OBJECT_DTYPE,
    RECORD_DTYPE,
)
from golden.result_writer import record as golden_record
from scripts.errors import ArgumentParser, UserError, run_main
from scripts.frames import open_frames
from sim.cosim.build import ROOT, build_stages
from sim.cosim.frame_list import FULL_HD, HD, FrameList, read_frame_list, write_frame_list
from sim.cosim.result import Frame, read_result

ALTITUDE_MM = 1500

PIXEL_STAGES = ("rgb", "gray", "smooth", "checked", "binary", "eroded", "median", "dilated")
"""Pixel streams of landing_core in the order of the data."""

_PAYLOADS: dict[str, npt.DTypeLike] = {
    **{stage: np.dtype("u1") for stage in PIXEL_STAGES},
    "rgb": np.dtype(("u1", 3)),
    "stats": np.dtype("<u4"),
    "objects": OBJECT_DTYPE,
}
FIRST = 1
LAST = 2


class StageMismatchError(Exception):
    """landing_core differs from its golden models; the message names stage, frame and place."""


@dataclass(frozen=True)
class Memory:
    """How the memory behind landing_core answers: at once, or late and unevenly."""

    random: bool = False
    seed: int = 1


@dataclass(frozen=True)
class Report:
    """What was compared, and how fast the model ran."""

    frames: int
    pixels: int
    objects: int
    clocks: int
    seconds: float

    def __str__(self) -> str:
        rate = self.clocks / self.seconds / 1e6
        return (
            f"{self.frames} frames, {self.pixels} pixels at {len(PIXEL_STAGES)} places, {self.objects} objects equal "
            f"the golden models; {self.clocks} clocks in {self.seconds:.1f} s ({rate:.2f} million a second)"
        )


Simulate = Callable[[FrameList, Settings, Path], tuple[int, float]]
"""Shows a frame list to landing_core under some settings, leaves the files that `check_run` reads in a folder, and
returns clocks and seconds; raises `StageMismatchError` if landing_core does not let it come to its end."""


def stage_pixels(golden: Stages) -> dict[str, np.ndarray]:
    """What each pixel stream carries for one frame."""
    # RGB is {R, G, B} with the least byte first, as the stream is written; threshold_stats passes its pixels on.
    stages = (
        *(golden.rgb[..., ::-1], golden.gray, golden.smooth, golden.smooth),
        *(golden.binary, golden.eroded, golden.median, golden.dilated),
    )
    return dict(zip(PIXEL_STAGES, stages, strict=True))


def ctrl_value(settings: Settings) -> int:
    """The register CTRL that makes landing_core work by `settings`."""
    order = settings.dark_is_one << CTRL_DARK_IS_ONE_SHIFT | settings.label_zeros << CTRL_LABEL_ZEROS_SHIFT
    return CTRL_ENABLE_MASK | order


def verilated(
    frames: FrameList, settings: Settings, out_dir: Path, memory: Memory | None = None, full_hd: bool = False
) -> tuple[int, float]:
    """A `Simulate` of the verilated model, as 1080p60 if wanted; its memory answers at once by default."""
    memory = memory or Memory()
    arguments = {
        "frames": frames.path,
        "out": out_dir,
        "frame-clocks": 0,
        "threshold": settings.threshold_register,
        "min-area": settings.min_area,
        "ctrl": ctrl_value(settings),
        "random-memory": int(memory.random),
        "seed": memory.seed,
        "taps": 1,
        "full-hd": int(full_hd),
    }
    command = [str(build_stages(full_hd)), *(f"{key}={value}" for key, value in arguments.items())]
    run = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
    if run.returncode != 0:
        raise StageMismatchError(run.stderr.strip().removeprefix("touchdown: "))
    clocks, seconds = re.fullmatch(r"clocks (\d+) seconds (\S+)\n", run.stdout).groups()
    return int(clocks), float(seconds)


def _beats(out_dir: Path, stage: str) -> np.ndarray:
    return np.fromfile(out_dir / f"{stage}.bin", np.dtype([("payload", _PAYLOADS[stage]), ("markers", "u1")]))


class _Stream:
    """One stage's beats, taken frame by frame."""

    def __init__(self, out_dir: Path, stage: str) -> None:
        self.stage = stage
        beats = _beats(out_dir, stage)
        self._payload = beats["payload"]
        self._markers = beats["markers"]
        self._at = 0

    def fail(self, frame: int, what: str) -> StageMismatchError:
        return StageMismatchError(f"stage {self.stage}, frame {frame}: {what}")

    def take(self, frame: int, markers: npt.NDArray[np.uint8]) -> np.ndarray:
        """The payloads of the next `len(markers)` beats, whose markers must be those."""
        end = self._at + len(markers)
        if end > len(self._payload):
            raise self.fail(frame, f"{len(self._payload) - self._at} beats instead of {len(markers)}")
        wrong = np.flatnonzero(self._markers[self._at : end] != markers)
        if wrong.size:
            beat = int(wrong[0])
            got = self._markers[self._at + beat]
            raise self.fail(frame, f"beat {beat}: expected {{tlast, tuser}} {markers[beat]:02b}, got {got:02b}")
        payload = self._payload[self._at : end]
        self._at = end
        return payload

    def take_frame_of_objects(self) -> npt.NDArray[np.uint8]:
        """How many beats there are up to the next trailer, as the markers that they should have."""
        trailers = np.flatnonzero(self._markers[self._at :] & LAST)
        count = int(trailers[0]) + 1 if trailers.size else 1
        markers = np.zeros(count, np.uint8)
        markers[0] |= FIRST
        markers[-1] |= LAST
        return markers

    def must_be_empty(self, frames: int) -> None:
        if self._at != len(self._payload):
            raise self.fail(frames, f"{len(self._payload) - self._at} beats after the last frame")


def _grid_markers(height: int, width: int) -> npt.NDArray[np.uint8]:
    """Markers of a raster: tuser on its first beat, tlast on the last of each line."""
    markers = np.zeros((height, width), np.uint8)
    markers[0, 0] |= FIRST
    markers[:, -1] |= LAST
    return markers.reshape(-1)


def _compare_grid(stream: _Stream, frame: int, expected: np.ndarray) -> None:
    height, width = expected.shape[:2]
    got = stream.take(frame, _grid_markers(height, width)).reshape(expected.shape)
    wrong = np.argwhere(got != expected)
    if wrong.size:
        y, x = wrong[0][:2]
        values = f"expected {expected[y, x]}, got {got[y, x]}"
        raise stream.fail(frame, f"first of {len(wrong)} differences at x={x} y={y}: {values}")


def _compare_objects(stream: _Stream, frame: int, expected: np.ndarray) -> None:
    got = stream.take(frame, stream.take_frame_of_objects())
    trailer = got[-1]
    if trailer.tobytes() != bytes(OBJECT_DTYPE.itemsize):
        raise stream.fail(frame, f"the trailer is {trailer}")
    objects = got[:-1]
    common = min(len(objects), len(expected))
    wrong = np.flatnonzero(objects[:common] != expected[:common])
    if wrong.size:
        first = int(wrong[0])
        raise stream.fail(frame, f"object {first}: expected {expected[first]}, got {objects[first]}")
    if len(objects) != len(expected):
        raise stream.fail(frame, f"{len(objects)} objects, expected {len(expected)}")


def _near(got: np.void, shown: Frame, camera_us: int) -> dict[str, int]:
    """The fields of the header that tell times and distances: as they are, once they were found plausible.

    The pixel clock is not the clock in which times are counted, and lines that are flushed take their time.
    The camera's first pixel, at `camera_us`, waits for a reading of the LiDAR. The next one cannot end within the time
    of a pulse; the blanking before that pixel and the flushing after the last one take less than half of that. Until
    then no reading is younger than that pixel.
    """
    first_us = shown.first_pixel_ns // 1000
    since_us = shown.last_pixel_ns // 1000 - camera_us
    scan_us = (shown.last_pixel_ns - shown.first_pixel_ns) // 1000
    limits = {
        "start_time_us": (first_us - 1, first_us + 1),
        "scan_time_us": (scan_us, scan_us + scan_us // 10 + 100),
        "altitude_mm": (ALTITUDE_MM - 1, ALTITUDE_MM + 1),
        "altitude_age_us": (since_us if since_us < ALTITUDE_MM // 2 else 0, 2 * ALTITUDE_MM + 2000),
    }
    for name, (least, greatest) in limits.items():
        if not least <= int(got["header"][name]) <= greatest:
            value = got["header"][name]
            raise StageMismatchError(f"record, frame {shown.index}: {name} is {value}, expected {least} to {greatest}")
    return {name: int(got["header"][name]) for name in limits}


def _compare_record(shown: Frame, camera_us: int, objects: np.ndarray, frames: FrameList, settings: Settings) -> None:
    if shown.record is None:
        raise StageMismatchError(f"record, frame {shown.index}: none was written")
    values = {
        **_near(shown.record, shown, camera_us),
        "frame_number": shown.index + 1,
        "frame_size_width": frames.width,
        "frame_size_height": frames.height,
        "threshold_factor": settings.factor,
        "min_area": settings.min_area,
        "thresholds_missing": int(shown.index == 0),
        "altitude_valid": 1,
    }
    data = golden_record(values, objects)
    expected = np.frombuffer(data.ljust(RECORD_DTYPE.itemsize, b"\0"), RECORD_DTYPE)[0]
    if shown.record.tobytes() == expected.tobytes():
        return
    for name in expected["header"].dtype.names:
        got, want = shown.record["header"][name], expected["header"][name]
        if got != want:
            raise StageMismatchError(f"record, frame {shown.index}: {name} is {got}, expected {want}")
    wrong = int(np.flatnonzero(shown.record["objects"] != expected["objects"])[0])
    got, want = shown.record["objects"][wrong], expected["objects"][wrong]
    raise StageMismatchError(f"record, frame {shown.index}, object {wrong}: expected {want}, got {got}")


def compare(
    frames: Iterable[np.ndarray],
    out_dir: Path,
    settings: Settings | None = None,
    simulate: Simulate = verilated,
    most: tuple[int, int] = HD,
) -> Report:
    """Show frames back to back and compare every stage.

    Args:
        frames: uint8 RGB of shape (height, width, 3), one size.
        out_dir: folder for the streams as files; made if needed.
        settings: registers; default those of the firmware.
        simulate: what runs the RTL; default the verilated model.
        most: width and height for which that is built.

    Raises:
        StageMismatchError: a stage or a record differs; the message names the first place in the order of the data.
        UserError: the frames cannot be used or the model cannot be built.
    """
    settings = settings or Settings()
    out_dir.mkdir(parents=True, exist_ok=True)
    shown = write_frame_list(out_dir / "frames.tdf", frames, itertools.repeat(ALTITUDE_MM), most=most)
    clocks, seconds = simulate(shown, settings, out_dir)
    objects = check_run(shown, out_dir, settings)
    return Report(shown.shown, shown.shown * shown.width * shown.height, objects, clocks, seconds)


def full_hd(frames: Iterable[np.ndarray], out_dir: Path, settings: Settings | None = None) -> Report:
    """`compare` with landing_core built for 1920x1080, clocks and timing of 1080p60."""
    return compare(frames, out_dir, settings, partial(verilated, full_hd=True), FULL_HD)


def check_run(shown: FrameList, out_dir: Path, settings: Settings) -> int:
    """Compare the streams and records that a run left in `out_dir`; return how many objects there were.

    Raises:
        StageMismatchError: as `compare`.
    """
    result = read_result(out_dir, 0.0)
    streams = {stage: _Stream(out_dir, stage) for stage in _PAYLOADS}
    camera_us = result.frames[0].first_pixel_ns // 1000
    objects = 0
    for index, golden in enumerate(run_frames(read_frame_list(shown), settings)):
        for stage, expected in stage_pixels(golden).items():
            if stage == "binary":
                _compare_grid(streams["stats"], index, golden.stats.beats())
            _compare_grid(streams[stage], index, expected)
        _compare_objects(streams["objects"], index, golden.objects)
        _compare_record(result.frames[index], camera_us, golden.objects, shown, settings)
        objects += len(golden.objects)
    for stream in streams.values():
        stream.must_be_empty(shown.shown)
    return objects


def main() -> int:
    """Entry point: compare the frames of a folder, a video or the bundled clip."""
    parser = ArgumentParser(prog="python -m sim.compare_stages", description=__doc__)
    parser.add_argument("--frames", help="folder of pictures, picture or video; default: the rendered clip")
    parser.add_argument("--limit", type=int, help="take at most this many frames")
    parser.add_argument("--paper", action="store_true", help="the paper's registers instead of the firmware's")
    parser.add_argument("--slow-memory", action="store_true", help="memory that answers late and unevenly")
    parser.add_argument("--seed", type=int, default=Memory.seed, help="of the slow memory")
    options = parser.parse_args()
    settings = PAPER if options.paper else Settings()
    memory = Memory(options.slow_memory, options.seed)
    frames = open_frames(options.frames, options.limit)
    try:
        print(compare(frames.open(), ROOT / "build" / "stages", settings, partial(verilated, memory=memory)))
    except StageMismatchError as error:
        raise UserError(f"landing_core differs from its golden models: {error}.") from error
    return 0


if __name__ == "__main__":
    run_main(main)

# SPDX-License-Identifier: Apache-2.0
"""Golden input and output of one core for recorded frames, as files.

    python -m scripts.vectors --core CORE [--frames FOLDER|PICTURE|VIDEO] [--out build/vectors] [--limit N]

For each frame build/vectors/CORE/FRAME/ gets, for each stream of the core, a
.npy file, a .hex file with one beat a line for $readmemh, a .png file where it
is a picture, and metadata.json, which says what everything is.
"""

import json
import shutil
from collections.abc import Callable, Iterator
from dataclasses import asdict, dataclass
from pathlib import Path

import cv2
import numpy as np

from golden.chain import Settings, Stages, run_chain
from golden.generated.landing_regs import OBJECT_DTYPE
from scripts.errors import ArgumentParser, UserError, run_main
from scripts.frames import FrameSet, open_frames

DEFAULT_OUT = Path("build/vectors")


@dataclass(frozen=True)
class Stream:
    """A stream between cores.

    Attributes:
        bits: Width of tdata.
        take: Its array out of the stages; None where the stream carries nothing for this frame.
        what: One line for metadata.json.
    """

    bits: int
    take: Callable[[Stages], np.ndarray | None]
    what: str


def _beats_before(stages: Stages) -> np.ndarray | None:
    return stages.stats_before.beats() if stages.stats_before else None


_STAT = "stat stream, {max, min, threshold Q8.8}, windows in raster order"

STREAMS = {
    "rgb": Stream(24, lambda stages: stages.rgb, "video, {R, G, B}"),
    "gray": Stream(8, lambda stages: stages.gray, "video, gray"),
    "smooth": Stream(8, lambda stages: stages.smooth, "video, gray"),
    "stat": Stream(32, lambda stages: stages.stats.beats(), _STAT),
    "stat_before": Stream(32, _beats_before, f"{_STAT}, of the frame before"),
    "binary": Stream(1, lambda stages: stages.binary, "video, binary"),
    "eroded": Stream(1, lambda stages: stages.eroded, "video, binary"),
    "median": Stream(1, lambda stages: stages.median, "video, binary"),
    "dilated": Stream(1, lambda stages: stages.dilated, "video, binary"),
    "objects": Stream(
        512, lambda stages: stages.objects, "object stream without its trailer, laid out as in the record"
    ),
}


@dataclass(frozen=True)
class Ports:
    """Which streams a core takes and gives."""

    inputs: tuple[str, ...]
    outputs: tuple[str, ...]


CORES = {
    "rgb2gray": Ports(("rgb",), ("gray",)),
    "gaussian5x5": Ports(("gray",), ("smooth",)),
    "threshold_stats": Ports(("smooth",), ("smooth", "stat")),
    "threshold_apply": Ports(("smooth", "stat_before"), ("binary",)),
    "erode3x3": Ports(("binary",), ("eroded",)),
    "median5x5": Ports(("eroded",), ("median",)),
    "dilate3x3": Ports(("median",), ("dilated",)),
    "ccl": Ports(("dilated",), ("objects",)),
    "landing_core": Ports(("rgb",), ("objects",)),
}


def stages_of(frames: FrameSet, settings: Settings) -> Iterator[Stages]:
    """The golden stages of each frame, with the thresholds that the demo would have too.

    A clip's or video's frame uses those of the frame before. Pictures that have
    nothing to do with each other, and the first frame of a clip, use their own.
    """
    before = None
    for rgb in frames.open():
        own = run_chain(rgb, before, settings)
        if before is None:
            own = run_chain(rgb, own.stats, settings)
        yield own
        before = own.stats if frames.sequential else None


def write_vectors(core: str, frames: FrameSet, out_dir: Path, settings: Settings | None = None) -> list[Path]:
    """Write the vectors of one core.

    Args:
        core: A key of `CORES`.
        frames: The frames.
        out_dir: A folder a core and a frame is made below it.
        settings: Registers; default those of the firmware.

    Returns:
        The folders, one a frame.

    Raises:
        UserError: the core is not known, or files cannot be written.
    """
    if core not in CORES:
        problem = f"CORE={core} has no vectors" if core else "no core was named"
        raise UserError(f"{problem}; give CORE= one of {', '.join(CORES)}.")
    settings = settings or Settings()
    folders = []
    for label, name, stages in zip(frames.labels, frames.names, stages_of(frames, settings), strict=True):
        folder = out_dir / core / label
        try:
            _write_frame(folder, core, name, stages, settings)
        except OSError as error:
            raise UserError(f"{folder} cannot be written: {error.strerror}; choose another folder.") from error
        folders.append(folder)
        print(f"vectors: {folder}", flush=True)
    return folders


def _write_frame(folder: Path, core: str, name: str, stages: Stages, settings: Settings) -> None:
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    metadata = {
        "core": core,
        "frame": name,
        "width": stages.gray.shape[1],
        "height": stages.gray.shape[0],
        "settings": asdict(settings),
        "streams": {},
    }
    for direction, streams in (("in", CORES[core].inputs), ("out", CORES[core].outputs)):
        for stream in streams:
            array = STREAMS[stream].take(stages)
            if array is None:
                continue
            prefix = f"{direction}_{stream}"
            np.save(folder / f"{prefix}.npy", array, allow_pickle=False)
            (folder / f"{prefix}.hex").write_text(hex_lines(array, STREAMS[stream].bits), encoding="ascii")
            files = [f"{prefix}.npy", f"{prefix}.hex"]
            if STREAMS[stream].what.startswith("video"):
                _write_png(folder / f"{prefix}.png", array, STREAMS[stream].bits)
                files.append(f"{prefix}.png")
            metadata["streams"][prefix] = {
                "what": STREAMS[stream].what,
                "bits": STREAMS[stream].bits,
                "beats": int(np.prod(array.shape[:2])),
                "files": files,
            }
    (folder / "metadata.json").write_text(json.dumps(metadata, indent=2) + "\n", encoding="utf-8")


def hex_lines(array: np.ndarray, bits: int) -> str:
    """One beat a line, most significant digit first.

    Args:
        array: The beats in order: integers, (..., 3) uint8 for 24 bits, or `OBJECT_DTYPE` for 512.
        bits: Width of a beat.
    """
    if array.size == 0:
        return ""
    if array.dtype == OBJECT_DTYPE:
        # Memory order is little endian; the number on the stream has its last byte first.
        data = array.view(np.uint8).reshape(len(array), -1)[:, ::-1].tobytes()
    elif bits == 1:
        return "\n".join((array.ravel() + ord("0")).astype(np.uint8).tobytes().decode("ascii")) + "\n"
    else:
        data = array.astype(array.dtype.newbyteorder(">")).tobytes()
    return data.hex("\n", bits // 8) + "\n"


def _write_png(path: Path, array: np.ndarray, bits: int) -> None:
    picture = array * np.uint8(255) if bits == 1 else array
    if bits == 24:
        picture = cv2.cvtColor(array, cv2.COLOR_RGB2BGR)
    if not cv2.imwrite(str(path), picture):
        raise UserError(f"{path} cannot be written; check the folder and the space left on the disk.")


def main(arguments: list[str] | None = None) -> None:
    """Entry point."""
    parser = ArgumentParser(description="Golden input and output of one core for recorded frames.")
    parser.add_argument("--core", default="", help=", ".join(CORES))
    parser.add_argument("--frames", help="folder of PNG or JPEG files, one such file, or a video (default: the clip)")
    parser.add_argument("--out", type=Path, default=DEFAULT_OUT, help="folder for the vectors")
    parser.add_argument("--limit", type=int, help="take at most this many frames")
    options = parser.parse_args(arguments)
    write_vectors(options.core, open_frames(options.frames, options.limit), options.out)


if __name__ == "__main__":
    run_main(main)

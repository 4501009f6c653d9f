# SPDX-License-Identifier: Apache-2.0
"""Frames for demo and vectors: the rendered clip, a folder of pictures, one picture, or a video.

Pictures are decoded when they are asked for, so that a long video never has to
fit into memory; what is wrong with any of them is said before anything starts.
"""

import os
import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from itertools import islice
from pathlib import Path

import cv2
import numpy as np

from scripts.errors import UserError
from scripts.frames_decode import decode_picture
from sim.world.clip import demo_clip, images
from sim.world.pose import Truth

WIDTH = 1280
HEIGHT = 720
CLIP_FRAMES = 24
"""As many as the height needs to change by 6 % from one to the next, so that a pad can be followed as in flight."""
ESTIMATE_OFF_BY = 0.05
"""Some containers tell their length in time only, of which sound has its share; so a little less is no fault."""
PICTURE_SUFFIXES = (".png", ".jpg", ".jpeg")


@dataclass(frozen=True)
class FrameSet:
    """Frames of one source, in order.

    Attributes:
        title: What they are, for a person.
        names: One a frame: the file's name, or the number in the clip or video.
        sequential: True where each frame follows the one before; False for pictures that have nothing to do with each
            other.
        truths: What is exactly true of each frame, where that is known.
        altitude_csv: Where altitudes are looked for when none are given.
        open: Starts from the first frame; yields (720, 1280, 3) uint8 RGB.
    """

    title: str
    names: tuple[str, ...]
    sequential: bool
    truths: tuple[Truth | None, ...]
    altitude_csv: Path | None
    open: Callable[[], Iterator[np.ndarray]]

    @property
    def labels(self) -> tuple[str, ...]:
        """One a frame, for names of files: the name without its suffix, where that tells them apart."""
        stems = [Path(name).stem for name in self.names]
        return tuple(
            stem if stems.count(stem) == 1 else name.replace(".", "_")
            for stem, name in zip(stems, self.names, strict=True)
        )


def how_many(count: int, noun: str) -> str:
    """A number of things, for a person."""
    return f"{count} {noun}{'' if count == 1 else 's'}"


def open_frames(source: str | None, limit: int | None = None) -> FrameSet:
    """Find the frames.

    Args:
        source: A folder of PNG and JPEG files, one such file, or a video; None is the rendered clip.
        limit: Take at most this many, from the first on.

    Raises:
        UserError: there are none, or one cannot be read or has the wrong size.
    """
    if limit is not None and limit < 1:
        raise UserError(f"the limit of frames is {limit}; give 1 or more.")
    if source is None:
        return _clip(limit)
    path = Path(source)
    if not path.exists():
        raise UserError(f"{source} does not exist; give a folder of PNG or JPEG files, or a video, as FRAMES=path.")
    if path.is_dir():
        pictures = sorted((file for file in path.iterdir() if _is_picture(file)), key=_natural)
        if not pictures:
            raise UserError(f"{source} holds no PNG or JPEG file; give a folder that does, or a video.")
        some = pictures[:limit]
        return _pictures(f"{how_many(len(some), 'picture')} of {path.name}", some, path / "altitude.csv")
    if _is_picture(path):
        return _pictures(path.name, [path], path.parent / "altitude.csv")
    return _video(path, limit)


def _clip(limit: int | None) -> FrameSet:
    clip = demo_clip(CLIP_FRAMES)[:limit]
    return FrameSet(
        title="rendered descent",
        names=tuple(f"{index:04d}" for index in range(len(clip))),
        sequential=True,
        truths=tuple(frame.truth for frame in clip),
        altitude_csv=None,
        open=lambda: images(clip),
    )


def _pictures(title: str, files: list[Path], altitude_csv: Path) -> FrameSet:
    for file in files:
        read_picture(file)
    return FrameSet(
        title=title,
        names=tuple(file.name for file in files),
        sequential=False,
        truths=(None,) * len(files),
        altitude_csv=altitude_csv,
        open=lambda: (read_picture(file) for file in files),
    )


def _video(path: Path, limit: int | None) -> FrameSet:
    count = sum(1 for _ in islice(_decode(path), limit))
    if count == 0:
        raise UserError(f"{path} holds no frame that can be decoded; give a video that OpenCV can play.")
    promised = _promised(path) if limit is None or count < limit else count
    if count < promised - 1 - promised * ESTIMATE_OFF_BY:
        raise UserError(
            f"{path} is cut off or damaged: {count} of its {promised} frames can be decoded; copy it again, "
            f"or take the beginning by `python -m scripts.demo --limit {count}`."
        )
    return FrameSet(
        title=f"video {path.name}",
        names=tuple(f"{index:04d}" for index in range(count)),
        sequential=True,
        truths=(None,) * count,
        altitude_csv=path.with_suffix(".csv"),
        open=lambda: islice(_decode(path), count),
    )


def read_picture(path: Path) -> np.ndarray:
    """One picture as (720, 1280, 3) uint8 RGB.

    Raises:
        UserError: it cannot be read, or has the wrong size.
    """
    try:
        data = path.read_bytes()
    except OSError as error:
        raise UserError(f"{path} cannot be read: {error.strerror}; check the file.") from error
    picture = decode_picture(data)
    if picture is None:
        raise UserError(f"{path} cannot be decoded; replace it by a whole PNG or JPEG file, or take it out.")
    return _as_rgb(picture, str(path))


def _decode(path: Path) -> Iterator[np.ndarray]:
    # OpenCV's decoder would explain a broken file on stderr in its own words.
    os.environ.setdefault("OPENCV_FFMPEG_LOGLEVEL", "-8")
    video = cv2.VideoCapture(str(path))
    try:
        if not video.isOpened():
            raise UserError(f"{path} is neither a PNG or JPEG file nor a video that OpenCV can play; convert it.")
        index = 0
        while True:
            present, frame = video.read()
            if not present:
                return
            yield _as_rgb(frame, f"frame {index} of {path}")
            index += 1
    finally:
        video.release()


def _promised(path: Path) -> int:
    """How many frames the container says it has; 0 or less if it does not say."""
    video = cv2.VideoCapture(str(path))
    promised = int(video.get(cv2.CAP_PROP_FRAME_COUNT))
    video.release()
    return promised


def _as_rgb(picture: np.ndarray, what: str) -> np.ndarray:
    height, width = picture.shape[:2]
    if (width, height) != (WIDTH, HEIGHT):
        raise UserError(f"{what} is {width}x{height}; the camera is {WIDTH}x{HEIGHT}: scale or crop it to that size.")
    return cv2.cvtColor(picture, cv2.COLOR_BGR2RGB)


def _is_picture(path: Path) -> bool:
    return path.is_file() and path.suffix.lower() in PICTURE_SUFFIXES


def _natural(path: Path) -> list[tuple[int, int, str]]:
    """Sort key that puts image_9 before image_10."""
    parts = re.findall(r"\d+|\D+", path.name)
    return [(0, int(part), part) if part.isdigit() else (1, 0, part) for part in parts]

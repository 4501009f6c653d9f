# SPDX-License-Identifier: Apache-2.0
"""One picture of all corpora for `docs/world.md`: `python -m sim.world.sheet [--out file]`."""

import dataclasses
from collections.abc import Iterator
from pathlib import Path

import cv2
import numpy as np

from scripts.errors import ArgumentParser, UserError, run_main
from sim.world.corpus import SWEEPS, corpus
from sim.world.drawings import DRAWINGS
from sim.world.ground import GROUNDS
from sim.world.look import Look
from sim.world.pose import Pose
from sim.world.scene import Scene, render_scene

PICTURE = Path(__file__).resolve().parents[2] / "docs" / "pictures" / "world.jpg"
MOST_BYTES = 400_000

_COLUMNS = 8
_THUMB = (160, 90)
_PART = (480, 270)
_TITLE_PX = 150
_GAP_PX = 3
_INK, _PAPER = (230, 236, 240), (20, 26, 32)
_FONT = cv2.FontFace("sans")
_QUALITIES = range(85, 30, -5)
_SEED = 1


def rows() -> Iterator[tuple[str, list[Scene]]]:
    """Titles and scenes of the rows, at most eight scenes each."""
    pose = Pose(0.6, 0.05, 0.02, 20.0)
    yield "grounds", [Scene(pose, Look(), index, ground=ground) for index, ground in enumerate(GROUNDS)]
    for name in ("sharp", "typical", "border", "metric", "descent"):
        yield name, list(corpus(name, _COLUMNS, _SEED))
    yield "light_step", list(corpus("light_step", 5 * _COLUMNS, _SEED))[::5]
    for name, values in SWEEPS.items():
        # The same scene at each value, from the weakest to the strongest: the second, which lies on plain asphalt.
        scenes = list(corpus(f"sweep:{name}", 2, _SEED))[1::2]
        yield f"sweep:{name}", [scenes[round(at)] for at in np.linspace(0, len(values) - 1, _COLUMNS)]
    near = dataclasses.replace(pose, altitude_m=0.5)
    scenes = [
        Scene(near, Look(), index, pad=False, drawing=drawing, ground=GROUNDS[index % len(GROUNDS)])
        for index, drawing in enumerate((*DRAWINGS, ""))
    ]
    for start in range(0, len(scenes), _COLUMNS):
        yield "negatives", scenes[start : start + _COLUMNS]


def draw() -> np.ndarray:
    """The sheet, RGB."""
    width = _TITLE_PX + _COLUMNS * (_THUMB[0] + _GAP_PX)
    strips = []
    for title, scenes in rows():
        strip = np.full((_THUMB[1] + _GAP_PX, width, 3), _PAPER, np.uint8)
        cv2.putText(strip, title, (6, _THUMB[1] // 2 + 5), _INK, _FONT, 13)
        for column, scene in enumerate(scenes):
            left = _TITLE_PX + column * (_THUMB[0] + _GAP_PX)
            image, truth = render_scene(scene)
            if title.startswith("sweep:"):
                image = _around(image, truth.truth.x_px, truth.truth.y_px)
            thumb = cv2.resize(image, _THUMB, interpolation=cv2.INTER_AREA)
            strip[: _THUMB[1], left : left + _THUMB[0]] = thumb
        strips.append(strip)
    return np.vstack(strips)


def _around(image: np.ndarray, x_px: float, y_px: float) -> np.ndarray:
    """The part of the image about the pad."""
    left, top = (
        int(np.clip(round(middle - size / 2), 0, whole - size))
        for middle, size, whole in zip((x_px, y_px), _PART, image.shape[1::-1], strict=True)
    )
    return image[top : top + _PART[1], left : left + _PART[0]]


def write(path: Path) -> None:
    """Write the sheet as JPEG, as good as fits into `MOST_BYTES`."""
    picture = cv2.cvtColor(draw(), cv2.COLOR_RGB2BGR)
    for quality in _QUALITIES:
        data = cv2.imencode(".jpg", picture, [cv2.IMWRITE_JPEG_QUALITY, quality])[1]
        if len(data) <= MOST_BYTES:
            break
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(data.tobytes())
    except OSError as error:
        raise UserError(f"cannot write {path}: {error.strerror}; choose another place with --out.") from error


def main() -> None:
    """Entry point."""
    parser = ArgumentParser(prog="python -m sim.world.sheet", description=__doc__)
    parser.add_argument("--out", type=Path, default=PICTURE, help="file to write")
    path = parser.parse_args().out
    write(path)
    print(f"{path}: {path.stat().st_size} bytes")


if __name__ == "__main__":
    run_main(main)

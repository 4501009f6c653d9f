# SPDX-License-Identifier: Apache-2.0
"""Contact sheets: many annotated frames in one picture, to look at rather than to count."""

from collections.abc import Container, Iterator, Sequence
from dataclasses import replace
from itertools import groupby
from pathlib import Path

import cv2
import numpy as np

from scripts.demo_draw import annotate
from scripts.errors import UserError
from sim.accuracy.measure import Workers
from sim.accuracy.paths import golden
from sim.accuracy.photos import PREFIX
from sim.accuracy.rows import Row
from sim.accuracy.shots import Unit, develop

SHEETS = {
    "photos": "Photographs",
    "missed": "Missed",
    "false": "False detections",
    "worst": "Farthest centres",
    "samples": "Samples of the rendered sets",
}
_COLUMNS = 4
_THUMB = (480, 270)
_CAPTION_PX = 26
_FULL_SHEET = 40
_SAMPLES = 4
_WORST = 12
_JPEG_QUALITY = 80
_INK, _PAPER = (230, 236, 240), (20, 26, 32)
_FONT = cv2.FontFace("sans")


def overlays(unit: Unit, names: Sequence[str]) -> Iterator[np.ndarray]:
    """Frames of a unit with what was seen in each, (720, 1280, 3) RGB. The golden path sees what the RTL sees.

    Of a picture with a false pad, the last showing that has one.
    """
    film = develop(unit)
    answer = golden(film)
    places = {shot.name: place for place, shot in enumerate(unit.shots)}
    for name in names:
        place = places[name]
        seen = answer.seen[place]
        if not unit.clip and seen.pad is None:
            seen = next((one for one in reversed(answer.before) if one.pad is not None), seen)
        # No wire, no latency.
        yield annotate(film.images[place], replace(seen, latency_us=None))


def plan(rows: Sequence[Row]) -> dict[str, list[Row]]:
    """Which frames go on which sheet; a sheet without a frame is left out."""
    by_error = sorted((row for row in rows if row.found and row.error_px is not None), key=lambda row: -row.error_px)
    sheets = {
        "photos": [row for row in rows if row.set.startswith(PREFIX)],
        "missed": [row for row in rows if row.missed],
        "false": [row for row in rows if row.false],
        "worst": by_error[:_WORST],
        "samples": [row for part in _by_set(rows) for row in part[:: max(1, len(part) // _SAMPLES)][:_SAMPLES]],
    }
    return {name: chosen for name, chosen in sheets.items() if chosen}


def _by_set(rows: Sequence[Row]) -> Iterator[list[Row]]:
    for name in dict.fromkeys(row.set for row in rows):
        if not name.startswith(PREFIX):
            yield [row for row in rows if row.set == name]


def caption(row: Row) -> str:
    """What stands below a frame."""
    words = [row.set, row.name]
    if row.strength is not None:
        words.append(f"strength {row.strength:g}")
    if row.missed:
        words.append("MISSED")
    if row.false:
        words.append("FALSE")
    if row.error_px is not None:
        words.append(f"{row.error_px:.2f} px")
    return " ".join(words)


def write_sheets(
    rows: Sequence[Row],
    units: Sequence[Unit],
    out_dir: Path,
    workers: Workers,
    *,
    names: Container[str] = SHEETS,
    most: int = _FULL_SHEET,
) -> dict[str, Path]:
    """Draw the sheets.

    Args:
        rows: All rows.
        units: Where they come from.
        out_dir: Where the pictures go.
        workers: Who draws.
        names: Which of `SHEETS`; those without a frame are left out.
        most: Frames a sheet.

    Returns:
        Paths by name of the sheet.
    """
    unit_of = {(unit.set, shot.name): unit for unit in units for shot in unit.shots}
    paths = {}
    for name, frames in plan(rows).items():
        if name not in names:
            continue
        # Evenly over all of them: the first ones would be those of one set.
        chosen = frames[:: -(-len(frames) // most)]
        tasks = [(unit, list(part)) for unit, part in groupby(chosen, lambda row: unit_of[row.set, row.name])]
        thumbs = [thumb for part in workers.map(f"sheet {name}", _thumbs, tasks) for thumb in part]
        path = out_dir / f"sheet_{name}.jpg"
        sheet = tile(thumbs)
        if not cv2.imwrite(
            str(path), cv2.cvtColor(sheet, cv2.COLOR_RGB2BGR), [cv2.IMWRITE_JPEG_QUALITY, _JPEG_QUALITY]
        ):
            raise UserError(f"{path} cannot be written; check the folder and the space left on the disk.")
        paths[name] = path
    return paths


def _thumbs(task: tuple[Unit, list[Row]]) -> list[np.ndarray]:
    unit, rows = task
    pictures = overlays(unit, [row.name for row in rows])
    return [_thumb(picture, row) for picture, row in zip(pictures, rows, strict=True)]


def _thumb(picture: np.ndarray, row: Row) -> np.ndarray:
    small = cv2.resize(picture, _THUMB, interpolation=cv2.INTER_AREA)
    strip = np.full((_CAPTION_PX, _THUMB[0], 3), _PAPER, np.uint8)
    cv2.putText(strip, caption(row), (8, 18), _INK, _FONT, 13, 500)
    return np.vstack([small, strip])


def tile(thumbs: Sequence[np.ndarray]) -> np.ndarray:
    """Pictures of one size in rows of four."""
    columns = min(_COLUMNS, len(thumbs))
    blank = np.full_like(thumbs[0], _PAPER)
    full = [*thumbs, *[blank] * (-len(thumbs) % columns)]
    return np.vstack([np.hstack(full[start : start + columns]) for start in range(0, len(full), columns)])

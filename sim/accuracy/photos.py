# SPDX-License-Identifier: Apache-2.0
"""Photographs: a folder of sets with altitudes, and the reference that lies beside them."""

import csv
from functools import partial
from pathlib import Path

import numpy as np

from scripts.errors import UserError
from scripts.frames import open_frames, read_picture
from scripts.frames_altitude import altitudes_m
from sim.accuracy.rows import Reference
from sim.accuracy.shots import Shot, Unit

REFERENCE = "reference.csv"
PREFIX = "photos:"
_COLUMNS = ("image", "centre_x", "centre_y", "angle_deg")


def photo_units(folder: str, altitude: str | None = None) -> list[Unit]:
    """All pictures below a folder.

    Args:
        folder: Holds a folder of pictures a set, or the pictures themselves; with `reference.csv`, or without one.
        altitude: Metres, or a CSV file; default is each set's `altitude.csv`.

    Raises:
        UserError: there is no picture, or something in the folder cannot be used.
    """
    root = Path(folder)
    if not root.is_dir():
        raise UserError(f"{folder} is not a folder; give FRAMES=folder with one folder of pictures a set.")
    references = _references(root / REFERENCE) if (root / REFERENCE).is_file() else {}
    inner = sorted(path for path in root.iterdir() if path.is_dir() and not path.name.startswith("."))
    units = []
    for path in inner or [root]:
        frames = open_frames(str(path))
        prefix = f"{path.name}/" if inner else ""
        for name, metres in zip(frames.names, altitudes_m(frames, altitude), strict=True):
            reference, difficulty = references.pop(prefix + name, (Reference(), "-"))
            shot = Shot(name, partial(_read, path / name, reference), metres, difficulty)
            units.append(Unit(PREFIX + path.name, (shot,)))
    if references:
        raise UserError(f"{root / REFERENCE} names {next(iter(references))}, which is not there; mend the name.")
    return units


def _read(path: Path, reference: Reference) -> tuple[np.ndarray, Reference]:
    return read_picture(path), reference


def _references(path: Path) -> dict[str, tuple[Reference, str]]:
    """Reference and difficulty by image. Without a centre, the line says that the picture holds no pad."""
    try:
        with path.open(newline="", encoding="utf-8-sig") as file:
            rows = list(csv.DictReader(file, skipinitialspace=True))
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        raise UserError(f"{path} cannot be read as CSV ({error}); mend it or take it out.") from error
    if not rows or not set(_COLUMNS) <= set(rows[0]):
        raise UserError(f"{path} needs a first line with the columns {', '.join(_COLUMNS)}, and a line an image.")
    table = {}
    for number, row in enumerate(rows, start=2):
        try:
            numbers = [float(row[name]) if row[name] else None for name in _COLUMNS[1:]]
        except (TypeError, ValueError) as error:
            raise UserError(f"line {number} of {path} holds something that is no number; mend it.") from error
        x_px, y_px, angle_deg = numbers
        if (x_px is None) != (y_px is None):
            raise UserError(f"line {number} of {path} gives one coordinate of the centre; give both or none.")
        present = x_px is not None
        table[row["image"]] = (Reference(present, present, x_px, y_px, angle_deg), row.get("difficulty") or "-")
    return table

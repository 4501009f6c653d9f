# SPDX-License-Identifier: Apache-2.0
"""Measures the camera from photos of a chessboard, or of the landing pad itself.

    python -m scripts.calibrate --frames FOLDER [--board 9x6 | --board pad] [--square-mm 25] [--radial 0|1|2]

Writes build/calibrate/camera.toml, which `make firmware CAMERA=build/calibrate/camera.toml` takes, and
residuals.svg; docs/calibration.md says how to take the photos and what the numbers mean.
"""

import math
from collections.abc import Iterator
from functools import partial
from pathlib import Path

import numpy as np

from scripts.calibrate_chessboard import find_board, parse_board
from scripts.calibrate_fit import PARAMETERS, Fit, View, fit_without_outliers
from scripts.calibrate_pad import find_pad
from scripts.calibrate_picture import residuals_svg
from scripts.camera_file import FIELDS, text_of
from scripts.errors import ArgumentParser, UserError, run_main
from scripts.frames import PICTURE_SUFFIXES, how_many, read_picture
from sim.world.camera import Camera

DEFAULT_OUT = Path("build/calibrate")
PAD = "pad"
FEWEST = {"board": 5, PAD: 10}


def photos(folder: str) -> dict[str, Path]:
    """All pictures in a folder and below, by their names in it.

    Raises:
        UserError: it is no folder, or holds none.
    """
    root = Path(folder)
    if not folder:
        raise UserError("no photos are named; give their folder as FRAMES=folder.")
    if not root.is_dir():
        raise UserError(f"{folder} is not a folder; give the folder of your photos as FRAMES=folder.")
    files = sorted(path for path in root.rglob("*") if path.is_file() and path.suffix.lower() in PICTURE_SUFFIXES)
    if not files:
        raise UserError(f"{folder} holds no PNG or JPEG file; give the folder of your photos as FRAMES=folder.")
    return {str(path.relative_to(root)): path for path in files}


def calibrate(files: dict[str, Path], board: str, square_mm: float, radial: int) -> Fit:
    """Fit the camera to photos, starting from the default camera.

    Args:
        files: The photos.
        board: Inner corners as 9x6, or "pad".
        square_mm: Side of a square.
        radial: How many radial terms are fitted; the others are 0.

    Raises:
        UserError: too few of them show the target, or they do not determine the camera.
    """
    kind = PAD if board == PAD else "board"
    fewest = FEWEST[kind]
    camera = Camera()
    find = find_pad if kind == PAD else partial(find_board, board=parse_board(board, square_mm))
    if len(files) < fewest:
        raise UserError(
            f"there are {how_many(len(files), 'photo')}; {fewest} or more are needed, better three times that."
        )
    views = list(_views(files, partial(find, camera=camera)))
    if len(views) < fewest:
        target = "the whole pad" if kind == PAD else f"a whole board of {board} inner corners"
        raise UserError(
            f"{target} is seen in {len(views)} of {how_many(len(files), 'photo')}; {fewest} or more are needed."
        )
    free = PARAMETERS[: 3 + radial]
    return fit_without_outliers(camera, views, free)


def _views(files: dict[str, Path], find: partial) -> Iterator[View]:
    for name, file in files.items():
        view = find(read_picture(file), name=name)
        if view is not None:
            yield view


def report(fit: Fit, seen: int, given: int) -> list[str]:
    """What is printed."""
    lines = [f"{seen} of {how_many(given, 'photo')} show the target.", ""]
    lines += [f"{'photo':30}  points  distance [m]  error [px]", f"{'-' * 30}  ------  ------------  ----------"]
    lines += [
        f"{view.name:30.30}  {view.pixels // 2:6}  {distance:12.3f}  {rms:10.3f}"
        for view, distance, rms in zip(fit.views, fit.distances_m(), fit.rms_px(), strict=True)
    ]
    lines += [f"{name:30.30}  left out: far worse than the others" for name in fit.left_out]
    lines += ["", f"Error over all points: {total_rms_px(fit):.3f} px", ""]
    return lines + [f"{key:12} {_value(fit, key)}" for key in FIELDS]


def total_rms_px(fit: Fit) -> float:
    """Root mean square of the distance between point and model over all photos."""
    weights = [view.pixels for view in fit.views]
    return math.sqrt(float(np.average(np.square(fit.rms_px()), weights=weights)))


def _value(fit: Fit, key: str) -> str:
    attribute = FIELDS[key]
    value = getattr(fit.camera, attribute)
    digits = 5 if attribute.startswith("radial") else 2
    if attribute not in fit.errors:
        return f"{value:10} not fitted"
    return f"{value:10.{digits}f} +- {fit.errors[attribute]:.{digits}f}"


def notes_of(fit: Fit) -> list[str]:
    """Comment of the file: how good the numbers are."""
    errors = ", ".join(f"{key} {fit.errors[name]:.2g}" for key, name in FIELDS.items() if name in fit.errors)
    return [
        f"Measured by make calibrate: {how_many(len(fit.views), 'photo')}, {total_rms_px(fit):.3f} px over all points.",
        f"Standard errors: {errors}.",
    ]


def main(arguments: list[str] | None = None) -> None:
    """Entry point."""
    parser = ArgumentParser(prog="python -m scripts.calibrate", description=__doc__)
    parser.add_argument("--frames", default="", help="folder of photos, 1280x720")
    parser.add_argument("--board", default="9x6", help="inner corners of the chessboard, or pad")
    parser.add_argument(
        "--square-mm",
        type=float,
        default=25.0,
        help="side of a square; scales the distances, the camera does not depend on it",
    )
    parser.add_argument("--radial", type=int, choices=(0, 1, 2), help="radial terms to fit; default 2, of the pad 0")
    parser.add_argument("--out", type=Path, default=DEFAULT_OUT, help="folder for the results")
    options = parser.parse_args(arguments)
    files = photos(options.frames)
    radial = options.radial if options.radial is not None else (0 if options.board == PAD else 2)
    fit = calibrate(files, options.board, options.square_mm, radial)
    print("\n".join(report(fit, len(fit.views) + len(fit.left_out), len(files))))
    options.out.mkdir(parents=True, exist_ok=True)
    camera_toml = options.out / "camera.toml"
    camera_toml.write_text(text_of(fit.camera, notes_of(fit)), encoding="utf-8")
    (options.out / "residuals.svg").write_text(residuals_svg(fit), encoding="utf-8")
    print(f"\nWritten: {camera_toml} and residuals.svg beside it. Build with it: make firmware CAMERA={camera_toml}")


if __name__ == "__main__":
    run_main(main)

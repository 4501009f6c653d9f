# SPDX-License-Identifier: Apache-2.0
"""The altitude that the simulated LiDAR measures in each frame."""

import csv
from pathlib import Path

from scripts.errors import UserError
from scripts.frames import FrameSet

MAX_ALTITUDE_M = 40.0
_COLUMNS = ("frame", "altitude_m")


def altitudes_m(frames: FrameSet, given: str | None) -> list[float]:
    """One altitude a frame.

    Args:
        frames: The frames.
        given: Metres, or the path of a CSV file with the columns frame and altitude_m; None takes the rendered clip's
            own altitudes, or the CSV file that lies with the frames.

    Raises:
        UserError: there is none, or it is not one between 0 and 40 m.
    """
    if given is not None:
        constant = _number(given)
        if constant is not None:
            return [_checked(constant, "ALTITUDE")] * len(frames.names)
        return _from_csv(Path(given), frames.names)
    known = [truth.lidar_m for truth in frames.truths if truth is not None]
    if len(known) == len(frames.names):
        return known
    if frames.altitude_csv is None or not frames.altitude_csv.is_file():
        raise UserError(
            f"no altitude is known for the {frames.title}: give ALTITUDE=metres, or ALTITUDE=file.csv "
            f"with the columns frame and altitude_m, or put that file beside the frames as {frames.altitude_csv}."
        )
    return _from_csv(frames.altitude_csv, frames.names)


def _from_csv(path: Path, names: tuple[str, ...]) -> list[float]:
    table = _read(path)
    missing = [name for name in names if _key(name) not in table]
    if missing:
        others = f" and {len(missing) - 1} more" if len(missing) > 1 else ""
        raise UserError(f"{path} has no altitude for frame {missing[0]}{others}; add a line {missing[0]},metres.")
    return [table[_key(name)] for name in names]


def _read(path: Path) -> dict[str, float]:
    try:
        with path.open(newline="", encoding="utf-8-sig") as file:
            rows = list(csv.reader(file, skipinitialspace=True))
    except FileNotFoundError as error:
        raise UserError(f"{path} does not exist; give ALTITUDE as metres or as the path of a CSV file.") from error
    except OSError as error:
        reason = (error.strerror or "unknown reason").lower()
        raise UserError(f"{path} cannot be read: {reason}; give ALTITUDE as metres or as a CSV file.") from error
    except (UnicodeDecodeError, csv.Error) as error:
        raise UserError(f"{path} cannot be read as CSV ({error}); give frame,altitude_m lines in UTF-8.") from error
    if not rows or not set(_COLUMNS) <= set(rows[0]):
        raise UserError(f"{path} does not start with a line that names the columns frame and altitude_m; add it.")
    frame_column, altitude_column = (rows[0].index(column) for column in _COLUMNS)
    table: dict[str, float] = {}
    for line, row in enumerate(rows[1:], start=2):
        if not any(row):
            continue
        where = f"line {line} of {path}"
        if len(row) <= max(frame_column, altitude_column):
            raise UserError(f"{where} is too short; write frame,altitude_m.")
        value = _number(row[altitude_column])
        if value is None:
            raise UserError(f"{where} gives the altitude {row[altitude_column]!r}; write metres, as in 1.25.")
        key = _key(row[frame_column])
        if key in table:
            raise UserError(f"{where} gives a second altitude for frame {row[frame_column]}; leave one.")
        table[key] = _checked(value, where)
    return table


def _key(name: str) -> str:
    """A frame's number without leading zeros, or its file name in lower case."""
    name = name.strip()
    return str(int(name)) if name.isascii() and name.isdigit() else name.lower()


def _number(text: str) -> float | None:
    try:
        return float(text)
    except ValueError:
        return None


def _checked(value: float, where: str) -> float:
    # Not a number fails every comparison, so it is refused here too.
    if not 0.0 < value <= MAX_ALTITUDE_M:
        raise UserError(
            f"{where} gives an altitude of {value:g} m; it must be above 0 and at most {MAX_ALTITUDE_M:g} m."
        )
    return value

# SPDX-License-Identifier: Apache-2.0
"""What is known and what was seen of one frame: one row, one line of JSON."""

import json
from collections.abc import Iterable
from dataclasses import asdict, dataclass
from pathlib import Path

import numpy as np

from scripts.demo_results import Pad
from scripts.errors import UserError
from sim.world.pose import wrap_degrees

FALSE_PX = 5.0
FALSE_DEG = 5.0
POSITION_SLACK_M = 0.005
POSITION_SHARE = 0.01


@dataclass(frozen=True)
class Reference:
    """What is true of a frame; None where it is not known.

    Attributes:
        present: The pad is in the frame.
        required: Its shapes are visible, so that not finding it is a miss.
        x_px: Column of the image of the ring's physical centre.
        y_px: Its line.
        angle_deg: 0 = square above rectangle, clockwise.
        right_m: The pad's centre from the camera, body axes.
        forward_m: The same, ahead.
        altitude_m: Distance along the optical axis.
    """

    present: bool | None = None
    required: bool = False
    x_px: float | None = None
    y_px: float | None = None
    angle_deg: float | None = None
    right_m: float | None = None
    forward_m: float | None = None
    altitude_m: float | None = None


@dataclass(frozen=True)
class Row:
    """One frame of a set.

    Attributes:
        set: Name of the set.
        name: Name of the frame in the set.
        difficulty: What the reference calls it; "-" where it does not.
        strength: How strong the set's disturbance is in this frame.
        reference: What is true.
        pad: What the firmware said; None = no pad.
        altitude_m: The firmware's altitude.
        objects: Objects in the record.
        dropped: Objects that did not fit into it.
        min_area_px: MIN_AREA of the record.
        shapes: Of a frame that was missed, what became of the pad's shapes.
        strays: Of a picture, earlier showings in which a false pad was reported.
    """

    set: str
    name: str
    difficulty: str
    strength: float | None
    reference: Reference
    pad: Pad | None
    altitude_m: float | None
    objects: int
    dropped: int
    min_area_px: int
    shapes: str = ""
    strays: int = 0

    @property
    def error_x_px(self) -> float | None:
        """Column, seen less true."""
        return None if self._blind else self.pad.x_px - self.reference.x_px

    @property
    def error_y_px(self) -> float | None:
        """Line, seen less true."""
        return None if self._blind else self.pad.y_px - self.reference.y_px

    @property
    def error_px(self) -> float | None:
        """Distance from the true centre."""
        return None if self._blind else float(np.hypot(self.error_x_px, self.error_y_px))

    @property
    def error_deg(self) -> float | None:
        """Difference to the true angle, without sign."""
        if self._blind or self.reference.angle_deg is None:
            return None
        return abs(wrap_degrees(self.pad.angle_deg - self.reference.angle_deg))

    @property
    def error_m(self) -> float | None:
        """Distance from the true place, metres."""
        truth = self.reference
        if self.pad is None or truth.right_m is None or truth.forward_m is None:
            return None
        return float(np.hypot(self.pad.right_m - truth.right_m, self.pad.forward_m - truth.forward_m))

    @property
    def position_share(self) -> float | None:
        """`error_m` as a part of what is allowed: 1 % of the altitude and 5 mm."""
        if self.error_m is None or self.reference.altitude_m is None:
            return None
        return self.error_m / (POSITION_SHARE * self.reference.altitude_m + POSITION_SLACK_M)

    @property
    def false(self) -> bool:
        """A pad where there is none, or farther than 5 px or 5 degrees from it; at any time."""
        if self.strays:
            return True
        if self.pad is None or self.reference.present is None:
            return False
        if not self.reference.present:
            return True
        far = self.error_px is not None and self.error_px > FALSE_PX
        return far or (self.error_deg is not None and self.error_deg > FALSE_DEG)

    @property
    def found(self) -> bool:
        """A pad, and not a false one."""
        return self.pad is not None and not self.false

    @property
    def missed(self) -> bool:
        """The pad is plain to see and was not found."""
        return self.reference.required and not self.found

    @property
    def _blind(self) -> bool:
        return self.pad is None or self.reference.x_px is None or self.reference.y_px is None


def write_rows(path: Path, rows: Iterable[Row]) -> None:
    """Write one line of JSON a row.

    Raises:
        UserError: the file cannot be written.
    """
    text = "".join(json.dumps(asdict(row)) + "\n" for row in rows)
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
    except OSError as error:
        raise UserError(f"{path} cannot be written: {error.strerror}; check the folder and the disk.") from error


def read_rows(path: Path) -> list[Row]:
    """Read what `write_rows` wrote.

    Raises:
        UserError: the file is absent or was not written by `write_rows`.
    """
    try:
        lines = path.read_text(encoding="utf-8").splitlines()
        return [_row(json.loads(line)) for line in lines]
    except OSError as error:
        raise UserError(f"{path} cannot be read: {error.strerror}; run `make accuracy` first.") from error
    except (ValueError, TypeError, KeyError) as error:
        raise UserError(f"{path} holds no results of this version; run `make accuracy` again.") from error


def _row(values: dict) -> Row:
    pad = Pad(**values.pop("pad")) if values["pad"] else values.pop("pad")
    return Row(reference=Reference(**values.pop("reference")), pad=pad, **values)

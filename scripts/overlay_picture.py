# SPDX-License-Identifier: Apache-2.0
"""docs/pictures/overlay.png: a rendered frame with the drawing of `overlay`: `python -m scripts.overlay_picture`.

The drawing is what the renderer knows to be true; the pixels are those of the golden model, which the RTL equals.
"""

import math

import cv2
import numpy as np

from golden import pad_geometry as pad
from golden.overlay import Drawing, overlay
from scripts.errors import UserError, run_main
from sim.world.clip import demo_clip
from sim.world.pose import project_pad
from tb.common.cores import ROOT

PICTURE = ROOT / "docs/pictures/overlay.png"
FRAME = 2
MARGIN, TIP = 3, 130
"""Pixels around a shape; from the centre to the tip of the direction."""


def _ring(radius_mm: float) -> np.ndarray:
    turns = np.linspace(0, 2 * math.pi, 64)
    return radius_mm * np.stack([np.cos(turns), np.sin(turns)], axis=1)


def _rectangle(x_mm: float, y_mm: float, width_mm: float, height_mm: float) -> np.ndarray:
    half = np.array([width_mm, height_mm]) / 2
    return np.array([x_mm, y_mm]) + half * np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]])


SHAPES = (
    _ring(pad.RING_OUTER_RADIUS_MM),
    _rectangle(pad.SQUARE_CENTRE_X_MM, pad.SQUARE_CENTRE_Y_MM, pad.SQUARE_SIDE_MM, pad.SQUARE_SIDE_MM),
    _rectangle(pad.RECTANGLE_CENTRE_X_MM, pad.RECTANGLE_CENTRE_Y_MM, pad.RECTANGLE_WIDTH_MM, pad.RECTANGLE_HEIGHT_MM),
    _ring(pad.SMALL_RING_OUTER_RADIUS_MM),
)


def main() -> int:
    """Render and draw."""
    frame = demo_clip()[FRAME]
    truth, boxes = frame.truth, []
    for shape in SHAPES:
        pixels = project_pad(frame.camera, frame.pose, shape)
        low, high = np.floor(pixels.min(axis=0)) - MARGIN, np.ceil(pixels.max(axis=0)) + MARGIN
        boxes.append((*low.astype(int).tolist(), *high.astype(int).tolist()))
    turn = math.radians(truth.angle_deg)
    centre = round(truth.x_px), round(truth.y_px)
    tip = round(truth.x_px + TIP * math.sin(turn)), round(truth.y_px - TIP * math.cos(turn))
    words = f"RIGHT {truth.right_m:+.2f} M  FORWARD {truth.forward_m:+.2f} M  ALTITUDE {truth.altitude_m:.2f} M"
    drawing = Drawing(tuple(boxes), centre, tip, crosshair=True, text=("DESCEND", words))
    rgb = frame.image().astype(np.int64)
    drawn = overlay(rgb[..., 0] << 16 | rgb[..., 1] << 8 | rgb[..., 2], drawing)
    bgr = np.stack([drawn & 255, drawn >> 8 & 255, drawn >> 16], axis=-1).astype(np.uint8)
    # Half as large: it is a picture of a page.
    if not cv2.imwrite(str(PICTURE), cv2.resize(bgr, None, fx=0.5, fy=0.5, interpolation=cv2.INTER_AREA)):
        raise UserError(f"{PICTURE} cannot be written; see that its folder is there.")
    return 0


if __name__ == "__main__":
    run_main(main)

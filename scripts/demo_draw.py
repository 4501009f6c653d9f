# SPDX-License-Identifier: Apache-2.0
"""Draws on a frame what hardware and firmware found in it."""

import math
from typing import NamedTuple

import cv2
import numpy as np

from golden import pad_geometry
from scripts.demo_results import Row


class _Style(NamedTuple):
    """How a text looks."""

    size: int
    weight: int
    outlined: bool = False


_FONT = cv2.FontFace("sans")
_CAPTION = _Style(13, 450)
_VALUE = _Style(20, 700)
_NAME = _Style(14, 700, outlined=True)
_SUBPIXEL_BITS = 4

_WHITE = (245, 248, 250)
_MUTED = (166, 182, 190)
_PANEL = (14, 20, 26)
_FOUND = (86, 224, 130)
_MISSED = (255, 128, 96)
_OBJECT = (150, 170, 180)
_SHAPE_COLOURS = {
    "ring": (72, 196, 255),
    "square": (255, 214, 84),
    "rectangle": (255, 148, 84),
    "small ring": (214, 150, 226),
}
_PANEL_HEIGHT = 66
_PANEL_OPACITY = 0.80
_NEAR_MM = 20.0
_SMALL_RING_PX = 130
_INSET_PX = 220


def annotate(image: np.ndarray, row: Row) -> np.ndarray:
    """The frame with boxes, centre, direction and a panel of figures.

    Args:
        image: (height, width, 3) uint8 RGB.
        row: What was found.

    Returns:
        A new image of the same shape.
    """
    canvas = image.copy()
    shapes = name_shapes(row)
    for index, item in enumerate(row.objects):
        if index not in shapes.values():
            _box(canvas, item, _OBJECT, 1)
    _crosshair(canvas)
    width = _width(row.objects[shapes["ring"]]) if shapes else 0
    small = 0 < width < _SMALL_RING_PX
    for name, index in shapes.items():
        _box(canvas, row.objects[index], _SHAPE_COLOURS[name], 1 if small else 2)
    if row.pad:
        _pad(canvas, row, width)
    if small:
        _magnified(canvas, image, row, width)
    else:
        for name, index in shapes.items():
            _label(canvas, name, row.objects[index])
    _panel(canvas, row)
    return canvas


def name_shapes(row: Row) -> dict[str, int]:
    """Which object is which shape of the pad, for the picture alone: the firmware does not report it.

    Returns:
        Indices into `row.objects` by name of the shape; empty if the picture cannot tell.
    """
    if row.pad is None:
        return {}
    objects = row.objects
    x, y = row.pad.x_px, row.pad.y_px
    around = (objects["box_min_x"] <= x) & (x <= objects["box_max_x"])
    around &= (objects["box_min_y"] <= y) & (y <= objects["box_max_y"])
    sides = objects["box_max_x"].astype(int) - objects["box_min_x"] + 1
    candidates = np.nonzero(around)[0]
    # From the smallest on: the small ring is none, because square and rectangle would have to lie within it.
    for ring in candidates[np.argsort(sides[candidates])]:
        scale = 0.5 * sides[ring] / pad_geometry.RING_OUTER_RADIUS_MM
        shapes = {"ring": int(ring)}
        for name, along_mm in (
            ("square", -pad_geometry.SQUARE_CENTRE_Y_MM),
            ("rectangle", -pad_geometry.RECTANGLE_CENTRE_Y_MM),
            ("small ring", 0.0),
        ):
            index = _nearest(objects, _ahead(row, along_mm * scale), _NEAR_MM * scale)
            if index is not None and index != ring and sides[index] < 0.6 * sides[ring]:
                shapes[name] = index
        if "square" in shapes and "rectangle" in shapes:
            return shapes
    return {}


def _ahead(row: Row, pixels: float) -> np.ndarray:
    """The point so many pixels from the pad's centre towards its upper edge."""
    turn = math.radians(row.pad.angle_deg)
    return np.array([row.pad.x_px + pixels * math.sin(turn), row.pad.y_px - pixels * math.cos(turn)])


def _nearest(objects: np.ndarray, place: np.ndarray, reach: float) -> int | None:
    centroids = np.column_stack([objects["sum_x"], objects["sum_y"]]) / objects["area"][:, None]
    distances = np.linalg.norm(centroids - place, axis=1)
    index = int(np.argmin(distances))
    return index if distances[index] <= reach else None


def _box(canvas: np.ndarray, item: np.void, colour: tuple[int, int, int], thickness: int) -> None:
    low = int(item["box_min_x"]) - thickness, int(item["box_min_y"]) - thickness
    high = int(item["box_max_x"]) + thickness, int(item["box_max_y"]) + thickness
    cv2.rectangle(canvas, low, high, colour, thickness, cv2.LINE_AA)


def _label(canvas: np.ndarray, name: str, item: np.void) -> None:
    width = _text_width(name, _NAME)
    left = int(item["box_max_x"]) + 6
    if name == "ring" or left + width > canvas.shape[1] - 8:
        left = max(int(item["box_min_x"]) - 1, 4)
        place = (left, max(int(item["box_min_y"]) - 8, 16))
    else:
        place = (left, int(item["box_min_y"]) + 12)
    _text(canvas, name, place, _SHAPE_COLOURS[name], _NAME)


def _width(item: np.void) -> int:
    return int(item["box_max_x"]) - int(item["box_min_x"]) + 1


def _pad(canvas: np.ndarray, row: Row, ring_width: int) -> None:
    """Cross on the centre, arrow towards the pad's upper edge."""
    _arrow(canvas, _ahead(row, 0.0), _ahead(row, 0.72 * ring_width or 60.0))
    _cross(canvas, _ahead(row, 0.0), float(np.clip(0.05 * ring_width, 5.0, 11.0)))


def _magnified(canvas: np.ndarray, image: np.ndarray, row: Row, ring_width: int) -> None:
    """A far pad, enlarged, in an upper corner it does not lie in."""
    scale = _INSET_PX / (1.7 * ring_width)
    left = 20 if row.pad.x_px > canvas.shape[1] / 2 else canvas.shape[1] - 20 - _INSET_PX
    half = (_INSET_PX - 1) / 2
    place = np.array([[scale, 0.0, half - scale * row.pad.x_px], [0.0, scale, half - scale * row.pad.y_px]])
    inset = cv2.warpAffine(image, place, (_INSET_PX, _INSET_PX), flags=cv2.INTER_CUBIC, borderMode=cv2.BORDER_REPLICATE)
    _cross(inset, np.array([half, half]), 9.0)
    _text(inset, f"{scale:.1f}x", (10, _INSET_PX - 10), _WHITE, _NAME)
    canvas[20 : 20 + _INSET_PX, left : left + _INSET_PX] = inset
    cv2.rectangle(canvas, (left - 1, 19), (left + _INSET_PX, 20 + _INSET_PX), _FOUND, 2, cv2.LINE_AA)


def _cross(canvas: np.ndarray, centre: np.ndarray, arm: float) -> None:
    for colour, thickness in (((0, 0, 0), 5), (_FOUND, 2)):
        for reach in (np.array([arm, 0.0]), np.array([0.0, arm])):
            _line(canvas, centre - reach, centre + reach, colour, thickness)


def _arrow(canvas: np.ndarray, start: np.ndarray, tip: np.ndarray) -> None:
    along = (start - tip) / np.linalg.norm(start - tip)
    across = np.array([-along[1], along[0]])
    for colour, thickness in (((0, 0, 0), 5), (_FOUND, 2)):
        _line(canvas, start, tip, colour, thickness)
        for side in (-1, 1):
            _line(canvas, tip, tip + 13 * along + side * 7 * across, colour, thickness)


def _line(canvas: np.ndarray, start: np.ndarray, end: np.ndarray, colour: tuple[int, int, int], thickness: int) -> None:
    points = [tuple(np.rint(point * (1 << _SUBPIXEL_BITS)).astype(int).tolist()) for point in (start, end)]
    cv2.line(canvas, points[0], points[1], colour, thickness, cv2.LINE_AA, _SUBPIXEL_BITS)


def _crosshair(canvas: np.ndarray) -> None:
    """Where the camera points: the middle of the image."""
    middle = np.array([canvas.shape[1] / 2.0, canvas.shape[0] / 2.0])
    for dx, dy in ((1, 0), (-1, 0), (0, 1), (0, -1)):
        for colour, thickness in (((0, 0, 0), 3), (_WHITE, 1)):
            _line(canvas, middle + np.array([dx, dy]) * 6, middle + np.array([dx, dy]) * 22, colour, thickness)


def _panel(canvas: np.ndarray, row: Row) -> None:
    strip = canvas[-_PANEL_HEIGHT:]
    strip[:] = np.rint(strip * (1 - _PANEL_OPACITY) + np.array(_PANEL) * _PANEL_OPACITY)
    top = canvas.shape[0] - _PANEL_HEIGHT
    left = 24
    for label, value, colour in _figures(row):
        _text(canvas, label, (left, top + 24), _MUTED, _CAPTION)
        _text(canvas, value, (left, top + 50), colour, _VALUE)
        left += 30 + max(_text_width(label, _CAPTION), _text_width(value, _VALUE))


def _figures(row: Row) -> list[tuple[str, str, tuple[int, int, int]]]:
    figures = [("frame", row.name, _WHITE)]
    if row.pad is None or row.target is None:
        figures.append(("pad", "no pad", _MISSED))
    else:
        figures += [
            ("pad centre", f"{row.pad.x_px:.1f}, {row.pad.y_px:.1f} px", _FOUND),
            ("angle", f"{row.pad.angle_deg:+.1f}°", _WHITE),
            ("right, forward", f"{row.pad.right_m:+.3f}, {row.pad.forward_m:+.3f} m", _WHITE),
        ]
    if row.altitude_m is not None:
        figures.insert(-1 if row.pad else len(figures), ("altitude", f"{row.altitude_m:.3f} m", _WHITE))
    dropped = int(row.record["header"]["objects_dropped"])
    figures.append(("objects", f"{len(row.objects)} + {dropped} dropped" if dropped else str(len(row.objects)), _WHITE))
    if row.target and row.latency_us is not None:
        figures.append(("LANDING_TARGET", f"#{row.target.sequence}", _WHITE))
        figures.append(("last pixel to last byte", f"{row.latency_us:.0f} µs", _WHITE))
    if row.error_px is not None:
        figures.append(("error", f"{row.error_px:.2f} px", _WHITE))
    return figures


def _text(
    canvas: np.ndarray,
    text: str,
    place: tuple[int, int],
    colour: tuple[int, int, int],
    style: _Style,
) -> None:
    if style.outlined:
        for dx, dy in ((-1, 0), (1, 0), (0, -1), (0, 1)):
            cv2.putText(canvas, text, (place[0] + dx, place[1] + dy), (0, 0, 0), _FONT, style.size, style.weight)
    cv2.putText(canvas, text, place, colour, _FONT, style.size, style.weight)


def _text_width(text: str, style: _Style) -> int:
    box = cv2.getTextSize((1280, 720), text, (0, 0), _FONT, style.size, style.weight)
    return int(box[2])

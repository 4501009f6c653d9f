# SPDX-License-Identifier: Apache-2.0
"""One HTML file with table, charts and pictures; it needs nothing but a browser."""

import base64
import html
import statistics
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

import cv2
import numpy as np

from scripts.demo_decode import Line
from scripts.demo_results import Row
from scripts.demo_table import cells, columns, units
from scripts.errors import UserError
from scripts.frames import how_many
from scripts.report_chart import Series, chart

_STYLE_SHEET = Path(__file__).with_name("report.css")
_JPEG_QUALITY = 82
_PICTURE_WIDTH = 960
_NOTE = (
    "Pixels count from 0 at the centre of the first one, x right, y down. Angle 0 is the square above the rectangle, "
    "clockwise. Right and forward are from the drone to the pad. Latency runs from the frame's last pixel on the "
    "camera's wire to the stop bit of the last byte of LANDING_TARGET."
)


@dataclass(frozen=True)
class Facts:
    """What is to be said about a run as a whole.

    Attributes:
        source: What the frames are.
        sequential: Each frame follows the one before, so that lines between them mean something.
        firmware: "qemu" or "host".
        shown: Frames that the camera showed, repeats included.
        simulated_ns: Simulated time.
        wall_s: Time the run took.
        autopilot: UART0.
        ground: UART1.
    """

    source: str
    sequential: bool
    firmware: str
    shown: int
    simulated_ns: int
    wall_s: float
    autopilot: Line
    ground: Line

    @property
    def firmware_text(self) -> str:
        """The firmware in words."""
        return "board ELF on QEMU's Zynq" if self.firmware == "qemu" else "firmware built for this host"

    def sentence(self, rows: list[Row]) -> str:
        """The run in one line."""
        found = sum(row.pad is not None for row in rows)
        return (
            f"Pad found in {found} of {how_many(len(rows), 'frame')}; {how_many(self.shown, 'frame')} shown, "
            f"{self.simulated_ns / 1e9:.3f} s simulated in {self.wall_s:.1f} s; {self.firmware_text}."
        )


def write_report(path: Path, rows: list[Row], pictures: Iterable[np.ndarray], facts: Facts) -> Path:
    """Write the report.

    Args:
        path: Where to.
        rows: One a frame.
        pictures: The annotated frames, RGB, in the order of the rows; taken one at a time.
        facts: The run as a whole.

    Returns:
        The path.

    Raises:
        UserError: the file cannot be written.
    """
    figures = "".join(_figure(row, picture) for row, picture in zip(rows, pictures, strict=True))
    sections = [
        _head(rows, facts),
        _cards(rows, facts),
        _charts(rows, facts.sequential),
        f"<section><h2>Every frame</h2>{_table(rows)}<p class='note'>{_NOTE}</p></section>",
        f"<section><h2>What was seen</h2><div class='pictures'>{figures}</div></section>",
        _run_facts(facts),
    ]
    return write_page(path, facts.source, sections)


def write_page(path: Path, title: str, sections: Iterable[str]) -> Path:
    """Write a page in the project's style.

    Args:
        path: Where to.
        title: For the browser, plain text.
        sections: HTML.

    Returns:
        The path.

    Raises:
        UserError: the file cannot be written.
    """
    page = (
        "<!doctype html><html lang='en'><head><meta charset='utf-8'>"
        "<meta name='viewport' content='width=device-width, initial-scale=1'>"
        f"<title>Touchdown: {html.escape(title)}</title>"
        f"<style>{_STYLE_SHEET.read_text(encoding='utf-8')}</style></head>"
        f"<body><main>{''.join(sections)}</main></body></html>\n"
    )
    try:
        path.write_text(page, encoding="utf-8")
    except OSError as error:
        raise UserError(f"{path} cannot be written: {error.strerror}; choose another folder.") from error
    return path


def _head(rows: list[Row], facts: Facts) -> str:
    source = html.escape(facts.source[:1].upper() + facts.source[1:])
    way = f"camera pixels through the verilated cores and the {facts.firmware_text}, to MAVLink bytes on the wire"
    return f"<header><h1>Touchdown</h1><p>{source}, {how_many(len(rows), 'frame')}: {html.escape(way)}.</p></header>"


def _cards(rows: list[Row], facts: Facts) -> str:
    found = [row for row in rows if row.pad]
    latencies = [row.latency_us for row in rows if row.latency_us is not None]
    cards = [("Pad found", f"{len(found)} of {len(rows)}", "frames")]
    if latencies:
        cards.append(("Latency, median", f"{statistics.median(latencies):.0f}", "µs, last pixel to last byte"))
        cards.append(
            ("Latency, worst", f"{max(latencies):.0f}", f"µs, {max(latencies) - min(latencies):.0f} µs spread")
        )
    errors = [row.error_px for row in rows if row.error_px is not None]
    if errors:
        cards.append(("Centre error, mean", f"{statistics.mean(errors):.2f}", f"px, worst {max(errors):.2f} px"))
        angles = [row.error_deg for row in rows if row.error_deg is not None]
        cards.append(("Angle error, mean", f"{statistics.mean(angles):.2f}", f"deg, worst {max(angles):.2f} deg"))
    cards.append(("Simulated", f"{facts.simulated_ns / 1e6:.0f}", f"ms in {facts.wall_s:.1f} s"))
    return (
        "<section class='cards'>"
        + "".join(
            f"<div class='card'><h3>{html.escape(title)}</h3><strong>{html.escape(value)}</strong>"
            f"<span>{html.escape(note)}</span></div>"
            for title, value, note in cards
        )
        + "</section>"
    )


def _charts(rows: list[Row], joined: bool) -> str:
    names = [row.name for row in rows]
    altitude = [Series("firmware", [row.altitude_m for row in rows], "primary")]
    if any(row.truth for row in rows):
        altitude.insert(0, Series("truth", [row.truth.altitude_m if row.truth else None for row in rows], "muted"))
    offsets = [
        Series("right", [row.pad.right_m if row.pad else None for row in rows], "primary"),
        Series("forward", [row.pad.forward_m if row.pad else None for row in rows], "second"),
    ]
    latency = [Series("latency", [row.latency_us for row in rows], "primary")]
    charts = [
        chart("Altitude", "m", names, altitude, joined),
        chart("Offset to the pad", "m", names, offsets, joined),
        chart("Last pixel to last byte", "µs", names, latency, joined),
    ]
    return f"<section class='charts'>{''.join(charts)}</section>"


def _table(rows: list[Row]) -> str:
    names = columns(rows)
    head = "".join(
        f"<th>{html.escape(name)}{f' <small>{units()[name]}</small>' if name in units() else ''}</th>" for name in names
    )
    lines = []
    for row in rows:
        texts = cells(row)
        data = "".join(f"<td>{html.escape(texts[name])}</td>" for name in names)
        lines.append(f"<tr{'' if row.pad else ' class=missed'}>{data}</tr>")
    return f"<div class='scroll'><table><thead><tr>{head}</tr></thead><tbody>{''.join(lines)}</tbody></table></div>"


def _figure(row: Row, picture: np.ndarray) -> str:
    height = round(picture.shape[0] * _PICTURE_WIDTH / picture.shape[1])
    small = cv2.resize(picture, (_PICTURE_WIDTH, height), interpolation=cv2.INTER_AREA)
    quality = [cv2.IMWRITE_JPEG_QUALITY, _JPEG_QUALITY]
    encoded = cv2.imencode(".jpg", cv2.cvtColor(small, cv2.COLOR_RGB2BGR), quality)[1]
    data = base64.b64encode(encoded).decode("ascii")
    name = html.escape(row.name)
    return (
        f"<figure><img alt='frame {name}' width='{_PICTURE_WIDTH}' height='{height}' "
        f"src='data:image/jpeg;base64,{data}'></figure>"
    )


def _run_facts(facts: Facts) -> str:
    lines = [("Frames shown", f"{facts.shown}, repeats for the thresholds included"), ("Firmware", facts.firmware_text)]
    for title, line in (("UART0, autopilot", facts.autopilot), ("UART1, ground station", facts.ground)):
        kinds = sorted({message.kind for message in line.messages})
        counts = ", ".join(f"{len(line.of(kind))} {kind}" for kind in kinds) or "nothing"
        lines.append((title, f"{counts}; {line.lost} lost, {line.bad_bytes} bytes outside messages"))
    items = "".join(f"<dt>{html.escape(name)}</dt><dd>{html.escape(text)}</dd>" for name, text in lines)
    return f"<section><h2>The run</h2><dl>{items}</dl></section>"

# SPDX-License-Identifier: Apache-2.0
"""The two ways from pixels to what the firmware says: the golden models with the firmware's C, and the verilated RTL.

Both end in the same record, decoded by the same code, so that they can be compared message by message.
"""

from dataclasses import dataclass, field, replace
from pathlib import Path

import numpy as np

from firmware.library import AUTOPILOT, GROUND, Firmware, attitude_bytes
from golden import result_writer
from golden.chain import Settings, binary_stages
from golden.gaussian5x5 import gaussian5x5
from golden.generated.landing_regs import OBJECT_DTYPE, RECORD_DTYPE
from golden.rgb2gray import rgb2gray
from golden.threshold_stats import threshold_stats
from scripts.demo_decode import Line, decode
from scripts.demo_results import Row as Seen
from scripts.demo_results import collect
from scripts.frames import HEIGHT, WIDTH
from sim.accuracy.shots import SHOWINGS_LEAST, SHOWINGS_STEADY, Film, Shot
from sim.cosim.result import Frame
from sim.cosim.run import run_cosim

FRAME_NS = 50_000_000 / 3
FIRST_FRAME_NS = 3_800_000
SCAN_NS = 16_072_000
RECORD_NS = 78_000


@dataclass(frozen=True)
class Answer:
    """What a unit gave.

    Attributes:
        frames: All showings with their records.
        autopilot: Messages of UART0.
        ground: Messages of UART1.
        seen: One row a shot, as `scripts.demo_results` joins them.
        before: The same for every showing before those, in order.
    """

    frames: list[Frame] = field(repr=False)
    autopilot: Line = field(repr=False)
    ground: Line = field(repr=False)
    seen: list[Seen]
    before: list[Seen] = field(repr=False)


def shown(film: Film) -> list[int]:
    """Which of its shots the camera shows, one after the other; of a picture, as often as it is shown at most."""
    count = len(film.images)
    # A clip's first frame primes the thresholds, as in the demo.
    return [0, *range(count)] if film.unit.clip else [0] * film.unit.showings


def _answer(film: Film, frames: list[Frame], autopilot: Line, ground: Line) -> Answer:
    """What counts are the last showings, one a shot."""
    order, source = shown(film)[: len(frames)], film.frames
    showings = replace(
        source,
        names=tuple(source.names[number] for number in order),
        truths=tuple(source.truths[number] for number in order),
    )
    every = collect(showings, list(range(len(order))), frames, autopilot, ground)
    first = len(every) - len(film.images)
    return Answer(frames, autopilot, ground, every[first:], every[:first])


def settled(film: Film) -> Film:
    """The film with its picture shown as often as the golden path needs, for a path that cannot stop by itself."""
    return replace(film, unit=replace(film.unit, showings=len(golden(film).frames)))


class Objects:
    """What the hardware finds in a film, of every size and in its order; computed once, when it is first asked for.

    Args:
        film: What is shown.
        settings: Registers; the factor is given with each question, and MIN_AREA has no part in it.
    """

    def __init__(self, film: Film, settings: Settings) -> None:
        self._images = film.images
        self._settings = replace(settings, min_area=0)
        self._smooth: dict[int, np.ndarray] = {}
        self._known: dict[tuple[int, int, int], np.ndarray] = {}

    def of(self, shot: int, before: int, factor: int) -> np.ndarray:
        """Objects of a shot with the thresholds of the shot before it, made with that factor."""
        key = (shot, before, factor)
        if key not in self._known:
            stats = threshold_stats(self._smoothed(before), factor, flat_limit=self._settings.flat_limit)
            self._known[key] = binary_stages(self._smoothed(shot), stats, self._settings).objects
        return self._known[key]

    def _smoothed(self, shot: int) -> np.ndarray:
        if shot not in self._smooth:
            self._smooth[shot] = gaussian5x5(rgb2gray(self._images[shot]))
        return self._smooth[shot]


def golden(
    film: Film,
    settings: Settings | None = None,
    options: int | None = None,
    objects: Objects | None = None,
    attitude: bool = True,
) -> Answer:
    """The golden models and the firmware's C in this process.

    What the firmware writes to MIN_AREA and THRESHOLD after one record counts from the next frame on: the record is
    there 0.1 ms after a frame's last pixel, and the next frame, which takes its registers with its first pixel, comes
    after 0.67 ms. Thresholds serve the frame after the one with whose factor they were made.

    Args:
        film: What is shown.
        settings: Registers other than the firmware's; MIN_AREA is the firmware's all the same, and so is the factor
            unless it is another than the one with which the firmware starts.
        options: What the firmware's detection may do, a mask; default is what the firmware starts with.
        objects: Where some of them are known already for these settings.
        attitude: False leaves out what the autopilot says.
    """
    settings = settings or Settings()
    firmware = Firmware()
    if options is not None:
        firmware.set_options(options)
    objects = objects or Objects(film, settings)
    own_factor = settings.factor == Settings.factor
    sent = {AUTOPILOT: bytearray(), GROUND: bytearray()}
    frames: list[Frame] = []
    steady = 0
    order = shown(film)
    # Without thresholds everything is bright, and no settings in use make that an object.
    every = np.zeros(0, OBJECT_DTYPE)
    for index, number in enumerate(order):
        shot = film.unit.shots[number]
        first_ns = FIRST_FRAME_NS + round(index * FRAME_NS)
        last_ns = first_ns + SCAN_NS
        if index:
            every = objects.of(number, order[index - 1], int(frames[-1].record["header"]["threshold_factor"]))
        values = {
            "frame_number": index + 1,
            "start_time_us": first_ns // 1000,
            "scan_time_us": SCAN_NS // 1000,
            "altitude_mm": round(1000 * shot.lidar_m),
            "altitude_valid": 1,
            "frame_size_width": WIDTH,
            "frame_size_height": HEIGHT,
            "threshold_factor": firmware.factor if own_factor else settings.factor,
            "min_area": firmware.min_area_px,
            "thresholds_missing": int(index == 0),
        }
        record = result_writer.record(values, every[every["area"] >= firmware.min_area_px])
        now_us = (last_ns + RECORD_NS) // 1000
        firmware.on_bytes(AUTOPILOT, from_autopilot(shot) if attitude else b"", now_us)
        error = firmware.on_record(record, now_us)
        if error != 0:
            raise RuntimeError(f"the firmware refuses the record of {shot.name} with {error}")
        # All that goes to an autopilot here is LANDING_TARGET: nothing asks, and no time passes for heartbeats.
        steady = steady + 1 if firmware.sent[AUTOPILOT] else 0
        for link, data in firmware.sent.items():
            sent[link] += data
            data.clear()
        frames.append(Frame(index, first_ns, last_ns, _whole(record), last_ns + RECORD_NS))
        if not film.unit.clip and len(frames) >= SHOWINGS_LEAST and steady >= SHOWINGS_STEADY:
            break
    lines = {link: decode(bytes(data), [0] * len(data)) for link, data in sent.items()}
    return _answer(film, frames, lines[AUTOPILOT], lines[GROUND])


def from_autopilot(shot: Shot) -> bytes:
    """What the autopilot says before the record of a shot."""
    return attitude_bytes(*shot.attitude_rad) if shot.attitude_rad else b""


def _whole(record: bytes) -> np.void:
    """The record as a buffer holds it, the places without an object empty."""
    return np.frombuffer(record.ljust(RECORD_DTYPE.itemsize, b"\0"), RECORD_DTYPE)[0]


def rtl(film: Film, out_dir: Path) -> Answer:
    """The verilated landing_core with the firmware built for this machine.

    Args:
        film: What is shown.
        out_dir: Where the run leaves its files; a folder of its own.
    """
    shots = [film.unit.shots[number] for number in shown(film)]
    result = run_cosim(
        (film.images[number] for number in shown(film)),
        [round(1000 * shot.lidar_m) for shot in shots],
        from_autopilot=[from_autopilot(shot) for shot in shots],
        firmware="host",
        out_dir=out_dir,
        progress=lambda _text: None,
    )
    autopilot = decode(result.uart0.data, result.uart0.done_ns)
    ground = decode(result.uart1.data, result.uart1.done_ns)
    return _answer(film, result.frames, autopilot, ground)

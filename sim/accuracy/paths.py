# SPDX-License-Identifier: Apache-2.0
"""The two ways from pixels to what the firmware says: the golden models with the firmware's C, and the verilated RTL.

Both end in the same record, decoded by the same code, so that they can be compared message by message.
"""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field, replace
from pathlib import Path

import numpy as np

from firmware.library import AUTOPILOT, GROUND, Firmware
from golden import result_writer
from golden.chain import Settings, run_chain
from golden.generated.landing_regs import OBJECT_DTYPE, RECORD_DTYPE
from scripts.demo_decode import Line, decode
from scripts.demo_results import Row as Seen
from scripts.demo_results import collect
from scripts.frames import HEIGHT, WIDTH
from sim.accuracy.shots import Film
from sim.cosim.result import Frame
from sim.cosim.run import run_cosim

SHOWINGS = 9
"""How often an independent picture is shown; the last time counts.

The first showing has no thresholds. From the second on the firmware moves MIN_AREA from 100 px towards 30 (few shapes)
or 150 (too many), where it is by the eighth showing; a test sees that it then stays.
"""
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
    """

    frames: list[Frame] = field(repr=False)
    autopilot: Line = field(repr=False)
    ground: Line = field(repr=False)
    seen: list[Seen]


def _shown(film: Film) -> list[int]:
    """Which of its shots the camera shows, one after the other."""
    count = len(film.images)
    # A clip's first frame primes the thresholds, as in the demo.
    return [0, *range(count)] if film.unit.clip else [0] * SHOWINGS


def _answer(film: Film, frames: list[Frame], autopilot: Line, ground: Line) -> Answer:
    """What counts are the last showings, one a shot."""
    counted = list(range(len(frames) - len(film.images), len(frames)))
    return Answer(frames, autopilot, ground, collect(film.frames, counted, frames, autopilot, ground))


def shown_objects(film: Film, settings: Settings) -> Iterator[np.ndarray]:
    """The objects of each showing, of every size, in the order of the hardware.

    A picture that is shown again differs in nothing but the registers, so it is computed once.
    """
    every = replace(settings, min_area=0)
    # Without thresholds everything is bright, and no settings in use make that an object.
    yield np.zeros(0, OBJECT_DTYPE)
    before = run_chain(film.images[0], None, every).stats
    if not film.unit.clip:
        objects = run_chain(film.images[0], before, every).objects
        yield from [objects] * (SHOWINGS - 1)
        return
    for image in film.images:
        stages = run_chain(image, before, every)
        yield stages.objects
        before = stages.stats


def golden(
    film: Film,
    settings: Settings | None = None,
    options: int | None = None,
    objects: Iterable[np.ndarray] | None = None,
) -> Answer:
    """The golden models and the firmware's C in this process.

    What the firmware writes to MIN_AREA after one record counts from the next frame on: the record is there 0.1 ms
    after a frame's last pixel, and the next frame, which takes its registers with its first pixel, comes after 0.67 ms.

    Args:
        film: What is shown.
        settings: Registers other than the firmware's; MIN_AREA is the firmware's all the same.
        options: What the firmware's detection may do, a mask; default is what the firmware starts with.
        objects: What `shown_objects` gives for these, where it is known already.
    """
    settings = settings or Settings()
    firmware = Firmware()
    if options is not None:
        firmware.set_options(options)
    sent = {AUTOPILOT: bytearray(), GROUND: bytearray()}
    frames = []
    objects = shown_objects(film, settings) if objects is None else objects
    for index, (shown, every) in enumerate(zip(_shown(film), objects, strict=True)):
        shot = film.unit.shots[shown]
        first_ns = FIRST_FRAME_NS + round(index * FRAME_NS)
        last_ns = first_ns + SCAN_NS
        values = {
            "frame_number": index + 1,
            "start_time_us": first_ns // 1000,
            "scan_time_us": SCAN_NS // 1000,
            "altitude_mm": round(1000 * shot.lidar_m),
            "altitude_valid": 1,
            "frame_size_width": WIDTH,
            "frame_size_height": HEIGHT,
            "threshold_factor": settings.factor,
            "min_area": firmware.min_area_px,
            "thresholds_missing": int(index == 0),
        }
        record = result_writer.record(values, every[every["area"] >= firmware.min_area_px])
        error = firmware.on_record(record, (last_ns + RECORD_NS) // 1000)
        if error != 0:
            raise RuntimeError(f"the firmware refuses the record of {shot.name} with {error}")
        for link, data in firmware.sent.items():
            sent[link] += data
            data.clear()
        frames.append(Frame(index, first_ns, last_ns, _whole(record), last_ns + RECORD_NS))
    lines = {link: decode(bytes(data), [0] * len(data)) for link, data in sent.items()}
    return _answer(film, frames, lines[AUTOPILOT], lines[GROUND])


def _whole(record: bytes) -> np.void:
    """The record as a buffer holds it, the places without an object empty."""
    return np.frombuffer(record.ljust(RECORD_DTYPE.itemsize, b"\0"), RECORD_DTYPE)[0]


def rtl(film: Film, out_dir: Path) -> Answer:
    """The verilated landing_core with the firmware built for this machine.

    Args:
        film: What is shown.
        out_dir: Where the run leaves its files; a folder of its own.
    """
    result = run_cosim(
        (film.images[shown] for shown in _shown(film)),
        [round(1000 * film.unit.shots[shown].lidar_m) for shown in _shown(film)],
        firmware="host",
        out_dir=out_dir,
        progress=lambda _text: None,
    )
    autopilot = decode(result.uart0.data, result.uart0.done_ns)
    ground = decode(result.uart1.data, result.uart1.done_ns)
    return _answer(film, result.frames, autopilot, ground)

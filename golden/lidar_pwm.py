# SPDX-License-Identifier: Apache-2.0
"""What `lidar_pwm` reports for a waveform at its pin."""

from collections.abc import Sequence
from dataclasses import dataclass


@dataclass(frozen=True)
class Limits:
    """Times in microseconds; a millimetre is a microsecond. The defaults are those of the core."""

    min_mm: int = 50
    max_mm: int = 40000
    max_age_us: int = 60000
    start_timeout_us: int = 18000
    release_us: int = 1000


@dataclass(frozen=True)
class Event:
    """Something reported: kind is "reading", "timeout", "too_long" or "too_short"; distance is 0 but for a reading."""

    kind: str
    time_us: float
    distance_mm: float = 0


def events(high: Sequence[tuple[float, float]], end_us: float, limits: Limits) -> list[Event]:
    """Return what is reported from time 0, when measuring is enabled, to `end_us`.

    Args:
        high: intervals (start, end) in microseconds in which the pin is high, ascending; a start may lie before 0.
        end_us: end of the observation.
        limits: thresholds and times.

    The pin is read as given also while the core does not pull it low.
    """
    found: list[Event] = []
    time, armed = 0.0, False
    while time < end_us:
        fault = None
        if not armed:
            low_from = next((end for start, end in high if start <= time < end), time)
            if low_from - time > limits.max_mm:
                time += limits.max_mm
                fault = "too_long"
            else:
                time, armed = low_from, True
                continue
        else:
            start, end = next(((start, end) for start, end in high if start >= time), (float("inf"), float("inf")))
            if start - time > limits.start_timeout_us:
                time += limits.start_timeout_us
                fault = "timeout"
            elif end - start > limits.max_mm:
                time = start + limits.max_mm
                fault = "too_long"
            else:
                short = end - start < limits.min_mm
                found.append(Event("too_short", end) if short else Event("reading", end, end - start))
                time = end
                continue
        found.append(Event(fault, time))
        time, armed = time + limits.release_us, False
    return [event for event in found if event.time_us < end_us]

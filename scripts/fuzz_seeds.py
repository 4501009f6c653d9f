# SPDX-License-Identifier: Apache-2.0
"""Inputs of the fuzz targets written by hand: what a fuzzer would take long to find, and what it once found.

They are in the order in which `firmware/fuzz/loop.c` and `record.c` take their input apart.
"""

import struct

FLY, COMMAND, HEARTBEAT, STATE, PARAMETER, WAIT = 3, 4, 5, 11, 12, 1
GAIN_INDEX = 5
START, ABORT, PAUSE, GO_ON, TELL_LOG = range(5)
IN_AIR, ON_GROUND = 2, 1


def _share(value: float, least: float, most: float) -> int:
    """The byte that stands for a value between two."""
    return max(0, min(255, round((value - least) / (most - least) * 255)))


def _fly(px4: bool, pad: bool, steps: int, height_m: float, *, right_px: float = 0.0, step_ms: int = 50) -> bytes:
    """Steps with an autopilot that obeys, and a pad below or none."""
    place = [_share(height_m, 0.2, 2.5), _share(right_px, -200.0, 200.0), _share(0.0, -200.0, 200.0), 128]
    return bytes([FLY, px4 | pad << 1, steps - 1, step_ms // 2 - 1, *place])


def _command(which: int) -> bytes:
    return bytes([COMMAND, 126 + which])


def _state(landed: int, battery_percent: int) -> bytes:
    return bytes([STATE, landed, battery_percent])


def _started(px4: bool) -> bytes:
    return bytes([0]) + _fly(px4, True, 6, 1.8) + _state(IN_AIR, 90) + _command(START)


def _landing(px4: bool) -> bytes:
    """From the start to motors off."""
    down = b"".join(_fly(px4, True, 24, height_m) for height_m in (1.8, 1.8, 0.9, 0.9, 0.5))
    ground = _state(ON_GROUND, 90) + _fly(px4, False, 24, 0.25, step_ms=100) * 3
    return (
        _started(px4) + down + _fly(px4, True, 6, 0.35) + ground + bytes([HEARTBEAT, px4 | 12]) + bytes([WAIT, 10]) * 3
    )


def _search(px4: bool) -> bytes:
    """The pad lost, a climb, seen again, held, on, aborted."""
    lost = _fly(px4, True, 12, 1.8) + _fly(px4, False, 24, 1.2) + _fly(px4, False, 24, 1.2, step_ms=100) * 3
    held = _command(PAUSE) + _fly(px4, True, 4, 1.8) + _command(GO_ON) + _fly(px4, True, 4, 1.8)
    seen = _fly(px4, True, 10, 1.8) + held + _command(ABORT) + _fly(px4, True, 8, 1.8)
    return _started(px4) + _fly(px4, False, 24, 1.0, step_ms=100) + lost + seen


def _battery(px4: bool) -> bytes:
    """A low battery above the pad, and the log told."""
    low = _fly(px4, True, 24, 1.8) + _state(IN_AIR, 3) + _fly(px4, True, 12, 0.9)
    return _started(px4) + low + _command(TELL_LOG) + bytes([WAIT, 60]) * 12


def _aside(px4: bool) -> bytes:
    """The pad so far off, with the greatest gain, that the speed has to be limited."""
    gain = bytes([PARAMETER, GAIN_INDEX]) + struct.pack("<f", 1.5)
    return _started(px4) + gain + _fly(px4, True, 24, 1.8, right_px=190.0)


def _at_once(px4: bool) -> bytes:
    """Start and abort between two ticks: found by the fuzzer."""
    return _started(px4) + _command(ABORT) + bytes([WAIT, 10])


def _while_it_waits(px4: bool) -> bytes:
    """An abort when LANDING_TARGET is about to go out, and all else waits: once a demand that did not know of it."""
    frames = _fly(px4, True, 24, 1.2, step_ms=16)
    return bytes([0]) + frames + _command(START) + frames + _command(ABORT) + bytes([WAIT, 16])


def _torn(until: int) -> bytes:
    """A pad in the ring, read while the hardware writes up to stage `until` at the copy's end."""
    head = [0, 0, 0, 0, 0, 0, 0, 0, 1]  # options, attitude, flags, area, altitude, age, dropped, one piece
    pad = [0, 0, 128, 128, 90, 128, 128, 128]
    return bytes([*head, *pad, 0, 0, 130 + 5 * (until - 1), 0])


def seeds(target: str) -> list[bytes]:
    """The inputs for a target; none for those that need none."""
    if target == "loop":
        ways = (_landing, _search, _battery, _aside, _at_once, _while_it_waits)
        return [way(px4) for way in ways for px4 in (False, True)]
    if target == "record":
        return [_torn(until) for until in range(1, 5)]
    return []

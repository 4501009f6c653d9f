# SPDX-License-Identifier: Apache-2.0
"""The bench's arithmetic, with clocks made up here; and that what it compares runs."""

import numpy as np
import pytest

from firmware.library import GROUND, Firmware, make
from golden.chain import run_frames
from scripts.bench import Pair, bench, firmware_seconds, line, main, opencv, ratios, records, timed
from scripts.errors import UserError
from sim.world.clip import demo_clip


def test_ratios_are_pair_by_pair_and_take_turns(capsys: pytest.CaptureFixture[str]) -> None:
    order = []
    # The machine becomes ten times slower on the way: the ratio stays.
    busy = iter([1.0, 1.0, 10.0, 10.0, 100.0, 100.0] * 2)

    def side(name: str, seconds: float) -> float:
        order.append(name)
        return seconds * next(busy)

    pair = Pair("this", "that", lambda: side("one", 3.0), lambda: side("other", 2.0))
    assert ratios(pair, 3) == pytest.approx([1.5, 1.5, 1.5])
    assert order == ["one", "other", "other", "one", "one", "other"]
    bench([pair], 3)
    assert "1.50 x  that" in capsys.readouterr().out


def test_the_median_counts() -> None:
    text = line(Pair("this", "that", float, float), [9.0, 1.0, 2.0])
    assert text.split() == ["this", "2.00", "x", "that", "1.00", "to", "9.00"]


def test_time_is_that_of_the_work() -> None:
    clock = iter([5.0, 7.5])
    done = []
    assert timed(lambda: done.append(1), lambda: next(clock))() == 2.5
    assert done == [1]


def test_the_records_show_the_pad() -> None:
    make("host")
    frame = demo_clip()[3]
    image = frame.image()
    *_, stages = run_frames([image, image])
    given = records(stages, round(1000 * frame.truth.lidar_m))
    firmware = Firmware()
    for index, data in enumerate(given[:3]):
        assert firmware.on_record(data, 16_667 * (index + 2)) == 0
    assert sum(message.get_type() == "DEBUG_FLOAT_ARRAY" for message in firmware.take(GROUND)) == 3
    assert firmware_seconds(given[:3], searching=True) > 0
    assert firmware_seconds(given[:3], searching=False) > 0
    with pytest.raises(UserError, match="refuses a record"):
        firmware_seconds([given[0][:40]], searching=False)
    opencv(np.zeros((720, 1280, 3), np.uint8))


def test_no_rounds_are_refused() -> None:
    with pytest.raises(UserError, match="0 rounds are none; give 1 or more"):
        main(["--rounds", "0"])

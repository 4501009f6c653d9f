# SPDX-License-Identifier: Apache-2.0
"""The names of the PAD array against the firmware's."""

import re
from pathlib import Path

from scripts.demo_decode import PAD_FIELDS

APP_H = Path(__file__).resolve().parent.parent / "firmware" / "core" / "app.h"


def test_pad_fields_are_the_firmwares() -> None:
    enum = re.search(r"enum app_pad_field \{(.*?)\}", APP_H.read_text(), re.DOTALL)
    assert enum is not None, f"{APP_H} has no enum app_pad_field"
    names = re.findall(r"^\s*APP_PAD_(\w+)", enum[1], re.MULTILINE)
    assert names[-1] == "FIELDS", "the number of fields comes last"
    assert list(PAD_FIELDS) == [name.lower() for name in names[:-1]]

# SPDX-License-Identifier: Apache-2.0
"""Numbers that the page of a core promises. Tests assert these, so page and RTL cannot part; headers are compared."""

import re

from tb.common.cores import ROOT

PAGES = ROOT / "docs/cores"
WORDS = {"one": 1, "two": 2, "three": 3, "four": 4, "five": 5, "six": 6, "seven": 7, "eight": 8, "nine": 9}
NUMBER = re.compile(rf"(?<![\w.])(?:(\d+)(?![\w.]*\w)|({'|'.join(WORDS)})\b)", re.IGNORECASE)


def numbers(text: str) -> list[int]:
    """Whole numbers of a text in order, in digits or as a word up to nine; those within names are none."""
    return [int(digits or WORDS[word.lower()]) for digits, word in NUMBER.findall(text)]


def sections(text: str) -> dict[str, str]:
    """Second-level sections of a page: title to body."""
    parts = re.split(r"^## (.*)$", text, flags=re.MULTILINE)
    return dict(zip(parts[1::2], parts[2::2], strict=True))


def page_figures(core: str, section: str = "Latency") -> list[int]:
    """Numbers of a section of the page of a core, in order."""
    return numbers(sections((PAGES / f"{core}.md").read_text(encoding="utf-8"))[section])

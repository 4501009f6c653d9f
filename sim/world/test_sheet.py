# SPDX-License-Identifier: Apache-2.0
"""The sheet shows every corpus and stays small."""

import cv2

from sim.world.corpus import NAMES
from sim.world.sheet import MOST_BYTES, PICTURE, rows


def test_every_corpus_has_its_row_on_the_picture() -> None:
    shown = list(rows())
    assert {title for title, _ in shown} == {"grounds", *NAMES}
    assert all(1 <= len(scenes) <= 8 for _, scenes in shown)
    assert PICTURE.stat().st_size <= MOST_BYTES
    height = cv2.imread(str(PICTURE)).shape[0]
    # A row of another number of pixels, or a corpus more or less, is a picture that was not written again.
    assert height == 93 * len(shown)

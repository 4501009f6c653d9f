# SPDX-License-Identifier: Apache-2.0
"""What `display` shows of a frame: one of its views, with the drawing over it."""

from dataclasses import replace

import numpy as np
import numpy.typing as npt

from golden.overlay import Drawing, overlay

VIEWS = ("rgb", "gray", "binary", "labels")
"""By the number in CTRL.view."""


def display(
    view: int,
    rgb: npt.NDArray[np.int64],
    gray: npt.NDArray[np.int64],
    binary: npt.NDArray[np.int64],
    drawing: Drawing,
) -> npt.NDArray[np.int64]:
    """Return the picture at the monitor.

    Args:
        view: index into `VIEWS`.
        rgb: integer array (height, width) of 0xRRGGBB.
        gray: of 0 to 255.
        binary: of 0 and 1; 1 belongs to a shape.
        drawing: what is drawn; whether it tints goes by the view.
    """
    pictures = (rgb, gray * 0x010101, binary * 0xFFFFFF, binary * 0xFFFFFF)
    return overlay(pictures[view], replace(drawing, tint=VIEWS[view] == "labels"))

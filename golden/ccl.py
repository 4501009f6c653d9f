# SPDX-License-Identifier: Apache-2.0
"""Connected components of a binary picture with exact integer features: runs, and the least run that each hangs on.

Works on the whole picture at once and shares no idea with the RTL but the definition of a component.
"""

import numpy as np

from golden.generated.landing_regs import OBJECT_DTYPE


def ccl(binary: np.ndarray, min_area: int = 0, label_zeros: bool = False) -> np.ndarray:
    """Return the 8-connected components of the ones (or of the zeros).

    Args:
        binary: integer array (height, width) of 0 and 1.
        min_area: components with fewer pixels are left out.
        label_zeros: label the zeros instead of the ones.

    Returns:
        Array of `OBJECT_DTYPE`, reserved words 0: area in pixels, box in pixels (both corners included), sums of x, y,
        xx, yy, xy over all pixels with (0, 0) at the top left. The order is that of the RTL: by the place of each
        component's last pixel in raster order.
    """
    y, first, last = _runs(np.asarray(binary).astype(bool) != label_zeros)
    root = _roots(y, first, last, width=np.shape(binary)[1])
    roots, of_run = np.unique(root, return_inverse=True)
    objects = np.zeros(roots.size, OBJECT_DTYPE)
    area = last - first + 1
    sum_x = _triangle(last) - _triangle(first - 1)
    sum_xx = _pyramid(last) - _pyramid(first - 1)
    for name, value in {
        "area": area,
        "sum_x": sum_x,
        "sum_y": y * area,
        "sum_xx": sum_xx,
        "sum_yy": y * y * area,
        "sum_xy": y * sum_x,
    }.items():
        total = np.zeros(roots.size, np.int64)
        np.add.at(total, of_run, value)
        objects[name] = total
    for name, value in {"box_max_x": last, "box_max_y": y}.items():
        np.maximum.at(objects[name], of_run, value.astype(np.uint16))
    for name, value in {"box_min_x": first, "box_min_y": y}.items():
        objects[name] = 0xFFFF
        np.minimum.at(objects[name], of_run, value.astype(np.uint16))
    # Runs are in raster order, so the last run of a component holds its last pixel.
    last_run = np.zeros(roots.size, np.int64)
    np.maximum.at(last_run, of_run, np.arange(y.size))
    objects = objects[np.argsort(last_run)]
    return objects[objects["area"] >= min_area]


def _runs(mask: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return line, first and last column (int64 each) of every run of True, in raster order."""
    edges = np.diff(np.pad(mask.astype(np.int8), ((0, 0), (1, 1))), axis=1)
    y, first = np.nonzero(edges == 1)
    last = np.nonzero(edges == -1)[1] - 1
    return y.astype(np.int64), first.astype(np.int64), last.astype(np.int64)


def _roots(y: np.ndarray, first: np.ndarray, last: np.ndarray, width: int) -> np.ndarray:
    """Return for each run the least number of a run of the same component."""
    # Place on one axis on which the lines lie apart by more than one pixel.
    pitch = width + 3
    start, end = y * pitch + first, y * pitch + last
    lowest = np.searchsorted(end, start - pitch - 1, side="left")
    behind = np.searchsorted(start, end - pitch + 1, side="right")
    # Every pair of runs that touch: the later one, and each of its neighbours in the line above.
    counts = np.maximum(behind - lowest, 0)
    later = np.repeat(np.arange(y.size), counts)
    above = np.repeat(lowest - np.concatenate([[0], np.cumsum(counts)[:-1]]), counts) + np.arange(later.size)
    parent = np.arange(y.size)
    while True:
        one, other = parent[above], parent[later]
        apart = one != other
        if not apart.any():
            return parent
        one, other = one[apart], other[apart]
        # Roots hang below the least root that they touch; then every run hangs below its root again.
        np.minimum.at(parent, np.maximum(one, other), np.minimum(one, other))
        while not np.array_equal(parent, parent[parent]):
            parent = parent[parent]


def _triangle(n: np.ndarray) -> np.ndarray:
    """Sum of 0 to n; 0 for n = -1."""
    return n * (n + 1) // 2


def _pyramid(n: np.ndarray) -> np.ndarray:
    """Sum of the squares of 0 to n; 0 for n = -1."""
    return n * (n + 1) * (2 * n + 1) // 6

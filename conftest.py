# SPDX-License-Identifier: Apache-2.0
"""What takes long starts first and is spread over the workers, so that no worker ends with it alone."""

from itertools import pairwise

import pytest

LONGEST_FIRST = ("sim/test_full_frames.py", "tb/mutation/", "formal/", "tb/coverage/", "tb/exhaustive/")
"""Where the items marked `full` that take minutes are, by the time that one takes."""

SIMULATIONS = ("tb/test_cores.py", "tb/top/test_board_video.py")
"""The long ones of `make test`."""


def rank(item: pytest.Item) -> int:
    """Place of an item in the order."""
    if item.get_closest_marker("full") is None:
        return len(LONGEST_FIRST) + 1
    matches = [index for index, place in enumerate(LONGEST_FIRST) if item.nodeid.startswith(place)]
    return matches[0] if matches else len(LONGEST_FIRST)


def dealt(items: list[pytest.Item], workers: int) -> list[pytest.Item]:
    """Simulations first in each worker's piece, the slower simulator's before the others; the rest as it was."""
    long = [item for item in items if item.nodeid.startswith(SIMULATIONS)]
    long.sort(key=lambda item: "icarus" not in item.nodeid)
    rest = [item for item in items if not item.nodeid.startswith(SIMULATIONS)]
    cuts = [len(rest) * worker // workers for worker in range(workers + 1)]
    pieces = [rest[first:last] for first, last in pairwise(cuts)]
    return [item for worker, piece in enumerate(pieces) for item in (*long[worker::workers], *piece)]


# Last: what -m leaves out is gone by then.
@pytest.hookimpl(trylast=True)
def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    """Sort; `--dist worksteal` gives each worker a piece of the list, so each piece begins with long ones."""
    workers = getattr(config, "workerinput", {}).get("workercount", 1)
    items.sort(key=rank)
    if any(item.get_closest_marker("full") for item in items):
        items[:] = [item for first in range(workers) for item in items[first::workers]]
    else:
        items[:] = dealt(items, workers)

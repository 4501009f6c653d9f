# SPDX-License-Identifier: Apache-2.0
"""What takes long starts first and is spread over the workers, so that no worker ends with it alone."""

import pytest

LONGEST_FIRST = ("sim/test_full_frames.py", "tb/mutation/", "formal/", "tb/coverage/", "tb/exhaustive/")
"""Where the items marked `full` that take minutes are, by the time that one takes."""


def rank(item: pytest.Item) -> int:
    """Place of an item in the order."""
    if item.get_closest_marker("full") is None:
        return len(LONGEST_FIRST) + 1
    matches = [index for index, place in enumerate(LONGEST_FIRST) if item.nodeid.startswith(place)]
    return matches[0] if matches else len(LONGEST_FIRST)


# Last: what -m leaves out is gone by then.
@pytest.hookimpl(trylast=True)
def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    """Sort; `--dist worksteal` gives each worker a piece of the list, so each piece begins with long ones."""
    workers = getattr(config, "workerinput", {}).get("workercount", 1)
    items.sort(key=rank)
    if any(item.get_closest_marker("full") for item in items):
        items[:] = [item for first in range(workers) for item in items[first::workers]]

# SPDX-License-Identifier: Apache-2.0
"""Each flight is flown twice: by the firmware's core in this process, and by the ELF on QEMU.

`make test` flies one of the two: the ELF where a test is marked `elf`, which takes longer. `make test-full` flies both.
"""

from collections.abc import Iterator

import pytest

from firmware.library import make
from sim.flight.board import Board, HostBoard, ZynqBoard

pytest.register_assert_rewrite("sim.flight.steps")

BOARDS = {"host": HostBoard, "zynq": ZynqBoard}


@pytest.fixture(scope="session")
def _library() -> None:
    make("host")


@pytest.fixture(params=BOARDS)
def board(request: pytest.FixtureRequest) -> Iterator[Board]:
    """A board that has just been powered up."""
    if request.param == "host":
        request.getfixturevalue("_library")
    one = BOARDS[request.param]()
    yield one
    one.close()


# First: -m looks at the marks.
@pytest.hookimpl(tryfirst=True)
def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Leave the other half of the flights to `make test-full`."""
    for item in items:
        params = item.callspec.params if hasattr(item, "callspec") else {}
        if "board" in params and (params["board"] == "zynq") != (item.get_closest_marker("elf") is not None):
            item.add_marker(pytest.mark.full)

# SPDX-License-Identifier: Apache-2.0
"""Runs the cocotb tests of every core in every config and simulator. The environment variable SEED sets the seed.

`make test` runs the first config and those that `core.toml` names as `quick` besides it in the faster simulator, and
one in the slower; `make test-full` runs all.
"""

from collections.abc import Iterator
from xml.etree import ElementTree

import pytest

from scripts.errors import UserError
from scripts.signoff import combine, leave_part
from tb.common.cores import core_names, load_core
from tb.common.runner import SIMULATORS, default_seed, run_core

SLOWER = "icarus"
SMALL = {
    "ccl": 2,
    "dilate3x3": 1,
    "erode3x3": 1,
    "gaussian5x5": 1,
    "landing_core": 1,
    "lidar_pwm": 1,
    "median5x5": 1,
    "threshold_apply": 1,
    "threshold_stats": 1,
}
"""The config for the slower simulator in `make test`, where the first one would take it minutes."""


def runs() -> Iterator[object]:
    """Yield one pytest parameter a run; a core that cannot be read gives one item, which then fails."""
    for name in core_names():
        try:
            core = load_core(name)
            count, quick = len(core.configs), core.quick
        except UserError:
            count, quick = 1, (0,)
        for index in range(count):
            for sim in SIMULATORS:
                in_test = index == SMALL.get(name, 0) if sim == SLOWER else index in quick
                marks = [] if in_test else [pytest.mark.full]
                yield pytest.param(name, index, sim, id=f"{name}-{index}-{sim}", marks=marks)


@pytest.mark.parametrize(("name", "index", "sim"), list(runs()))
def test_core(name: str, index: int, sim: str) -> None:
    seed = default_seed()
    (result,) = run_core(name, sim, index, seed=seed)
    # What a build skips is no test of it.
    results = result.log.with_name("results.xml")
    skipped = len(ElementTree.parse(results).findall(".//skipped")) if results.is_file() else 0
    leave_part(name, "matrix", f"{index}-{sim}", result.passed, result.tests - skipped)
    builds = len(load_core(name).configs)
    expected = [f"{other}-{simulator}" for other in range(builds) for simulator in SIMULATORS]
    combine(name, "matrix", expected, f"{{count}} tests in {builds} builds x {len(SIMULATORS)} simulators")
    print(f"seed {seed}: {result.summary}")
    assert result.passed, f"{result.summary}\nlog: {result.log}\nreplay: {result.replay}"

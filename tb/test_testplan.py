# SPDX-License-Identifier: Apache-2.0
"""The test plan names what exists, all of it, and its check sees each kind of gap."""

from copy import deepcopy

import pytest

from scripts.signoff import CHECKS
from tb.common.cores import core_names
from tb.testplan import Plan, faults, load_plan


def test_the_plan_and_the_tests_agree() -> None:
    assert faults(load_plan(), core_names(), CHECKS) == []


def without_core(plan: Plan) -> None:
    del plan["ccl"]


def without_point(plan: Plan) -> None:
    del plan["ccl"]["points"]["reset"]


def empty_point(plan: Plan) -> None:
    plan["ccl"]["points"]["reset"] = []


def unknown_test(plan: Plan) -> None:
    plan["ccl"]["points"]["reset"].append("reset_at_the_weekend")


def unknown_file(plan: Plan) -> None:
    plan["ccl"]["points"]["reset"].append("tb/ccl/test_nothing.py::test_nothing")


def proof_of_nothing(plan: Plan) -> None:
    plan["landing_core"]["points"]["formal"] = ["formal/test_formal.py::test_proof"]


def unnamed_test(plan: Plan) -> None:
    for tests in plan["ccl"]["points"].values():
        tests[:] = [test for test in tests if test != "hard_images"]


def unknown_core(plan: Plan) -> None:
    plan["ccl2"] = plan["ccl"]


def empty_reason(plan: Plan) -> None:
    plan["video_in"]["exempt"]["exhaustive"] = " "


def unknown_exemption(plan: Plan) -> None:
    plan["video_in"]["exempt"]["weekends"] = "nobody works then"


def exempt_although_tested(plan: Plan) -> None:
    plan["video_in"]["exempt"]["latency"] = "it is fast enough"


@pytest.mark.parametrize(
    ("spoil", "sentence"),
    [
        (without_core, "ccl: nothing shows latency"),
        (without_point, "ccl: nothing shows reset"),
        (empty_point, "ccl: reset has no test"),
        (unknown_test, "ccl: there is no test reset_at_the_weekend"),
        (unknown_file, "ccl: there is no test tb/ccl/test_nothing.py::test_nothing"),
        (proof_of_nothing, "landing_core: formal/landing_core/tasks.toml does not exist"),
        (unnamed_test, "ccl: no testpoint names hard_images"),
        (unknown_core, "ccl2: no such core"),
        (empty_reason, "video_in: no reason for exhaustive"),
        (unknown_exemption, "video_in: weekends is no point"),
        (exempt_although_tested, "video_in: latency is exempt but has tests"),
    ],
)
def test_a_gap_is_seen(spoil: object, sentence: str) -> None:
    plan = deepcopy(load_plan())
    spoil(plan)
    assert sentence in faults(plan, core_names(), CHECKS)

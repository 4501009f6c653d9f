# SPDX-License-Identifier: Apache-2.0
"""Every proof passes and every planted fault breaks its proof; the quick ones within `make test`."""

from dataclasses import replace

import pytest

from formal.run import run_fault, run_task
from formal.solve import complaint, solve
from formal.tasks import Fault, Task, all_faults, all_tasks, load
from scripts.errors import UserError


def item(entry: Task | Fault) -> object:
    """One pytest parameter."""
    return pytest.param(entry, id=entry.id, marks=() if entry.quick else pytest.mark.full)


@pytest.mark.parametrize("task", [item(task) for task in all_tasks()])
def test_proof(task: Task) -> None:
    answer = run_task(task)
    assert answer.status == "PASS", complaint(answer.log)
    assert answer.assertions > 0


@pytest.mark.parametrize("fault", [item(fault) for fault in all_faults()])
def test_fault_is_found(fault: Fault) -> None:
    answer = run_fault(fault)
    assert answer.status == "FAIL", f"the proof does not see it\n{complaint(answer.log)}"


def test_a_fault_that_does_not_fit_is_refused() -> None:
    fault = replace(load("axis_skid")[1][0], find="no such text")
    with pytest.raises(UserError, match="stands 0 times"):
        solve(fault.task, fault)


def test_an_unknown_core_is_one_sentence() -> None:
    with pytest.raises(UserError, match="there is no proof of 'nothing'"):
        load("nothing")

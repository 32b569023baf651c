"""What a run suggests for the record of known deviations: never a wider bound, never without a reason."""

import re

import pytest
from poinsot.reference.errors import InputError
from poinsot.reports.deviations import Deviation, parsed
from poinsot.reports.proposals import proposed

ENTRY = Deviation("top", "alpha", "Euler", "==1", "truth", "omega", 1e-3, "measured")


def results(status, measured=1e-4, message="far", dt=1e-3, stale=()):
    verdict = {
        "check": "truth", "observable": "omega", "status": status, "measured": measured, "allowed": 1e-6,
        "unit": "rad/s", "at": None, "message": message,
    }  # fmt: skip
    cells = [
        {"scene": "top", "engine": "alpha", "engine_version": "1", "scheme": "Euler", "dt": step,
         "verdicts": [verdict | {"measured": measured * step / dt if measured else None}]}
        for step in (dt, dt / 2)
    ]  # fmt: skip
    return {"cells": cells, "stale_deviations": list(stale)}


def test_a_failure_becomes_an_entry_that_is_refused_until_it_has_a_reason():
    text = proposed(results("fail"), [])
    with pytest.raises(InputError, match="got no reason"):
        parsed(text)
    (entry,) = parsed(text.replace('reason = ""', 'reason = "its term is dropped"'))
    assert entry == Deviation(
        "top", "alpha", "Euler", "==1", "truth", "omega", 2e-4, "its term is dropped", 1e-3
    )


def test_a_bound_that_was_exceeded_is_told_and_stays():
    text = proposed(results("fail", 2e-3, "far; beyond the recorded bound of 0.001"), [ENTRY])
    assert "[[deviation]]" not in text
    assert re.search(
        r"^# Beyond its bound, which stays: alpha Euler in top at dt 0.001 s", text, re.MULTILINE
    )


def test_what_is_gone_or_matches_nothing_is_named():
    text = proposed(results("fixed", stale=["known deviation of beta: no check"]), [ENTRY])
    assert "# Gone, remove its record: alpha Euler in top at dt 0.001 s, truth of omega" in text
    assert "# known deviation of beta: no check" in text


@pytest.mark.parametrize(("measured", "told"), [(2.4e-4, True), (2.6e-4, False)])
def test_a_bound_far_above_what_was_measured_may_come_down(measured, told):
    text = proposed(results("known", measured), [ENTRY])
    assert ("may come down to 4.8e-04" in text) == told
    assert told or not text


def test_a_large_deviation_of_something_else_hides_no_loose_bound():
    found = results("known", 2.4e-4)
    other = {**found["cells"][0]["verdicts"][0], "observable": "position", "measured": 9e-4}
    found["cells"][0]["verdicts"].append(other)
    assert "may come down to 4.8e-04" in proposed(found, [ENTRY])


def test_a_failure_without_a_number_and_a_pass_propose_nothing():
    assert proposed(results("fail", None), []) == proposed(results("pass"), []) == ""

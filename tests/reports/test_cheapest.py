"""What an accuracy costs: who is cheapest, who is next, what nothing reaches."""

import pytest
from poinsot.reports.cheapest import cheapest, pareto_front


def row(engine, seconds, error, scheme="Euler", dt=1e-3, observable="omega"):
    return {
        "scene": "top", "engine": engine, "engine_version": "1", "scheme": scheme, "dt": dt,
        "observable": observable, "unit": "rad/s", "error": error, "seconds_min": seconds,
    }  # fmt: skip


FAST, FINE, SLOW = row("alpha", 1.0, 5e-3), row("alpha", 4.0, 5e-5), row("beta", 3.0, 2e-3)
BEATEN, BROKEN, UNTIMED = row("beta", 5.0, 6e-5), row("beta", 0.1, None), row("beta", None, 1e-12)
ALL = (BEATEN, SLOW, FINE, UNTIMED, FAST, BROKEN)


def test_the_front_holds_what_nothing_beats_the_cheapest_first():
    assert pareto_front(ALL) == [FAST, SLOW, FINE]
    assert pareto_front([FAST, row("beta", 1.0, 1e-3)])[0]["engine"] == "beta"


def test_the_cheapest_for_each_target_and_how_much_longer_another_engine_takes():
    found = {line["target"]: line for line in cheapest(ALL, (1e-2, 1e-4, 1e-6))}
    assert (found[1e-2]["engine"], found[1e-2]["next_engine"], found[1e-2]["ratio"]) == ("alpha", "beta", 3.0)
    assert (found[1e-4]["seconds"], found[1e-4]["ratio"]) == (4.0, pytest.approx(1.25))
    assert found[1e-6]["engine"] is None


def test_where_no_coarser_step_of_its_scheme_was_tried_it_is_said():
    coarser = row("alpha", 0.5, None, dt=2e-3)
    assert [line["coarsest"] for line in cheapest([FAST, FINE], (1e-2, 1e-9))] == [True, None]
    assert not cheapest([FAST, coarser], (1e-2,))[0]["coarsest"], "it was tried, and broke down"
    assert cheapest([FAST, {**coarser, "scheme": "another"}], (1e-2,))[0]["coarsest"]


def test_an_error_just_at_the_target_reaches_it_and_no_other_engine_is_said_to():
    (found,) = cheapest([FAST, FINE], (5e-3,))
    assert (found["engine"], found["seconds"], found["next_engine"], found["ratio"]) == (
        "alpha",
        1.0,
        None,
        None,
    )


def test_observables_are_told_apart_and_one_that_was_never_timed_is_left_out():
    found = cheapest([FAST, row("beta", 2.0, 1e-9, observable="position"), {**UNTIMED, "observable": "x"}])
    assert {line["observable"] for line in found} == {"omega", "position"}

"""What a quick, a usual and a full run take in."""

from collections import Counter

import pytest
from poinsot.reference.errors import InputError
from poinsot.reports.verdict import Status
from poinsot.scenarios.registry import scenes, select

from poinsot.plan import Extent, not_to_time, plan, to_time

LADDER, ALONE = "free_symmetric_top[oblate]", "free_symmetric_top[prolate]"


def cells(extent, names=(LADDER, ALONE)):
    laid = plan(select(list(names)), ["pinocchio"], ["semi-implicit Euler"], [], extent)
    return Counter(record.scene for record in laid.records), laid


@pytest.mark.parametrize(
    ("extent", "first", "second"),
    [(Extent.QUICK, 1, 1), (Extent.USUAL, 5, 1), (Extent.WHOLE, 5, 5), (Extent.FULL, 5, 5)],
)
def test_how_many_steps_the_variants_of_a_scene_are_run_at(extent, first, second):
    counted, laid = cells(extent)
    assert counted == {LADDER: first, ALONE: second}
    assert any(f"a {extent.name.lower()} run" in note for note in laid.notes) == (
        extent in (Extent.QUICK, Extent.USUAL)
    )


@pytest.mark.parametrize(
    ("extent", "what"), [(Extent.FULL, "Run times, and errors over them,"), (Extent.USUAL, "")]
)
def test_of_a_second_variant_it_is_said_that_it_was_not_timed(extent, what):
    _, laid = cells(extent)
    assert {record.scene for record in to_time(laid, laid.records)} == {LADDER}
    (said,) = not_to_time(laid)
    assert said.startswith(what or "Run times are")
    assert "first variant of each scene: the others (1 of 2), most of which" in said
    _, alone = cells(extent, [ALONE])
    assert not not_to_time(alone)


@pytest.mark.parametrize("extent", Extent)
def test_one_cell_of_each_scheme_is_asked_everything_and_run_twice_for_its_determinism(extent):
    _, laid = cells(extent)
    asked = [request for request in laid.requests.values() if request.asked]
    assert Counter(request.scene for request in asked) == {LADDER: 1, ALONE: 1}
    assert {request.dt for request in asked} == {1e-3}
    twice = [request.scene for request in laid.requests.values() if request.repeats == 2]
    assert twice == {Extent.QUICK: [], Extent.USUAL: [LADDER]}.get(extent, [LADDER, ALONE])


def test_every_step_that_is_named_is_run_twice_where_it_is_the_nearest():
    laid = plan(select([LADDER, ALONE]), ["pinocchio"], ["semi-implicit Euler"], [2e-3, 1e-3], Extent.USUAL)
    assert [request.repeats for request in laid.requests.values()] == [1, 2, 1, 2]


def test_a_step_that_no_scheme_can_take_is_left_out_with_its_reason_and_the_others_run():
    names = ["euler_angles[general]", "euler_angles[through zero]"]
    laid = plan(select(names), ["pinocchio"], ["RKMK4"], [5e-3, 1e-3], Extent.WHOLE)
    assert [(scene, round(dt, 6)) for scene, _, _, dt in laid.requests] == [
        (names[0], 5.333e-3),
        (names[0], 1e-3),
        (names[1], 1e-3),
    ]
    (record,) = (record for record in laid.records if record.key not in laid.requests)
    assert (record.status, round(record.dt, 6), record.scheme) == (Status.UNSUPPORTED, 5.333e-3, "RKMK4")
    assert "a step of 0.00533333 s comes to 0.602667 s" in record.message


def test_what_becomes_of_steps_that_do_not_fit_is_said_of_each():
    names = ["stiff_spring", LADDER]
    laid = plan(select(names), ["pinocchio"], ["semi-implicit Euler"], [0.01, 3e-4, 3.01e-4], Extent.WHOLE)
    assert laid.adjusted == [
        "dt 0.01 s is left out in 1 variant of 2: a step of 0.01 s is longer than the whole run, 0.0032 s",
        "dt 0.0003 s is rounded to whole steps between samples: 8e-05 to 0.000300752 s",
        "dt 0.000301 s is rounded to whole steps between samples: 8e-05 to 0.000300752 s",
    ]
    assert sum("rounded to" in note for note in laid.notes) == 4
    left_out = [(r.scene, r.dt) for r in laid.records if r.status is Status.UNSUPPORTED]
    assert left_out == [("stiff_spring", 0.01)]


@pytest.mark.parametrize(("names", "dt"), [(["stiff_spring"], 0.01), ([LADDER, ALONE], 1e-12)])
def test_where_no_step_fits_there_is_nothing_to_run(names, dt):
    with pytest.raises(InputError, match=r"dt: nothing is left to run; dt .* is left out"):
        plan(select(names), ["pinocchio"], [], [dt], Extent.WHOLE)


def test_two_engines_of_one_name_cannot_be_told_apart(tmp_path):
    pytest.importorskip("pinocchio")
    path = tmp_path / "other.py"
    path.write_text("from poinsot.adapters.pinocchio_ import Pinocchio\nclass Same(Pinocchio): pass\n")
    with pytest.raises(InputError, match=r"got 'pinocchio' and '.*other.py:Same', both named 'pinocchio'"):
        plan(select([LADDER]), ["pinocchio", f"{path}:Same"], [], [1e-3], Extent.WHOLE)
    laid = plan(select([LADDER]), [f"{path}:Same"], [], [1e-3], Extent.WHOLE)
    (said,) = (note for note in laid.notes if "other.py" in note)
    assert "has the name of Poinsot's own 'pinocchio'" in said
    assert said in laid.adjusted


@pytest.mark.parametrize("dt", [0.0, -1e-3, float("nan")])
def test_a_step_is_a_number_above_0(dt):
    with pytest.raises(InputError, match="dt: got"):
        plan(select([LADDER]), ["pinocchio"], [], [1e-3, dt], Extent.WHOLE)


def test_a_quick_run_of_everything_takes_the_first_variant_of_each_scene():
    laid = plan(list(scenes().values()), ["pinocchio"], ["semi-implicit Euler"], [], Extent.QUICK)
    names = [record.scene for record in laid.records]
    assert len({name.partition("[")[0] for name in names}) == len(names)
    assert LADDER in names
    assert not laid.whole
    assert any("the first variant alone" in note for note in laid.notes)

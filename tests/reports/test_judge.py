"""The comparator as a whole: what it takes, what it refuses, and that it says the same thing twice."""

import random
import re
from dataclasses import replace

import numpy as np
import pytest
from poinsot.adapters import log
from poinsot.reference.errors import InputError
from poinsot.reports.deviations import Deviation
from poinsot.reports.judge import judge
from poinsot.reports.verdict import CHECKS, Status
from poinsot.scenarios.registry import scenes

FREE, TOP, CHAIN = (
    scenes()[name] for name in ("free_symmetric_top[oblate]", "heavy_top[cusps]", "co2_chain[symmetric]")
)
SE = "semi-implicit Euler"


@pytest.fixture(scope="module")
def runs(ahead):
    """Ladders of two engines on three scenes, with the twin name of a known scheme."""
    return [
        ahead(scene, dt, c=0.02, engine=engine, twin=SE, digests=("same", "same") if dt == scene.dt else ())
        for scene in (FREE, TOP, CHAIN)
        for engine in ("alpha", "beta")
        for dt in scene.ladders[1]
    ]


def key(verdict):
    return (verdict.scene, verdict.engine, verdict.scheme, verdict.dt, verdict.check, verdict.observable)


def test_every_kind_of_check_is_made_of_every_cell(runs):
    verdicts = judge(runs, known=())
    made = {}
    for verdict in verdicts:
        made.setdefault((verdict.scene, verdict.engine, verdict.dt), set()).add(verdict.check)
    assert len(made) == len(runs)
    for (scene, _, dt), checks in made.items():
        ladder = scenes()[scene].ladders[1]
        expected = {"truth", "invariant", "setup", "twin"}
        expected |= {"order"} if dt == min(ladder) else set()
        expected |= {"determinism"} if dt == scenes()[scene].dt else set()
        assert checks == expected
    assert {v.check for v in verdicts} <= set(CHECKS)


def test_no_check_is_made_twice(runs):
    keys = [key(verdict) for verdict in judge(runs, known=())]
    assert len(set(keys)) == len(keys)


def test_judging_twice_says_the_same(runs):
    assert judge(runs, known=()) == judge(runs, known=())


def test_the_order_of_the_runs_changes_nothing(runs):
    shuffled = random.Random(1).sample(runs, len(runs))
    assert sorted(judge(shuffled, known=()), key=key) == sorted(judge(runs, known=()), key=key)


def test_a_log_is_judged_as_the_run_was(runs, tmp_path):
    logged = []
    for number, run in enumerate(runs[:10]):
        log.write(tmp_path / f"{number}.mcap", FREE, run, {})
        logged.append(log.read(tmp_path / f"{number}.mcap").trajectory)
    assert judge(logged, known=()) == judge(runs[:10], known=())


def test_one_scene_does_not_touch_another(runs):
    alone = judge([run for run in runs if run.provenance.scene == FREE.full_name], known=())
    assert [v for v in judge(runs, known=()) if v.scene == FREE.full_name] == [
        next(v for v in alone if key(v) == key(w)) for w in judge(runs, known=()) if w.scene == FREE.full_name
    ]


def test_nothing_to_judge_is_no_verdict():
    assert judge([]) == []


@pytest.mark.parametrize("value", [np.nan, np.inf, -np.inf])
@pytest.mark.parametrize("name", ["position", "quaternion", "velocity", "omega"])
def test_what_is_not_finite_is_an_error_and_the_others_are_judged(runs, name, value):
    array = getattr(runs[0], name).copy()
    array[100:] = value
    found = judge([replace(runs[0], **{name: array}), *runs[1:5], *runs[5:10]], known=())
    (broken,) = [v for v in found if v.status is Status.ERROR]
    assert (broken.engine, broken.dt, broken.at) == ("alpha", runs[0].provenance.dt, runs[0].t[100])
    assert broken.message == f"not finite from t = {runs[0].t[100]:g} s on"
    assert [v for v in found if (v.engine, v.dt) == ("alpha", broken.dt)] == [broken]
    # Four steps are no ladder; the twin of what is gone has none left to be held against.
    assert {v.engine for v in found if v.check == "order"} == {"beta"}
    assert ("beta", broken.dt) not in {(v.engine, v.dt) for v in found if v.check == "twin"}


def test_a_run_of_unknown_origin_is_refused(runs):
    with pytest.raises(InputError, match="got one without provenance, expected one from simulate"):
        judge([replace(runs[0], provenance=None)])
    stranger = replace(runs[0], provenance=replace(runs[0].provenance, scene="juggling"))
    with pytest.raises(InputError, match="got scene 'juggling', which this Poinsot does not have"):
        judge([stranger])


def test_two_runs_of_one_step_are_refused(runs):
    words = f"trajectories: got two of {FREE.full_name} in alpha 1.0 own at dt {runs[0].provenance.dt:g} s"
    with pytest.raises(InputError, match=re.escape(words)):
        judge([*runs[:3], runs[0]])


def test_a_check_that_could_not_be_made_keeps_nobody_from_being_a_twin(ahead):
    scene = scenes()["two_body[spring]"]  # of a scheme unheard of no theory is known there
    runs = [
        ahead(scene, scene.dt, c=0.0, engine=engine, twin="unheard of", stable_step=sought)
        for engine, sought in (("alpha", ()), ("beta", (0.1, 0.2)))
    ]
    found = judge(runs, known=())
    assert Status.UNSUPPORTED in {v.status for v in found}
    assert {v.measured for v in found if v.check == "twin"} == {0.0}


ARRAYS = ("t", "position", "quaternion", "velocity", "omega", "joint_position", "joint_velocity")


@pytest.mark.parametrize(
    ("part", "says"),
    [
        (slice(None, -1), "got 250 samples up to 9.96 s, expected 251, evenly up to 10 s"),
        (slice(1, None), "got 250 samples up to 10 s, expected 251"),
        (slice(None, None, 2), "got 126 samples up to 10 s, expected 251"),
        (slice(0, 0), "got 0 samples, expected 251"),
    ],
)
def test_a_run_that_is_not_the_whole_scene_is_refused(runs, part, says):
    # Judged on what is there, an engine that stops in time would pass.
    cut = replace(runs[0], **{name: getattr(runs[0], name)[part] for name in ARRAYS})
    with pytest.raises(InputError, match=re.escape(f"trajectory of {FREE.full_name}: {says}")):
        judge([cut])


@pytest.mark.parametrize("shift", [1e-6, -1e-6])
def test_samples_at_other_times_are_refused(runs, shift):
    t = runs[0].t.copy()
    t[77] += shift
    with pytest.raises(InputError, match="got 251 samples up to 10 s, expected 251, evenly"):
        judge([replace(runs[0], t=t)])


def test_a_run_of_other_bodies_is_refused(runs):
    three = replace(runs[-1], provenance=replace(runs[-1].provenance, scene=FREE.full_name))
    with pytest.raises(
        InputError, match="got 3 bodies, 3 hinges and slides and 0 reactions, expected 1 bodies, 0 h"
    ):
        judge([three])


def test_scenes_of_ones_own_are_judged_by_their_own_truth(ahead):
    own = replace(FREE, name="mine", v0=(0.0, 0.0, 0.0, 0.2, 0.1, 3.0))
    run = ahead(own, 1e-3, c=0.0, twin=SE)
    assert {v.status for v in judge([run], {own.full_name: own}, known=())} == {Status.PASS}
    with pytest.raises(InputError, match=re.escape("mine[oblate]")):
        judge([run])


def test_deviations_are_those_given(ahead):
    run = ahead(FREE, 1e-3, c=0.02)
    run = replace(run, provenance=replace(run.provenance, setup=dict(run.provenance.setup) | {"dt": 2e-3}))
    entry = Deviation(FREE.full_name, "alpha", "own", "", "setup", "dt", 2.0, "it was measured to be so")
    for known, status in (((), Status.FAIL), ((entry,), Status.KNOWN)):
        assert {v.status for v in judge([run], known=known) if v.check == "setup"} == {status}


def test_an_iterator_is_read_once(runs):
    assert judge(iter(runs), known=iter(())) == judge(runs, known=())

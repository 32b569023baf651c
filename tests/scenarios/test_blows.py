"""Blows: which steps they act over, however steps are called for, and what is refused of them."""

from dataclasses import replace

import numpy as np
import pytest
from poinsot.reference.errors import InputError
from poinsot.scenarios import blows, equivalents
from poinsot.scenarios.blows import Blow
from poinsot.scenarios.forces import Constant
from poinsot.scenarios.registry import scenes

BLOW, ALWAYS = Blow("peg", (1.0, 2.0, 3.0), 0.3, 0.34), Constant("hung", (0.0, 1.0, 0.0))
STRUCK = scenes()["compound_pendulum[struck]"]


@pytest.mark.parametrize("dt", [0.02, 0.01, 1e-3, 1.25e-4])
@pytest.mark.parametrize("called", [1, 7, 10**9])
def test_it_acts_over_the_steps_between_its_moments_and_over_no_other(dt, called):
    acted, step, steps = [], 0, round(0.5 / dt)
    while step < steps:
        for count, forces in blows.stretches((ALWAYS, BLOW), dt, step, min(called, steps - step)):
            assert forces[0] is ALWAYS
            acted += [len(forces) == 2] * count
        step = len(acted)
    assert np.flatnonzero(acted).tolist() == list(range(round(0.3 / dt), round(0.34 / dt)))
    assert len(acted) == steps


def test_steps_without_blows_are_taken_in_one_call():
    forces = (ALWAYS,)
    assert list(blows.stretches(forces, 1e-3, 17, 1000)) == [(1000, forces)]
    assert list(blows.stretches(forces, 1e-3, 17, 0)) == [(0, forces)]
    assert [count for count, _ in blows.stretches((BLOW,), 1e-3, 0, 1000)] == [300, 40, 660]


def test_as_if_it_lasted_it_is_a_constant_force():
    assert blows.lasting((ALWAYS, BLOW)) == (ALWAYS, Constant("peg", (1.0, 2.0, 3.0)))


@pytest.mark.parametrize(
    ("change", "says"),
    [
        ({"end": 0.3}, "got an end at 0.3 s, expected one after its start"),
        ({"start": -0.1}, "start of the blow on 'peg'"),
        ({"end": 0.35}, "got its end at 0.35 s, expected a multiple of 0.02 s, the time between samples"),
        ({"end": 1.02}, "up to 1 s"),
        ({"body": "nail"}, "force: got body 'nail'"),
    ],
)
def test_what_cannot_be_is_refused(change, says):
    with pytest.raises(InputError, match=says):
        replace(STRUCK, forces=(replace(BLOW, **change),))


def test_in_other_units_it_lasts_as_many_steps():
    (blow,) = equivalents.scaled(STRUCK, 2.0, 3.0, 4.0).scene.forces
    (own,) = STRUCK.forces
    assert (blow.start, blow.end) == (4 * own.start, 4 * own.end)
    assert np.array(blow.force) == pytest.approx(np.array(own.force) * 2.0 * 3.0 / 16)


def test_a_scene_with_one_says_so():
    assert {"blow", "force"} <= STRUCK.features
    assert "blow" not in scenes()["car_pendulum"].features

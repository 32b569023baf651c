"""A blow that is not as asked: named, and not taken for a wrong sample or for a jump."""

from dataclasses import replace

import numpy as np
import pytest
from poinsot.adapters.simulate import simulate
from poinsot.reports.cell import Cell
from poinsot.reports.evidence import Evidence
from poinsot.reports.judge import judge
from poinsot.reports.localisation import localised
from poinsot.reports.struck import struck_otherwise
from poinsot.scenarios.registry import scenes

SCENE = scenes()["compound_pendulum[struck]"]


def runs(scheme, shift=None, **changes):
    """A ladder of MuJoCo's whose blow is another; ``shift`` changes what is told."""
    mujoco_ = pytest.importorskip("poinsot.adapters.mujoco_")

    class Other(mujoco_.MuJoCo):
        def build(self, scene, scheme, dt):
            (blow,) = scene.forces
            super().build(replace(scene, forces=(replace(blow, **changes),)), scheme, dt)

    (chosen,) = (s for s in Other.schemes if s.name == scheme)
    found = [simulate(SCENE, Other, chosen, dt)[0] for dt in SCENE.ladder(chosen.order, chosen.twin)]
    return [shift(run) for run in found] if shift else found


def cause(found):
    (one,) = localised([Cell.of(run, dict(scenes())) for run in found], judge(found, known=()))
    return one.causes[0]


@pytest.mark.parametrize("scheme", ["Euler", "RK4"])
def test_one_of_another_force_is_named_with_how_many_times_it_is(scheme):
    (blow,) = SCENE.forces
    stronger = tuple((1.01 * np.array(blow.force)).tolist())
    assert cause(runs(scheme, force=stronger)) == "the blow on 'peg' has 1.01 times its force"


@pytest.mark.parametrize("scheme", ["Euler", "RK4"])
def test_one_that_comes_late_is_named_with_where_it_lacks(scheme):
    expected = "from t = 0.2 s to 0.22 s it gives "
    found = cause(runs(scheme, start=0.22, end=0.26))
    assert expected in found
    assert found.startswith("the blow on 'peg' acts at another time")
    assert found.endswith("where all of it is asked")


def test_one_that_goes_on_is_named_with_where_it_is_too_much():
    found = cause(runs("Euler", end=0.26))
    assert "from t = 0.24 s to 0.26 s it gives 1 of its force, where nothing of it is asked" in found


def test_a_sample_that_is_wrong_where_it_strikes_is_still_that():
    def spoilt(run):
        angle = run.joint_position.copy()
        angle[11] += 1e-4
        return replace(run, joint_position=angle)

    found = runs("Euler", spoilt)
    evidence = Evidence.of([Cell.of(run, dict(scenes())) for run in found])
    assert struck_otherwise(evidence) == ""
    assert "blow" not in cause(found)


def test_of_a_right_run_nothing_is_said():
    evidence = Evidence.of([Cell.of(run, dict(scenes())) for run in runs("Euler")])
    assert struck_otherwise(evidence) == ""
    assert evidence.right

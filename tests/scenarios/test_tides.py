"""Tides: what is fitted to the truth is the tide, and engines in which nothing parts, or too little."""

from dataclasses import replace

import numpy as np
import pytest
from poinsot.reference.tides import tide_at_named_points
from poinsot.scenarios import tides
from poinsot.scenarios.registry import scenes

POINTS = ("near", "far", "side")


def fitted(scene):
    motion = scene.truth(scene, scene.sample_times())
    none = replace(motion, velocity=np.zeros_like(motion.velocity))
    named = [next(o for o in scene.observables if o.name == f"tide at the {point} point") for point in POINTS]
    return [o.difference(scene, motion, none)[0, 0] for o in named]


def exact():
    return tide_at_named_points(tides.GM, tides.DISTANCE, tides.RADIUS)


@pytest.mark.parametrize("number", range(3))
def test_what_is_fitted_to_the_truth_is_the_tide_at_the_start(number):
    found = fitted(scenes()["tides"])[number]
    # The polynomial is cut off at its degree.
    assert found == pytest.approx(exact()[number], rel=1e-4)
    named = {o.name: o for o in scenes()["tides"].observables}
    assert named[f"tide at the {POINTS[number]} point"].exact(scenes()["tides"]) == exact()[number]


def test_the_tide_stretches_twice_as_much_as_it_squeezes():
    near, far, side = fitted(scenes()["tides"])
    assert near > 2 * side > far > side


def test_an_engine_that_takes_the_pull_at_one_place_for_all_is_seen(failed, monkeypatch):
    mujoco_ = pytest.importorskip("poinsot.adapters.mujoco_")

    class Uniform(mujoco_.Forces):
        def __init__(self, *arguments):
            super().__init__(*arguments)
            total = self._total
            masses = np.array(list(tides.MASSES.values()))[:, None]

            def everywhere_as_at_the_centre(position, velocity):
                return total(position, velocity)[0] / masses[0] * masses

            self._total = everywhere_as_at_the_centre

    monkeypatch.setattr(mujoco_, "Forces", Uniform)
    seen = failed(mujoco_.MuJoCo, scenes()["tides"])
    assert {("truth", f"tide at the {point} point") for point in POINTS} <= seen

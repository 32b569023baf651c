"""The rocket: Newton's law for what is left, and engines that keep the mass or are late with it."""

from dataclasses import replace

import numpy as np
import pytest
from poinsot.adapters import registry
from poinsot.adapters.simulate import simulate, unsupported
from poinsot.reference.errors import InputError
from poinsot.scenarios import rocket
from poinsot.scenarios.burning import Burning
from poinsot.scenarios.forces import Coriolis
from poinsot.scenarios.registry import scenes

ENGINES = [engine for engine in registry.engines().values() if not isinstance(engine, str)]


def test_what_is_left_is_pushed_by_what_is_thrown_out():
    scene, h = scenes()["rocket"], 1e-5
    t = np.linspace(0.1, 1.9, 7)
    before, after = (scene.truth(scene, t + shift).velocity[:, 0, 2] for shift in (-h, h))
    left = rocket.MASS - rocket.RATE * t
    pushed = left * ((after - before) / (2 * h) + rocket.G)
    # The quotient is off by h²/6 of a third derivative, about 1e4 of these units.
    assert pushed == pytest.approx(rocket.RATE * rocket.EXHAUST, rel=1e-6)


def test_what_is_gained_is_by_the_logarithm():
    scene = scenes()["rocket"]
    motion = scene.truth(scene, scene.sample_times())
    assert rocket._gained(scene, motion) == pytest.approx(rocket._exactly_gained(scene), rel=1e-13)
    assert rocket._exactly_gained(scene) == pytest.approx(60 * np.log(5))


@pytest.mark.parametrize("engine", ENGINES, ids=lambda engine: engine.name)
def test_each_build_begins_with_the_whole_mass(engine):
    scene = scenes()["rocket"]
    for scheme in engine.schemes:
        if not unsupported(scene, engine, scheme):
            motion, _ = simulate(scene, engine, scheme, 2e-2, repeats=2)
            assert len(set(motion.provenance.digests)) == 1
            assert motion.provenance.setup["body/rocket/mass"] == rocket.MASS


def test_an_engine_that_keeps_its_mass_is_seen(failed):
    mujoco_ = pytest.importorskip("poinsot.adapters.mujoco_")

    class Heavy(mujoco_.MuJoCo):
        def build(self, scene, scheme, dt):
            super().build(replace(scene, burning=()), scheme, dt)

    assert {("truth", "velocity gained"), ("truth", "velocity, limit")} <= failed(Heavy, scenes()["rocket"])


def test_an_engine_that_is_a_step_late_with_its_mass_is_seen(failed, monkeypatch):
    mujoco_ = pytest.importorskip("poinsot.adapters.mujoco_")

    class Late(mujoco_.Masses):
        def at(self, step):
            super().at(max(0, step - 1))

    monkeypatch.setattr(mujoco_, "Masses", Late)
    seen = failed(mujoco_.MuJoCo, scenes()["rocket"])
    # Still of first order, and right in the limit: the prediction of the scheme's own motion tells.
    assert ("truth", "velocity, scheme's own") in seen
    assert ("truth", "velocity, limit") not in seen


def test_a_force_that_would_go_on_with_the_mass_of_the_start_is_refused():
    with pytest.raises(InputError, match="forces: got Coriolis beside a burning body"):
        replace(scenes()["rocket"], forces=(Coriolis((0.0, 0.0, 1.0)),))


def test_a_body_that_is_not_there_or_burns_up_is_refused():
    scene = scenes()["rocket"]
    with pytest.raises(InputError, match="burning: got body 'stage', expected a free one of rocket"):
        replace(scene, burning=(Burning("stage", 1.0),))
    with pytest.raises(InputError, match="burning: body 'rocket' is used up by 2 s"):
        replace(scene, burning=(Burning("rocket", 5.0),))

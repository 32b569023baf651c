"""Engines as they come: what they do by themselves is on record, and one that is tuned is found out."""

from dataclasses import replace

import numpy as np
import pytest
from poinsot.adapters.registry import scheme_of
from poinsot.adapters.simulate import simulate
from poinsot.reports.judge import judge
from poinsot.reports.verdict import Status
from poinsot.scenarios import compound_pendulum
from poinsot.scenarios.registry import scenes

DEFAULTS = [name for name, scene in scenes().items() if scene.defaults]


def verdicts(engine, name, scheme=None):
    scene = scenes()[name]
    motion, _ = simulate(scene, engine, scheme_of(engine, scheme), scene.dt, repeats=2)
    return judge([motion])


def tuned(engine):
    """The engine with the settings of every other scene, whatever it is asked for."""

    class Tuned(engine):
        def build(self, scene, scheme, dt):
            super().build(replace(scene, defaults=False), scheme, dt)

    return Tuned


def test_every_variant_of_that_name_and_no_other_asks_for_defaults():
    assert {scenes()[name].variant for name in DEFAULTS} == {"defaults", "defaults fast"}
    assert not [name for name, s in scenes().items() if s.variant.startswith("defaults") and not s.defaults]
    assert '"defaults"' in scenes()[DEFAULTS[0]].as_json()
    assert '"defaults"' not in scenes()["free_symmetric_top[oblate]"].as_json()


@pytest.mark.parametrize(
    ("name", "engine"),
    [
        ("free_symmetric_top[defaults]", "pybullet"),
        ("free_symmetric_top[defaults fast]", "pybullet"),
        ("collisions[defaults]", "pybullet"),
        ("collisions[defaults]", "mujoco"),
        ("rolling[defaults]", "mujoco"),
        ("compound_pendulum[defaults]", "pybullet"),
    ],
)
def test_what_an_engine_does_by_itself_is_known_and_tuned_it_does_so_no_longer(name, engine):
    module = pytest.importorskip(f"poinsot.adapters.{engine}_")
    engine = {"pybullet": "PyBullet", "mujoco": "MuJoCo"}[engine]
    found = verdicts(getattr(module, engine), name)
    assert {verdict.status for verdict in found} == {Status.PASS, Status.KNOWN}
    known = {verdict.check for verdict in found if verdict.status is Status.KNOWN}
    # MuJoCo's pyramid of friction is no setting that its model tells of: it shows in the motion.
    assert ({"truth"} if (name, engine) == ("rolling[defaults]", "MuJoCo") else {"truth", "setup"}) <= known
    now = verdicts(tuned(getattr(module, engine)), name)
    assert Status.FIXED in {verdict.status for verdict in now}
    assert Status.KNOWN not in {verdict.status for verdict in now}


def test_what_pybullet_takes_from_a_free_body_is_as_its_record_says():
    # s' = -c s (1 + s), so that s/(1 + s) dies away at the rate c; a rate alone would leave exp(-c t) of s.
    module = pytest.importorskip("poinsot.adapters.pybullet_")
    scene = scenes()["free_symmetric_top[defaults]"]
    motion, _ = simulate(scene, module.PyBullet, scheme_of(module.PyBullet, None), scene.dt)
    speed = np.linalg.norm(motion.velocity[:, 0], axis=1)
    left = speed[0] / (1 + speed[0]) * np.exp(-0.04 * motion.t)
    assert speed == pytest.approx(left / (1 - left), rel=5e-5)


def test_pybullet_clips_a_spin_of_150_at_100_in_one_step_and_tuned_it_does_not():
    module = pytest.importorskip("poinsot.adapters.pybullet_")
    scene = scenes()["free_symmetric_top[defaults fast]"]
    scheme = scheme_of(module.PyBullet, None)
    for engine, spin in ((module.PyBullet, 100.0), (tuned(module.PyBullet), 150.0)):
        machine = engine()
        machine.build(replace(scene, q0=(0, 0, 0, 0, 0, 0, 1), v0=(0, 0, 0, 0, 0, 150)), scheme, scene.dt)
        machine.step(1)
        assert machine.state().omega[0] == pytest.approx([0, 0, spin], abs=1e-9)
        machine.close()


@pytest.mark.parametrize("dt", [1e-3, 1e-9])
def test_pybullets_motor_takes_an_impulse_of_1_from_a_hinge_in_a_step_however_short(dt):
    module = pytest.importorskip("poinsot.adapters.pybullet_")
    scene = replace(scenes()["compound_pendulum[defaults]"], gravity=(0, 0, 0), q0=(0, 0), v0=(20, 5))
    for engine, left in (
        (module.PyBullet, (20 - 1 / compound_pendulum.MOMENT, 0)),
        (tuned(module.PyBullet), (20, 5)),
    ):
        machine = engine()
        machine.build(scene, scheme_of(module.PyBullet, None), dt)
        machine.step(1)
        # PyBullet's damping takes its own share of 20 rad/s.
        assert machine.state().joint_velocity == pytest.approx(left, abs=20 * dt)
        machine.close()


def test_settings_that_are_not_made_are_not_told():
    module = pytest.importorskip("poinsot.adapters.pybullet_")
    scene = scenes()["free_symmetric_top[defaults fast]"]
    motion, _ = simulate(scene, module.PyBullet, scheme_of(module.PyBullet, None), scene.dt)
    assert not motion.provenance.settings.keys() & module.PyBullet.settings.keys()

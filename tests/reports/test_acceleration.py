"""Accelerations of true and of wrong engines, put into the equations of motion: no step is taken."""

from dataclasses import replace

import numpy as np
import pytest
from poinsot.adapters import registry
from poinsot.adapters.simulate import simulate
from poinsot.reports import acceleration
from poinsot.reports.cell import Cell
from poinsot.reports.verdict import Status
from poinsot.scenarios.body import Body, diagonal
from poinsot.scenarios.equations import STATES, states
from poinsot.scenarios.registry import scenes

FREE, HEAVY, CHAIN = (
    scenes()[name] for name in ("free_asymmetric_top[general]", "heavy_top[fast]", "co2_chain[mixture]")
)
GIMBAL = scenes()["euler_angles[general]"]
ENGINES = pytest.mark.parametrize("name", ["mujoco", "pinocchio", "pybullet"])


def short(scene):
    return replace(scene, duration=scene.duration / scene.samples, samples=1)


def judged(engine, scene, shown=None):
    """The verdict on an engine that was given ``scene`` and is judged by ``shown``."""
    scene, shown = short(scene), short(shown or scene)
    engine = registry.load(engine) if isinstance(engine, str) else engine
    motion, _ = simulate(scene, engine, engine.schemes[0], scene.dt, repeats=2)
    motion = replace(motion, provenance=replace(motion.provenance, scene=shown.full_name))
    (verdict,) = acceleration.check(Cell.of(motion, {shown.full_name: shown}))
    return verdict


@ENGINES
@pytest.mark.parametrize("scene", [FREE, HEAVY, CHAIN, GIMBAL], ids=lambda scene: scene.full_name)
def test_the_engines_are_right_to_rounding(name, scene):
    pytest.importorskip(f"poinsot.adapters.{name}_")
    verdict = judged(name, scene)
    assert verdict.status is Status.PASS
    # Ten times less than is allowed, and not nothing: a truth that was copied would leave no rounding.
    assert verdict.measured < acceleration.TOLERANCE / 10


def with_moment(scene, factor):
    body = scene.bodies[0]
    I1, I2, I3 = np.diag(body.inertia_array)
    heavier = Body(body.name, body.mass, diagonal(I1, I2 * factor, I3), body.joints, body.center_of_mass)
    return replace(scene, bodies=(heavier, *scene.bodies[1:]))


@ENGINES
@pytest.mark.parametrize("scene", [FREE, HEAVY, GIMBAL], ids=lambda scene: scene.full_name)
def test_one_part_in_a_million_in_one_moment_shows(name, scene):
    pytest.importorskip(f"poinsot.adapters.{name}_")
    verdict = judged(name, with_moment(scene, 1 + 1e-6), scene)
    assert verdict.status is Status.FAIL
    assert 1e-10 < verdict.measured < 1e-5


def wrong(change):
    """MuJoCo with its accelerations changed."""
    mujoco_ = pytest.importorskip("poinsot.adapters.mujoco_")

    class Wrong(mujoco_.MuJoCo):
        def acceleration(self, q, v):
            return change(self._scene, v, super().acceleration(q, v))

    return Wrong


def without_gyroscopic_term(scene, v, a):
    inertia = scene.bodies[0].inertia_array
    return a + np.concatenate([np.zeros(3), np.linalg.solve(inertia, np.cross(v[3:], inertia @ v[3:]))])


def not_finite(scene, v, a):
    return a * np.nan


@pytest.mark.parametrize("change", [without_gyroscopic_term, not_finite])
def test_an_engine_that_drops_a_term_or_gives_no_number(change):
    assert judged(wrong(change), FREE).status is Status.FAIL


def test_an_engine_whose_gravity_is_a_millionth_too_large():
    mujoco_ = pytest.importorskip("poinsot.adapters.mujoco_")
    heavier = replace(HEAVY, gravity=(0.0, 0.0, HEAVY.gravity[2] * (1 + 1e-6)))
    verdict = judged(mujoco_.MuJoCo, heavier, HEAVY)
    assert verdict.status is Status.FAIL
    assert "random state" in verdict.message or "the start" in verdict.message


def test_the_states_are_the_scenes_own_and_random_ones_that_stay_the_same():
    q, v = states(GIMBAL)
    assert (len(q), len(v)) == (STATES + 1, STATES + 1)
    assert (tuple(q[0]), tuple(v[0])) == (GIMBAL.q0, GIMBAL.v0)
    assert len(np.unique(q[1:], axis=0)) == STATES
    again, _ = states(GIMBAL)
    assert np.array_equal(q, again)
    turns = states(FREE)[0][:, 3:]
    assert np.linalg.norm(turns, axis=1) == pytest.approx(1, abs=1e-15)
    # No axis is favoured: a frame that is wrong shows in some of them.
    assert np.abs(turns[1:].mean(axis=0)).max() < 0.2


def test_a_cell_that_is_run_once_and_one_that_can_touch_log_none():
    mujoco_ = pytest.importorskip("poinsot.adapters.mujoco_")
    scheme = mujoco_.MuJoCo.schemes[0]
    once, _ = simulate(short(FREE), mujoco_.MuJoCo, scheme, FREE.dt)
    touching = scenes()["collisions[e=1]"]
    twice, _ = simulate(touching, mujoco_.MuJoCo, scheme, touching.dt, repeats=2)
    assert once.provenance.accelerations == twice.provenance.accelerations == ()
    assert acceleration.check(Cell.of(once, {FREE.full_name: short(FREE)})) == []

"""The largest stable step against theory: right schemes meet it, schemes other than they say do not."""

import math
from dataclasses import replace

import numpy as np
import pytest

pytest.importorskip("mujoco")
pytest.importorskip("pinocchio")
pytest.importorskip("pybullet")

from poinsot.adapters.engine import Scheme
from poinsot.adapters.mujoco_ import MuJoCo
from poinsot.adapters.pinocchio_ import Pinocchio
from poinsot.adapters.pinocchio_schemes import semi_implicit_euler
from poinsot.adapters.pybullet_ import PyBullet
from poinsot.adapters.simulate import simulate
from poinsot.adapters.stable_step import rises, stable_step
from poinsot.reference import scheme_stability
from poinsot.reports import stability
from poinsot.reports.cell import Cell
from poinsot.reports.stability import TOLERANCE, deviation
from poinsot.reports.verdict import Status
from poinsot.scenarios import extreme_tops, stiff_spring
from poinsot.scenarios.registry import scenes
from wrong_engines.stability import DampedSteps

SCENE = stiff_spring.SCENES[0]


def judged(engine, scheme=None, scene=SCENE):
    """The verdict on the engine's largest stable step."""
    chosen = next((s for s in engine.schemes if s.name == scheme), engine.schemes[0])
    trajectory, _ = simulate(scene, engine, chosen, scene.dt, repeats=2)
    (verdict,) = stability.check(Cell.of(trajectory, {scene.full_name: scene}))
    return verdict


@pytest.mark.parametrize(
    ("engine", "scheme"),
    [
        *((MuJoCo, name) for name in ("Euler", "RK4", "discrete")),
        *((Pinocchio, name) for name in ("semi-implicit Euler", "RKMK4")),
        (PyBullet, "reduced coordinates"),
    ],
)
def test_right_schemes_meet_theory(engine, scheme):
    verdict = judged(engine, scheme)
    assert verdict.status is Status.PASS, verdict.message
    assert verdict.measured <= TOLERANCE
    assert verdict.check == "stability"


def test_maximal_coordinates_meet_it_between_two_bodies():
    verdict = judged(PyBullet, "maximal coordinates", scenes()["two_body[spring]"])
    assert verdict.status is Status.PASS, verdict.message


@pytest.mark.parametrize("stiffness", [1e2, 1e6, 1e10])
def test_the_limit_follows_the_stiffness(stiffness):
    scene = stiff_spring.on_spring(stiffness)
    trajectory, _ = simulate(scene, Pinocchio, Pinocchio.schemes[0], scene.dt, repeats=2)
    # ωdt at the limit is 2 whatever the spring, to what the halving leaves open.
    assert stability.between(*trajectory.provenance.stable_step) * np.sqrt(stiffness) == pytest.approx(
        2.0, rel=5e-3
    )


def test_hidden_damping_moves_the_limit():
    # λ² − (1.9 − z²)λ + 0.9 = 0 has its root −1 at z = √3.8 instead of 2.
    verdict = judged(DampedSteps)
    assert verdict.status is Status.FAIL
    assert verdict.measured == pytest.approx(1 - np.sqrt(3.8) / 2, rel=0.1)


class HeldByDamping(Pinocchio):
    """Takes a gyroscopic torque explicitly, and a part in 1000 of what spins across the axis at each step."""

    def build(self, scene, scheme, dt):
        super().build(scene, scheme, dt)

        def damped(system, q, v, dt, n):
            for _ in range(n):
                q, v = semi_implicit_euler(system, q, v * [1, 1, 1, 0.999, 0.999, 1], dt, 1)
            return q, v

        self._advance = damped


@pytest.mark.parametrize(("engine", "status"), [(Pinocchio, Status.PASS), (HeldByDamping, Status.FAIL)])
def test_what_grows_at_any_step_grows_at_small_ones(engine, status):
    scene = extreme_tops.spin(10.0)
    theory = scene.stable_step(scene, "semi-implicit Euler")
    assert theory == 0
    machine = engine()
    try:
        held, grew = stable_step(machine, scene, engine.schemes[0])
    finally:
        machine.close()
    found, _, message = stability.told(held, grew, theory)
    assert found is status, message
    if engine is HeldByDamping:
        # (1 + z²) 0.999² = 1: six times below the step that is tried first.
        assert stability.between(held, grew) * 10 == pytest.approx(np.sqrt(0.999**-2 - 1), rel=TOLERANCE)
        assert "by theory it grows at any step; beyond what the scheme can do" in message
    else:
        assert (held, grew) == (0.0, scene.dt / 64)


def test_slow_growth_is_told_from_what_falls_again_or_jumps():
    t = np.linspace(0.0, 1.0, 201)
    assert rises((1 + 0.002 * t).tolist())
    assert rises(np.exp(t).tolist())
    for energies in (np.ones(201), 1 + 1e-4 * t, 1 - t / 2, 1 + 0.1 * np.sin(9 * t), 1 + (t > 0.5)):
        assert not rises(energies.tolist())


def test_a_scheme_without_theory_is_measured_and_not_judged():
    class Unknown(Pinocchio):
        schemes = (Scheme("semi-implicit Euler", 1, "one's own", {}),)

    verdict = judged(Unknown)
    assert verdict.status is Status.UNSUPPORTED
    assert "measured: energy stays bounded up to a step of 0.00" in verdict.message


def test_nothing_is_said_where_nothing_was_sought():
    trajectory, _ = simulate(SCENE, Pinocchio, Pinocchio.schemes[0], SCENE.dt, repeats=1)
    assert trajectory.provenance.stable_step == ()
    assert stability.check(Cell.of(trajectory, {SCENE.full_name: SCENE})) == []


@pytest.mark.parametrize(
    ("held", "grew", "limit", "expected"),
    [
        (1.99, 2.01, 2.0, 1.25e-5),
        (1.0, math.inf, math.inf, 0.0),
        (0.0, 0.1, 0.0, 0.0),
        (1.0, math.inf, 2.0, math.inf),
        (1.0, 1.1, math.inf, math.inf),
        (0.0, 0.1, 2.0, math.inf),
        (0.1, 0.2, 0.0, math.inf),
    ],
)
def test_deviation(held, grew, limit, expected):
    assert deviation(held, grew, limit) == pytest.approx(expected, rel=1e-2)


def test_what_the_scenes_expect_is_theory():
    for name in ("stiff_spring", "two_body[spring]"):
        scene = scenes()[name]
        (rate,) = [observable for observable in scene.observables if observable.name == "frequency"]
        omega = rate.scale(scene, None)
        expected = scheme_stability.largest_stable_step("rk4", omega)
        assert scene.stable_step(scene, "RKMK4") == expected
        assert scene.stable_step(scene, "no such scheme") is None
    softer = replace(SCENE, bodies=stiff_spring.on_spring(1e6).bodies)
    assert softer.stable_step(softer, "semi-implicit Euler") == 2e-3

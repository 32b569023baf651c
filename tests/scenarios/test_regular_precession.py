"""Regular precession: both its rates, how far the rule of thumb is off, an engine that goes by that rule."""

import re

import numpy as np
import pytest
from poinsot.reference import heavy_top, heavy_top_rates, quaternions
from poinsot.scenarios import pivoted_top, regular_precession
from poinsot.scenarios.registry import scenes

SCENES = pytest.mark.parametrize("name", ["regular_precession[slow]", "regular_precession[fast]"])


@SCENES
def test_the_truth_precesses_at_a_root_of_the_equation_of_steady_motion(own_rate, name):
    scene = scenes()[name]
    rate = own_rate(scene, "precession")
    mass, length, (I1, I3), g, _, omega = pivoted_top.arguments(scene)
    terms = I1 * np.cos(0.6) * rate**2, -I3 * omega[2] * rate, mass * g * length
    assert sum(terms) == pytest.approx(0, abs=1e-11 * max(np.abs(terms)))
    assert (rate > 15) == (scene.variant == "fast")
    assert regular_precession._precession(scene) == pytest.approx(rate, rel=1e-12)


@SCENES
def test_the_tilt_stays(name):
    scene = scenes()[name]
    tilt = pivoted_top.tilt(scene, scene.truth(scene, scene.sample_times()))
    assert tilt == pytest.approx(np.full(len(tilt), 0.6), abs=1e-14)


def test_the_rule_of_thumb_is_as_far_off_as_is_said():
    (said,) = re.findall(r"(\d+) % too slow", regular_precession.__doc__)
    *arguments, _, omega = pivoted_top.arguments(scenes()["regular_precession[slow]"])
    error = heavy_top_rates.weak_torque_error(*arguments[:4], 0.6, omega[2])
    assert -100 * error == pytest.approx(int(said), abs=0.5)


@SCENES
def test_an_engine_that_goes_by_the_rule_of_thumb(failed, name):
    mujoco_ = pytest.importorskip("poinsot.adapters.mujoco_")

    class RuleOfThumb(mujoco_.MuJoCo):
        """Turns a spinning body's axis about the vertical at Mgl/(I3ω3), and the body about it."""

        def step(self, n):
            body, dt = self._scene.bodies[0], self._model.opt.timestep
            q, spin = self._data.qpos[[1, 2, 3, 0]], self._data.qvel[2]
            weight = body.mass * 9.81 * body.center_of_mass[2]
            precession = weight / (body.inertia[2][2] * spin) * np.array([0.0, 0.0, 1.0])
            along = quaternions.rotated(quaternions.conjugate(q), precession)[2]
            rest = np.array([0.0, 0.0, spin - along])
            q = quaternions.product(q, quaternions.from_rotation_vector(rest * n * dt))
            q = quaternions.product(quaternions.from_rotation_vector(precession * n * dt), q)
            self._data.qpos[[1, 2, 3, 0]] = q
            self._data.qvel[:] = quaternions.rotated(quaternions.conjugate(q), precession) + rest
            self._steps += n
            self._data.time += n * dt

    found = failed(RuleOfThumb, scenes()[name])
    assert {("truth", "precession"), ("order", "orientation"), ("truth", "omega")} <= found
    # What it does looks steady enough.
    assert not {("invariant", "tilt"), ("invariant", "p_gamma")} & found


def test_its_rates_are_those_of_regular_precession():
    own = regular_precession
    top = own.MASS, own.LENGTH, (own.I1, own.I3), own.G, own.ANGLES[1], own.OMEGA3
    assert tuple(own.RATES.values()) == pytest.approx(heavy_top.regular_precession(*top), rel=1e-15)

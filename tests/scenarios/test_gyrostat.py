"""The gyrostat: its truth by the equations of motion, and rotors that the carrier does not feel."""

from dataclasses import replace

import numpy as np
import pytest
from poinsot.reference import equations_of_motion, quaternions
from poinsot.scenarios import gyrostat
from poinsot.scenarios.registry import scenes

SCENE = scenes()["gyrostat"]


def test_both_rates_are_the_truths_own(own_rate):
    assert own_rate(SCENE, "wobble") == pytest.approx(gyrostat._wobble(SCENE), rel=1e-12)
    assert own_rate(SCENE, "spin of the rotor") == pytest.approx(gyrostat.SPIN, rel=1e-12)


def test_the_rotor_turns_the_wobble_the_other_way():
    frozen = (gyrostat.I3 - gyrostat.I1) * SCENE.v0[5] / gyrostat.I1
    assert frozen < -0.1
    assert gyrostat._wobble(SCENE) > 0.5


def test_the_truths_accelerations_are_those_of_the_equations_of_motion(links_of):
    h, t = 1e-3, 0.7
    motion = SCENE.truth(SCENE, np.array([t - h, t, t + h]))
    q = np.concatenate([motion.position[1, 0], motion.quaternion[1, 0], motion.joint_position[1]])
    v = np.hstack([motion.velocity[:, 0], motion.omega[:, 0], motion.joint_velocity])
    expected = equations_of_motion.accelerations(links_of(SCENE), q, v[1], np.zeros(3))
    # Central differences: off by h² of the third derivative, some units a second cubed here.
    assert (v[2] - v[0]) / (2 * h) == pytest.approx(expected, abs=2e-6)
    assert np.linalg.norm(expected[:3]) > 0.1
    assert np.linalg.norm(expected[3:6]) > 0.5


def test_the_truths_places_turns_and_rates_are_of_one_motion():
    h, t = 1e-4, 0.7
    motion = SCENE.truth(SCENE, np.array([t - h, t, t + h]))
    assert gyrostat._parted(SCENE, motion) == pytest.approx(0.0, abs=1e-14)
    turn = quaternions.product(quaternions.conjugate(motion.quaternion[0]), motion.quaternion[2])
    for difference, rate in (
        (quaternions.rotation_vector(turn), motion.omega[1]),
        (motion.position[2] - motion.position[0], motion.velocity[1]),
    ):
        assert difference / (2 * h) == pytest.approx(rate, abs=1e-6)


def test_a_hinge_that_hides_the_rotors_momentum_is_seen(failed):
    mujoco_ = pytest.importorskip("poinsot.adapters.mujoco_")

    class Hidden(mujoco_.MuJoCo):
        """Turns the carrier as if the rotor stood still in it, and the rotor beside."""

        def build(self, scene, scheme, dt):
            super().build(replace(scene, v0=(*scene.v0[:-1], 0.0)), scheme, dt)
            self._dt, self._turned = dt, 0.0

        def step(self, n):
            super().step(n)
            self._turned += n * self._dt * gyrostat.SPIN

        def state(self):
            state = super().state()
            axis = np.array([0.0, 0.0, 1.0])
            more = quaternions.from_rotation_vector(self._turned * axis)
            q, omega = state.quaternion.copy(), state.omega.copy()
            q[1] = quaternions.product(q[1], more)
            omega[1] = quaternions.rotated(quaternions.conjugate(more), omega[1]) + gyrostat.SPIN * axis
            return state._replace(
                quaternion=q,
                omega=omega,
                joint_position=state.joint_position + self._turned,
                joint_velocity=state.joint_velocity + gyrostat.SPIN,
            )

    found = failed(Hidden, SCENE)
    assert {("truth", "wobble"), ("invariant", "angular momentum")} <= found
    # The hinge itself is as it must be: nothing but the wobble tells.
    assert ("invariant", "joint residual") not in found


def test_a_rotor_that_rubs_a_little_is_seen(failed):
    mujoco_ = pytest.importorskip("poinsot.adapters.mujoco_")

    class Rubbing(mujoco_.MuJoCo):
        def build(self, scene, scheme, dt):
            super().build(scene, scheme, dt)
            self._model.dof_damping[-1] = 1e-6

    found = failed(Rubbing, SCENE)
    assert {("invariant", "rotor about its axis"), ("truth", "spin of the rotor")} <= found

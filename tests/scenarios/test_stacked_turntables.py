"""Three tables on each other: the carried one's rate, the sum of ω as vectors, engines that miss either."""

import numpy as np
import pytest
from poinsot.scenarios import stacked_turntables as stack
from poinsot.scenarios.registry import scenes

SCENE = scenes()["stacked_turntables"]
T = np.linspace(0.0, 1.28, 1281)


def test_the_last_rate_is_the_derivative_of_the_last_angle_and_follows_from_how_it_is_carried():
    angle, rate = stack._hinges(SCENE, T)
    h = T[1]
    derivative = (-angle[4:] + 8 * angle[3:-1] - 8 * angle[1:-3] + angle[:-4]) / (12 * h)
    assert derivative[:, 2] == pytest.approx(rate[2:-2, 2], abs=1e-8)
    assert (angle[0].tolist(), rate[0].tolist()) == (list(stack.ANGLES), list(stack.RATES))
    # Far from constant: an engine that holds it would be seen at once.
    assert np.ptp(rate[:, 2]) > 3


def test_free_of_torque_about_its_axis_the_last_table_keeps_its_turn_about_it():
    # Of a ball, ω̇·a3 = 0 in an inertial frame, whatever carries it.
    motion = SCENE.truth(SCENE, T)
    world = np.array([np.gradient(w, T[1], edge_order=2) for w in stack.quaternions.rotated(
        motion.quaternion, motion.omega)[:, 2].T]).T  # fmt: skip
    axis = stack.quaternions.rotated(motion.quaternion[:, 2], np.array(stack.AXES[2]))
    assert np.abs(np.sum(world * axis, axis=1)[5:-5]).max() < 1e-4 * np.abs(world).max()


def test_the_rates_add_as_vectors_and_not_as_numbers():
    motion = SCENE.truth(SCENE, T)
    assert np.abs(stack._missing(SCENE, motion)).max() < 1e-13
    speeds = np.linalg.norm(motion.omega, axis=2)
    assert np.abs(speeds[:, 2] - np.abs(motion.joint_velocity.sum(axis=1))).max() > 1


def test_an_engine_whose_carried_hinge_keeps_its_rate(failed):
    mujoco_ = pytest.importorskip("poinsot.adapters.mujoco_")

    class Steady(mujoco_.MuJoCo):
        """A hinge turns at the rate it was given, however its axis is carried round."""

        def step(self, n):
            for _ in range(n):
                super().step(1)
                self._data.qvel[2] = self._scene.v0[2]

    found = failed(Steady, SCENE)
    assert {("truth", "orientation"), ("truth", "hinge angle"), ("order", "omega")} <= found
    # Its ω are right for its rates, and where the tables stand does not depend on the last one.
    assert not {("truth", "position"), ("invariant", "ω31 − ω32 − ω21")} & found


def test_an_engine_that_adds_rates_as_numbers(failed):
    mujoco_ = pytest.importorskip("poinsot.adapters.mujoco_")

    class Scalar(mujoco_.MuJoCo):
        """Tells of each body its hinge's own rate along its own axis, and forgets what carries it."""

        def state(self):
            own = super().state()
            omega = own.joint_velocity[:, None] * np.array(stack.AXES)
            return own._replace(omega=omega)

    assert {("truth", "omega"), ("invariant", "ω31 − ω32 − ω21")} <= failed(Scalar, SCENE)

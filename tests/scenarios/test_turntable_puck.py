"""The turntable puck: its truth by the equations of motion, and tables whose slides feel too little."""

from dataclasses import replace

import numpy as np
import pytest
from poinsot.reference import equations_of_motion
from poinsot.scenarios import turntable_puck
from poinsot.scenarios.registry import scenes

SCENE = scenes()["turntable_puck"]


def test_both_rates_are_the_truths_own(own_rate):
    # Seen from the table the room turns the other way.
    assert own_rate(SCENE, "turning of the puck's path") == pytest.approx(-turntable_puck.RATE, rel=1e-12)
    assert own_rate(SCENE, "turning of the table") == pytest.approx(turntable_puck.RATE, rel=1e-12)


def test_the_truths_accelerations_are_those_of_the_equations_of_motion(links_of):
    h, t = 1e-3, 0.7
    motion = SCENE.truth(SCENE, np.array([t - h, t, t + h]))
    q, v = motion.joint_position, motion.joint_velocity
    # Central differences: off by h² of the third derivative, some 10 m/s³ here.
    assert (q[2] - q[0]) / (2 * h) == pytest.approx(v[1], abs=1e-5)
    expected = equations_of_motion.accelerations(links_of(SCENE), q[1], v[1], np.zeros(3))
    assert (v[2] - v[0]) / (2 * h) == pytest.approx(expected, abs=1e-5)
    assert np.abs(expected[1:]).min() > 0.1


def test_the_path_is_straight_in_the_room_and_the_joints_make_it():
    motion = SCENE.truth(SCENE, SCENE.sample_times())
    # What is left is rounding of places of about 2 m.
    assert np.diff(motion.position[:, 1], n=2, axis=0) == pytest.approx(0.0, abs=2e-15)
    assert turntable_puck._parted(SCENE, motion) == pytest.approx(0.0, abs=1e-14)
    assert motion.velocity[:, 1] == pytest.approx(np.gradient(motion.position[:, 1], motion.t, axis=0))


@pytest.mark.parametrize("felt", [0.5, 0.999])
def test_slides_that_feel_only_part_of_the_turning_are_seen(felt, failed):
    mujoco_ = pytest.importorskip("poinsot.adapters.mujoco_")
    mujoco = pytest.importorskip("mujoco")

    class Numb(mujoco_.MuJoCo):
        """Gives back a part of what Coriolis' and the centrifugal force do in the slides."""

        def step(self, n):
            for _ in range(n):
                mujoco.mj_forward(self._model, self._data)
                self._data.qfrc_applied[1:] = (1 - felt) * self._data.qfrc_bias[1:]
                super().step(1)

    found = failed(Numb, SCENE)
    assert {("truth", "turning of the puck's path"), ("truth", "position, limit")} <= found


# Without any of that moment the puck is soon nowhere: so long it stays on the table.
@pytest.mark.parametrize(("missing", "duration"), [(1.0, 0.8), (1e-3, SCENE.duration)])
def test_a_hinge_that_does_not_feel_the_puck_move_is_seen(missing, duration, failed):
    mujoco_ = pytest.importorskip("poinsot.adapters.mujoco_")
    mujoco = pytest.importorskip("mujoco")

    class Unmoved(mujoco_.MuJoCo):
        """Leaves Coriolis' moment, or a part of it, out of the hinge."""

        def step(self, n):
            for _ in range(n):
                mujoco.mj_forward(self._model, self._data)
                self._data.qfrc_applied[0] = missing * self._data.qfrc_bias[0]
                super().step(1)

    found = failed(Unmoved, SCENE, duration=duration)
    assert {("truth", "turning of the table"), ("truth", "orientation, limit")} <= found
    assert not failed(mujoco_.MuJoCo, SCENE, duration=duration)


def test_the_puck_flies_on_whatever_the_masses():
    heavy = replace(SCENE, bodies=(SCENE.bodies[0], replace(SCENE.bodies[1], mass=70.0)))
    mujoco_ = pytest.importorskip("poinsot.adapters.mujoco_")
    engine = mujoco_.MuJoCo()
    scheme = next(scheme for scheme in engine.schemes if scheme.name == "RK4")
    engine.build(heavy, scheme, 5e-3)
    engine.step(400)
    end = heavy.truth(heavy, np.array([0.0, 2.0]))
    # RK4 at 5 ms: 0.6 dt⁴.
    assert engine.state().position[1] == pytest.approx(end.position[1, 1], abs=1e-9)

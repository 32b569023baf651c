"""The car pendulum: its rate, what the truth leaves out, and a hinge that does not feel its pivot move."""

from dataclasses import replace

import numpy as np
import pytest
from poinsot.reference import car_pendulum as reference
from poinsot.scenarios import car_pendulum
from poinsot.scenarios.registry import scenes


def test_the_rate_is_the_truths_own_over_whole_swings():
    scene = scenes()["car_pendulum"]
    motion = scene.truth(scene, np.array([0.0, 5 * 2 * np.pi / car_pendulum._rate(scene)]))
    # Five swings of phase, each rounded at most a few times.
    assert motion.joint_position[1, 1] == pytest.approx(motion.joint_position[0, 1], abs=1e-12)
    assert motion.joint_velocity[1, 1] == pytest.approx(motion.joint_velocity[0, 1], abs=1e-11)


def test_small_swings_are_at_the_frequency_of_the_books():
    scene = scenes()["car_pendulum"]
    tilt = reference.equilibrium(car_pendulum.G, car_pendulum.ACCELERATION)
    small = replace(scene, q0=(0.0, tilt + 1e-4), v0=(0.0, 0.0))
    exact = reference.frequency(car_pendulum.G, car_pendulum.ACCELERATION, car_pendulum.LENGTH)
    # The next term is a sixteenth of the amplitude's square.
    assert car_pendulum._rate(small) == pytest.approx(exact, rel=1e-9)


def test_the_car_does_not_feel_the_pendulum():
    # What the truth leaves out is the pull of the pendulum, at most twice its weight, on the car.
    assert 2 * car_pendulum.MASS * car_pendulum.G / car_pendulum.CAR < 1e-13 * car_pendulum.ACCELERATION


def test_an_engine_whose_hinge_does_not_feel_its_pivot_speed_up_is_seen(failed):
    mujoco_ = pytest.importorskip("poinsot.adapters.mujoco_")

    class Unfelt(mujoco_.MuJoCo):
        """The pendulum swings in the car as if it stood still, the car goes as it must."""

        def build(self, scene, scheme, dt):
            super().build(scene, scheme, dt)
            self._at_rest = mujoco_.MuJoCo()
            self._at_rest.build(replace(scene, forces=()), scheme, dt)

        def step(self, n):
            super().step(n)
            self._at_rest.step(n)

        def state(self):
            state, still = super().state(), self._at_rest.state()
            angle, rate = state.joint_position.copy(), state.joint_velocity.copy()
            angle[1], rate[1] = still.joint_position[1], still.joint_velocity[1]
            return state._replace(joint_position=angle, joint_velocity=rate)

    seen = failed(Unfelt, scenes()["car_pendulum"])
    assert {("truth", "frequency"), ("invariant", "energy in the car")} <= seen

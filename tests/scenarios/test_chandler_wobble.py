"""The wobble of the pole: its rate and its distance, and an engine that takes the Earth for a sphere."""

import numpy as np
import pytest
from poinsot.reference import chandler
from poinsot.scenarios import chandler_wobble
from poinsot.scenarios.registry import scenes


def test_the_pole_goes_round_in_305_turns(own_rate):
    scene = scenes()["chandler_wobble"]
    # One turn a second about the axis of figure.
    assert own_rate(scene, "wobble") == pytest.approx(2 * np.pi / 305, rel=1e-11)
    assert chandler_wobble._wobble_rate(scene) == pytest.approx(2 * np.pi / 305, rel=1e-13)


def test_the_pole_draws_the_circle_of_the_closed_form():
    scene = scenes()["chandler_wobble"]
    t = np.linspace(0.0, 305.0, 7)
    motion = scene.truth(scene, t)
    path = motion.omega[:, 0, :2] / motion.omega[:, 0, 2:]
    assert path == pytest.approx(chandler.pole_path(1 / 305, 2 * np.pi, 0.2, t, 0.7), abs=1e-12)
    assert chandler_wobble._pole_distance(scene, motion) == pytest.approx(np.full(7, 0.2), abs=1e-14)


def test_an_engine_that_takes_the_earth_for_a_sphere(failed):
    mujoco_ = pytest.importorskip("poinsot.adapters.mujoco_")

    class Rounding(mujoco_.MuJoCo):
        """Moments within a hundredth of their mean are made equal."""

        def build(self, scene, scheme, dt):
            super().build(scene, scheme, dt)
            moments = self._model.body_inertia[1]
            if np.ptp(moments) < 0.01 * moments.mean():
                moments[:] = moments.mean()

    found = failed(Rounding, scenes()["chandler_wobble"])
    # The turn that is left is exact at any step, and so there is no order in it.
    assert {("truth", "wobble"), ("truth", "omega"), ("order", "omega")} <= found
    assert not failed(Rounding, scenes()["free_asymmetric_top[general]"])

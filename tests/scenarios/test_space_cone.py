"""The space cone: rates and half angle against the closed forms, and an engine that forgets small bodies."""

import numpy as np
import pytest
from poinsot.reference.cones import cones
from poinsot.scenarios import space_cone
from poinsot.scenarios.registry import scenes

SCENES = pytest.mark.parametrize("name", ["space_cone[oblate]", "space_cone[prolate]"])


@SCENES
@pytest.mark.parametrize("observable", ["space cone, axis", "space cone, omega"])
def test_axis_and_omega_go_round_momentum_at_its_size_over_the_transverse_moment(own_rate, name, observable):
    scene = scenes()[name]
    I1, _, I3 = np.diag(scene.bodies[0].inertia_array)
    w = np.array(scene.v0[3:])
    expected = np.hypot(I1 * np.hypot(w[0], w[1]), I3 * w[2]) / I1
    assert own_rate(scene, observable) == pytest.approx(expected, rel=1e-12)


@SCENES
def test_the_half_angle_is_that_of_the_closed_form_all_the_way(name):
    scene = scenes()[name]
    I1, _, I3 = np.diag(scene.bodies[0].inertia_array)
    expected = cones(I1, I3, scene.v0[3:])
    assert expected.inside == (scene.variant == "oblate")
    found = space_cone._half_angle(scene, scene.truth(scene, scene.sample_times()))
    # An angle of order 1 from a few products: some roundings.
    assert found == pytest.approx(np.full(found.shape, expected.space), abs=1e-14)


@SCENES
def test_an_engine_that_leaves_out_the_gyroscopic_torque_of_small_bodies(failed, name):
    mujoco_ = pytest.importorskip("poinsot.adapters.mujoco_")

    class Forgetful(mujoco_.MuJoCo):
        """As Bullet's maximal coordinates do, which draw the line at 2.2e-16."""

        def step(self, n):
            small = np.prod(self._model.body_inertia[1]) < 1e-13
            for _ in range(n):
                omega = self._data.qvel[3:].copy()
                super().step(1)
                if small:
                    self._data.qvel[3:] = omega

    found = failed(Forgetful, scenes()[name])
    assert {("truth", "space cone, axis"), ("invariant", "angular momentum"), ("order", "omega")} <= found
    assert ("invariant", "energy") not in found  # a turn about a fixed axis of the body keeps it
    assert not failed(Forgetful, scenes()["free_symmetric_top[prolate]"], duration=1.0)

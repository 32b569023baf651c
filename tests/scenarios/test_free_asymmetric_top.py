"""The asymmetric top: the linear theory near its stable axes, its period, an engine that clamps a torque."""

import numpy as np
import pytest
from poinsot.scenarios import free_asymmetric_top, free_body
from poinsot.scenarios.registry import scenes

#: The spin, and Ω1 and Ω2 near it, by hand from the moments (120, 60, 90) and spins of 2 rad/s.
NEAR = {"largest": (0, 2.0 * 30 / 60, 2.0 * 60 / 90), "smallest": (1, 2.0 * 60 / 90, 2.0 * 30 / 120)}


@pytest.mark.parametrize("variant", NEAR)
def test_near_a_stable_axis_the_ellipse_is_that_of_the_linear_theory(variant):
    scene = scenes()[f"free_asymmetric_top[{variant}]"]
    axis, Omega_1, Omega_2 = NEAR[variant]
    assert free_body.circled_axis(scene) == axis
    # Beyond the linear theory comes the square of the tilt, 0.06.
    assert free_asymmetric_top._rate(scene) == pytest.approx(np.sqrt(Omega_1 * Omega_2), rel=0.06**2)
    t = np.linspace(0.0, 2 * np.pi / free_asymmetric_top._rate(scene), 201)[:-1]
    found = free_asymmetric_top._amplitude_ratio(scene, scene.truth(scene, t))
    assert found == pytest.approx(np.sqrt(Omega_2 / Omega_1), rel=0.06**2)


@pytest.mark.parametrize("variant", [*NEAR, "general"])
def test_omega_goes_round_once_in_a_period(variant):
    scene = scenes()[f"free_asymmetric_top[{variant}]"]
    t = np.linspace(0.0, 2 * np.pi / free_asymmetric_top._rate(scene), 101)
    motion = scene.truth(scene, t)
    phase = np.unwrap(np.angle(free_asymmetric_top._round(scene, motion)))
    assert abs(phase[-1] - phase[0]) == pytest.approx(2 * np.pi, rel=1e-13)
    assert motion.omega[-1] == pytest.approx(motion.omega[0], abs=1e-13)


def test_an_engine_that_clamps_the_gyroscopic_torque(failed):
    mujoco_ = pytest.importorskip("poinsot.adapters.mujoco_")

    class Clamping(mujoco_.MuJoCo):
        """At 2 N m, as Bullet's explicit gyroscopic force is clamped where one asks for it."""

        def step(self, n):
            data, moments = self._data, self._model.body_inertia[1]
            for _ in range(n):
                omega = data.qvel[-3:]
                torque = np.cross(moments * omega, omega)
                data.qfrc_applied[-3:] = np.clip(torque, -2, 2) - torque
                super().step(1)

    general, largest = (scenes()[f"free_asymmetric_top[{variant}]"] for variant in ("general", "largest"))
    assert {("truth", "wobble"), ("invariant", "angular momentum")} <= failed(Clamping, general)
    assert ("truth", "amplitude ratio") in failed(Clamping, largest)
    assert not failed(Clamping, scenes()["free_symmetric_top[oblate]"], duration=1.0)

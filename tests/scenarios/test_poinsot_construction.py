"""Poinsot's construction: its rolling, its curves against the closed forms, an engine that falls asleep."""

import numpy as np
import pytest
from poinsot.reference.poinsot_construction import contact_point, herpolhode_radii, plane_distance
from poinsot.reference.wobble import flip_period
from poinsot.scenarios import poinsot_construction as scene_file
from poinsot.scenarios.registry import scenes

SCENES = pytest.mark.parametrize("name", [f"poinsot_construction[{v}]" for v in ("triaxial", "symmetric")])


def moments(scene):
    return np.diag(scene.bodies[0].inertia_array)


@SCENES
def test_the_ellipsoid_rolls_on_the_plane(name):
    scene, h = scenes()[name], 1e-3
    t = np.linspace(0.3, 31.0, 23)
    before, after = (scene_file._contact_world(scene, scene.truth(scene, t + dt)) for dt in (-h, h))
    body = [contact_point(moments(scene), scene.truth(scene, t + dt).omega[:, 0]) for dt in (-h, h)]
    # Rolling: the contact runs along the plane as fast as along the ellipsoid. Quotients are good to h².
    along_plane, along_body = (np.linalg.norm(b - a, axis=1) / (2 * h) for a, b in ((before, after), body))
    assert along_plane == pytest.approx(along_body, rel=1e-6)
    expected = plane_distance(moments(scene), scene.v0[3:])
    assert scene_file._plane_distance(scene, scene.truth(scene, t)) == pytest.approx(expected, rel=1e-13)


@SCENES
def test_the_radii_are_those_of_the_closed_form(name):
    scene = scenes()[name]
    t = np.linspace(0.0, flip_period(moments(scene), scene.v0[3:]), 4001)
    radii = np.abs(scene_file._herpolhode(scene, scene.truth(scene, t)))
    # At an extremum, missed by half a sample of 1/4000 of a period: off by its square.
    expected = herpolhode_radii(moments(scene), scene.v0[3:])
    assert (radii.min(), radii.max()) == pytest.approx(expected, rel=1e-5)


def test_the_herpolhode_of_a_symmetric_top_is_a_circle_run_through_at_the_space_cone_rate(own_rate):
    scene = scenes()["poinsot_construction[symmetric]"]
    omega = np.array(scene.v0[3:])
    across, L = moments(scene)[0], np.linalg.norm(moments(scene) * omega)
    assert own_rate(scene, "herpolhode") == pytest.approx(L / across, rel=1e-12)
    assert scene_file._herpolhode_rate(scene) == pytest.approx(L / across, rel=1e-12)
    # Ω_b about e2: ω2 (I2 − I1)/I1, from e3 to e1.
    assert own_rate(scene, "polhode") == pytest.approx(omega[1] * (1.0 - 3.1) / 3.1, rel=1e-12)
    assert np.ptp(herpolhode_radii(moments(scene), omega)) < 1e-15


def test_the_polhode_closes_and_the_herpolhode_does_not():
    scene = scenes()["poinsot_construction[triaxial]"]
    t = np.array([0.0, 2 * np.pi / scene_file._polhode_rate(scene)])
    motion = scene.truth(scene, t)
    assert motion.omega[1] == pytest.approx(motion.omega[0], abs=1e-14)
    herpolhode = scene_file._herpolhode(scene, motion)
    assert abs(herpolhode[1]) == pytest.approx(abs(herpolhode[0]), rel=1e-13)
    assert abs(herpolhode[1] - herpolhode[0]) > 0.1 * abs(herpolhode[0])
    expected = np.angle(np.exp(1j * scene_file._herpolhode_rate(scene) * t[1]))
    assert np.angle(herpolhode[1] / herpolhode[0]) == pytest.approx(expected, abs=1e-12)


def test_an_engine_that_lets_slow_bodies_fall_asleep(failed):
    mujoco_ = pytest.importorskip("poinsot.adapters.mujoco_")

    class Sleepy(mujoco_.MuJoCo):
        """With Bullet's thresholds: below 0.8 m/s and 1 rad/s for two seconds a body stops."""

        def build(self, scene, scheme, dt):
            super().build(scene, scheme, dt)
            self._calm = 0.0

        def step(self, n):
            velocity = self._data.qvel
            for _ in range(n):
                slow = np.linalg.norm(velocity[:3]) < 0.8 and np.linalg.norm(velocity[3:]) < 1
                self._calm = self._calm + self._model.opt.timestep if slow else 0.0
                if self._calm > 2:
                    velocity[:] = 0.0
                super().step(1)

    found = failed(Sleepy, scenes()["poinsot_construction[triaxial]"])
    assert {("truth", "polhode"), ("truth", "herpolhode"), ("invariant", "energy")} <= found
    for other in ("free_asymmetric_top[general]", "space_cone[prolate]", "middle_axis[1e-2]"):
        assert not failed(Sleepy, scenes()[other])

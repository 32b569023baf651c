"""The cone on its tip: its moments, a precession that never turns back, an engine that takes it for a box."""

from dataclasses import replace

import numpy as np
import pytest
from poinsot.reference import cone_top as closed_form
from poinsot.reference.inertia_of_shapes import box
from poinsot.scenarios import pivoted_top
from poinsot.scenarios.body import diagonal
from poinsot.scenarios.registry import scenes

CONE = scenes()["cone_top"]


def test_its_moments_about_the_tip_are_those_of_the_books():
    mass, length, moments, g, _, _ = pivoted_top.arguments(CONE)
    M, R, h = 0.1, 0.06, 0.05
    assert (mass, g) == (M, 9.81)
    assert length == pytest.approx(3 * h / 4, rel=1e-15)
    assert moments == pytest.approx((3 * M / 20 * (R**2 + 4 * h**2), 3 * M / 20 * 2 * R**2), rel=1e-14)
    assert moments == pytest.approx(closed_form.moments(M, R, h), rel=1e-14)


def test_its_rates_are_the_means_of_the_exact_motion():
    t = np.linspace(0.0, 2 * np.pi / pivoted_top.nutation_frequency(CONE), 2001)
    motion = CONE.truth(CONE, t)
    tilt = pivoted_top.tilt(CONE, motion)
    azimuth = np.unwrap(np.angle(pivoted_top.from_above(CONE, motion)))
    assert tilt[-1] == pytest.approx(tilt[0], abs=1e-13)
    # Down and up again once: the nutation's period is no multiple of it.
    assert np.count_nonzero(np.diff(np.sign(np.gradient(tilt)))) == 2
    assert (azimuth[-1] - azimuth[0]) / t[-1] == pytest.approx(pivoted_top.mean_precession(CONE), rel=1e-12)


def test_it_never_turns_back_and_the_heavy_top_does():
    def least_advance(scene):
        motion = scene.truth(scene, np.linspace(0.0, scene.duration, 5001))
        return np.diff(np.unwrap(np.angle(pivoted_top.from_above(scene, motion)))).min()

    assert least_advance(CONE) > 0 > least_advance(scenes()["heavy_top[moderate]"])


def test_an_engine_that_takes_the_box_around_a_cone_for_the_cone(failed):
    mujoco_ = pytest.importorskip("poinsot.adapters.mujoco_")

    class Boxing(mujoco_.MuJoCo):
        """Gives a body called a cone the inertia of the box around it, about the cone's own centre."""

        def build(self, scene, scheme, dt):
            if scene.bodies[0].name == "cone":
                moments = 0.1 * box(0.12, 0.12, 0.05).inertia.diagonal()
                scene = replace(scene, bodies=(replace(scene.bodies[0], inertia=diagonal(*moments)),))
            super().build(scene, scheme, dt)

    found = failed(Boxing, CONE)
    assert {("truth", "nutation"), ("truth", "orientation"), ("order", "omega")} <= found

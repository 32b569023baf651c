"""Orbit and spin: their parts against the closed forms, and an engine that pulls beside the centre."""

from dataclasses import replace

import numpy as np
import pytest
from poinsot.adapters.simulate import simulate
from poinsot.reference import orbit_and_spin as closed_form
from poinsot.scenarios import mechanics
from poinsot.scenarios.registry import scenes

ORBIT, FLIGHT = (scenes()[f"orbit_and_spin[{variant}]"] for variant in ("orbit", "flight"))


def parts(scene, motion):
    return (
        mechanics.orbital_momentum_world(scene, motion),
        mechanics.spin_momentum_world(scene, motion),
        mechanics.orbital_energy(scene, motion),
        mechanics.spin_energy(scene, motion),
    )


@pytest.mark.parametrize("scene", [ORBIT, FLIGHT], ids=["orbit", "flight"])
def test_the_parts_are_those_of_the_closed_form(scene):
    (body,), motion = scene.bodies, scene.truth(scene, scene.sample_times())
    split = closed_form.of_body(
        body.mass,
        body.inertia,
        motion.position[:, 0],
        motion.velocity[:, 0],
        motion.quaternion[:, 0],
        motion.omega[:, 0],
    )
    for found, expected in zip(parts(scene, motion), split, strict=True):
        assert found == pytest.approx(expected, rel=1e-13, abs=1e-13)


def test_what_no_force_keeps_does_change():
    # So that what is kept is kept for a reason.
    motion = FLIGHT.truth(FLIGHT, FLIGHT.sample_times())
    orbital, _, energy, _ = parts(FLIGHT, motion)
    assert np.ptp(orbital[:, 0]) > 1.0
    assert np.ptp(energy) > 1.0
    assert np.ptp(parts(ORBIT, ORBIT.truth(ORBIT, ORBIT.sample_times()))[2]) > 1.0


def test_the_rate_is_that_of_the_orbit():
    (circling,) = (o for o in ORBIT.observables if o.name == "circling")
    rate = circling.scale(ORBIT, None)
    motion = ORBIT.truth(ORBIT, np.array([0.0, 5 * 2 * np.pi / rate]))
    assert motion.position[1] == pytest.approx(motion.position[0], rel=1e-13)
    assert rate == pytest.approx(np.sqrt(24.0 / 1.5), rel=1e-15)


def test_an_engine_whose_pull_misses_the_centre_of_mass(failed):
    mujoco_ = pytest.importorskip("poinsot.adapters.mujoco_")

    class Beside(mujoco_.MuJoCo):
        """Has the centre of mass a little off the point that the springs hold."""

        def build(self, scene, scheme, dt):
            (body,) = scene.bodies
            super().build(replace(scene, bodies=(replace(body, center_of_mass=(5e-3, 0, 0)),)), scheme, dt)

    found = failed(Beside, ORBIT)
    assert {("invariant", name) for name in ("L_orbital", "L_spin", "T_about", "T_cm + V")} <= found
    # L as a whole does not show it: the force still points at the origin.
    rk4 = next(scheme for scheme in Beside.schemes if scheme.name == "RK4")
    motion = simulate(ORBIT, Beside, rk4, 1e-3)[0]
    whole = mechanics.angular_momentum_world(ORBIT, motion)
    assert np.abs(whole - whole[0]).max() < 1e-8
    assert np.ptp(mechanics.spin_momentum_world(ORBIT, motion), axis=0).max() > 1e-3

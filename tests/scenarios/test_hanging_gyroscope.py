"""The gyroscope on a rope: its steady state, its kicked motion, an engine that forgets the rope's turning."""

from dataclasses import replace

import numpy as np
import pytest
from poinsot.reference import equations_of_motion, hanging_gyroscope_motion, quaternions
from poinsot.reference import hanging_gyroscope as closed_form
from poinsot.scenarios import hanging_gyroscope
from poinsot.scenarios.body import diagonal
from poinsot.scenarios.registry import scenes

HANGING = scenes()["hanging_gyroscope[steady]"]

SWINGING = scenes()["hanging_gyroscope[swinging]"]


def test_its_tilt_and_spin_are_those_of_the_closed_form():
    found = closed_form.steady_precession(
        *hanging_gyroscope.system(), hanging_gyroscope.G, hanging_gyroscope.BETA, hanging_gyroscope.OMEGA
    )
    assert pytest.approx(found, rel=1e-14) == (hanging_gyroscope.CHI, hanging_gyroscope.OMEGA3)
    axle = quaternions.rotated(
        HANGING.truth(HANGING, np.zeros(1)).quaternion[0, 1], np.array([0.0, 0.0, 1.0])
    )
    assert axle[2] < 0


def test_the_bodies_are_the_system_of_the_closed_form():
    rope, wheel = HANGING.bodies
    system = hanging_gyroscope.system()
    half = rope.center_of_mass[2]
    assert system[0].inertia == pytest.approx(rope.inertia[0][0] + rope.mass * half**2, rel=1e-14)
    assert system[0].mass_moment == pytest.approx(rope.mass * half, rel=1e-14)
    assert system[1].moments[0] == pytest.approx(
        wheel.inertia[0][0] + wheel.mass * wheel.center_of_mass[2] ** 2, rel=1e-14
    )


def test_a_kicked_one_moves_as_two_links_on_ball_joints(links_of):
    # Kane's equations against the difference quotients of a motion far from the steady one.
    kicked = replace(HANGING, v0=(1.0, -2.0, HANGING.v0[2], *HANGING.v0[3:]))
    h, links = 1e-4, links_of(kicked)
    motion = kicked.truth(kicked, np.array([0.0, 0.3 - h, 0.3, 0.3 + h]))
    rope, wheel = motion.quaternion[2]
    relative = quaternions.product(quaternions.conjugate(rope), wheel)
    carried = quaternions.rotated(quaternions.conjugate(relative), motion.omega[2, 0])
    q = np.concatenate([rope, relative])
    v = np.concatenate([motion.omega[2, 0], motion.omega[2, 1] - carried])
    a = equations_of_motion.accelerations(links, q, v, kicked.gravity)
    linear, angular = equations_of_motion.link_accelerations(links, q, v, a)
    for found, expected in ((motion.velocity, linear), (motion.omega, angular)):
        # A difference quotient is off by h²/6 of a third derivative, up to 30³ times the velocity; and the
        # rope's moment about its own axis, which the closed form leaves out, is 6e-4 of the one across.
        assert (found[3] - found[1]) / (2 * h) == pytest.approx(expected, rel=2e-3, abs=2e-3)


def test_an_engine_that_hands_out_the_joints_own_rate(failed):
    mujoco_ = pytest.importorskip("poinsot.adapters.mujoco_")

    class Relative(mujoco_.MuJoCo):
        """The angular velocity of the body behind the second joint is that of the joint."""

        def state(self):
            state = super().state()
            omega = state.omega.copy()
            omega[1:] = self._data.qvel[3:].reshape(-1, 3)
            return state._replace(omega=omega)

    found = failed(Relative, HANGING)
    assert {("truth", "omega"), ("order", "omega")} <= found
    assert ("truth", "orientation") not in found


def test_an_engine_whose_rope_has_no_mass(failed):
    mujoco_ = pytest.importorskip("poinsot.adapters.mujoco_")

    class Massless(mujoco_.MuJoCo):
        """Takes a light body between two joints for none."""

        def build(self, scene, scheme, dt):
            rope, wheel = scene.bodies
            light = replace(rope, mass=rope.mass * 1e-6, inertia=diagonal(1e-9, 1e-9, 1e-9))
            super().build(replace(scene, bodies=(light, wheel)), scheme, dt)

    assert ("truth", "precession of the rope") in failed(Massless, HANGING)


def test_the_swings_rates_are_the_truths_own(own_rate):
    for name, rate in zip(("rope", "axle"), hanging_gyroscope.SWING_RATES, strict=True):
        found = own_rate(SWINGING, f"precession of the {name}", samples=21)
        assert found == pytest.approx(rate, rel=1e-8)


def test_the_swing_is_integrated_far_below_what_the_finest_steps_are_off_by():
    t = SWINGING.sample_times()
    motion = SWINGING.truth(SWINGING, t)
    start = motion.quaternion[0], motion.omega[0]
    coarser = hanging_gyroscope_motion.motion(
        *hanging_gyroscope.system(), hanging_gyroscope.G, *start, t, 1e-13
    )
    constants = dict(zip((o.name for o in SWINGING.observables), SWINGING.errors["RKMK4"], strict=True))
    finest = min(SWINGING.ladder(4)) ** 4
    found = zip(("orientation", "omega"), (motion.quaternion, motion.omega), coarser, strict=True)
    for name, ours, other in found:
        assert np.abs(ours - other).max() < 1e-3 * constants[name] * finest
    # Nor does the rope spin, whose moment about its axis the equations leave out.
    assert np.abs(motion.omega[:, 0, 2]).max() < 1e-13


def test_an_engine_whose_wheel_keeps_that_one_precession_with_other_moments(failed):
    """Moments that keep I3ω3Ω − I1Ω²cosβ, which dL/dt asks for, keep the steady precession and no other."""
    mujoco_ = pytest.importorskip("poinsot.adapters.mujoco_")
    slower = hanging_gyroscope.OMEGA * np.cos(hanging_gyroscope.BETA) / hanging_gyroscope.OMEGA3

    class Deceived(mujoco_.MuJoCo):
        """Takes the wheel for one with a larger moment across its axle."""

        def build(self, scene, scheme, dt):
            rope, wheel = scene.bodies
            more = 0.2 * hanging_gyroscope.ACROSS
            across, axial = hanging_gyroscope.ACROSS + more, hanging_gyroscope.AXIAL + more * slower
            wheel = replace(wheel, inertia=diagonal(across, across, axial))
            super().build(replace(scene, bodies=(rope, wheel)), scheme, dt)

    steady = failed(Deceived, HANGING, "RKMK4")
    assert not [name for kind, name in steady if kind == "order" or name.endswith("limit")]
    assert {("truth", "orientation"), ("truth", "tilts"), ("order", "omega")} <= failed(Deceived, SWINGING)

"""Equations of motion of the heavy top against those of any tree of links, and its constants by hand."""

import math

import numpy as np
import pytest
from poinsot.reference import equations_of_motion, quaternions
from poinsot.reference.equations_of_motion import Joint, Link
from poinsot.reference.errors import InputError
from poinsot.reference.heavy_top import motion
from poinsot.reference.heavy_top_equations import accelerations, constants_of_motion, effective_potential

TOP = {"mass": 2.0, "length": 0.3, "moments": (0.5, 0.2), "gravity": 9.81}
SEED = 20240612


def random_states(n):
    random = np.random.default_rng(SEED)
    q = random.normal(size=(n, 4))
    return q / np.linalg.norm(q, axis=-1, keepdims=True), random.normal(size=(n, 3)) * 5


def test_accelerations_are_those_of_a_link_on_a_ball_joint():
    q, omega = random_states(20)
    across = 0.5 - 2 * 0.3**2
    inertia = np.diag([across, across, 0.2])
    link = Link(2.0, inertia, (0, 0, 0.3), joints=(Joint("ball"),))
    got = accelerations(**TOP, q=q, omega=omega)
    for i in range(20):
        expected = equations_of_motion.accelerations([link], q[i], omega[i], (0, 0, -9.81))
        assert np.allclose(got[i], expected, rtol=1e-13, atol=1e-12)


def test_accelerations_by_hand():
    """Lying along −y: the weight turns it about −x, with Mgl/I1; spinning, ω1 comes of ω2 and ω3."""
    level = [math.sqrt(0.5), 0, 0, math.sqrt(0.5)]
    got = accelerations(**TOP, q=level, omega=[0, 0, 0])
    assert np.allclose(got, [2 * 0.3 * 9.81 / 0.5, 0, 0], atol=1e-14)
    weightless = {**TOP, "gravity": 0.0}
    assert np.allclose(accelerations(**weightless, q=level, omega=[0, 2, 5]), [0.3 * 10 / 0.5, 0, 0])
    assert np.allclose(accelerations(**weightless, q=level, omega=[2, 0, 5]), [0, -0.3 * 10 / 0.5, 0])


def test_constants_by_hand():
    """Along −y, which is level: p_α = I1ω2, for e2 points up; then tilted by 60° and only spinning."""
    level = [math.sqrt(0.5), 0, 0, math.sqrt(0.5)]
    p_alpha, p_gamma, energy = constants_of_motion(**TOP, q=level, omega=[3, 4, 5])
    assert p_alpha == pytest.approx(0.5 * 4, rel=1e-15)
    assert p_gamma == 1.0
    assert energy == pytest.approx(0.5 * 0.5 * 25, rel=1e-15)
    p_alpha, p_gamma, energy = constants_of_motion(**TOP, q=[0.5, 0, 0, math.sqrt(0.75)], omega=[0, 0, 5])
    assert p_alpha == pytest.approx(0.5, rel=1e-15)
    assert energy == pytest.approx(2 * 0.3 * 9.81 / 2, rel=1e-15)


def test_constants_are_momentum_and_energy_in_the_world():
    q, omega = random_states(20)
    p_alpha, p_gamma, energy = constants_of_motion(**TOP, q=q, omega=omega)
    L = quaternions.rotated(q, omega * [0.5, 0.5, 0.2])
    e3 = quaternions.rotated(q, np.array([0.0, 0.0, 1.0]))
    assert np.allclose(p_alpha, L[:, 2], rtol=1e-13)
    assert np.allclose(p_gamma, np.sum(L * e3, axis=-1), rtol=1e-13)
    kinetic = np.sum(L * quaternions.rotated(q, omega), axis=-1) / 2
    assert np.allclose(energy + p_gamma**2 / (2 * 0.2), kinetic + 2 * 9.81 * 0.3 * e3[:, 2], rtol=1e-13)


def test_the_effective_potential_is_what_is_left_of_the_energy():
    q, omega = random_states(20)
    p_alpha, p_gamma, energy = constants_of_motion(**TOP, q=q, omega=omega)
    e3 = quaternions.rotated(q, np.array([0.0, 0.0, 1.0]))
    velocity = np.cross(quaternions.rotated(q, omega), e3)
    for i in range(20):
        beta = math.acos(e3[i, 2])
        beta_rate = -velocity[i, 2] / math.sin(beta)
        potential = effective_potential(2.0, 0.3, 0.5, 9.81, p_alpha[i], p_gamma[i], beta)
        assert energy[i] == pytest.approx(0.25 * beta_rate**2 + potential, rel=1e-12)


def test_the_effective_potential_by_hand():
    """At 60°, p_α = 3, p_γ = 2: (3 − 1)²/(2·0.5·¾) + Mgl/2; near 0, where p_α = p_γ: p_γ²β²/(8I1)."""
    assert effective_potential(1.0, 1.0, 0.5, 4.0, 3.0, 2.0, math.pi / 3) == pytest.approx(
        16 / 3 + 2, rel=1e-15
    )
    beta = np.array([1e-9, 1e-3])
    near = effective_potential(1.0, 0.0, 0.5, 4.0, 2.0, 2.0, beta)
    assert near == pytest.approx(4 * beta**2 / 8 / 0.5, rel=1e-6)
    for bad in (0.0, [1.0, 0.0]):
        with pytest.raises(InputError, match="beta: got"):
            effective_potential(1.0, 1.0, 0.5, 4.0, 3.0, 2.0, bad)


def test_they_hold_along_a_motion():
    """A wide stencil of the motion's own rates against the accelerations at its middle."""
    h = 2.0**-12
    top = {"q0": [0.1, 0.2, 0.3, math.sqrt(0.86)], "omega0": [1.0, -2.0, 9.0]}
    q, omega = motion(**TOP, **top, t=0.7 + h * np.arange(-2, 3))
    slope = (8 * (omega[3] - omega[1]) - (omega[4] - omega[0])) / (12 * h)
    assert np.allclose(slope, accelerations(**TOP, q=q[2], omega=omega[2]), atol=1e-10)


@pytest.mark.parametrize("function", [accelerations, constants_of_motion])
def test_what_cannot_be_is_refused(function):
    state = {"q": [0, 0, 0, 1], "omega": [1, 2, 3]}
    for change in ({"mass": 0}, {"moments": (1, 3)}, {"q": [0, 0, 1, 1]}, {"omega": [math.nan, 0, 0]}):
        with pytest.raises(InputError):
            function(**{**TOP, **state, **change})

"""The cones of a symmetric top: by vectors, by rolling, and where the notes misprint them."""

import math

import numpy as np
import pytest
from poinsot.reference import quaternions
from poinsot.reference.cones import cones, space_cone_rate_from_angle
from poinsot.reference.errors import InputError
from poinsot.reference.torque_free import body_cone_rate, motion, space_cone_rate

TOPS = [(0.01, 0.02), (0.01, 0.004), (1.0, 1e-6), (1.0, 2.0), (1.0, 1.0)]
SPINS = [np.array([1.0, -0.5, 3.0]), np.array([1.0, 2.0, -3.0]), np.array([0.3, 0.0, 0.0])]


def between(a, b):
    return math.atan2(np.linalg.norm(np.cross(a, b)), a @ b)


@pytest.mark.parametrize(("I1", "I3"), TOPS)
@pytest.mark.parametrize("omega", SPINS)
def test_the_angles_are_those_of_the_vectors(I1, I3, omega):
    found = cones(I1, I3, omega)
    L, e3 = np.array([I1, I1, I3]) * omega, np.array([0.0, 0.0, 1.0])
    assert abs(found.alpha - between(omega, e3)) < 1e-15
    assert abs(found.theta - between(L, e3)) < 1e-15
    assert abs(found.space - between(omega, L)) < 1e-15
    assert abs(found.body - min(found.alpha, math.pi - found.alpha)) < 1e-15
    assert found.inside is (I3 > I1)


@pytest.mark.parametrize(("I1", "I3"), TOPS[:4])
@pytest.mark.parametrize("omega", SPINS[:2])
def test_the_body_cone_rolls_on_the_space_cone(I1, I3, omega):
    """Equal lengths on both cones pass the line of contact: |Ω_b| sin(body) = φ̇ sin(space)."""
    found = cones(I1, I3, omega)
    body = abs(body_cone_rate(I1, I3, omega[2])) * math.sin(found.body)
    space = space_cone_rate(I1, I3, omega) * math.sin(found.space)
    assert abs(body / space - 1) < 1e-14


def test_an_oblate_top_has_its_space_cone_inside_a_prolate_one_outside():
    """Landau & Lifshitz § 33: L is between e3 and ω for an oblate top, beyond ω for a prolate one."""
    oblate, prolate = cones(1.0, 1.8, [1.0, 0.0, 2.0]), cones(1.0, 0.3, [1.0, 0.0, 2.0])
    assert oblate.theta < oblate.alpha
    assert abs(oblate.alpha - oblate.theta - oblate.space) < 1e-15
    assert prolate.theta > prolate.alpha
    assert abs(prolate.theta - prolate.alpha - prolate.space) < 1e-15


def test_no_spin_has_no_cones():
    assert cones(1.0, 2.0, [0.0, 0.0, 0.0])[:4] == (0.0, 0.0, 0.0, 0.0)


@pytest.mark.parametrize(("I1", "I3"), TOPS)
@pytest.mark.parametrize("omega", SPINS)
def test_the_rate_by_the_angle_is_L_over_I1(I1, I3, omega):
    rate = space_cone_rate_from_angle(I1, I3, np.linalg.norm(omega), cones(I1, I3, omega).alpha)
    assert abs(rate / space_cone_rate(I1, I3, omega) - 1) < 1e-15
    alpha, speed = cones(I1, I3, omega).alpha, np.linalg.norm(omega)
    assert abs(rate - speed * math.sqrt(1 + ((I3 / I1) ** 2 - 1) * math.cos(alpha) ** 2)) < 1e-9 * speed


def test_bad_input_is_refused():
    for call in (
        lambda: cones(0.0, 1.0, [0.0, 0.0, 1.0]),
        lambda: cones(1.0, -1.0, [0.0, 0.0, 1.0]),
        lambda: cones(1.0, 1.0, [0.0, 1.0]),
        lambda: space_cone_rate_from_angle(0.0, 1.0, 1.0, 1.0),
        lambda: space_cone_rate_from_angle(1.0, 0.0, 1.0, 1.0),
        lambda: space_cone_rate_from_angle(1.0, 1.0, math.nan, 1.0),
        lambda: space_cone_rate_from_angle(1.0, 1.0, 1.0, math.inf),
    ):
        with pytest.raises(InputError, match="got"):
            call()


# Misprints in the sources: the printed form is wrong, the mended one right.


def residual(I1, I3, omega3, formula):
    """How far ω(t) = formula(t) is from Euler's equations at t = 0.3, by central differences."""
    t, step = 0.3, 1e-6
    now, rate = formula(t), (formula(t + step) - formula(t - step)) / (2 * step)
    euler = np.array([(I1 - I3) * now[1] * omega3 / I1, (I3 - I1) * omega3 * now[0] / I1])
    return np.abs(rate - euler).max()


def test_free_precession_from_the_first_axis_is_cos_and_minus_sin():
    """IAC wiki: with ω(0) = (ω0, 0) it prints (ω0 sin Ω_b t, −ω0 cos Ω_b t), its Ω_b = (λ1 − λ3)ω3/λ1."""
    I1, I3, omega3, omega0 = 0.01, 0.018, 5.0, 1.3
    Omega_b = -body_cone_rate(I1, I3, omega3)

    def mended(t):
        return omega0 * np.array([math.cos(Omega_b * t), -math.sin(Omega_b * t)])

    def printed(t):
        return omega0 * np.array([math.sin(Omega_b * t), -math.cos(Omega_b * t)])

    assert np.array_equal(mended(0.0), [omega0, 0.0])
    assert np.abs(printed(0.0) - [omega0, 0.0]).max() > 1
    assert residual(I1, I3, omega3, mended) < 1e-8
    _, omega = motion([I1, I1, I3], [0, 0, 0, 1], [omega0, 0.0, omega3], [0.3])
    assert np.abs(omega[0, :2] - mended(0.3)).max() < 1e-15
    assert np.abs(omega[0, :2] - printed(0.3)).max() > 0.1


def test_the_second_component_of_the_slides_eq_52_is_omega_y_with_a_minus():
    """Slides, eqs. 45–52: Ω = (I1 − I3)ω_z/I1, ω_x = A cos Ωt, and eq. 52 prints ω_x = A sin Ωt."""
    I1, I3, omega3, A = 0.01, 0.018, 5.0, 1.3
    Omega = -body_cone_rate(I1, I3, omega3)
    for sign, right in ((-1, True), (1, False)):
        off = residual(
            I1, I3, omega3, lambda t, s=sign: A * np.array([math.cos(Omega * t), s * math.sin(Omega * t)])
        )
        assert bool(off < 1e-8) is right
    # As printed, both lines speak of ω_x, which cannot be both.
    assert abs(math.cos(Omega * 0.3) - math.sin(Omega * 0.3)) > 0.1


def test_the_space_rate_weighs_both_moments_with_a_plus():
    """Handwritten notes: φ̇ = L(sin²θ/I1 − cos²θ/I3) − ω_R cosθ with ω_R = L(1/I1 − 1/I3)cosθ.

    The weight has a plus, and what the body turns by itself is ω_R = L(1/I3 − 1/I1)cosθ: then it is L/I1.
    """
    I1, I3, omega = 0.01, 0.018, np.array([1.0, -0.5, 3.0])
    L = np.linalg.norm(np.array([I1, I1, I3]) * omega)
    theta = cones(I1, I3, omega).theta
    rate = space_cone_rate(I1, I3, omega)
    assert abs(rate / (L / I1) - 1) < 1e-15
    for sign, own, right in ((1, 1, True), (-1, 1, False), (1, -1, False), (-1, -1, False)):
        weight = L * (math.sin(theta) ** 2 / I1 + sign * math.cos(theta) ** 2 / I3)
        omega_R = own * L * (1 / I3 - 1 / I1) * math.cos(theta)
        assert bool(abs((weight - omega_R * math.cos(theta)) / rate - 1) < 1e-14) is right
    # ω is the sum of both turns: its part along e3 is φ̇ cosθ + ω_R.
    assert abs(rate * math.cos(theta) + L * (1 / I3 - 1 / I1) * math.cos(theta) - omega[2]) < 1e-14
    # ω·L/|L| is the weight itself.
    weight = L * (math.sin(theta) ** 2 / I1 + math.cos(theta) ** 2 / I3)
    q, w = motion([I1, I1, I3], [0, 0, 0, 1], omega, [0.7])
    along = quaternions.rotated(q, np.array([I1, I1, I3]) * w)[0] / L
    assert abs(quaternions.rotated(q, w)[0] @ along / weight - 1) < 1e-14


def test_the_body_rate_carries_the_speed():
    """Big-picture notes: Ω = (I_s/I − 1)cosα, which is not a rate; times ω it is (I3 − I1)ω3/I1."""
    I1, I3, omega = 0.01, 0.018, np.array([1.0, -0.5, 3.0])
    printed = (I3 / I1 - 1) * math.cos(cones(I1, I3, omega).alpha)
    rate = body_cone_rate(I1, I3, omega[2])
    assert abs(printed * np.linalg.norm(omega) / rate - 1) < 1e-14
    assert abs(printed / rate - 1) > 0.1

"""The ball on a turntable: the contact that does not slip, Newton's laws, the published circles."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp
from poinsot.reference.errors import InputError
from poinsot.reference.sphere_on_turntable import ball_on_a_turntable, circling_rate
from scipy.integrate import solve_ivp

Z = np.array([0, 0, 1.0])
flat = hnp.arrays(float, 2, elements=st.floats(-3, 3))


def test_the_published_rates():
    assert circling_rate(7.0) == pytest.approx(2.0, rel=1e-15)
    assert circling_rate(5.0, 2 / 3) == pytest.approx(2.0, rel=1e-15)


def test_the_circle_of_a_solid_ball():
    # A circle of radius v/(2Ω/7), gone round the way the table turns, in seven half turns of it.
    Omega, v = 2.1, 0.6
    rate = 2 * Omega / 7
    t = np.array([0.0, 0.25, 0.5, 1.0]) * 2 * np.pi / rate
    r, velocity, _ = ball_on_a_turntable(0.1, Omega, [1.0, 0.0], [0.0, v], t)
    centre = 1.0 - v / rate
    expected = [[1, 0], [centre, v / rate], [centre - v / rate, 0], [1, 0]]
    # Times of some seconds are rounded: 1e-15 of phase.
    np.testing.assert_allclose(r, expected, atol=4e-15)
    np.testing.assert_allclose(velocity[1], [-v, 0], atol=1e-15)
    assert t[3] == pytest.approx(3.5 * 2 * np.pi / Omega)


@settings(max_examples=40, deadline=None)
@given(flat, flat, flat, st.floats(-5, 5), st.floats(0.1, 1), st.floats(-6, 6))
def test_the_contact_moves_with_the_table(r0, v0, pull, Omega, kappa, t):
    a = 0.3
    r, v, omega = ball_on_a_turntable(a, Omega, r0, v0, t, 1.7, kappa, pull)
    contact = np.append(v[0], 0) + np.cross(omega[0], -a * Z)
    table = np.cross(Omega * Z, np.append(r[0], 0))
    np.testing.assert_allclose(contact, table, atol=1e-12 * (1 + np.abs(r).max()) * (1 + abs(Omega)))
    assert omega[0, 2] == 1.7


def test_newtons_laws_of_the_ball():
    # Integrate force and torque themselves: the friction F that keeps the contact, I ω̇ = −aẑ×F.
    a, Omega, kappa, pull = 0.3, 1.9, 0.55, np.array([0.4, -0.2, 0.0])
    r0, v0, spin = np.array([0.5, -0.3]), np.array([0.2, 0.7]), 0.8

    def rates(_, y):
        v = y[3:6]
        # F/m from the rate of v − aω×ẑ = Ωẑ×r: pull + F + F/κ = Ωẑ×v, all across z.
        friction = (np.cross(Omega * Z, v) - pull) / (1 + 1 / kappa)
        return np.concatenate([v, pull + friction, -np.cross(Z, friction) / (kappa * a)])

    _, _, omega0 = ball_on_a_turntable(a, Omega, r0, v0, 0.0, spin, kappa, pull[:2])
    start = np.concatenate([[*r0, 0], [*v0, 0], omega0[0]])
    y = solve_ivp(rates, (0, 7), start, method="DOP853", rtol=1e-12, atol=1e-12).y[:, -1]
    r, v, omega = ball_on_a_turntable(a, Omega, r0, v0, 7.0, spin, kappa, pull[:2])
    np.testing.assert_allclose(r[0], y[:2], atol=1e-10)
    np.testing.assert_allclose(v[0], y[3:5], atol=1e-10)
    np.testing.assert_allclose(omega[0], y[6:], atol=1e-9)


def test_on_a_tilted_table_the_ball_drifts_across_the_slope():
    # The steady drift: W ẑ×v + pull/(1 + κ) = 0, speed (5/2) g sinα/Ω for a solid ball.
    Omega, g_sin = 3.0, 0.6
    r, v, _ = ball_on_a_turntable(0.1, Omega, [0, 0], [0, 2.5 * g_sin / Omega], [0.0, 5.0], pull=[g_sin, 0])
    np.testing.assert_allclose(v, [[0, 0.5], [0, 0.5]], atol=1e-15)
    np.testing.assert_allclose(r[1], [0, 2.5], atol=1e-14)


def test_a_table_at_rest_lets_the_ball_run_straight():
    r, _, omega = ball_on_a_turntable(0.5, 0.0, [1, 2], [0.3, 0.4], [0.0, 10.0])
    np.testing.assert_allclose(r[1], [4, 6], atol=1e-15)
    np.testing.assert_allclose(omega[1], [-0.8, 0.6, 0], atol=1e-15)


@pytest.mark.parametrize(
    "call",
    [
        lambda: circling_rate(1.0, 0.0),
        lambda: circling_rate(np.nan),
        lambda: ball_on_a_turntable(0.0, 1.0, [0, 0], [0, 0], 1.0),
        lambda: ball_on_a_turntable(1.0, np.inf, [0, 0], [0, 0], 1.0),
        lambda: ball_on_a_turntable(1.0, 1.0, [0, 0, 0], [0, 0], 1.0),
        lambda: ball_on_a_turntable(1.0, 1.0, [0, 0], [0, 0], 1.0, pull=[1.0]),
        lambda: ball_on_a_turntable(1.0, 1.0, [0, 0], [0, 0], 1.0, spin=np.nan),
    ],
)
def test_bad_input_is_refused(call):
    with pytest.raises(InputError):
        call()

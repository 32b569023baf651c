"""Two free bodies: their common centre, residuals of Newton's laws, and limits that are known."""

import mpmath as mp
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from poinsot.reference import kepler_orbit
from poinsot.reference.errors import InputError
from poinsot.reference.two_body import gravity_motion, reduced_mass, spring_motion
from scipy.integrate import solve_ivp

R0 = np.array([[1.0, 0.2, -0.3], [-0.5, 0.4, 0.8]])
V0 = np.array([[0.3, 0.9, 0.1], [-0.2, -0.4, 0.5]])


def integrated(force, m1, m2, positions, velocities, seconds):
    def rates(_, y):
        r = y[:6].reshape(2, 3)
        on_first = force(r[0] - r[1])
        return np.concatenate([y[6:], on_first / m1, -on_first / m2])

    start = np.concatenate([np.ravel(positions), np.ravel(velocities)])
    y = solve_ivp(rates, (0, seconds), start, method="DOP853", rtol=1e-12, atol=1e-13).y[:, -1]
    return y[:6].reshape(2, 3), y[6:].reshape(2, 3)


def test_the_reduced_mass():
    assert reduced_mass(3.0, 6.0) == pytest.approx(2.0, rel=1e-15)
    assert reduced_mass(6.0, 3.0) == reduced_mass(3.0, 6.0)
    assert reduced_mass(2.5, 1e300) == 2.5
    assert reduced_mass(1e308, 1e308) == 5e307


@pytest.mark.parametrize(("m1", "m2"), [(0.7, 2.1), (2.1, 0.7)])
def test_a_spring_between_two_bodies_obeys_newton(m1, m2):
    k = 5.0
    r, v = spring_motion(m1, m2, k, R0, V0, [0.0, 2.3])
    np.testing.assert_allclose(r[0], R0, atol=1e-15)
    np.testing.assert_allclose(v[0], V0, atol=1e-15)
    expected = integrated(lambda s: -k * s, m1, m2, R0, V0, 2.3)
    np.testing.assert_allclose(r[1], expected[0], atol=1e-10)
    np.testing.assert_allclose(v[1], expected[1], atol=1e-10)


def test_a_spring_of_some_length_swings_about_it():
    m1, m2, k, length = 0.7, 2.1, 5.0, 1.2
    line = np.array([2.0, -1.0, 2.0]) / 3
    positions, velocities = np.array([[0.4 * c for c in line], -line]), np.array([-0.3 * line, 0.5 * line])

    def force(s):
        distance = np.linalg.norm(s)
        return -k * (distance - length) * s / distance

    r, v = spring_motion(m1, m2, k, positions, velocities, 1.9, length)
    expected = integrated(force, m1, m2, positions, velocities, 1.9)
    np.testing.assert_allclose(r[0], expected[0], atol=1e-10)
    np.testing.assert_allclose(v[0], expected[1], atol=1e-10)
    # One full swing of √(k/μ) brings the separation back.
    period = 2 * np.pi * np.sqrt(reduced_mass(m1, m2) / k)
    r, _ = spring_motion(m1, m2, k, positions, velocities, period, length)
    np.testing.assert_allclose(r[0, 0] - r[0, 1], positions[0] - positions[1], atol=1e-14)


@pytest.mark.parametrize("size", [2.0**40, 2.0**-40])
def test_a_spring_of_some_length_of_any_size(size):
    # What counts as motion along the line scales with it; 1e-14 of it across is too much.
    line = np.array([2.0, -1.0, 2.0]) / 3
    positions, velocities = np.array([0.4 * line, -line]), np.array([-0.3 * line, 0.5 * line])
    r, _ = spring_motion(0.7, 2.1, 5.0, positions, velocities, 1.9, 1.2)
    large, _ = spring_motion(0.7, 2.1, 5.0, size * positions, size * velocities, 1.9, size * 1.2)
    np.testing.assert_array_equal(large / size, r)
    velocities[0] += 1e-14 * np.array([1.0, 2.0, 0.0])
    with pytest.raises(InputError, match="across"):
        spring_motion(0.7, 2.1, 5.0, size * positions, size * velocities, 1.9, size * 1.2)


def test_the_phase_of_a_spring_survives_a_million_swings():
    m1, m2, k, t = 0.7, 2.1, 5.0, 3e6
    r, _ = spring_motion(m1, m2, k, R0, 0 * V0, t)
    with mp.workdps(40):
        omega = mp.sqrt(mp.mpf(k) * (mp.mpf(m1) + mp.mpf(m2)) / (mp.mpf(m1) * mp.mpf(m2)))
        swing = float(mp.cos(omega * t))
    np.testing.assert_allclose(r[0, 0] - r[0, 1], swing * (R0[0] - R0[1]), atol=1e-15)


@settings(max_examples=40, deadline=None)
@given(st.floats(0.01, 100), st.floats(0.01, 100), st.floats(-20, 20))
def test_what_two_bodies_conserve(m1, m2, t):
    masses = np.array([m1, m2])
    for r, v in (
        spring_motion(m1, m2, 3.0, R0, V0, [0.0, t]),
        gravity_motion(m1, m2, 0.6, R0, V0, [0.0, t]),
    ):
        centre = np.einsum("i,nic->nc", masses, r) / (m1 + m2)
        drift = masses @ V0 / (m1 + m2)
        np.testing.assert_allclose(
            centre[1] - centre[0], drift * t, atol=1e-14 * (1 + abs(t) + np.abs(r).max())
        )
        P = np.einsum("i,nic->nc", masses, v)
        np.testing.assert_allclose(P[1], masses @ V0, atol=1e-12 * (m1 + m2))
        L = np.einsum("i,nic->nc", masses, np.cross(r, v))
        np.testing.assert_allclose(L[1], L[0], atol=1e-12 * (m1 + m2) * (1 + np.abs(r).max()))


@pytest.mark.parametrize(("m1", "m2"), [(0.7, 2.1), (2.1, 0.7)])
def test_two_bodies_under_gravity_obey_newton(m1, m2):
    G = 0.9
    r, v = gravity_motion(m1, m2, G, R0, V0, [0.0, 3.0])
    np.testing.assert_allclose(r[0], R0, atol=2e-15)
    np.testing.assert_allclose(v[0], V0, atol=2e-15)
    expected = integrated(lambda s: -G * m1 * m2 * s / np.linalg.norm(s) ** 3, m1, m2, R0, V0, 3.0)
    np.testing.assert_allclose(r[1], expected[0], atol=1e-9)
    np.testing.assert_allclose(v[1], expected[1], atol=1e-9)


def test_a_heavy_centre_stays_and_the_light_body_follows_kepler():
    r, v = gravity_motion(1e-20, 2.0, 1.5, [[1, 0, 0], [0, 0, 0]], [[0, 1.2, 0], [0, 0, 0]], [0.4, 5.0])
    expected = kepler_orbit.motion(3.0, [1, 0, 0], [0, 1.2, 0], [0.4, 5.0])
    np.testing.assert_allclose(r[:, 0], expected[0], atol=1e-14)
    np.testing.assert_allclose(v[:, 0], expected[1], atol=1e-14)
    np.testing.assert_allclose(r[:, 1], 0, atol=1e-19)


def test_equal_masses_circle_their_middle():
    # Each at radius d/2: m v²/(d/2) = Gm²/d².
    G, m, d = 1.0, 2.0, 1.0
    speed = np.sqrt(G * m / (2 * d))
    period = np.pi * d / speed
    places = [[d / 2, 0, 0], [-d / 2, 0, 0]]
    r, _ = gravity_motion(m, m, G, places, [[0, speed, 0], [0, -speed, 0]], [period / 4, period])
    np.testing.assert_allclose(r[0], [[0, d / 2, 0], [0, -d / 2, 0]], atol=1e-15)
    np.testing.assert_allclose(r[1], places, atol=1e-15)


@pytest.mark.parametrize(
    "call",
    [
        lambda: reduced_mass(0.0, 1.0),
        lambda: reduced_mass(1.0, -1.0),
        lambda: spring_motion(1, 1, 0.0, R0, V0, 1.0),
        lambda: spring_motion(1, 1, 1.0, R0[0], V0, 1.0),
        lambda: spring_motion(1, 1, 1.0, R0, V0, np.nan),
        lambda: spring_motion(1, 1, 1.0, R0, V0, 1.0, -1.0),
        lambda: spring_motion(1, 1, 1.0, R0, V0, 1.0, 1.0),
        lambda: spring_motion(1, 1, 1.0, np.zeros((2, 3)), V0, 1.0, 1.0),
        lambda: spring_motion(1, 1, 1.0, [[1, 0, 0], [0, 0, 0]], [[5, 0, 0], [0, 0, 0]], 1.0, 1.0),
        lambda: gravity_motion(1, 1, 0.0, R0, V0, 1.0),
        lambda: gravity_motion(1, 1, 1.0, np.zeros((2, 3)), V0, 1.0),
    ],
)
def test_bad_input_is_refused(call):
    with pytest.raises(InputError):
        call()

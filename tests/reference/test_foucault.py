"""Foucault's pendulum: residuals of its equations, the matrix exponential, and the figures people quote."""

import mpmath as mp
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp
from poinsot.reference.errors import InputError
from poinsot.reference.foucault import motion, motion_on_a_turntable, precession_rate
from poinsot.reference.rotating_frames import apparent_accelerations

EARTH = 7.292115e-5
flat = hnp.arrays(float, 2, elements=st.floats(-2, 2))


def test_the_plane_at_the_pantheon_turns_by_11_3_degrees_an_hour():
    # The published figure for Paris, latitude 48° 51′: 11.3° an hour, once round in 31.8 hours.
    rate = precession_rate(EARTH, np.radians(48.846))
    assert np.degrees(rate) * 3600 == pytest.approx(-11.3, abs=0.05)
    assert 2 * np.pi / abs(rate) / 3600 == pytest.approx(31.8, abs=0.05)


def test_the_plane_turns_with_the_sun_in_the_north_and_stays_at_the_equator():
    assert precession_rate(EARTH, np.pi / 2) == -EARTH
    assert precession_rate(EARTH, -np.pi / 2) == EARTH
    assert precession_rate(EARTH, 0.0) == 0


@settings(max_examples=50, deadline=None)
@given(flat, flat, st.floats(-3, 3), st.floats(-1.5, 1.5), st.floats(-40, 40))
def test_the_equations_of_small_swings(r0, v0, Omega, latitude, t):
    # ẍ = −g/L x + 2Ωz ẏ and ÿ = −g/L y − 2Ωz ẋ (Taylor, sect. 9.9).
    L, g, h = 1.7, 9.81, 1e-3
    Oz = Omega * np.sin(latitude)
    r, v = motion(L, g, Omega, latitude, r0, v0, t + h * np.array([-2, -1, 0, 1, 2]))
    five = np.array([1, -8, 0, 8, -1]) / (12 * h)
    expected = -g / L * r[2] + 2 * Oz * np.array([v[2, 1], -v[2, 0]])
    # h⁴/30 times fifth derivatives up to 10⁴, and rounding over h.
    np.testing.assert_allclose(five @ v, expected, atol=1e-8)
    np.testing.assert_allclose(five @ r, v[2], atol=1e-8)
    energy = 0.5 * np.sum(v * v, 1) + 0.5 * g / L * np.sum(r * r, 1)
    start = 0.5 * v0 @ v0 + 0.5 * g / L * r0 @ r0
    np.testing.assert_allclose(energy, start, atol=1e-13 * (1 + start))  # Coriolis forces do no work


def test_the_start_and_a_late_time_to_all_digits():
    L, g, Omega, lat, r0, v0 = 2.3, 9.81, 0.9, 0.7, [0.3, -0.2], [0.1, 0.4]
    r, v = motion(L, g, Omega, lat, r0, v0, [0.0, 12.0, 1e7])
    np.testing.assert_allclose(r[0], r0, atol=1e-16)
    np.testing.assert_allclose(v[0], v0, atol=1e-16)
    with mp.workdps(40):
        Oz = -mp.mpf(precession_rate(Omega, lat))
        A = mp.zeros(4)
        A[0, 2] = A[1, 3] = 1
        A[2, 0] = A[3, 1] = -mp.mpf(g) / mp.mpf(L)
        A[2, 3], A[3, 2] = 2 * Oz, -2 * Oz
        expected = mp.expm(12 * A) * mp.matrix([mp.mpf(x) for x in (*r0, *v0)])
        got = [float(x) for x in expected]
        late = [mp.exp(mp.mpc(0, s * mp.sqrt(mp.mpf(g) / mp.mpf(L) + Oz**2) - Oz) * 10**7) for s in (1, -1)]
        w1, eta, rate = mp.sqrt(mp.mpf(g) / mp.mpf(L) + Oz**2), mp.mpc(*r0), mp.mpc(*v0)
        first = (eta + (rate + mp.mpc(0, 1) * Oz * eta) / mp.mpc(0, 1) / w1) / 2
        far = first * late[0] + (eta - first) * late[1]
    np.testing.assert_allclose([*r[1], *v[1]], got, atol=2e-15)
    np.testing.assert_allclose(r[2], [float(far.real), float(far.imag)], atol=2e-15)


def test_turning_points_of_a_pendulum_let_go_turn_at_the_precession_rate():
    L, g, Omega, lat = 67.0, 9.81, 1e-3, 0.85
    w1 = np.sqrt(g / L + (Omega * np.sin(lat)) ** 2)
    t = 2 * np.pi / w1 * np.arange(1, 200, 40)
    # Let go so that ζ̇ is 0: at rest in the room but for the turn of the axes.
    r, _ = motion(L, g, Omega, lat, [3.0, 0], [0, -3.0 * Omega * np.sin(lat)], t)
    bearing = np.unwrap(np.arctan2(r[:, 1], r[:, 0]))
    np.testing.assert_allclose(bearing, precession_rate(Omega, lat) * t, atol=1e-12)
    np.testing.assert_allclose(np.linalg.norm(r, axis=1), 3.0, rtol=1e-12)


@given(flat, flat, st.floats(-3, 3), st.floats(-20, 20))
def test_on_a_turntable_the_ellipse_stays_in_the_room(r0, v0, Omega, t):
    L, g = 1.7, 9.81
    w = np.sqrt(g / L)
    r, v = motion_on_a_turntable(L, g, Omega, r0, v0, t)
    turn = np.array([[np.cos(Omega * t), -np.sin(Omega * t)], [np.sin(Omega * t), np.cos(Omega * t)]])
    in_room = v0 + Omega * np.array([-r0[1], r0[0]])
    np.testing.assert_allclose(turn @ r[0], r0 * np.cos(w * t) + in_room * np.sin(w * t) / w, atol=1e-12)
    moving = v[0] + Omega * np.array([-r[0, 1], r[0, 0]])
    np.testing.assert_allclose(turn @ moving, in_room * np.cos(w * t) - r0 * w * np.sin(w * t), atol=1e-11)


def test_on_a_turntable_all_apparent_forces_act():
    L, g, Omega, h = 1.7, 9.81, 2.0, 1e-3
    r, v = motion_on_a_turntable(L, g, Omega, [0.3, 0.1], [-0.2, 0.5], 1.0 + h * np.array([-2, -1, 0, 1, 2]))
    coriolis, centrifugal, _ = apparent_accelerations([0, 0, Omega], [0, 0, 0], [*r[2], 0], [*v[2], 0])
    numeric = np.array([1, -8, 0, 8, -1]) / (12 * h) @ v
    np.testing.assert_allclose(numeric, (coriolis + centrifugal)[:2] - g / L * r[2], atol=1e-8)


@pytest.mark.parametrize(
    "call",
    [
        lambda: precession_rate(EARTH, 1.6),
        lambda: precession_rate(np.inf, 1.0),
        lambda: motion(0.0, 9.8, EARTH, 1.0, [0, 0], [0, 0], 1.0),
        lambda: motion(1.0, -9.8, EARTH, 1.0, [0, 0], [0, 0], 1.0),
        lambda: motion(1.0, 9.8, EARTH, 1.0, [0, 0, 0], [0, 0], 1.0),
        lambda: motion(1.0, 9.8, EARTH, 1.0, [0, 0], [0, np.nan], 1.0),
        lambda: motion_on_a_turntable(1.0, 0.0, 1.0, [0, 0], [0, 0], 1.0),
    ],
)
def test_bad_input_is_refused(call):
    with pytest.raises(InputError):
        call()

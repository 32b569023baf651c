"""Kepler orbits against universal variables in forty digits, an integration, and what orbits conserve."""

import mpmath as mp
import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp
from poinsot.reference import kepler_orbit
from poinsot.reference.errors import InputError
from poinsot.reference.kepler_equation import (
    eccentric_anomaly,
    hyperbolic_anomaly,
    less_sine,
    parabolic_anomaly,
    sine_less,
)
from scipy.integrate import solve_ivp

# Rounding of the equation in E itself, a few units in the last place.
ROUNDING = 2e-15
CENTRE = 3.7  # GM of the tests

GAPS = [1.0, 0.9, 0.3, 0.1, 1e-3, 1e-8, 1e-15, 0.0]


@pytest.mark.parametrize("gap", GAPS)
def test_keplers_equation_to_round_off(gap):
    M = np.array([1e-300, 1e-30, 1e-15, 1e-9, 1e-3, 0.1, 0.5, 1.0, 2.0, 3.0, 3.14159])
    E = eccentric_anomaly(M, 1 - gap, gap)
    with mp.workdps(330):
        for mean, got in zip(M, E, strict=True):
            x = mp.mpf(float(got))
            residual = mp.mpf(gap) * x + (1 - mp.mpf(gap)) * (x - mp.sin(x)) - mp.mpf(float(mean))
            slope = mp.mpf(gap) + (1 - mp.mpf(gap)) * (1 - mp.cos(x))
            assert abs(residual / slope) < ROUNDING * x
    np.testing.assert_array_equal(eccentric_anomaly(-M, 1 - gap, gap), -E)
    assert eccentric_anomaly(np.zeros(1), 1 - gap, gap)[0] == 0


@pytest.mark.parametrize("gap", [30.0, 1.0, 0.1, 1e-8, 1e-15, 0.0])
def test_the_hyperbolic_equation_to_round_off(gap):
    M = np.array([1e-300, 1e-30, 1e-9, 1e-3, 0.1, 1.0, 2.0, 3.0, 50.0, 1e6, 1e14])
    H = hyperbolic_anomaly(M, 1 + gap, gap)
    with mp.workdps(330):
        for mean, got in zip(M, H, strict=True):
            x = mp.mpf(float(got))
            residual = mp.mpf(gap) * mp.sinh(x) + mp.sinh(x) - x - mp.mpf(float(mean))
            slope = mp.mpf(gap) * mp.cosh(x) + mp.cosh(x) - 1
            assert abs(residual / slope) < ROUNDING * x
    np.testing.assert_array_equal(hyperbolic_anomaly(-M, 1 + gap, gap), -H)


def test_barkers_equation_to_round_off():
    M = np.array([-1e20, -3.0, -1e-5, 0.0, 1e-300, 4.0 / 3.0, 7.0, 1e30])
    D = parabolic_anomaly(M)
    np.testing.assert_allclose(D + D**3 / 3, M, rtol=1e-15)
    assert D[5] == pytest.approx(1.0, rel=1e-15)


def test_differences_from_the_argument_keep_their_digits():
    x = np.array([1e-100, 1e-6, 0.3, 0.99, 1.01, 3.0])
    with mp.workdps(260):
        low = [float(mp.mpf(float(y)) - mp.sin(mp.mpf(float(y)))) for y in x]
        high = [float(mp.sinh(mp.mpf(float(y))) - mp.mpf(float(y))) for y in x]
    np.testing.assert_allclose(less_sine(x), low, rtol=2e-15)
    np.testing.assert_allclose(sine_less(-x), -np.array(high), rtol=2e-15)


def universal(GM, r0, v0, t):
    """Place and velocity by Stumpff's functions in many digits (Danby, sect. 6.9): no anomaly, no case."""
    with mp.workdps(60):
        r0, v0 = ([mp.mpf(float(x)) for x in vector] for vector in (r0, v0))
        GM, t = mp.mpf(GM), mp.mpf(float(t))
        radius, sigma = mp.sqrt(sum(x * x for x in r0)), sum(x * y for x, y in zip(r0, v0, strict=True))
        alpha = 2 * GM / radius - sum(x * x for x in v0)

        def stumpff(s):
            x = alpha * s * s
            return [
                s**k * mp.nsum(lambda n, k=k: (-x) ** n / mp.factorial(2 * n + k), [0, 60]) for k in range(4)
            ]

        def late(s):
            _, c1, c2, c3 = stumpff(s)
            return radius * c1 + sigma * c2 + GM * c3 - t

        if t == 0:
            return np.array([float(x) for x in r0 + v0])
        # The time grows with s; a bracket, then bisection by secants.
        low, high = mp.mpf(0), t / radius
        while late(high) * mp.sign(t) < 0:
            low, high = high, 2 * high
        s = mp.findroot(late, (low, high), solver="anderson", tol=mp.mpf(10) ** -80)
        c0, c1, c2, c3 = stumpff(s)
        distance = radius * c0 + sigma * c1 + GM * c2
        f, g = 1 - GM / radius * c2, t - GM * c3
        df, dg = -GM * c1 / (radius * distance), 1 - GM * c2 / distance
        r = [f * x + g * y for x, y in zip(r0, v0, strict=True)]
        v = [df * x + dg * y for x, y in zip(r0, v0, strict=True)]
        return np.array([float(x) for x in r + v])


def starts():
    """One of each kind: circle, ellipses in all phases, next to a parabola on both sides, fast, straight."""
    circular = float(np.sqrt(CENTRE))
    escape = float(np.sqrt(2 * CENTRE))
    tilted = np.array([0.6, 0.48, 0.64])
    yield "circle", [1, 0, 0], [0, circular, 0]
    yield "nearly a circle", [1, 0, 0], [0, circular * (1 + 1e-12), 1e-13]
    yield "e = 0.1 at its nearest", [0.9, 0, 0], [0, np.sqrt(CENTRE * 1.1 / 0.9), 0]
    yield "e = 0.9 at its farthest", [1.9, 0, 0], [0, np.sqrt(CENTRE * 0.1 / 1.9), 0]
    yield "outward in space", tilted, [0.3, 0.9, -1.1]
    yield "inward in space", tilted, [-1.2, 0.2, -0.7]
    yield "e = 1 - 1e-6", [1, 0, 0], [0.1, 0, 0.0027]
    yield "just below escape", [1, 0, 0], [0, escape * (1 - 1e-14), 0]
    yield "just above escape", [1, 0, 0], [0, escape * (1 + 1e-14), 0]
    yield "exactly escape, oblique", [8, 0, 0], [0.5, 0.5, 0.5]  # GM = 3 below
    yield "fast", tilted, [4.0, -2.0, 3.0]
    yield "straight out, bound", [1, 0, 0], [1.0, 0, 0]
    yield "straight out, for ever", tilted, 5 * tilted
    yield "from rest", [2, -1, 2], [0, 0, 0]


@pytest.mark.parametrize(("name", "r0", "v0"), [pytest.param(*s, id=s[0]) for s in starts()])
def test_every_kind_of_orbit_against_universal_variables(name, r0, v0):
    GM = 3.0 if name.startswith("exactly") else CENTRE
    energy = 0.5 * np.dot(v0, v0) - GM / np.linalg.norm(r0)
    t = [0.05, 0.7] if name == "from rest" or name.startswith("straight") else [-2.3, 0.4]
    r, v = kepler_orbit.motion(GM, r0, v0, t)
    expected = np.array([universal(GM, r0, v0, when) for when in t])
    # Relative to the largest distance and speed of the motion: rounding of the last formula.
    np.testing.assert_allclose(r, expected[:, :3], atol=1e-14 * np.abs(expected[:, :3]).max())
    np.testing.assert_allclose(v, expected[:, 3:], atol=4e-14 * np.abs(expected[:, 3:]).max())
    assert np.sign(kepler_orbit.orbit(GM, r0, v0).energy) == np.sign(energy) or name.startswith("exactly")


def test_the_late_phase_is_not_lost():
    r0, v0 = [0.9, 0, 0], [0, np.sqrt(CENTRE * 1.1 / 0.9), 0]
    t = 1e6
    r, v = kepler_orbit.motion(CENTRE, r0, v0, t)
    with mp.workdps(60):
        R, V, GM = mp.mpf(0.9), mp.mpf(v0[1]), mp.mpf(CENTRE)
        a = 1 / (2 / R - V * V / GM)
        e = 1 - R / a
        n = mp.sqrt(GM / a**3)
        M = mp.fmod(n * t, 2 * mp.pi)
        E = mp.findroot(lambda x: x - e * mp.sin(x) - M, M)
        place = [a * (mp.cos(E) - e), a * mp.sqrt(1 - e * e) * mp.sin(E)]
        rate = n / (1 - e * mp.cos(E))
        speed = [-a * mp.sin(E) * rate, a * mp.sqrt(1 - e * e) * mp.cos(E) * rate]
    np.testing.assert_allclose(r[0], [*map(float, place), 0], atol=3e-15)
    np.testing.assert_allclose(v[0], [*map(float, speed), 0], atol=6e-15)


def test_an_integration_follows_the_same_orbit():
    r0, v0 = np.array([0.6, 0.48, 0.64]), np.array([0.3, 0.9, -1.1])

    def rates(_, y):
        return np.concatenate([y[3:], -CENTRE * y[:3] / np.linalg.norm(y[:3]) ** 3])

    y = solve_ivp(rates, (0, 5), np.concatenate([r0, v0]), method="DOP853", rtol=1e-12, atol=1e-13).y[:, -1]
    r, v = kepler_orbit.motion(CENTRE, r0, v0, 5.0)
    # The integrator's own error after some revolutions.
    np.testing.assert_allclose(np.concatenate([r[0], v[0]]), y, atol=2e-10)


vectors = hnp.arrays(float, 3, elements=st.floats(-2, 2))


@settings(max_examples=50, deadline=None)
@given(vectors, vectors, st.floats(-30, 30), st.floats(-30, 30))
def test_orbits_conserve_compose_and_turn_back(r0, v0, t1, t2):
    assume(np.linalg.norm(r0) > 0.2)
    assume(np.linalg.norm(np.cross(r0, v0)) > 0.1)
    orbit = kepler_orbit.orbit(CENTRE, r0, v0)
    r, v = kepler_orbit.motion(CENTRE, r0, v0, [0.0, t1, t1 + t2])
    fastest = 2 * CENTRE / np.linalg.norm(np.cross(r0, v0)) + np.linalg.norm(v0)
    np.testing.assert_allclose(r[0], r0, atol=1e-14 * (1 + np.abs(r).max()))
    np.testing.assert_allclose(v[0], v0, atol=1e-14 * fastest)
    distance = np.linalg.norm(r, axis=1)
    energy = 0.5 * np.sum(v * v, axis=1) - CENTRE / distance
    np.testing.assert_allclose(energy, orbit.energy, atol=1e-13 * fastest**2)
    np.testing.assert_allclose(np.cross(r, v), np.broadcast_to(orbit.angular_momentum, (3, 3)), atol=1e-12)
    lenz = np.cross(v, np.cross(r, v)) / CENTRE - r / distance[:, None]
    np.testing.assert_allclose(lenz, np.broadcast_to(orbit.eccentricity_vector, (3, 3)), atol=1e-12)
    again, speed = kepler_orbit.motion(CENTRE, r[1], v[1], t2)
    # A rounded place grows into a phase: by the number of radians gone through, up to fastest/nearest × 60 s.
    grown = 1e-15 * (1 + fastest / orbit.nearest * 60) * (1 + np.abs(r).max())
    np.testing.assert_allclose(again[0], r[2], atol=grown * 10)
    back, speed = kepler_orbit.motion(CENTRE, r[1], -v[1], t1)
    np.testing.assert_allclose(back[0], r0, atol=grown * 10)
    np.testing.assert_allclose(speed[0], -v0, atol=grown * 10 * fastest / orbit.nearest)


@pytest.mark.parametrize(("length", "time"), [(2.0**40, 2.0**-20), (2.0**-60, 2.0**30)])
@pytest.mark.parametrize("speed", [0.5, 1.9, 2.7, 3.5])
def test_units_do_not_matter(length, time, speed):
    # Powers of two scale doubles exactly: any threshold in the formulas would show.
    r0, v0, t = np.array([1.0, 0.1, 0]), np.array([0.2, speed, 0.3]), np.array([-1.0, 0.3, 40.0])
    r, v = kepler_orbit.motion(CENTRE, r0, v0, t)
    GM = CENTRE * length**3 / time**2
    r2, v2 = kepler_orbit.motion(GM, r0 * length, v0 * (length / time), t * time)
    np.testing.assert_allclose(r2 / length, r, rtol=1e-14)
    np.testing.assert_allclose(v2 / (length / time), v, rtol=1e-14)


def test_elements_a_textbook_gives():
    # Kepler's third law; vis viva; a comet of e = 0.9 is 19 times as far away at its farthest.
    GM, a, e = 2.0, 3.0, 0.9
    got = kepler_orbit.orbit(GM, [0, a * (1 - e), 0], [-np.sqrt(GM / a * (1 + e) / (1 - e)), 0, 0])
    assert got.semi_major_axis == pytest.approx(a, rel=1e-14)
    assert got.eccentricity == pytest.approx(e, rel=1e-14)
    assert got.nearest == pytest.approx(0.3, rel=1e-14)
    assert got.period == pytest.approx(2 * np.pi * np.sqrt(a**3 / GM), rel=1e-14)
    assert got.energy == pytest.approx(-GM / (2 * a), rel=1e-14)
    np.testing.assert_allclose(got.eccentricity_vector, [0, e, 0], atol=1e-15)
    np.testing.assert_allclose(got.angular_momentum, [0, 0, np.sqrt(GM * a * (1 - e**2))], rtol=1e-14)
    half, _ = kepler_orbit.motion(
        GM, [0, a * (1 - e), 0], [-np.sqrt(GM / a * (1 + e) / (1 - e)), 0, 0], got.period / 2
    )
    np.testing.assert_allclose(half[0], [0, -a * (1 + e), 0], atol=1e-14)


def test_unbound_orbits_have_the_textbook_elements():
    got = kepler_orbit.orbit(1.0, [1.0, 0, 0], [0, 2.0, 0])  # ε = 1, h = 2, p = 4, e = 3
    assert (got.energy, got.eccentricity, got.semi_major_axis, got.nearest) == (1.0, 3.0, -0.5, 1.0)
    assert got.period == np.inf
    r, v = kepler_orbit.motion(1.0, [1.0, 0, 0], [0, 2.0, 0], 1e8)
    assert np.linalg.norm(v) == pytest.approx(np.sqrt(2), rel=1e-8)
    # The asymptote stands at arccos(−1/e) (Goldstein, sect. 3.10).
    assert np.arctan2(r[0, 1], r[0, 0]) == pytest.approx(np.arccos(-1 / 3), abs=1e-6)
    parabola = kepler_orbit.orbit(0.5, [1.0, 0, 0], [0, 1.0, 0])
    assert (parabola.eccentricity, parabola.semi_major_axis, parabola.period) == (1.0, np.inf, np.inf)
    assert parabola.nearest == 1.0


def test_a_fall_from_rest_meets_the_centre_when_a_thin_ellipse_would():
    # Half the period of an ellipse of half the axis: π/2 √(r³/2GM).
    R = 1.7
    meeting = np.pi / 2 * np.sqrt(R**3 / (2 * CENTRE))
    r, v = kepler_orbit.motion(CENTRE, [0, 0, R], [0, 0, 0], meeting * (1 - 1e-9))
    assert 0 < r[0, 2] < 1e-5
    assert v[0, 2] < -100
    for t in (meeting * (1 + 1e-9), -meeting * (1 + 1e-9), 5 * meeting):
        with pytest.raises(InputError, match="met"):
            kepler_orbit.motion(CENTRE, [0, 0, R], [0, 0, 0], [0.0, t])
    assert kepler_orbit.motion(CENTRE, [0, 0, R], [0, 0, 0], -0.1)[0][0, 2] < R


def test_straight_flights_that_have_left_or_will_meet():
    for v in (1.0, 1.5):  # exactly escape, and faster
        r, _ = kepler_orbit.motion(0.5, [1.0, 0, 0], [v, 0, 0], [0.0, 2.0])
        assert r[1, 0] > r[0, 0] == 1.0
        with pytest.raises(InputError, match="met"):
            kepler_orbit.motion(0.5, [1.0, 0, 0], [v, 0, 0], -1.0)
        with pytest.raises(InputError, match="met"):
            kepler_orbit.motion(0.5, [1.0, 0, 0], [-v, 0, 0], 1.0)
    # r^(3/2) grows evenly at exactly the speed of escape: r = (1 + 3t/2)^(2/3).
    r, v = kepler_orbit.motion(0.5, [1.0, 0, 0], [1.0, 0, 0], 2.0)
    assert r[0, 0] == pytest.approx(4 ** (2 / 3), rel=1e-15)
    assert v[0, 0] == pytest.approx(4 ** (-1 / 3), rel=1e-15)


@pytest.mark.parametrize(
    "call",
    [
        lambda: kepler_orbit.motion(0.0, [1, 0, 0], [0, 1, 0], 1.0),
        lambda: kepler_orbit.motion(1.0, [0, 0, 0], [0, 1, 0], 1.0),
        lambda: kepler_orbit.motion(1.0, [1, 0], [0, 1, 0], 1.0),
        lambda: kepler_orbit.motion(1.0, [1, 0, 0], [0, np.nan, 0], 1.0),
        lambda: kepler_orbit.motion(1.0, [1, 0, 0], [0, 1, 0], 1e20),
        lambda: kepler_orbit.orbit(-1.0, [1, 0, 0], [0, 1, 0]),
    ],
)
def test_bad_input_is_refused(call):
    with pytest.raises(InputError):
        call()

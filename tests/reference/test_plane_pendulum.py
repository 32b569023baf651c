"""The plane pendulum against a 40-digit Taylor integration, its invariants and tabled periods."""

import mpmath
import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from poinsot.reference import plane_pendulum as pendulum
from poinsot.reference.errors import InputError

G, L = 9.81, 0.8
W = np.sqrt(G / L)


def integrated(theta, rate, t, order=40):
    """(θ, θ̇) at t by Taylor series at 40 digits, from exact doubles."""
    with mpmath.workdps(40):
        square = mpmath.mpf(G) / mpmath.mpf(L)
        theta, rate, t = mpmath.mpf(theta), mpmath.mpf(rate), mpmath.mpf(t)
        # Three steps per radian of the fastest motion, leave 1e-28: four times as many change no more.
        steps = int(mpmath.ceil(3 * abs(t) * (mpmath.sqrt(square) + abs(rate)))) or 1
        h = t / steps
        for _ in range(steps):
            x, s, c = [theta, rate], [mpmath.sin(theta)], [mpmath.cos(theta)]
            for j in range(order):
                x.append(-square * s[j] / ((j + 1) * (j + 2)))
                terms = [i * x[i] for i in range(1, j + 2)]
                s.append(mpmath.fdot(terms, c[j::-1]) / (j + 1))
                c.append(-mpmath.fdot(terms, s[j::-1]) / (j + 1))
            powers = [h**i for i in range(order + 2)]
            theta = mpmath.fdot(x, powers)
            rate = mpmath.fdot([i * x[i] for i in range(1, order + 2)], powers[:-1])
        return theta, rate


STARTS = {
    "small": (0.01, 0.0),
    "wide": (2.5, -1.0),
    "downward from the left": (-2.9, -0.7),
    "near the top": (3.14, -0.1),
    "on its head but for rounding": (np.pi, 0.0),
    "separatrix": (0.0, 2 * W),
    "1e-8 inside": (0.0, 2 * W * (1 - 1e-8)),
    "1e-12 inside": (0.0, -2 * W * (1 - 1e-12)),
    "1e-12 outside": (0.0, 2 * W * (1 + 1e-12)),
    "1e-8 outside": (1.0, -2 * W * np.cos(0.5) * (1 + 1e-8)),
    "round": (0.4, 3 * W),
    "round backwards": (-1.0, -6 * W),
    "turns before the start": (20.0, -0.3),
    "turns and round": (-20.0, 2.3 * W),
}


@pytest.mark.parametrize("start", STARTS.values(), ids=STARTS)
@pytest.mark.parametrize("t", [1.9, -0.7])
def test_motion_is_that_of_a_forty_digit_integration(start, t):
    expected, expected_rate = integrated(*start, t)
    theta, rate = pendulum.motion(G, L, *start, [t])
    # One rounding of θ itself, a few of what it is made of.
    assert abs(theta[0] - expected) < 4e-16 + 2.3e-16 * abs(expected)
    assert abs(rate[0] - expected_rate) < 1e-15 * max(2 * W, abs(start[1]))


@pytest.mark.parametrize("start", STARTS.values(), ids=STARTS)
def test_a_thousand_seconds(start):
    # The formula above in mpmath's own elliptic functions, at 60 digits, without any reduction of phases.
    with mpmath.workdps(60):
        w = mpmath.sqrt(mpmath.mpf(G) / mpmath.mpf(L))
        half, p = mpmath.mpf(start[0]) / 2, start[1] / (2 * w)
        s, c = mpmath.sin(half), mpmath.cos(half)
        m = s * s + p * p
        if m > 1:
            way, r = mpmath.sign(p), mpmath.sqrt(m)
            u = w * r * 1000 + mpmath.ellipf(way * half, 1 / m)
            sn, cn, dn = (mpmath.ellipfun(name, u, m=1 / m) for name in ("sn", "cn", "dn"))
            expected = [way * sn, cn], 2 * way * w * r * dn
        else:
            r, sign = mpmath.sqrt(m), mpmath.sign(c)
            u0 = mpmath.ellipf(mpmath.asin(sign * s / r), m)
            u = w * 1000 + (2 * mpmath.ellipk(m) - u0 if p < 0 else u0)
            sn, cn, dn = (mpmath.ellipfun(name, u, m=m) for name in ("sn", "cn", "dn"))
            expected = [sign * r * sn, sign * dn], 2 * w * r * cn
    theta, rate = pendulum.motion(G, L, *start, [1000.0])
    # θ itself is rounded on the scale of the turns it has made.
    slack = 1e-15 + np.spacing(abs(theta[0]))
    np.testing.assert_allclose(
        [np.sin(theta[0] / 2), np.cos(theta[0] / 2)], [float(x) for x in expected[0]], rtol=0, atol=slack
    )
    assert rate[0] == pytest.approx(float(expected[1]), abs=2e-15 * max(2 * W, abs(start[1])))


starts = st.tuples(st.floats(-9, 9).map(lambda x: round(x, 9)), st.floats(-30, 30).map(lambda x: round(x, 9)))


@given(starts, st.floats(-100, 100))
def test_energy_is_kept(start, t):
    theta, rate = pendulum.motion(G, L, *start, [0.0, t])
    energy = rate**2 / (2 * W) ** 2 + np.sin(theta / 2) ** 2
    # θ̇ and θ are rounded once each; the largest is some hundred turns.
    assert abs(np.diff(energy)[0]) < 1e-13 * max(1, energy[0])
    np.testing.assert_allclose([theta[0], rate[0]], start, rtol=1e-15, atol=1e-15)


@given(starts, st.floats(-3, 3), st.floats(-3, 3))
def test_motion_composes_and_reverses(start, first, second):
    theta, rate = pendulum.motion(G, L, *start, [first, first + second])
    on, on_rate = pendulum.motion(G, L, theta[0], rate[0], [(first + second) - first])
    # Nearby pendulums part at most as exp(ω0 t), here e^10, from a rounding of the state between.
    slack = 1e-15 * np.exp(W * abs(second)) * (1 + abs(start[1]))
    np.testing.assert_allclose(on[0], theta[1], rtol=0, atol=slack)
    np.testing.assert_allclose(on_rate[0], rate[1], rtol=0, atol=slack * (W + abs(start[1])))
    mirrored, mirrored_rate = pendulum.motion(G, L, -start[0], -start[1], [first])
    np.testing.assert_allclose([mirrored[0], mirrored_rate[0]], [-theta[0], -rate[0]], rtol=1e-15, atol=1e-30)
    back, back_rate = pendulum.motion(G, L, start[0], -start[1], [-first])
    np.testing.assert_allclose([back[0], -back_rate[0]], [theta[0], rate[0]], rtol=1e-13, atol=1e-13)


@given(starts, st.integers(-20, 20))
def test_units_change_nothing(start, k):
    # Lengths × 4^k and times × 2^k: the same numbers, bit for bit.
    t = np.array([0.3, 2.0])
    theta, rate = pendulum.motion(G, L, *start, t)
    scaled, scaled_rate = pendulum.motion(G, L * 4.0**k, start[0], start[1] / 2.0**k, t * 2.0**k)
    np.testing.assert_array_equal(scaled, theta)
    np.testing.assert_array_equal(scaled_rate * 2.0**k, rate)


@given(starts, st.floats(0.01, 3))
def test_acceleration_is_the_slope_of_the_rate(start, t):
    h = 1e-4
    assume(abs(start[1]) < 20)
    theta, rate = pendulum.motion(G, L, *start, t + h * np.array([-2, -1, 0, 1, 2]))
    slope = (8 * (rate[3] - rate[1]) - (rate[4] - rate[0])) / (12 * h)
    # Rounding over h, and h⁴/30 of a fifth derivative.
    assert slope == pytest.approx(pendulum.acceleration(G, L, theta[2]), abs=1e-6)
    assert (8 * (theta[3] - theta[1]) - (theta[4] - theta[0])) / (12 * h) == pytest.approx(rate[2], abs=1e-6)


def test_at_rest_it_stays():
    for turns in (0.0, 2 * np.pi):
        theta, rate = pendulum.motion(G, L, turns, 0.0, [-1e6, 0.0, 1e6])
        np.testing.assert_allclose(theta, turns, rtol=0, atol=1e-9 * turns)
        np.testing.assert_allclose(rate, 0, atol=1e-14)
    theta, rate = pendulum.motion(G, L, 0.0, 0.0, [-1.0, 1.0])
    assert not theta.any()
    assert not rate.any()


def test_small_swings_are_harmonic():
    a, t = 1e-6, np.linspace(-3, 3, 13)
    theta, rate = pendulum.motion(G, L, a, 0.0, t)
    # The cubic term shifts the phase by a²/16 per radian.
    np.testing.assert_allclose(theta, a * np.cos(W * t), rtol=0, atol=1e-12 * a)
    np.testing.assert_allclose(rate, -a * W * np.sin(W * t), rtol=0, atol=4e-12 * a)


def test_on_the_separatrix_it_creeps_to_the_top():
    # With g/l = 1 the separatrix is exact: sin(θ/2) = tanh t.
    t = np.array([-30.0, -2.0, 0.0, 0.5, 5.0, 30.0, 300.0])
    for way in (1, -1):
        theta, rate = pendulum.motion(1.0, 1.0, 0.0, 2.0 * way, t)
        np.testing.assert_allclose(theta, way * 2 * np.arctan(np.sinh(t)), rtol=1e-15)
        np.testing.assert_allclose(rate, way * 2 / np.cosh(t), rtol=1e-15)


def test_a_turn_takes_a_rotation_period_and_a_swing_a_period():
    whirl = pendulum.rotation_period(G, L, 2.5 * W)
    theta, rate = pendulum.motion(G, L, 0.0, -2.5 * W, whirl * np.arange(-3, 4))
    np.testing.assert_allclose(theta, -2 * np.pi * np.arange(-3, 4), rtol=0, atol=1e-14)
    np.testing.assert_allclose(rate, -2.5 * W, rtol=1e-15)
    swing = pendulum.period(G, L, 2.0)
    theta, rate = pendulum.motion(G, L, 2.0, 0.0, swing * np.array([-1, -0.5, -0.25, 0.25, 0.5, 1]))
    np.testing.assert_allclose(theta, [2, -2, 0, 0, -2, 2], rtol=0, atol=4e-15)
    np.testing.assert_allclose(rate[[2, 3]], [2 * W * np.sin(1.0), -2 * W * np.sin(1.0)], rtol=1e-14)


@pytest.mark.parametrize(
    ("degrees", "K"),
    # Abramowitz & Stegun, *Handbook of Mathematical Functions*, table 17.1, at m = sin²(a/2) = ¼, ½, ¾.
    [(60, 1.68575035481260), (90, 1.85407467730137), (120, 2.15651564749964)],
)
def test_periods_as_tabled(degrees, K):
    assert pendulum.period(G, L, np.radians(degrees)) * W / 4 == pytest.approx(K, abs=1e-14)


def test_period_at_its_limits():
    small = 2 * np.pi / W
    assert pendulum.period(G, L, 0.0) == pytest.approx(small, rel=1e-15, abs=0)
    # 1 + a²/16 + 11a⁴/3072 (Landau & Lifshitz § 11, problem 1, has the first term).
    a = 0.01
    assert pendulum.period(G, L, a) / small == pytest.approx(1 + a**2 / 16 + 11 * a**4 / 3072, abs=1e-15)
    # Near the top 4K → 4 ln(4/cos(a/2)); π − a is known to 4e-16.
    a = np.pi - 1e-6
    assert pendulum.period(G, L, a) * W == pytest.approx(4 * np.log(8 / (np.pi - a)), rel=1e-9, abs=0)
    # Fast rotation: 2π/Ω (1 + ω0²/Ω² …).
    assert pendulum.rotation_period(G, L, -1e6) == pytest.approx(2 * np.pi / 1e6, rel=1e-10, abs=0)


@pytest.mark.parametrize(
    "arguments",
    [
        (0.0, 1.0, 0.0, 0.0, [0.0]),
        (1.0, -1.0, 0.0, 0.0, [0.0]),
        (1.0, 1.0, np.nan, 0.0, [0.0]),
        (1.0, 1.0, 0.0, np.inf, [0.0]),
        (1.0, 1.0, [0.0], 0.0, [0.0]),
        (1.0, 1.0, 0.0, 1.0, [np.nan]),
        (1.0, 1.0, 0.1, 1.0, [1e30]),
        (1.0, 1.0, 1e30, 1.0, [0.0]),
    ],
)
def test_bad_input_is_refused(arguments):
    with pytest.raises(InputError):
        pendulum.motion(*arguments)


def test_bad_amplitudes_and_rates_are_refused():
    for a in (-0.1, np.pi, 4.0, np.nan):
        with pytest.raises(InputError, match="amplitude"):
            pendulum.period(G, L, a)
    for rate in (0.0, 1.9 * W, -1.9 * W, 2.0):
        with pytest.raises(InputError, match="rate_below"):
            pendulum.rotation_period(G, L, rate)
    for call in (pendulum.period, pendulum.rotation_period, pendulum.acceleration):
        for gravity, length in ((0.0, 1.0), (1.0, 0.0)):
            with pytest.raises(InputError):
                call(gravity, length, 3.0)

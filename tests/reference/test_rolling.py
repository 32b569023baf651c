"""Rolling and slipping: forces and torques at every instant, thresholds, energies, textbook cases."""

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from poinsot.reference.errors import InputError
from poinsot.reference.rolling import GYRATION, down_an_incline, rolling_acceleration, slipping_slope

G = 9.81


def test_the_accelerations_of_common_shapes():
    # Goldstein, sect. 2.4: a hoop g sinθ/2; sphere 5/7, disc 2/3, thin hollow sphere 3/5.
    expected = {"hoop": 1 / 2, "disc": 2 / 3, "cylinder": 2 / 3, "sphere": 5 / 7, "thin hollow sphere": 3 / 5}
    for shape, factor in expected.items():
        got = rolling_acceleration(G, 0.3, GYRATION[shape])
        assert got == pytest.approx(factor * G * np.sin(0.3), rel=1e-15)
    assert rolling_acceleration(G, 0.3, 0.0) == G * np.sin(0.3)
    assert rolling_acceleration(G, -0.3, 0.4) == -rolling_acceleration(G, 0.3, 0.4)


def test_the_slopes_where_rolling_ends():
    # tanθ = 2μ hoop, 3μ disc, 3.5μ sphere.
    for shape, factor in {"hoop": 2, "disc": 3, "sphere": 3.5}.items():
        assert np.tan(slipping_slope(0.3, GYRATION[shape])) == pytest.approx(factor * 0.3, rel=1e-14)
    assert slipping_slope(0.0, 0.4) == 0
    assert slipping_slope(0.0, 0.0) == slipping_slope(0.3, 0.0) == np.pi / 2


@pytest.mark.parametrize("shape", sorted(GYRATION))
@pytest.mark.parametrize("ratio", [0.5, 0.999999, 1.000001, 1.5])
def test_from_rest_on_both_sides_of_the_threshold(shape, ratio):
    kk, mu, a = GYRATION[shape], 0.3, 0.2
    theta = np.arctan(ratio * mu * (1 + 1 / kk))
    got = down_an_incline(a, kk, G, theta, mu, [0.0, 2.0])
    if ratio < 1:
        acceleration, spin = G * np.sin(theta) / (1 + kk), G * np.sin(theta) / (1 + kk) / a
        np.testing.assert_array_equal(got.slip, 0)
        assert got.friction[1] == pytest.approx(G * np.sin(theta) / (1 + 1 / kk), rel=1e-14)
    else:
        acceleration = G * (np.sin(theta) - mu * np.cos(theta))
        spin = mu * G * np.cos(theta) / (kk * a)
        assert got.slip[1] == pytest.approx(2 * (acceleration - a * spin), rel=1e-9, abs=1e-13)
        assert got.slip[1] > 0
    np.testing.assert_allclose(got.v, [0, 2 * acceleration], rtol=1e-14)
    np.testing.assert_allclose(got.x, [0, 2 * acceleration], rtol=1e-14)
    np.testing.assert_allclose(got.omega, [0, 2 * spin], rtol=1e-14)
    np.testing.assert_allclose(got.angle, [0, 2 * spin], rtol=1e-14)


def test_a_bowling_ball_rolls_after_the_textbook_time():
    # Thrown without turning on a level lane: rolls at t = 2v/7μg with 5v/7, after 12v²/49μg.
    v0, mu, a = 7.0, 0.2, 0.11
    t = 2 * v0 / (7 * mu * G)
    got = down_an_incline(a, 0.4, G, 0.0, mu, [0.0, t / 2, t, 2 * t], v0)
    np.testing.assert_allclose(got.v, [7.0, 6.0, 5.0, 5.0], rtol=1e-15)
    np.testing.assert_allclose(a * got.omega, [0.0, 2.5, 5.0, 5.0], atol=1e-14)
    assert got.x[2] == pytest.approx(12 * v0**2 / (49 * mu * G), rel=1e-15)
    assert got.x[3] - got.x[2] == pytest.approx(5.0 * t, rel=1e-14)
    assert got.friction[1] == mu * G
    assert got.friction[3] == 0
    assert got.angle[2] == pytest.approx(2.5 * t / a, rel=1e-14)


starts = st.floats(-5, 5)


@given(st.floats(-1.5, 1.5), st.floats(0, 1), st.floats(0.1, 1), starts, starts, st.floats(0.01, 4))
def test_newton_and_coulomb_hold_at_every_instant(theta, mu, kk, v0, rim, t):
    a = 0.3
    h = 1e-4
    got = down_an_incline(a, kk, G, theta, mu, [t - h, t, t + h], v0, rim / a)
    # Stretches of constant acceleration: central differences are exact except across a change.
    assume(got.friction[0] == got.friction[2])
    acceleration = (got.v[2] - got.v[0]) / (2 * h)
    alpha = (got.omega[2] - got.omega[0]) / (2 * h)
    f = got.friction[1]
    assert acceleration == pytest.approx(G * np.sin(theta) - f, abs=1e-9)
    assert kk * a * alpha == pytest.approx(f, abs=1e-9)
    assert (got.x[2] - got.x[0]) / (2 * h) == pytest.approx(got.v[1], abs=1e-9)
    assert (got.angle[2] - got.angle[0]) / (2 * h) == pytest.approx(got.omega[1], abs=1e-8)
    limit = mu * G * np.cos(theta)
    assert abs(f) <= limit * (1 + 1e-15)
    if got.slip[1] != 0:
        assert f == pytest.approx(np.copysign(limit, got.slip[1]), abs=1e-12)
    assert got.slip[1] == pytest.approx(got.v[1] - a * got.omega[1], abs=1e-12)


@given(st.floats(-1.5, 1.5), st.floats(0, 1), st.floats(0.1, 1), starts, starts, st.floats(0, 4))
def test_energy_is_lost_to_slipping_alone(theta, mu, kk, v0, rim, t):
    a = 0.3
    times = np.linspace(0, t, 2001)
    got = down_an_incline(a, kk, G, theta, mu, times, v0, rim / a)
    energy = 0.5 * got.v**2 + 0.5 * kk * (a * got.omega) ** 2 - G * np.sin(theta) * got.x
    power = got.friction * got.slip
    lost = np.sum(0.5 * (power[1:] + power[:-1]) * np.diff(times))
    # Trapezoids err by one step of the power where slipping ends.
    assert energy[0] - energy[-1] == pytest.approx(lost, abs=np.abs(power).max() * t / 1000 + 1e-9)


@pytest.mark.parametrize(("mu", "v0"), [(0.0, 1.0), (1e-311, 1.0), (1e-200, 1e-200)])
def test_next_to_no_friction(mu, v0):
    got = down_an_incline(0.3, 0.4, G, 0.0, mu, [0.0, 3.0], v0)
    assert got.v[1] == pytest.approx(v0 if mu < v0 else 5 / 7 * v0, rel=1e-15, abs=0)
    assert (got.slip[1] == 0) == (mu == v0)


def test_backspin_brings_a_ball_back():
    # Kicked on a level floor with aω = −5 v: it stops, comes back and rolls at (v0 + kk aω0)/(1 + kk).
    got = down_an_incline(0.5, 0.4, G, 0.0, 0.1, [0.0, 50.0], 2.0, -20.0)
    assert got.v[1] == pytest.approx((2.0 - 0.4 * 10.0) / 1.4, rel=1e-14)
    assert got.slip[1] == 0


def test_thrown_uphill_too_steep_to_roll_it_slips_back_down():
    theta, mu = 1.2, 0.1
    got = down_an_incline(0.5, 0.4, G, theta, mu, [0.0, 0.1, 30.0], -3.0)
    assert got.friction[0] == pytest.approx(-mu * G * np.cos(theta))
    assert got.friction[2] == pytest.approx(mu * G * np.cos(theta))
    assert got.slip[2] > 0


@pytest.mark.parametrize(
    "call",
    [
        lambda: rolling_acceleration(-1.0, 0.1, 0.4),
        lambda: rolling_acceleration(G, 1.6, 0.4),
        lambda: rolling_acceleration(G, 0.1, -0.4),
        lambda: slipping_slope(-0.1, 0.4),
        lambda: slipping_slope(0.1, -0.4),
        lambda: down_an_incline(0.0, 0.4, G, 0.1, 0.1, 1.0),
        lambda: down_an_incline(1.0, 0.0, G, 0.1, 0.1, 1.0),
        lambda: down_an_incline(1.0, 0.4, -G, 0.1, 0.1, 1.0),
        lambda: down_an_incline(1.0, 0.4, G, 1.6, 0.1, 1.0),
        lambda: down_an_incline(1.0, 0.4, G, 0.1, -0.1, 1.0),
        lambda: down_an_incline(1.0, 0.4, G, 0.1, 0.1, [1.0, -1.0]),
        lambda: down_an_incline(1.0, 0.4, G, 0.1, 0.1, 1.0, np.nan),
        lambda: down_an_incline(1.0, 0.4, G, 0.1, 0.1, 1.0, 0.0, np.inf),
    ],
)
def test_bad_input_is_refused(call):
    with pytest.raises(InputError):
        call()

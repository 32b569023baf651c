"""The rocket against Newton's law for what changes its mass, and many digits near the start and the end."""

import mpmath as mp
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from poinsot.reference.errors import InputError
from poinsot.reference.rocket import rocket_mass, rocket_motion


def exact(m0, gamma, u, g, t):
    with mp.workdps(50):
        m0, gamma, u, g, t = (mp.mpf(x) for x in (m0, gamma, u, g, t))
        tau = m0 / gamma
        left = 1 - t / tau
        v = -g * t - u * mp.log(left)
        return float(u * (t + (tau - t) * mp.log(left)) - g * t * t / 2), float(v)


@given(st.floats(1, 100), st.floats(0.01, 10), st.floats(0.0, 3000), st.floats(-8, -1e-5))
def test_all_digits_from_the_first_instant_to_the_last(m0, gamma, u, logarithm):
    t = float(m0 / gamma * 10**logarithm)
    z, v = rocket_motion(m0, gamma, u, 0.0, t)
    expected = exact(m0, gamma, u, 0.0, t)
    # Near the end 1 − γt/m0 has lost digits in t itself.
    loss = 1 / (1 - 10**logarithm)
    assert z[0] == pytest.approx(expected[0], rel=4e-15 + 1e-15 * loss)
    assert v[0] == pytest.approx(expected[1], rel=4e-15 + 1e-15 * loss)


@pytest.mark.parametrize("x", [-5.0, -0.2, 0.0999999, 0.1000001, 0.5, 0.99])
def test_both_forms_of_the_height(x):
    z, v = rocket_motion(2.0, 0.5, 7.0, 9.81, 4.0 * x, z0=3.0, v0=-2.0)
    expected = exact(2.0, 0.5, 7.0, 9.81, 4.0 * x)
    assert z[0] == pytest.approx(expected[0] + 3.0 - 2.0 * 4.0 * x, rel=1e-14, abs=1e-13)
    assert v[0] == pytest.approx(expected[1] - 2.0, rel=1e-14, abs=1e-13)


def test_the_motion_obeys_the_rockets_law():
    # m v̇ = γu − mg (Taylor, sect. 3.2): five-point differences of v and of z.
    m0, gamma, u, g, h = 5.0, 0.4, 30.0, 9.81, 1e-3
    t = 3.0 + h * np.array([-2, -1, 0, 1, 2])
    z, v = rocket_motion(m0, gamma, u, g, t, 1.0, 2.0)
    five = np.array([1, -8, 0, 8, -1]) / (12 * h)
    m = rocket_mass(m0, gamma, 3.0)[0]
    assert m == pytest.approx(5.0 - 1.2, rel=1e-15)
    assert m * (five @ v) == pytest.approx(gamma * u - m * g, abs=1e-10)
    assert five @ z == pytest.approx(v[2], abs=1e-10)


def test_tsiolkovskys_speed():
    # Without gravity, burning to 1/e of the mass gains exactly the exhaust speed.
    _, v = rocket_motion(1.0, 1.0, 3.0, 0.0, 1 - np.exp(-1))
    assert v[0] == pytest.approx(3.0, rel=1e-15)


def test_a_rocket_that_does_not_burn_falls():
    z, v = rocket_motion(1.0, 0.0, 100.0, 9.81, [0.0, 2.0], 5.0, 1.0)
    np.testing.assert_allclose(z, [5.0, 7.0 - 0.5 * 9.81 * 4])
    np.testing.assert_allclose(v, [1.0, 1.0 - 2 * 9.81])


def test_the_last_instant_is_finite():
    t = np.nextafter(3.0 / 0.7, 0)
    z, v = rocket_motion(3.0, 0.7, 10.0, 0.0, t)
    assert np.isfinite(z[0])
    assert np.isfinite(v[0])
    assert v[0] > 300
    assert z[0] == pytest.approx(10.0 * t, rel=1e-13)  # x + (1 − x) ln(1 − x) is 1 at the end


@pytest.mark.parametrize(
    "call",
    [
        lambda: rocket_motion(0.0, 1.0, 1.0, 9.8, 0.1),
        lambda: rocket_motion(1.0, -1.0, 1.0, 9.8, 0.1),
        lambda: rocket_motion(1.0, 1.0, -1.0, 9.8, 0.1),
        lambda: rocket_motion(1.0, 1.0, 1.0, 9.8, [0.1, 1.0]),
        lambda: rocket_motion(1.0, 1.0, 1.0, np.nan, 0.1),
        lambda: rocket_motion(1.0, 1.0, 1.0, 9.8, 0.1, np.inf),
        lambda: rocket_mass(1.0, 1.0, 2.0),
    ],
)
def test_bad_input_is_refused(call):
    with pytest.raises(InputError):
        call()

"""Tidal accelerations against Newton in many digits, named points and Taylor's heights."""

import mpmath as mp
import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp
from poinsot.reference.errors import InputError
from poinsot.reference.tides import tidal_acceleration, tidal_tensor, tide_at_named_points, tide_height

MOON = (4.9028e12, 3.844e8, 6.371e6)  # GM, distance, radius of the Earth


def exact(GM, d0, r):
    with mp.workdps(60):
        a = [mp.mpf(float(x)) for x in d0]
        d = [x + mp.mpf(float(y)) for x, y in zip(a, r, strict=True)]
        d3, a3 = (sum(x * x for x in v) ** (mp.mpf(3) / 2) for v in (d, a))
        return np.array([float(-GM * (x / d3 - y / a3)) for x, y in zip(d, a, strict=True)])


@given(
    hnp.arrays(float, 3, elements=st.floats(0.1, 2)),
    hnp.arrays(float, 3, elements=st.floats(-1, 1)),
    st.floats(-14, -0.7),
)
def test_the_difference_keeps_its_digits_at_any_distance(d0, r, size):
    assume(np.linalg.norm(r) > 0.01)
    r = r * 10**size * 0.1
    expected = exact(3.0, d0, r)
    # Relative to the tide itself, which is smaller than the attraction by up to 1e14.
    scale = 3.0 * np.linalg.norm(r) / np.linalg.norm(d0) ** 3
    np.testing.assert_allclose(tidal_acceleration(3.0, d0, r), expected, atol=2e-15 * scale)


def test_the_moon_at_the_named_points():
    GM, d, R = MOON
    near, far, side = tide_at_named_points(GM, d, R)
    points = tidal_acceleration(GM, [d, 0, 0], [[-R, 0, 0], [R, 0, 0], [0, R, 0]])
    assert points[0] == pytest.approx([-near, 0, 0], rel=1e-14)
    assert points[1] == pytest.approx([far, 0, 0], rel=1e-14)
    assert points[2, 1] == pytest.approx(-side, rel=1e-14)
    assert points[2, 0] == pytest.approx(1.5 * R / d * side, rel=1e-3)
    assert near > far > 1.9 * side > 0
    # First order: 2GMR/d³ outward, GMR/d³ inward.
    assert (near + far) / 2 == pytest.approx(2 * GM * R / d**3, rel=2 * (R / d) ** 2 * 2)
    assert side == pytest.approx(GM * R / d**3, rel=2 * (R / d) ** 2)


def test_the_tensor_is_the_first_order():
    d0, r = np.array([0.3, -2.0, 1.1]), np.array([0.2, 0.5, -0.4])
    tensor = tidal_tensor(2.0, d0)
    small = 1e-7
    np.testing.assert_allclose(tidal_acceleration(2.0, d0, small * r) / small, tensor @ r, rtol=1e-6)
    assert np.trace(tensor) == pytest.approx(0, abs=1e-16)  # no sources in empty space
    np.testing.assert_allclose(tensor @ d0, 2 * 2.0 / np.linalg.norm(d0) ** 3 * d0, rtol=1e-14)


def test_the_heights_of_the_tides():
    # Taylor, sect. 9.2: 54 cm by the moon, 25 cm by the sun.
    assert tide_height(7.35e22 / 5.98e24, 3.84e8, 6.37e6) == pytest.approx(0.54, abs=0.005)
    assert tide_height(1.99e30 / 5.98e24, 1.495e11, 6.37e6) == pytest.approx(0.25, abs=0.005)


def test_the_height_balances_the_tide_against_the_weight():
    # The surface is level: g h = work against the tide from low (side) to high (near), to first order.
    ratio, d, R, Gm = 0.01, 60.0, 1.0, 1.0
    tensor = tidal_tensor(ratio * Gm, [d, 0, 0])
    work = 0.5 * R**2 * (tensor[0, 0] - tensor[1, 1])
    assert tide_height(ratio, d, R) == pytest.approx(work / (Gm / R**2), rel=1e-15)


@pytest.mark.parametrize(
    "call",
    [
        lambda: tidal_acceleration(-1.0, [1, 0, 0], [0, 0, 0]),
        lambda: tidal_acceleration(1.0, [0, 0, 0], [1, 0, 0]),
        lambda: tidal_acceleration(1.0, [1, 0, 0], [-1, 0, 0]),
        lambda: tidal_acceleration(1.0, [1, 0, 0], [0, np.nan, 0]),
        lambda: tidal_tensor(1.0, [0, 0, 0]),
        lambda: tide_at_named_points(1.0, 1.0, 1.0),
        lambda: tide_at_named_points(1.0, 1.0, 0.0),
        lambda: tide_height(0.0, 1.0, 1.0),
    ],
)
def test_bad_input_is_refused(call):
    with pytest.raises(InputError):
        call()

"""The pendulum in a car, against Newton's law in the room and the plane pendulum."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from poinsot.reference import car_pendulum as car
from poinsot.reference import plane_pendulum as plane
from poinsot.reference.errors import InputError

G, A, L = 9.81, 3.0, 0.8


def test_three_four_five():
    # g = 4, A = 3: an effective 5, tilted by atan(3/4).
    assert car.equilibrium(4.0, 3.0) == pytest.approx(np.arctan(0.75), rel=1e-15, abs=0)
    assert car.equilibrium(4.0, -3.0) == -car.equilibrium(4.0, 3.0)
    assert car.frequency(4.0, 3.0, 0.2) == pytest.approx(5, rel=1e-15, abs=0)
    assert car.frequency(4.0, -3.0, 0.2) == car.frequency(4.0, 3.0, 0.2)


def test_at_its_equilibrium_it_hangs_still():
    phi = car.equilibrium(G, A)
    assert car.angular_acceleration(G, A, L, phi) == pytest.approx(0, abs=1e-14)
    angle, rate = car.motion(G, A, L, phi, 0.0, np.linspace(-10, 10, 5))
    np.testing.assert_allclose(angle, phi, rtol=1e-15)
    np.testing.assert_allclose(rate, 0, atol=1e-15)


def test_small_swings_have_the_frequency():
    phi, w, a = car.equilibrium(G, A), car.frequency(G, A, L), 1e-6
    t = np.linspace(-2, 2, 9)
    angle, rate = car.motion(G, A, L, phi + a, 0.0, t)
    # φ is of order 0.3 and rounded to 5e-17.
    np.testing.assert_allclose(angle - phi, a * np.cos(w * t), rtol=0, atol=1e-15)
    np.testing.assert_allclose(rate, -a * w * np.sin(w * t), rtol=0, atol=1e-15)


@given(st.floats(-4, 4), st.floats(-15, 15), st.floats(-5, 5))
def test_in_the_room_only_string_and_weight_act(phi0, rate0, acceleration):
    h = 1e-3
    t = 0.3 + h * np.arange(-2, 3)
    phi, _ = car.motion(G, acceleration, L, phi0, rate0, t)
    # The hinge speeds up along +x, φ is towards −x.
    bob = np.column_stack([acceleration * t**2 / 2 - L * np.sin(phi), -L * np.cos(phi)])
    pull = (-bob[4] + 16 * bob[3] - 30 * bob[2] + 16 * bob[1] - bob[0]) / (12 * h**2) + [0, G]
    along = np.array([np.sin(phi[2]), np.cos(phi[2])])
    # What is not weight must point along the string; h⁴/90 of a sixth derivative up to ω⁶ ~ 1e8.
    assert abs(pull[0] * along[1] - pull[1] * along[0]) < 1e-5


@given(st.floats(-4, 4), st.floats(-15, 15), st.floats(-2, 2))
def test_angular_acceleration_is_the_slope_of_the_rate(phi0, rate0, t):
    h = 1e-4
    phi, rate = car.motion(G, A, L, phi0, rate0, t + h * np.arange(-2, 3))
    slope = (8 * (rate[3] - rate[1]) - (rate[4] - rate[0])) / (12 * h)
    # Rounding over h, and h⁴/30 of a fifth derivative.
    assert slope == pytest.approx(car.angular_acceleration(G, A, L, phi[2]), abs=1e-7)


def test_standing_car_is_a_plane_pendulum():
    t = np.linspace(-3, 3, 7)
    for start in ((2.0, -1.0), (0.1, 20.0), (8.0, 0.0)):
        np.testing.assert_array_equal(car.motion(G, 0.0, L, *start, t), plane.motion(G, L, *start, t))


def test_start_is_kept():
    angle, rate = car.motion(G, A, L, 7.5, -0.3, 0.0)
    np.testing.assert_allclose([angle[0], rate[0]], [7.5, -0.3], rtol=1e-15)


def test_bad_input_is_refused():
    for gravity, acceleration, length in ((0.0, A, L), (G, np.nan, L), (G, A, -1.0)):
        with pytest.raises(InputError):
            car.motion(gravity, acceleration, length, 0.0, 0.0, [0.0])
        with pytest.raises(InputError):
            car.frequency(gravity, acceleration, length)
        with pytest.raises(InputError):
            car.angular_acceleration(gravity, acceleration, length, 0.0)
    for gravity, acceleration in ((-1.0, A), (G, np.inf)):
        with pytest.raises(InputError):
            car.equilibrium(gravity, acceleration)
    for phi0, rate0, t in ((np.nan, 0.0, [0.0]), (0.0, np.inf, [0.0]), (0.0, 0.0, [[0.0]])):
        with pytest.raises(InputError):
            car.motion(G, A, L, phi0, rate0, t)

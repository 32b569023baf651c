"""The integrators alone: against their own step matrices, and against forty digits."""

import mpmath
import numpy as np
import pinocchio as pin
import pytest
from poinsot.adapters.pinocchio_schemes import (
    Mechanism,
    _pulled_back,
    implicit_gyroscopic,
    rkmk4,
    semi_implicit_euler,
)
from scipy.spatial.transform import Rotation

K, C, M, DT = 7.0, 0.4, 2.0, 0.05


@pytest.fixture
def oscillator():
    """A mass on a spring and a damper, on which each scheme is a matrix."""

    def force(q, v):
        return -K * q - C * v

    return Mechanism(
        force=force,
        accelerate=lambda q, v, f: f / M,
        integrate=lambda q, dq: q + dq,
        linearised=lambda q, v: (np.array([[M]]), np.array([[C]])),
        balls=(),
    )


def matrix_of(scheme):
    if scheme is rkmk4:
        A = np.array([[0, 1], [-K / M, -C / M]]) * DT
        return sum(np.linalg.matrix_power(A, k) / [1, 1, 2, 6, 24][k] for k in range(5))
    # Both take the velocity first; one with the damper at the start of the step, one at its end.
    weight = M if scheme is semi_implicit_euler else M + DT * C
    row = np.array([-K * DT / weight, 1 - C * DT / weight])
    return np.array([[1 + DT * row[0], DT * row[1]], row])


@pytest.mark.parametrize("scheme", [semi_implicit_euler, implicit_gyroscopic, rkmk4])
def test_on_an_oscillator_each_scheme_is_its_matrix(oscillator, scheme):
    q, v = scheme(oscillator, np.array([1.0]), np.array([-0.5]), DT, 40)
    expected = np.linalg.matrix_power(matrix_of(scheme), 40) @ [1.0, -0.5]
    # Forty steps, a few roundings each, of numbers of size 1.
    np.testing.assert_allclose([q[0], v[0]], expected, atol=1e-14)


@pytest.mark.parametrize("scheme", [semi_implicit_euler, implicit_gyroscopic, rkmk4])
def test_no_steps_change_nothing(oscillator, scheme):
    q, v = scheme(oscillator, np.array([1.0]), np.array([-0.5]), DT, 0)
    assert (q[0], v[0]) == (1.0, -0.5)


def exact_rate(turn, w):
    """The same sum, w + ½ u×w + c u×(u×w), in forty digits."""
    with mpmath.workdps(40):
        u, w = mpmath.matrix(turn.tolist()), mpmath.matrix(w.tolist())
        angle = mpmath.norm(u)
        c = (1 - angle / 2 * mpmath.cot(angle / 2)) / angle**2
        U = mpmath.matrix([[0, -u[2], u[1]], [u[2], 0, -u[0]], [-u[1], u[0], 0]])
        return np.array([float(x) for x in w + U * w / 2 + c * U * U * w])


ANGLES = [1e-9, 1e-6, 1.9e-4, 2.1e-4, 1e-3, 1e-2, 0.3, 2.0, 5.0]


@pytest.mark.parametrize("angle", ANGLES)
def test_the_inverse_differential_is_good_to_rounding(angle):
    rng = np.random.default_rng(1)
    axis, w = rng.normal(size=3), rng.normal(size=3)
    turn = angle * axis / np.linalg.norm(axis)
    # The result grows near a whole turn, where the inverse has none: 12 at 5 rad.
    np.testing.assert_allclose(_pulled_back(turn, w, (0,)), exact_rate(turn, w), rtol=4e-15, atol=4e-16)


def test_it_is_the_inverse_of_what_turns_make():
    # exp(u + h k) is exp(u) turned on by h w, to first order in h.
    turn, w, h = np.array([0.4, -0.7, 0.2]), np.array([1.0, 2.0, -0.5]), 1e-6
    k = _pulled_back(turn, w, (0,))
    reached = Rotation.from_rotvec(turn - h * k).inv() * Rotation.from_rotvec(turn + h * k)
    # Central differences: the error is of order h².
    np.testing.assert_allclose(reached.as_rotvec() / (2 * h), w, atol=1e-9)


def test_nothing_but_balls_is_pulled_back():
    turn, w = np.arange(1.0, 9.0), np.arange(8.0)
    k = _pulled_back(turn, w, (2,))
    np.testing.assert_array_equal(k[[0, 1, 5, 6, 7]], w[[0, 1, 5, 6, 7]])
    assert not np.any(k[2:5] == w[2:5])


def test_pinocchios_own_inverse_differential_loses_half_the_digits_at_a_thousandth():
    rng = np.random.default_rng(1)
    axis, w = rng.normal(size=3), rng.normal(size=3)
    turn = 1e-3 * axis / np.linalg.norm(axis)
    own = pin.Jlog3(pin.exp3(turn)) @ w
    assert np.abs(own - exact_rate(turn, w)).max() > 1e-12

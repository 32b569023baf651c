"""Euler's angles against turns built one after another, scipy, and differences of the attitude."""

import mpmath
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from poinsot.reference import euler_angles as euler
from poinsot.reference.errors import InputError
from scipy.spatial.transform import Rotation

ORDERS = {"ZYZ": "zyz", "ZXZ": "zxz"}
turns = st.floats(-3, 3)
middles = st.floats(0.05, 3.09)
rates = st.tuples(*[st.floats(-5, 5)] * 3)


def function(order, name):
    return getattr(euler, f"{ORDERS[order]}_{name}")


def axis_turn(axis, angle):
    """A turn about a coordinate axis, in mpmath: columns are the turned axes."""
    c, s = mpmath.cos(angle), mpmath.sin(angle)
    if axis == "Z":
        return mpmath.matrix([[c, -s, 0], [s, c, 0], [0, 0, 1]])
    if axis == "Y":
        return mpmath.matrix([[c, 0, s], [0, 1, 0], [-s, 0, c]])
    return mpmath.matrix([[1, 0, 0], [0, c, -s], [0, s, c]])


def omega_by_difference(order, angles, speeds):
    """(body, world) ω from the derivative of the product of three turns, at 40 digits."""

    def attitude(t):
        first, second, third = (
            axis_turn(axis, mpmath.mpf(x) + t * mpmath.mpf(v))
            for axis, x, v in zip(order, angles, speeds, strict=True)
        )
        return first * second * third

    with mpmath.workdps(40):
        step = mpmath.mpf(10) ** -12
        change = (attitude(step) - attitude(-step)) / (2 * step)
        parts = attitude(0).T * change, change * attitude(0).T
        return [np.array([float(m[2, 1]), float(m[0, 2]), float(m[1, 0])]) for m in parts]


@pytest.mark.parametrize("order", ORDERS)
@given(turns, middles, turns, rates)
def test_omega_is_the_rate_of_the_three_turns(order, a, b, c, speeds):
    body, world = omega_by_difference(order, (a, b, c), speeds)
    # Sums of three products of numbers up to 5.
    np.testing.assert_allclose(function(order, "omega")((a, b, c), speeds), body, rtol=0, atol=1e-14)
    np.testing.assert_allclose(function(order, "omega_world")((a, b, c), speeds), world, rtol=0, atol=1e-14)


@pytest.mark.parametrize("order", ORDERS)
@given(turns, middles, turns, rates)
def test_rates_come_back_with_the_loss_that_conditioning_says(order, a, b, c, speeds):
    angles = (a, b, c)
    loss = euler.conditioning(b)
    for there, back in (("omega", "rates"), ("omega_world", "rates_from_world")):
        omega = function(order, there)(angles, speeds)
        np.testing.assert_allclose(function(order, back)(angles, omega), speeds, rtol=0, atol=1e-14 * loss)


@pytest.mark.parametrize("order", ORDERS)
@given(turns, st.floats(-3, 6), turns)
def test_attitude_is_scipys(order, a, b, c):
    ours = Rotation.from_quat(function(order, "attitude")((a, b, c)))
    theirs = Rotation.from_euler(order, (a, b, c))
    assert (ours * theirs.inv()).magnitude() < 1e-14


@pytest.mark.parametrize("order", ORDERS)
@given(turns, middles, turns)
def test_angles_come_back(order, a, b, c):
    got = function(order, "angles")(function(order, "attitude")((a, b, c)))
    # An angle of a nearly upright body is known as badly as its sine is small.
    np.testing.assert_allclose(got, (a, b, c), rtol=0, atol=2e-15 / np.sin(b))


@pytest.mark.parametrize("order", ORDERS)
@given(st.integers(0, 2**32 - 1), st.floats(-12, 0))
def test_any_attitude_comes_back_however_small_the_middle_angle(order, seed, exponent):
    random = np.random.default_rng(seed)
    x, y, z, w = random.normal(size=4)
    small = 10**exponent
    for q in (np.array([x * small, y * small, z, w]), np.array([x, y, z * small, w * small])):
        q = q / np.linalg.norm(q)
        angles = function(order, "angles")(q)
        back = function(order, "attitude")(angles)
        # As attitudes: the angles one by one are lost near 0 and π, what they make together is not.
        assert min(np.abs(back - q).max(), np.abs(back + q).max()) < 1e-15 * 2
        assert np.all(np.abs(angles) <= np.pi)
        assert angles[1] >= 0
        expected = 2 * np.arctan2(np.hypot(q[0], q[1]), np.hypot(q[2], q[3]))
        assert angles[1] == pytest.approx(expected, rel=1e-15, abs=0)


@pytest.mark.parametrize("order", ORDERS)
def test_a_small_middle_angle_is_exact_where_scipy_gives_up(order):
    angles = np.array([0.7, 1e-12, -0.3])
    got = function(order, "angles")(function(order, "attitude")(angles))
    np.testing.assert_allclose(got[1], 1e-12, rtol=1e-15)
    np.testing.assert_allclose(got, angles, rtol=0, atol=1e-15)


@pytest.mark.parametrize("order", ORDERS)
def test_at_the_singular_angles_the_third_is_zero(order):
    attitude, angles = function(order, "attitude"), function(order, "angles")
    np.testing.assert_allclose(angles([0, 0, np.sin(0.5), np.cos(0.5)]), [1.0, 0.0, 0.0], rtol=0, atol=1e-15)
    upside_down = np.array([np.cos(0.2), np.sin(0.2), 0.0, 0.0])
    first, middle, third = angles(upside_down)
    assert middle == np.pi
    assert third == 0
    np.testing.assert_allclose(np.abs(attitude([first, np.pi, 0.0])), np.abs(upside_down), rtol=0, atol=1e-15)
    np.testing.assert_array_equal(angles([0, 0, 0, 1]), [0, 0, 0])
    np.testing.assert_allclose(angles([0, 0, 1, 0]), [np.pi, 0, 0], rtol=1e-15)


def test_both_orders_agree_by_quarter_turns():
    # Turning about x is turning about y between quarter turns about z: φ = α + π/2, ψ = γ − π/2.
    angles, speeds = np.array([0.3, 1.1, -2.0]), np.array([0.5, -0.7, 1.9])
    shifted = angles + np.array([np.pi / 2, 0, -np.pi / 2])
    for name in ("omega", "omega_world", "rates", "rates_from_world"):
        np.testing.assert_allclose(
            function("ZXZ", name)(shifted, speeds), function("ZYZ", name)(angles, speeds), rtol=0, atol=1e-14
        )
    np.testing.assert_allclose(euler.zxz_attitude(shifted), euler.zyz_attitude(angles), rtol=0, atol=1e-15)


def test_gimbal_turning_one_hinge_at_a_time():
    # By hand, all three 90°. z-y-z: body axes lie along −x, z, y of the world; z-x-z: along z, −y, x.
    right, hinges = np.full(3, np.pi / 2), np.eye(3)
    expected = {
        euler.zyz_omega: [[0, 1, 0], [1, 0, 0], [0, 0, 1]],
        euler.zyz_omega_world: [[0, 0, 1], [-1, 0, 0], [0, 1, 0]],
        euler.zxz_omega: [[1, 0, 0], [0, -1, 0], [0, 0, 1]],
        euler.zxz_omega_world: [[0, 0, 1], [0, 1, 0], [1, 0, 0]],
    }
    for omega, by_hand in expected.items():
        np.testing.assert_allclose(omega(right, hinges), by_hand, rtol=0, atol=1e-16)


@given(turns, st.floats(-4, 7), turns)
def test_direction_cosines_are_the_attitude(a, b, c):
    expected = Rotation.from_euler("ZXZ", (a, b, c)).as_matrix().T
    np.testing.assert_allclose(euler.zxz_direction_cosines((a, b, c)), expected, rtol=0, atol=4e-15)


def space_to_body(axis, angle):
    return np.array(axis_turn(axis, angle).T.tolist(), dtype=float)


def test_order_of_factors_printed_in_the_slides_is_reversed():
    phi, theta, psi = 0.3, 1.1, -0.8
    factors = [space_to_body(axis, x) for axis, x in zip("ZXZ", (phi, theta, psi), strict=True)]
    printed = factors[0] @ factors[1] @ factors[2]
    mended = factors[2] @ factors[1] @ factors[0]
    np.testing.assert_allclose(euler.zxz_direction_cosines((phi, theta, psi)), mended, rtol=0, atol=1e-15)
    assert np.abs(printed - mended).max() > 0.5


def test_order_of_factors_printed_in_the_lecture_is_reversed():
    alpha, beta, gamma = 0.3, 1.1, -0.8
    factors = [space_to_body(axis, x) for axis, x in zip("ZYZ", (alpha, beta, gamma), strict=True)]
    body = Rotation.from_quat(euler.zyz_attitude((alpha, beta, gamma))).as_matrix().T
    np.testing.assert_allclose(body, factors[2] @ factors[1] @ factors[0], rtol=0, atol=1e-15)
    assert np.abs(body - factors[0] @ factors[1] @ factors[2]).max() > 0.5


def test_space_rates_with_psi_for_phi_are_wrong():
    angles, speeds = np.array([0.3, 1.1, -0.8]), np.array([0.5, -0.7, 1.9])
    _, world = omega_by_difference("ZXZ", angles, speeds)
    _, theta, psi = angles
    dphi, dtheta, dpsi = speeds
    printed = [
        dtheta * np.cos(psi) + dphi * np.sin(psi) * np.sin(theta),
        dtheta * np.sin(psi) - dphi * np.cos(psi) * np.sin(theta),
        dphi + dpsi * np.cos(theta),
    ]
    assert np.abs(printed - world).max() > 0.5
    np.testing.assert_allclose(euler.zxz_omega_world(angles, speeds), world, rtol=0, atol=1e-15)


def test_kinetic_energy_without_the_cross_term_is_wrong():
    # One set of notes prints ψ̇² + φ̇² cos²θ for (ψ̇ + φ̇ cosθ)².
    I1, I3, angles, speeds = 0.3, 0.5, (0.4, 1.1, -0.8), (0.5, -0.7, 1.9)
    omega = euler.zxz_omega(angles, speeds)
    energy = (I1 * (omega[0] ** 2 + omega[1] ** 2) + I3 * omega[2] ** 2) / 2
    dphi, dtheta, dpsi = speeds
    tilted = I1 * (dphi**2 * np.sin(1.1) ** 2 + dtheta**2) / 2
    assert energy == pytest.approx(tilted + I3 * (dpsi + dphi * np.cos(1.1)) ** 2 / 2, rel=1e-14, abs=0)
    assert abs(energy - (tilted + I3 * (dpsi**2 + dphi**2 * np.cos(1.1) ** 2) / 2)) > 0.1


@given(turns, st.floats(0.01, 3.1), turns)
def test_conditioning_is_that_of_the_matrix(a, b, c):
    for omega in (euler.zyz_omega, euler.zxz_omega_world):
        matrix = omega((a, b, c), np.eye(3))
        assert euler.conditioning(b) == pytest.approx(np.linalg.cond(matrix), rel=1e-10, abs=0)


def test_conditioning_at_its_limits():
    assert euler.conditioning(0.0) == np.inf
    assert euler.conditioning(np.pi / 2) == pytest.approx(1, rel=1e-15, abs=0)
    np.testing.assert_allclose(euler.conditioning([1e-9, -1e-9, np.pi - 1e-3]), [2e9, 2e9, 2e3], rtol=1e-6)


def test_stacks_broadcast():
    angles = np.array([0.3, 1.1, -2.0])
    speeds = np.arange(12.0).reshape(2, 2, 3)
    omega = euler.zyz_omega(angles, speeds)
    assert omega.shape == (2, 2, 3)
    np.testing.assert_array_equal(omega[1, 0], euler.zyz_omega(angles, speeds[1, 0]))
    q = euler.zxz_attitude(speeds)
    np.testing.assert_array_equal(euler.zxz_angles(q)[0, 1], euler.zxz_angles(q[0, 1]))
    assert euler.zxz_direction_cosines(speeds).shape == (2, 2, 3, 3)


@pytest.mark.parametrize("order", ORDERS)
def test_refuses_undetermined_rates_and_bad_shapes(order):
    for name in ("rates", "rates_from_world"):
        with pytest.raises(InputError, match="sine is 0"):
            function(order, name)([0.1, 0.0, 0.2], [1.0, 2.0, 3.0])
    for name in ("omega", "omega_world", "rates", "rates_from_world"):
        for angles, speeds in (
            ([1.0, 2.0], [1.0, 2.0, 3.0]),
            ([1.0, 2.0, 3.0], 1.0),
            ([1, 2, np.nan], [1, 2, 3]),
        ):
            with pytest.raises(InputError):
                function(order, name)(angles, speeds)
    for q in ([0, 0, 0, 1.001], [0, 0, 1], 1.0, [0, 0, 0, np.nan]):
        with pytest.raises(InputError, match="q: "):
            function(order, "angles")(q)

"""A rotor's bearings against the forces on its point masses, one by one."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from poinsot.reference import inertia, rotor_balance
from poinsot.reference.errors import InputError

seeds = st.integers(0, 2**32 - 1)
speeds = st.floats(-20, 20)


def rotor(seed, n=5):
    random = np.random.default_rng(seed)
    return random.uniform(0.1, 3, n), random.uniform(-1, 1, (n, 3))


def pulls(m, r, omega, alpha):
    """Force on each point that keeps it on its circle and speeds it up."""
    axle = np.array([0.0, 0.0, 1.0])
    a = alpha * np.cross(axle, r) + omega**2 * np.cross(axle, np.cross(axle, r))
    return m[:, None] * a


@given(seeds, speeds, speeds)
def test_torque_and_force_are_the_sums_over_the_points(seed, omega, alpha):
    m, r = rotor(seed)
    force = pulls(m, r, omega, alpha)
    tensor, centre = inertia.of_points(m, r), inertia.centre_of(m, r)
    size = 1e-14 * (omega**2 + abs(alpha) + 1) * m.sum()
    got = rotor_balance.bearing_torque(tensor, omega, alpha)
    np.testing.assert_allclose(got, np.cross(r, force).sum(axis=0), rtol=0, atol=size)
    got = rotor_balance.axle_force(m.sum(), centre, omega, alpha)
    np.testing.assert_allclose(got, force.sum(axis=0), rtol=0, atol=size)


@given(seeds, speeds)
def test_angular_momentum_is_the_sum_over_the_points(seed, omega):
    m, r = rotor(seed)
    v = np.cross([0, 0, omega], r)
    got = rotor_balance.angular_momentum(inertia.of_points(m, r), omega)
    np.testing.assert_allclose(got, (m[:, None] * np.cross(r, v)).sum(axis=0), rtol=0, atol=1e-12)


def test_torque_is_omega_cross_momentum():
    tensor = inertia.of_points(*rotor(3))
    expected = np.cross([0, 0, 7.0], rotor_balance.angular_momentum(tensor, 7.0))
    np.testing.assert_allclose(rotor_balance.bearing_torque(tensor, 7.0), expected, rtol=1e-15)
    np.testing.assert_allclose(expected, 49 * np.array([-tensor[1, 2], tensor[0, 2], 0]), rtol=1e-15)


def test_slanted_dumbbell_by_hand():
    # Two masses m at ±(a, 0, b): I_xz = −2mab, so at ω the bearings turn it about −y by 2mabω².
    m, a, b, omega = 1.5, 0.4, 0.3, 10.0
    tensor = inertia.of_points([m, m], [[a, 0, b], [-a, 0, -b]])
    np.testing.assert_allclose(
        rotor_balance.angular_momentum(tensor, omega), [-2 * m * a * b * omega, 0, 2 * m * a**2 * omega]
    )
    np.testing.assert_allclose(rotor_balance.bearing_torque(tensor, omega), [0, -2 * m * a * b * omega**2, 0])


@given(seeds, speeds, speeds)
def test_two_bearings_share_force_and_torque(seed, omega, alpha):
    m, r = rotor(seed)
    tensor, centre = inertia.of_points(m, r), inertia.centre_of(m, r)
    places = np.array([-0.3, 1.1])
    forces = rotor_balance.bearing_forces(tensor, m.sum(), centre, places, omega, alpha)
    points = pulls(m, r, omega, alpha)
    size = 1e-13 * (omega**2 + abs(alpha) + 1) * m.sum()
    np.testing.assert_allclose(forces.sum(axis=0), points.sum(axis=0)[:2], rtol=0, atol=size)
    lever = np.cross(np.column_stack([0 * places, 0 * places, places]), np.column_stack([forces, 0 * places]))
    np.testing.assert_allclose(lever.sum(axis=0)[:2], np.cross(r, points).sum(axis=0)[:2], rtol=0, atol=size)


@given(seeds)
def test_correction_balances(seed):
    m, r = rotor(seed)
    planes = np.array([-0.5, 0.8])
    unbalance = rotor_balance.correction(inertia.of_points(m, r), m.sum(), inertia.centre_of(m, r), planes)
    # A mass of 0.7 kg where each unbalance says.
    added = np.column_stack([unbalance / 0.7, planes])
    m2, r2 = np.append(m, [0.7, 0.7]), np.vstack([r, added])
    tensor, centre = inertia.of_points(m2, r2), inertia.centre_of(m2, r2)
    size = 1e-14 * np.abs(tensor).max()
    np.testing.assert_allclose(rotor_balance.axle_force(m2.sum(), centre, 1.0), 0, atol=size)
    np.testing.assert_allclose(rotor_balance.bearing_torque(tensor, 1.0), 0, atol=size)


def test_static_balance_alone_leaves_a_torque():
    tensor = inertia.of_points([1.0, 1.0], [[1, 0, 1], [-1, 0, -1]])
    assert np.all(rotor_balance.axle_force(2.0, [0, 0, 0], 5.0) == 0)
    assert rotor_balance.bearing_torque(tensor, 5.0)[1] == -50


def test_balanced_rotor_needs_nothing():
    tensor = np.diag([1.0, 2.0, 2.5])
    np.testing.assert_array_equal(rotor_balance.bearing_torque(tensor, 9.0), [0, 0, 0])
    np.testing.assert_array_equal(rotor_balance.bearing_torque(tensor, 9.0, 2.0), [0, 0, 5])
    np.testing.assert_array_equal(rotor_balance.angular_momentum(tensor, 9.0), [0, 0, 22.5])


def test_bad_input_is_refused():
    good = np.eye(3)
    bad = [
        lambda: rotor_balance.angular_momentum(np.diag([1.0, 1, 3]), 1.0),
        lambda: rotor_balance.angular_momentum(good, np.inf),
        lambda: rotor_balance.bearing_torque(-good, 1.0),
        lambda: rotor_balance.bearing_torque(good, 1.0, np.nan),
        lambda: rotor_balance.axle_force(0.0, [0, 0, 0], 1.0),
        lambda: rotor_balance.axle_force(1.0, [0, 0], 1.0),
        lambda: rotor_balance.bearing_forces(good, 1.0, [0, 0, 0], [1.0, 1.0], 1.0),
        lambda: rotor_balance.bearing_forces(good, 1.0, [0, 0, 0], [1.0], 1.0),
        lambda: rotor_balance.correction(good, 1.0, [0, 0, 0], [2.0, 2.0]),
        lambda: rotor_balance.correction(good, -1.0, [0, 0, 0], [2.0, 1.0]),
    ]
    for call in bad:
        with pytest.raises(InputError):
            call()

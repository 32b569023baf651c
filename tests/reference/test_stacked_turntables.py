"""Stacked turntables against scipy's rotations, numerical derivatives and the general tree."""

import mpmath as mp
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from poinsot.reference.equations_of_motion import Joint, Link, link_accelerations, link_motion
from poinsot.reference.errors import InputError
from poinsot.reference.stacked_turntables import carried_point, stacked_turntables
from scipy.spatial.transform import Rotation


def some_stack(seed, k=3):
    rng = np.random.default_rng(seed)
    return rng.normal(size=(k, 3)), rng.normal(size=k), rng.normal(size=(k, 3)), rng.normal(size=k)


def test_angular_velocities_add():
    # ω31 = ω32 + ω21, each about where its axis points now (Taylor, sect. 9.3).
    axes, rates = np.array([[0, 0, 1.0], [1.0, 0, 0]]), np.array([2.0, 3.0])
    got = stacked_turntables(axes, rates, 0.4)
    about_first = np.array([0, 0, 2.0])
    about_second = 3.0 * np.array([np.cos(0.8), np.sin(0.8), 0])
    np.testing.assert_allclose(got.omega_world[0], [about_first, about_first + about_second], atol=1e-15)
    # The second axis is carried round by the first: dω/dt = ω21×ω32.
    np.testing.assert_allclose(got.alpha_world[0, 1], np.cross(about_first, about_second), atol=1e-15)
    np.testing.assert_array_equal(got.alpha_world[0, 0], np.zeros(3))


@settings(max_examples=40, deadline=None)
@given(st.integers(0, 10**6), st.floats(-20, 20))
def test_attitudes_are_the_turns_in_a_row(seed, t):
    axes, rates, offsets, angles = some_stack(seed)
    got = stacked_turntables(axes, rates, t, offsets, angles)
    turn, place = Rotation.identity(), np.zeros(3)
    for k, (axis, rate, offset, angle) in enumerate(zip(axes, rates, offsets, angles, strict=True)):
        place = place + turn.apply(offset)
        turn = turn * Rotation.from_rotvec((angle + rate * t) * axis / np.linalg.norm(axis))
        # scipy is given a rounded angle of up to 60 rad.
        assert (turn.inv() * Rotation.from_quat(got.quaternion[0, k])).magnitude() < 1e-13
        np.testing.assert_allclose(got.position[0, k], place, atol=1e-13)
        np.testing.assert_allclose(turn.apply(got.omega[0, k]), got.omega_world[0, k], atol=1e-13)


@pytest.mark.parametrize("seed", [1, 2, 3])
def test_rates_are_derivatives(seed):
    axes, rates, offsets, angles = some_stack(seed)
    t, h, place = 0.7, 1e-3, np.array([0.3, -0.8, 0.5])
    stack = stacked_turntables(axes, rates, t + h * np.array([-2, -1, 0, 1, 2]), offsets, angles)
    five = np.array([1, -8, 0, 8, -1]) / (12 * h)  # errs by h⁴ times fifth derivatives below 100
    for k in range(3):
        r, v, a = carried_point(stack, k, place)
        np.testing.assert_allclose(five @ r, v[2], atol=1e-10)
        np.testing.assert_allclose(five @ v, a[2], atol=1e-10)
        np.testing.assert_allclose(five @ stack.position[:, k], stack.velocity[2, k], atol=1e-10)
        np.testing.assert_allclose(five @ stack.velocity[:, k], stack.acceleration[2, k], atol=1e-10)
        np.testing.assert_allclose(five @ stack.omega_world[:, k], stack.alpha_world[2, k], atol=1e-10)
        turns = Rotation.from_quat(stack.quaternion[:, k])
        spin = np.tensordot(five, turns.as_matrix(), 1) @ turns[2].as_matrix().T
        np.testing.assert_allclose([spin[2, 1], spin[0, 2], spin[1, 0]], stack.omega_world[2, k], atol=1e-10)


def test_the_general_tree_moves_the_same_way():
    axes, rates, offsets, angles = some_stack(5)
    links = [
        Link(1.0, np.eye(3), parent=k - 1, joints=(Joint("hinge", axes[k]),), position=offsets[k])
        for k in range(3)
    ]
    t = np.linspace(-2, 2, 5)
    q = angles + np.outer(t, rates)
    v = np.broadcast_to(rates, q.shape)
    stack = stacked_turntables(axes, rates, t, offsets, angles)
    position, _, velocity, omega = link_motion(links, q, v)
    linear, angular = link_accelerations(links, q, v, np.zeros_like(v))
    np.testing.assert_allclose(stack.position, position, atol=1e-14)
    np.testing.assert_allclose(stack.velocity, velocity, atol=1e-13)
    np.testing.assert_allclose(stack.omega, omega, atol=1e-14)
    np.testing.assert_allclose(stack.acceleration, linear, atol=1e-13)
    in_world = Rotation.from_quat(stack.quaternion.reshape(-1, 4)).apply(angular.reshape(-1, 3))
    np.testing.assert_allclose(stack.alpha_world.reshape(-1, 3), in_world, atol=1e-13)


def test_one_table_alone_is_a_circle():
    stack = stacked_turntables([[0, 0, 4.0]], [2.0], [0.0, np.pi / 4])
    r, v, a = carried_point(stack, 0, [3.0, 0, 1.0])
    np.testing.assert_allclose(r, [[3, 0, 1], [0, 3, 1]], atol=1e-15)
    np.testing.assert_allclose(v, [[0, 6, 0], [-6, 0, 0]], atol=2e-15)
    np.testing.assert_allclose(a, [[-12, 0, 0], [0, -12, 0]], atol=4e-15)


def test_a_late_time_loses_nothing():
    rate, t = 1.1, 1e9
    late = stacked_turntables([[0, 0, 1.0]], [rate], t)
    with mp.workdps(40):
        half = mp.mpf(rate) * mp.mpf(t) / 2
        expected = [0, 0, float(mp.sin(half)), float(mp.cos(half))]
    np.testing.assert_allclose(late.quaternion[0, 0], expected, atol=1e-15)


@pytest.mark.parametrize(
    "arguments",
    [
        ([[0, 0, 0.0]], [1.0], 1.0),
        ([[0, 0, 1.0]], [1.0, 2.0], 1.0),
        ([[0, 0, 1.0]], [np.nan], 1.0),
        (np.zeros((0, 3)), np.zeros(0), 1.0),
        ([[0, 0, 1.0]], [1.0], 1.0, [[0, 0]]),
        ([[0, 0, 1.0]], [1.0], 1.0, [[0, 0, 0]], [0.0, 1.0]),
        ([[0, 0, 1.0]], [1.0], [[1.0]]),
    ],
)
def test_bad_input_is_refused(arguments):
    with pytest.raises(InputError):
        stacked_turntables(*arguments)


def test_a_table_that_is_not_there_is_refused():
    stack = stacked_turntables([[0, 0, 1.0]], [1.0], 0.0)
    for table in (-1, 1):
        with pytest.raises(InputError, match="table"):
            carried_point(stack, table, [0, 0, 0])

"""Quaternion arithmetic against scipy's rotations and against its own definitions."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp
from poinsot.reference import quaternions
from scipy.spatial.transform import Rotation

# A few units in the last place: every entry is a sum of at most four products of numbers below 2.
ROUNDING = 4e-15

vectors = hnp.arrays(float, 3, elements=st.floats(-3, 3))


@st.composite
def turns(draw):
    return Rotation.from_rotvec(draw(vectors)).as_quat()


def test_the_product_of_the_units_is_hamiltons():
    i, j, k = np.eye(4)[:3]
    np.testing.assert_array_equal(quaternions.product(i, j), k)
    np.testing.assert_array_equal(quaternions.product(j, k), i)
    np.testing.assert_array_equal(quaternions.product(k, i), j)
    np.testing.assert_array_equal(quaternions.product(i, i), [0, 0, 0, -1])


@given(turns(), turns(), vectors)
def test_product_and_turning_agree_with_scipy(p, q, v):
    both = Rotation.from_quat(p) * Rotation.from_quat(q)
    np.testing.assert_allclose(quaternions.matrix(quaternions.product(p, q)), both.as_matrix(), atol=ROUNDING)
    np.testing.assert_allclose(quaternions.rotated(p, v), Rotation.from_quat(p).apply(v), atol=10 * ROUNDING)
    np.testing.assert_allclose(
        quaternions.rotated(quaternions.conjugate(p), quaternions.rotated(p, v)), v, atol=10 * ROUNDING
    )


@given(vectors)
def test_a_rotation_vector_comes_back_by_the_shorter_way(v):
    q = quaternions.from_rotation_vector(v)
    np.testing.assert_allclose(np.linalg.norm(q), 1, atol=ROUNDING)
    np.testing.assert_allclose(quaternions.matrix(q), Rotation.from_rotvec(v).as_matrix(), atol=ROUNDING)
    back = quaternions.rotation_vector(q)
    assert np.linalg.norm(back) <= np.pi + ROUNDING
    np.testing.assert_allclose(
        Rotation.from_rotvec(back).as_matrix(), Rotation.from_rotvec(v).as_matrix(), atol=ROUNDING
    )
    if np.linalg.norm(v) < 3:
        np.testing.assert_allclose(back, v, atol=10 * ROUNDING)


def test_no_turn_and_a_tiny_one_are_exact():
    np.testing.assert_array_equal(quaternions.from_rotation_vector(np.zeros(3)), [0, 0, 0, 1])
    np.testing.assert_array_equal(quaternions.rotation_vector(np.array([0.0, 0.0, 0.0, 1.0])), np.zeros(3))
    tiny = np.array([0.0, 1e-200, 0.0])
    np.testing.assert_array_equal(quaternions.rotation_vector(quaternions.from_rotation_vector(tiny)), tiny)


def test_a_quaternion_and_its_negative_are_the_same_turn():
    q = np.array([0.1, -0.2, 0.3, -np.sqrt(1 - 0.14)])
    np.testing.assert_array_equal(quaternions.rotation_vector(q), quaternions.rotation_vector(-q))
    assert np.linalg.norm(quaternions.rotation_vector(q)) == pytest.approx(2 * np.arcsin(np.sqrt(0.14)))


@given(turns(), vectors)
def test_the_rate_is_that_of_a_steady_turn_in_body_axes(q, omega):
    h = 1e-4

    def at(t):
        return quaternions.product(q, quaternions.from_rotation_vector(t * omega))

    # The central difference errs by h²|ω/2|³/6, at most 3e-8.
    numeric = (at(h) - at(-h)) / (2 * h)
    np.testing.assert_allclose(quaternions.rate(q, omega), numeric, atol=1e-7)


def test_stacks_go_through_in_one_call():
    rng = np.random.default_rng(5)
    p, q = rng.normal(size=(2, 3, 4))
    one_by_one = [quaternions.product(a, b) for a, b in zip(p, q, strict=True)]
    np.testing.assert_array_equal(quaternions.product(p, q), one_by_one)
    assert quaternions.matrix(p).shape == (3, 3, 3)

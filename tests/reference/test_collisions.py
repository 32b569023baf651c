"""Collisions: momentum, the energy of the formula and of the speeds, textbook cases, both frames."""

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp
from poinsot.reference.collisions import centre_of_mass_velocity, collide, laboratory_angle
from poinsot.reference.errors import InputError

masses, speeds, factors = st.floats(0.01, 100), st.floats(-50, 50), st.floats(0, 1)
vectors = hnp.arrays(float, 3, elements=st.floats(-5, 5))


@given(masses, masses, speeds, speeds, factors)
def test_head_on_in_one_dimension(m1, m2, v1, v2, e):
    after = collide(m1, m2, v1, v2, e)
    M, size = m1 + m2, 1 + abs(v1) + abs(v2)
    # The formulas as printed in SYSTEMS and textbooks, and with them the separating speed −e u.
    assert after.v1 == pytest.approx(((m1 - e * m2) * v1 + m2 * (1 + e) * v2) / M, abs=1e-13 * size)
    assert after.v2 == pytest.approx(((m2 - e * m1) * v2 + m1 * (1 + e) * v1) / M, abs=1e-13 * size)
    assert after.v2 - after.v1 == pytest.approx(-e * (v2 - v1), abs=1e-12 * size)
    before = 0.5 * (m1 * v1**2 + m2 * v2**2)
    left = 0.5 * (m1 * after.v1**2 + m2 * after.v2**2)
    assert after.energy_lost == pytest.approx(before - left, abs=1e-12 * (1 + before))
    assert after.energy_lost >= 0
    assert m1 * after.v1 + m2 * after.v2 == pytest.approx(m1 * v1 + m2 * v2, abs=1e-13 * M * size)


@given(masses, masses, vectors, vectors, factors, vectors)
def test_a_blow_along_a_normal(m1, m2, v1, v2, e, normal):
    assume(np.linalg.norm(normal) > 0.1)
    after = collide(m1, m2, v1, v2, e, normal)
    n = normal / np.linalg.norm(normal)
    u = v2 - v1
    np.testing.assert_allclose((after.v2 - after.v1) @ n, -e * u @ n, atol=1e-12)
    # Nothing happens across the normal, and the impulse is what each momentum changes by.
    np.testing.assert_allclose(np.cross(n, after.v1 - v1), 0, atol=1e-12)
    np.testing.assert_allclose(np.cross(n, after.v2 - v2), 0, atol=1e-12)
    np.testing.assert_allclose(m1 * (after.v1 - v1), after.impulse, atol=1e-11)
    np.testing.assert_allclose(m2 * (after.v2 - v2), -after.impulse, atol=1e-11)
    energy = [0.5 * m1 * a @ a + 0.5 * m2 * b @ b for a, b in ((v1, v2), (after.v1, after.v2))]
    assert after.energy_lost == pytest.approx(energy[0] - energy[1], abs=1e-11 * (1 + energy[0]))
    opposite = collide(m1, m2, v1, v2, e, -1e-200 * normal)
    np.testing.assert_allclose(opposite.v1, after.v1, atol=1e-12)


def test_cases_a_textbook_solves_by_hand():
    equal = collide(2.0, 2.0, 3.0, -1.0, 1.0)
    assert (equal.v1, equal.v2, equal.energy_lost) == (-1.0, 3.0, 0.0)
    stuck = collide(1.0, 3.0, 4.0, 0.0, 0.0)
    assert (stuck.v1, stuck.v2, stuck.energy_lost) == (1.0, 1.0, 6.0)
    half = collide(1.0, 1.0, 2.0, 0.0, 0.5)
    assert (half.v1, half.v2, half.energy_lost) == (0.5, 1.5, 0.75)
    wall = collide(1.0, 1e20, 5.0, 0.0, 0.6)
    assert wall.v1 == pytest.approx(-3.0, rel=1e-15)


def test_without_a_normal_a_collision_is_head_on():
    v1, v2 = np.array([1.0, 2.0, -1.0]), np.array([0.5, 0.0, 0.0])
    free, aimed = collide(1.0, 2.0, v1, v2, 0.4), collide(1.0, 2.0, v1, v2, 0.4, v1 - v2)
    np.testing.assert_allclose(free.v1, aimed.v1, atol=1e-15)
    same = collide(1.0, 2.0, v1, v1, 0.4)
    np.testing.assert_array_equal(same.v1, v1)


def test_in_the_centre_of_mass_frame_velocities_only_turn_and_shrink():
    m1, m2, e = 1.3, 0.4, 0.7
    v1, v2, n = np.array([2.0, 0.3, -0.4]), np.array([-0.5, 0.6, 0.1]), np.array([1.0, 0.2, 0.3])
    V = centre_of_mass_velocity(m1, m2, v1, v2)
    np.testing.assert_allclose((m1 + m2) * V, m1 * v1 + m2 * v2, atol=1e-15)
    moved = collide(m1, m2, v1 - V, v2 - V, e, n)
    at_rest = collide(m1, m2, v1, v2, e, n)
    np.testing.assert_allclose(moved.v1 + V, at_rest.v1, atol=1e-15)
    np.testing.assert_allclose(m1 * moved.v1 + m2 * moved.v2, 0, atol=1e-15)


@pytest.mark.parametrize("theta", [0.0, 0.5, 1.4, 2.9])
@pytest.mark.parametrize(("m1", "m2"), [(1.0, 1.0), (0.3, 2.0), (2.0, 0.3)])
def test_the_laboratory_angle_is_that_of_the_velocities(theta, m1, m2):
    # An elastic blow on smooth bodies turns the relative velocity by Θ when the normal is at (π − Θ)/2.
    v1, v2 = np.array([3.0, 0, 0]), np.zeros(3)
    half = (np.pi - theta) / 2
    after = collide(m1, m2, v1, v2, 1.0, [np.cos(half), -np.sin(half), 0])
    got = laboratory_angle(m1, m2, theta)
    assert got == pytest.approx(np.arctan2(after.v1[1], after.v1[0]), abs=1e-14)


def test_equal_masses_part_at_a_right_angle():
    assert laboratory_angle(1.0, 1.0, 1.1) == pytest.approx(0.55, rel=1e-15)
    after = collide(1.0, 1.0, [1.0, 0, 0], [0, 0, 0], 1.0, [0.8, 0.6, 0])
    assert after.v1 @ after.v2 == pytest.approx(0, abs=1e-16)


def test_a_loss_turns_the_laboratory_angle_forward():
    # With relative speed e u after: v1 = V + (m2/M) e u (cosΘ, sinΘ).
    m1, m2, e, theta = 0.7, 1.9, 0.6, 2.0
    M = m1 + m2
    v1 = np.array([m1 / M + m2 / M * e * np.cos(theta), m2 / M * e * np.sin(theta)])
    assert laboratory_angle(m1, m2, theta, e) == pytest.approx(np.arctan2(v1[1], v1[0]), rel=1e-15)
    assert laboratory_angle(m1, m2, theta, e) < laboratory_angle(m1, m2, theta)


@pytest.mark.parametrize(
    "call",
    [
        lambda: collide(0.0, 1.0, 1.0, 0.0, 0.5),
        lambda: collide(1.0, -1.0, 1.0, 0.0, 0.5),
        lambda: collide(1.0, 1.0, 1.0, 0.0, 1.1),
        lambda: collide(1.0, 1.0, 1.0, 0.0, -0.1),
        lambda: collide(1.0, 1.0, 1.0, [0, 0, 0], 0.5),
        lambda: collide(1.0, 1.0, [0, 0], [0, 0], 0.5),
        lambda: collide(1.0, 1.0, [0, 0, 1], [0, 0, 0], 0.5, [0, 0, 0]),
        lambda: collide(1.0, 1.0, 1.0, 0.0, 0.5, 1.0),
        lambda: collide(1.0, 1.0, np.nan, 0.0, 0.5),
        lambda: laboratory_angle(1.0, 1.0, -0.1),
        lambda: laboratory_angle(1.0, 1.0, 3.2),
        lambda: laboratory_angle(1.0, 1.0, 1.0, 0.0),
        lambda: centre_of_mass_velocity(1.0, 0.0, 1.0, 1.0),
    ],
)
def test_bad_input_is_refused(call):
    with pytest.raises(InputError):
        call()

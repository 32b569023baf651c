"""Orbit and spin against plain sums over points, and against the Earth's."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from poinsot.reference import inertia, orbit_and_spin
from poinsot.reference.errors import InputError
from scipy.spatial.transform import Rotation

seeds = st.integers(0, 2**32 - 1)


@given(seeds)
def test_parts_add_up(seed):
    random = np.random.default_rng(seed)
    m, r, v = random.uniform(0.1, 3, 4), random.normal(size=(3, 4, 3)), random.normal(size=(3, 4, 3))
    split = orbit_and_spin.of_points(m, r, v)
    momentum = np.sum(m[:, None] * np.cross(r, v), axis=1)
    energy = np.einsum("n,tni,tni->t", m, v, v) / 2
    np.testing.assert_allclose(split.L_orbital + split.L_spin, momentum, rtol=0, atol=1e-13)
    np.testing.assert_allclose(split.T_orbital + split.T_spin, energy, rtol=1e-13)
    assert np.all(split.T_orbital >= 0)
    assert np.all(split.T_spin >= 0)


@given(seeds)
def test_spin_does_not_see_where_the_body_is_or_goes(seed):
    random = np.random.default_rng(seed)
    m, r, v = random.uniform(0.1, 3, 4), random.normal(size=(4, 3)), random.normal(size=(4, 3))
    here = orbit_and_spin.of_points(m, r, v)
    shift, drift = np.array([1.0, -2.0, 0.5]), np.array([0.3, 0.1, -0.7])
    there = orbit_and_spin.of_points(m, r + shift, v + drift)
    np.testing.assert_allclose(there.L_spin, here.L_spin, rtol=0, atol=1e-13)
    assert there.T_spin == pytest.approx(here.T_spin, rel=1e-12, abs=0)
    total, c, u = m.sum(), m @ r / m.sum() + shift, m @ v / m.sum() + drift
    np.testing.assert_allclose(there.L_orbital, total * np.cross(c, u), rtol=0, atol=1e-13)
    assert there.T_orbital == pytest.approx(total * u @ u / 2, rel=1e-13, abs=0)


@given(seeds)
def test_rigid_body_is_its_points(seed):
    random = np.random.default_rng(seed)
    m, body = random.uniform(0.1, 3, 5), random.normal(size=(5, 3))
    body = body - inertia.centre_of(m, body)
    turn = Rotation.random(2, rng=random)
    position, velocity, omega = random.normal(size=(3, 2, 3))
    split = orbit_and_spin.of_body(
        m.sum(), inertia.of_points(m, body), position, velocity, turn.as_quat(), omega
    )
    for i in range(2):
        r = turn[i].apply(body)
        v = turn[i].apply(np.cross(omega[i], body))
        points = orbit_and_spin.of_points(m, r + position[i], v + velocity[i])
        for got, expected in zip(split, points, strict=True):
            np.testing.assert_allclose(got[i], expected, rtol=0, atol=2e-13)


def test_two_masses_by_hand():
    # 1 and 3 kg pass at 4 m at relative speed 2: μ = 3/4, spin μ·4·2, ½μ·4; the centre, at 3 m, moves at 1.
    split = orbit_and_spin.of_points([1.0, 3.0], [[0, 0, 0], [4, 0, 0]], [[0, -0.5, 0], [0, 1.5, 0]])
    np.testing.assert_allclose(split.L_orbital, [0, 0, 4 * 3 * 1])
    np.testing.assert_allclose(split.L_spin, [0, 0, 6])
    assert (split.T_orbital, split.T_spin) == (pytest.approx(2), pytest.approx(1.5))


def test_the_earth():
    # 1 au, 29.78 km/s, C/MR² = 0.3307, one turn in 86164 s; the NASA fact sheet's numbers lead to the
    # 2.66e40 and 5.86e33 kg m²/s that are quoted everywhere.
    M, R = 5.972e24, 6.3781e6
    split = orbit_and_spin.of_body(
        M, 0.3307 * M * R**2 * np.eye(3), [1.496e11, 0, 0], [0, 29.78e3, 0], [0, 0, 0, 1], [0, 0, 7.292115e-5]
    )
    assert split.L_orbital[2] == pytest.approx(2.66e40, rel=2e-3, abs=0)
    assert split.L_spin[2] == pytest.approx(5.86e33, rel=2e-3, abs=0)


def test_free_dumbbell_keeps_each_part():
    # Two masses on a rod, thrown and spinning, without force: each of the four is constant.
    t = np.linspace(0, 3, 7)
    m, arm, omega = np.array([1.0, 2.0]), np.array([[2.0], [-1.0]]), 1.7
    flight = np.column_stack([1 + 0.3 * t, 2 - 0.1 * t, 0.5 * t])
    e = np.column_stack([np.cos(omega * t), np.sin(omega * t), 0 * t])
    de = omega * np.column_stack([-np.sin(omega * t), np.cos(omega * t), 0 * t])
    split = orbit_and_spin.of_points(
        m, flight[:, None] + arm * e[:, None], [0.3, -0.1, 0.5] + arm * de[:, None]
    )
    for part in split:
        np.testing.assert_allclose(part, np.broadcast_to(part[0], part.shape), rtol=0, atol=1e-13)
    np.testing.assert_allclose(split.L_spin[0], [0, 0, 6 * omega], rtol=1e-14)


def test_bad_input_is_refused():
    zero, turn = np.zeros(3), [0, 0, 0, 1]
    bad = [
        lambda: orbit_and_spin.of_points([1.0], np.zeros((2, 3)), np.zeros((2, 3))),
        lambda: orbit_and_spin.of_points([1.0], np.zeros((1, 3)), np.zeros((1, 2))),
        lambda: orbit_and_spin.of_points([1.0], zero, zero),
        lambda: orbit_and_spin.of_points([1.0, 0.0], np.zeros((2, 3)), np.zeros((2, 3))),
        lambda: orbit_and_spin.of_points([1.0], np.zeros((1, 2)), np.zeros((1, 2))),
        lambda: orbit_and_spin.of_body(0.0, np.eye(3), zero, zero, turn, zero),
        lambda: orbit_and_spin.of_body(1.0, -np.eye(3), zero, zero, turn, zero),
        lambda: orbit_and_spin.of_body(1.0, np.eye(3), zero, zero, [0, 0, 0, 2], zero),
        lambda: orbit_and_spin.of_body(1.0, np.eye(3), zero, zero, [0, 0, 1], zero),
        lambda: orbit_and_spin.of_body(1.0, np.eye(3), zero, np.zeros((2, 3)), turn, zero),
        lambda: orbit_and_spin.of_body(1.0, np.eye(3), zero, zero, turn, [0, np.nan, 0]),
        lambda: orbit_and_spin.of_body(1.0, np.eye(3), 0.0, zero, turn, zero),
    ]
    for call in bad:
        with pytest.raises(InputError):
            call()

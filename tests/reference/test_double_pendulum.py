"""The double pendulum against its points in the plane, Lagrange's equations and solved cases."""

import mpmath
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from poinsot.reference import double_pendulum as double
from poinsot.reference.errors import InputError
from poinsot.reference.normal_modes import normal_modes

G = 9.81
BOOK = double.links([0.7, 0.7], [0.5, 0.5], G)
seeds = st.integers(0, 2**32 - 1)


def links(seed):
    """Random links, over decades, with or without extent."""
    random = np.random.default_rng(seed)
    masses, lengths, arms = 10 ** random.uniform(-1, 1, (3, 2))
    inertias = random.integers(0, 2) * 10 ** random.uniform(-2, 1, 2)
    return double.links(masses, lengths, G, arms, inertias), masses, lengths, arms, inertias


@given(seeds)
def test_energy_is_that_of_the_two_bodies(seed):
    known, masses, lengths, arms, inertias = links(seed)
    random = np.random.default_rng(seed + 1)
    angles, rates = random.uniform(-4, 4, (2, 2))

    def place(theta, distance):
        return distance * np.array([np.sin(theta), -np.cos(theta)])

    def speed(theta, rate, distance):
        return distance * rate * np.array([np.cos(theta), np.sin(theta)])

    v1 = speed(angles[0], rates[0], arms[0])
    v2 = speed(angles[0], rates[0], lengths[0]) + speed(angles[1], rates[1], arms[1])
    z1 = place(angles[0], arms[0])[1]
    z2 = place(angles[0], lengths[0])[1] + place(angles[1], arms[1])[1]
    kinetic = (masses @ [v1 @ v1, v2 @ v2] + inertias @ rates**2) / 2
    below = -masses @ [arms[0], lengths[0] + arms[1]]
    potential = G * (masses @ [z1, z2] - below)
    assert double.energy(known, angles, rates) == pytest.approx(kinetic + potential, rel=1e-12, abs=0)


def lagrange(links, angles, rates):
    """θ̈ from the printed Lagrangian by mpmath's numerical derivatives, at 30 digits."""
    with mpmath.workdps(30):
        A, B, D, G1, G2 = (mpmath.mpf(x) for x in links[:5])
        start = [mpmath.mpf(x) for x in (*angles, *rates)]

        def lagrangian(a, b, u, v):
            kinetic = (A * u**2 + D * v**2) / 2 + B * u * v * mpmath.cos(a - b)
            return kinetic + G1 * mpmath.cos(a) + G2 * mpmath.cos(b)

        def slope(*orders):
            return mpmath.diff(lagrangian, tuple(start), orders)

        u, v = start[2:]
        # d/dt ∂L/∂θ̇ = ∂L/∂θ, the left side spelled out by the chain rule.
        push1 = slope(1, 0, 0, 0) - slope(1, 0, 1, 0) * u - slope(0, 1, 1, 0) * v
        push2 = slope(0, 1, 0, 0) - slope(1, 0, 0, 1) * u - slope(0, 1, 0, 1) * v
        mass = mpmath.matrix([[slope(0, 0, 2, 0), slope(0, 0, 1, 1)], [slope(0, 0, 1, 1), slope(0, 0, 0, 2)]])
        return [float(x) for x in mass**-1 * mpmath.matrix([push1, push2])]


@pytest.mark.parametrize("seed", range(12))
def test_accelerations_follow_from_the_lagrangian(seed):
    known, *_ = links(seed)
    angles, rates = np.random.default_rng(seed + 1).uniform(-4, 4, (2, 2))
    expected = lagrange(known, angles, rates)
    got = double.accelerations(known, angles, rates)
    # Numerical derivatives at 30 digits keep about ten of second ones.
    np.testing.assert_allclose(got, expected, rtol=1e-8, atol=1e-8 * np.abs(expected).max())


@given(seeds)
def test_accelerations_keep_the_energy(seed):
    known, *_ = links(seed)
    angles, rates = np.random.default_rng(seed + 1).uniform(-4, 4, (2, 2))
    push = double.accelerations(known, angles, rates)
    A, B, D, G1, G2, _ = known
    cos, sin = np.cos(angles[0] - angles[1]), np.sin(angles[0] - angles[1])
    (w1, w2), (a1, a2) = rates, push
    parts = [
        A * w1 * a1,
        D * w2 * a2,
        B * cos * (w1 * a2 + w2 * a1),
        -B * sin * (w1 - w2) * w1 * w2,
        G1 * np.sin(angles[0]) * w1,
        G2 * np.sin(angles[1]) * w2,
    ]
    assert abs(sum(parts)) < 1e-12 * np.abs(parts).max()


def test_links_that_need_no_torque_to_swing_as_one():
    # θ1 = θ2 for ever if G1/(A + B) = G2/(D + B): then it is one compound pendulum.
    A, B, _, G1, G2, _ = double.links([1.0, 1.0], [1.0, 1.0], G, [0.5, 0.5], [0.05, 0.3])
    D = G2 * (A + B) / G1 - B
    push = double.accelerations(double.Links(A, B, D, G1, G2, A * D - B**2), [1.1, 1.1], [0.4, 0.4])
    np.testing.assert_allclose(push, -G1 / (A + B) * np.sin(1.1), rtol=1e-13)


def test_equal_links_as_in_the_slides():
    unit = G / 0.5
    np.testing.assert_allclose(
        double.frequencies(BOOK) ** 2, [(2 - np.sqrt(2)) * unit, (2 + np.sqrt(2)) * unit], rtol=1e-15
    )
    np.testing.assert_allclose(double.modes(BOOK), [np.sqrt(2), -np.sqrt(2)], rtol=1e-15)
    # The slides use the hinge angle θ2 − θ1: T = ml²((5, 2), (2, 1)), V = mgl((3, 1), (1, 1)).
    T, V = double.energy_matrices(BOOK)
    to_hinges = np.array([[1.0, 0.0], [1.0, 1.0]])
    np.testing.assert_allclose(
        to_hinges.T @ T @ to_hinges, 0.7 * 0.25 * np.array([[5, 2], [2, 1]]), rtol=1e-15
    )
    np.testing.assert_allclose(
        to_hinges.T @ V @ to_hinges, 0.7 * G * 0.5 * np.array([[3, 1], [1, 1]]), rtol=1e-15
    )


def test_height_of_the_first_mass_as_printed_in_the_slides_is_wrong():
    # They print y1 = −l cos θ2; with the second link turned alone, the first mass must not rise.
    printed = -0.5 * np.cos(1.0) + 0.5
    lifted = double.energy(BOOK, [0.0, 1.0], [0.0, 0.0]) / (0.7 * G)
    assert lifted == pytest.approx(0.5 * (1 - np.cos(1.0)), rel=1e-14, abs=0)
    assert printed > 0.2


@given(seeds)
def test_frequencies_and_modes_are_those_of_the_matrices(seed):
    known, *_ = links(seed)
    omega, A = normal_modes(*double.energy_matrices(known))
    # The matrices are rounded, and AD − B² of theirs loses what `determinant` does not.
    loss = 1e-15 * known.A * known.D / known.determinant
    np.testing.assert_allclose(double.frequencies(known), omega, rtol=1e-15 + loss)
    gap = 1 - (omega[0] / omega[1]) ** 2
    ratios = A[1] / A[0]
    np.testing.assert_allclose(double.modes(known), ratios, rtol=(4e-15 + loss) / gap * (1 + ratios**2).max())


def test_heavy_first_link_leaves_two_pendulums():
    # m1 ≫ m2: √(g/l1) and √(g/l2), Landau & Lifshitz § 5's limit.
    known = double.links([1e12, 1.0], [0.5, 0.2], G)
    np.testing.assert_allclose(double.frequencies(known), np.sqrt([G / 0.5, G / 0.2]), rtol=1e-11)
    # m1 ≪ m2: √(g/(l1 + l2)) and one that grows as √(m2/m1).
    known = double.links([1e-12, 1.0], [0.5, 0.2], G)
    slow, fast = double.frequencies(known)
    assert slow == pytest.approx(np.sqrt(G / 0.7), rel=1e-11, abs=0)
    assert fast == pytest.approx(np.sqrt(1e12 * G * 0.7 / (0.5 * 0.2)), rel=1e-11, abs=0)


def test_light_link_above_a_heavy_one_keeps_its_digits():
    masses, lengths, angles, rates = [1e-8, 1.0], [0.5, 0.2], (0.3, 0.3 + 1e-7), (1.0, -2.0)
    got = double.accelerations(double.links(masses, lengths, G), angles, rates)
    with mpmath.workdps(50):
        m1, m2, l1, l2, g, a, b, u, v = (mpmath.mpf(x) for x in (*masses, *lengths, G, *angles, *rates))
        c, s = mpmath.cos(a - b), mpmath.sin(a - b)
        mass = mpmath.matrix([[(m1 + m2) * l1**2, m2 * l1 * l2 * c], [m2 * l1 * l2 * c, m2 * l2**2]])
        push = mpmath.matrix(
            [
                -m2 * l1 * l2 * s * v**2 - (m1 + m2) * g * l1 * mpmath.sin(a),
                m2 * l1 * l2 * s * u**2 - m2 * g * l2 * mpmath.sin(b),
            ]
        )
        expected = [float(x) for x in mass**-1 * push]
    # The pushes still cancel to 1e-7 of themselves, and θ1 − θ2 is rounded.
    np.testing.assert_allclose(got, expected, rtol=1e-8)


def test_default_arms_are_the_lengths():
    assert double.links([1.0, 2.0], [0.5, 0.3], G) == double.links([1.0, 2.0], [0.5, 9.0], G, [0.5, 0.3])


def test_stacks():
    angles, rates = np.random.default_rng(0).normal(size=(2, 3, 4, 2))
    push, energy = double.accelerations(BOOK, angles, rates), double.energy(BOOK, angles, rates)
    assert push.shape == (3, 4, 2)
    assert energy.shape == (3, 4)
    np.testing.assert_array_equal(push[1, 2], double.accelerations(BOOK, angles[1, 2], rates[1, 2]))


def test_bad_input_is_refused():
    good = {"masses": [1.0, 1.0], "lengths": [1.0, 1.0], "gravity": 1.0}
    bad = [
        ("masses", [1.0, 0.0]),
        ("masses", [1.0]),
        ("lengths", [-1.0, 1.0]),
        ("gravity", 0.0),
        ("arms", [1.0, 0.0]),
        ("inertias", [0.0, -1e-9]),
        ("inertias", [0.0, np.nan]),
    ]
    for name, value in bad:
        with pytest.raises(InputError, match=name):
            double.links(**(good | {name: value}))
    for call in (double.energy, double.accelerations):
        for angles, rates in (([0.0, 0.0], [0.0]), ([0.0], [0.0]), (0.0, 0.0), ([np.nan, 0.0], [0.0, 0.0])):
            with pytest.raises(InputError):
                call(BOOK, angles, rates)

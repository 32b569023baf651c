"""Theorems on inertia tensors, against sums over point masses."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from poinsot.reference import inertia
from poinsot.reference.errors import InputError
from scipy.spatial.transform import Rotation

ROUNDING = 1e-14
seeds = st.integers(0, 2**32 - 1)
CUBE = np.array([[8.0, -3, -3], [-3, 8, -3], [-3, -3, 8]])


def cloud(seed, n=5):
    random = np.random.default_rng(seed)
    return random.uniform(0.1, 3, n), random.normal(size=(n, 3)) * 10 ** random.uniform(-2, 2, 3)


@given(seeds, st.tuples(*[st.floats(-3, 3).map(lambda x: round(x, 3))] * 3))
def test_tensor_gives_angular_momentum_and_energy(seed, omega):
    m, r = cloud(seed)
    tensor, w = inertia.of_points(m, r), np.array(omega)
    v = np.cross(w, r)
    momentum = np.sum(m[:, None] * np.cross(r, v), axis=0)
    size = np.abs(tensor).max() * np.linalg.norm(w)
    np.testing.assert_allclose(tensor @ w, momentum, rtol=0, atol=ROUNDING * size)
    energy = np.sum(m[:, None] * v**2)
    assert w @ tensor @ w == pytest.approx(energy, abs=ROUNDING * size * np.linalg.norm(w))


def test_tensor_of_one_mass_by_hand():
    np.testing.assert_array_equal(
        inertia.of_points([2.0], [[1.0, 2.0, 3.0]]), 2 * np.array([[13, -2, -3], [-2, 10, -6], [-3, -6, 5]])
    )
    np.testing.assert_array_equal(inertia.centre_of([1.0, 3.0], [[0, 0, 0], [4, 8, -4]]), [3, 6, -3])


@given(seeds, st.tuples(*[st.floats(-3, 3)] * 3))
def test_parallel_axes(seed, offset):
    m, r = cloud(seed)
    r = r - inertia.centre_of(m, r)
    centred, moved = inertia.of_points(m, r), inertia.of_points(m, r - np.array(offset))
    size = np.abs(moved).max() + np.abs(centred).max()
    np.testing.assert_allclose(
        inertia.about_point(centred, m.sum(), offset), moved, rtol=0, atol=ROUNDING * size
    )
    np.testing.assert_allclose(
        inertia.about_centre(moved, m.sum(), offset), centred, rtol=0, atol=ROUNDING * size
    )


def test_displaced_tensor_with_zeros_for_two_products_is_wrong():
    # One set of notes prints 0 for −M a_y a_z.
    m, a = np.array([1.0, 1.0, 2.0]), np.array([0.3, -0.7, 0.4])
    r = np.array([[1.0, 0, 0], [-1.0, 2.0, 0], [0.0, -1.0, 0]])
    moved = inertia.of_points(m, r - a)
    printed = inertia.of_points(m, r) + 4 * (a @ a * np.eye(3) - np.outer(a, a))
    np.testing.assert_allclose(inertia.about_point(inertia.of_points(m, r), 4.0, a), moved, rtol=1e-14)
    printed[1, 2] = printed[2, 1] = inertia.of_points(m, r)[1, 2]
    assert np.abs(printed - moved).max() == pytest.approx(4 * 0.7 * 0.4)


def test_steiner_by_hand():
    # A rod of mass M and length l about its end: Ml²/3.
    M, l = 3.0, 2.0  # noqa: E741 - the book's letter
    rod = M * l**2 / 12 * np.diag([0.0, 1.0, 1.0])
    np.testing.assert_allclose(inertia.about_point(rod, M, [l / 2, 0, 0]), M * l**2 / 3 * np.diag([0, 1, 1]))


@given(seeds, st.tuples(*[st.floats(-1, 1)] * 3))
def test_moment_about_an_axis_is_the_sum_of_squared_distances(seed, axis):
    m, r = cloud(seed)
    n = np.array(axis) + np.array([0, 0, 2])
    distances = np.linalg.norm(np.cross(r, n), axis=1) / np.linalg.norm(n)
    tensor = inertia.of_points(m, r)
    assert inertia.about_axis(tensor, n) == pytest.approx(
        np.sum(m * distances**2), abs=ROUNDING * np.abs(tensor).max()
    )


def test_length_of_an_axis_does_not_matter():
    for length in (1e-300, 1.0, 1e300):
        assert inertia.about_axis(CUBE, [length, length, length]) == pytest.approx(2, rel=1e-15, abs=0)


@given(seeds)
def test_turning_the_body_turns_its_tensor(seed):
    m, r = cloud(seed)
    turn = Rotation.random(rng=np.random.default_rng(seed))
    tensor = inertia.of_points(m, r)
    np.testing.assert_allclose(
        inertia.turned(tensor, turn.as_quat()),
        inertia.of_points(m, turn.apply(r)),
        rtol=0,
        atol=ROUNDING * np.abs(tensor).max(),
    )


def test_quarter_turn_by_hand():
    # Turned by 90° about z, what was along x is along y.
    q = [0, 0, np.sqrt(0.5), np.sqrt(0.5)]
    np.testing.assert_allclose(inertia.turned(np.diag([1.0, 2, 3]), q), np.diag([2.0, 1, 3]), atol=1e-15)


@given(seeds)
def test_perpendicular_axes(seed):
    m, r = cloud(seed)
    r[:, 2] = 0
    tensor = inertia.of_points(m, r)
    np.testing.assert_allclose(
        inertia.lamina(tensor[:2, :2]), tensor, rtol=0, atol=ROUNDING * np.abs(tensor).max()
    )


def test_laminas_by_hand():
    # A disc: Mr²/4 in its plane, Mr²/2 across; two masses on a slanted line.
    np.testing.assert_array_equal(inertia.lamina(np.eye(2) / 4), np.diag([0.25, 0.25, 0.5]))
    np.testing.assert_array_equal(inertia.lamina([[1, -1], [-1, 1]]), [[1, -1, 0], [-1, 1, 0], [0, 0, 2]])


@given(seeds)
def test_principal_axes(seed):
    m, r = cloud(seed)
    tensor = inertia.of_points(m, r)
    moments, axes = inertia.principal(tensor)
    size = np.abs(tensor).max()
    np.testing.assert_allclose(axes.T @ axes, np.eye(3), rtol=0, atol=1e-15)
    assert np.linalg.det(axes) == pytest.approx(1, abs=1e-15)
    np.testing.assert_allclose(axes.T @ tensor @ axes, np.diag(moments), rtol=0, atol=4e-15 * size)
    assert np.all(np.diff(moments) >= 0)


def test_principal_axes_of_the_cube():
    moments, axes = inertia.principal(CUBE)
    np.testing.assert_allclose(moments, [2, 11, 11], rtol=1e-15)
    np.testing.assert_allclose(axes[:, 0], np.ones(3) / np.sqrt(3), rtol=1e-15)
    np.testing.assert_allclose(CUBE @ axes, axes * moments, rtol=0, atol=4e-15)


def test_small_moment_beside_large_ones_keeps_its_digits():
    # Plane block with eigenvalues (ε ± …): 1 + ε² and ε²/(1 + …) exactly from the quadratic.
    e = 2.0**-10
    tensor = np.array([[1 + e**2, e, 0], [e, 2 * e**2, 0], [0, 0, 1 + 3 * e**2]])
    p, d = 1 + 3 * e**2, (1 + e**2) * 2 * e**2 - e**2
    large = (p + np.sqrt(p**2 - 4 * d)) / 2
    moments, _ = inertia.principal(tensor)
    np.testing.assert_allclose(moments, [d / large, large, p], rtol=1e-15)


def test_bodies_at_the_edge_of_what_is_physical_pass():
    for moments in ([0, 1, 1], [1, 2, 3], [1e-6, 1, 1], [1e-6, 1, 1 + 1e-6], [1, 1, 2]):
        inertia.physical(np.diag(np.array(moments, dtype=float)))
    for seed in range(200):
        random = np.random.default_rng(seed)
        plate = np.append(random.uniform(1e-3, 1, 2), 0)
        plate[2] = plate[0] + plate[1]
        turn = Rotation.random(rng=random).as_quat()
        inertia.physical(inertia.turned(np.diag(plate), turn))


@pytest.mark.parametrize(
    ("tensor", "says"),
    [
        (np.diag([1.0, 2, 3.000001]), "largest exceeds"),
        (np.diag([3.0 + 1e-12, 1, 2]), "largest exceeds"),
        (np.diag([1.0, 1, -1e-9]), "none below 0"),
        (np.diag([-1.0, -1, -1]), "none below 0"),
        ([[1.0, 2, 0], [2, 3, 0], [0, 0, 4]], "none below 0"),
        ([[1.0, 0.1, 0], [0, 1, 0], [0, 0, 1]], "symmetric"),
        (np.eye(2), r"shape \(2, 2\), expected \(3, 3\)"),
        (np.ones(3), "shape"),
        (np.full((3, 3), np.nan), "finite"),
    ],
)
def test_what_no_body_has_is_refused(tensor, says):
    for call in (
        inertia.physical,
        inertia.principal,
        lambda t: inertia.about_point(t, 1.0, [0, 0, 0]),
        lambda t: inertia.about_centre(t, 1.0, [0, 0, 0]),
        lambda t: inertia.turned(t, [0, 0, 0, 1]),
        lambda t: inertia.about_axis(t, [0, 0, 1]),
    ):
        with pytest.raises(InputError, match=says):
            call(tensor)


def test_example_of_some_notes_is_no_inertia_tensor():
    # Its moments 2 ± √5 were worked out without a word about the negative one.
    with pytest.raises(InputError, match=r"plane: got principal moments \[-0\.236"):
        inertia.lamina([[1, 2], [2, 3]])
    for negative in ([[-1, 0], [0, -1]], [[1, 0], [0, -1]], [[0, 1], [1, 0]]):
        with pytest.raises(InputError, match="none below 0"):
            inertia.lamina(negative)
    with pytest.raises(InputError):
        inertia.principal([[1, 2], [2, 3]])


def test_moving_back_further_than_the_body_allows_is_refused():
    with pytest.raises(InputError, match="about the centre"):
        inertia.about_centre(np.eye(3), 1.0, [2.0, 0, 0])


def test_bad_arguments_are_refused():
    bad = [
        lambda: inertia.of_points([1.0, 2.0], [[0, 0, 0]]),
        lambda: inertia.of_points([], np.zeros((0, 3))),
        lambda: inertia.of_points([-1.0], [[0, 0, 0]]),
        lambda: inertia.centre_of([0.0], [[0, 0, 0]]),
        lambda: inertia.about_point(np.eye(3), -1.0, [0, 0, 0]),
        lambda: inertia.about_point(np.eye(3), 1.0, [0, 0]),
        lambda: inertia.about_axis(np.eye(3), [0, 0, 0]),
        lambda: inertia.turned(np.eye(3), [0, 0, 0, 2]),
        lambda: inertia.lamina(np.eye(3)),
        lambda: inertia.lamina([[1.0, 0.5], [0, 1]]),
    ]
    for call in bad:
        with pytest.raises(InputError):
            call()

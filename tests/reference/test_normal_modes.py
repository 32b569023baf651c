"""Normal modes against their defining equations, textbook cases and a 40-digit matrix exponential."""

import mpmath
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from poinsot.reference.errors import InputError
from poinsot.reference.normal_modes import motion, normal_coordinates, normal_modes

# Entries of a few ulp from one rounding to double and sums over n terms.
ROUNDING = 1e-14


@st.composite
def systems(draw):
    """Masses and stiffnesses over several decades, of any rank, with an equilibrium that is not unstable."""
    n = draw(st.integers(1, 6))
    random = np.random.default_rng(draw(st.integers(0, 2**32 - 1)))
    mixing = np.eye(n) + random.uniform(-0.3, 0.3, (n, n)) / n
    T = mixing.T @ np.diag(10 ** random.uniform(-2, 2, n)) @ mixing
    springs = random.integers(-3, 4, (draw(st.integers(0, n + 2)), n)).astype(float)
    V = springs.T @ springs * 2.0 ** draw(st.integers(-20, 20))
    return T, V


@given(systems())
def test_modes_satisfy_their_defining_equations(system):
    T, V = system
    omega, A = normal_modes(T, V)
    n = len(T)
    scale = max(omega.max() ** 2, 1e-300)
    # Sums in which large parts cancel are rounded as those parts are.
    parts = max(1.0, float((np.abs(A.T) @ np.abs(T) @ np.abs(A)).max()))
    assert np.abs(A.T @ T @ A - np.eye(n)).max() < ROUNDING * parts
    assert np.abs(A.T @ V @ A - np.diag(omega**2)).max() < ROUNDING * parts * scale
    assert np.all(np.diff(omega) >= 0)


@given(systems())
def test_every_direction_without_stiffness_is_a_mode_of_frequency_exactly_zero(system):
    T, V = system
    omega, _ = normal_modes(T, V)
    # V is a product of small whole numbers, so its rank is exact.
    assert np.count_nonzero(omega == 0) == len(T) - np.linalg.matrix_rank(V)


def exact(T, V, q0, v0, t):
    """(q, v) at t by the exponential of the first-order system, at 40 digits."""
    n = len(T)
    with mpmath.workdps(40):
        rates = mpmath.zeros(2 * n)
        acceleration = -(mpmath.matrix(T.tolist()) ** -1) * mpmath.matrix(V.tolist())
        for i in range(n):
            rates[i, n + i] = 1
            for j in range(n):
                rates[n + i, j] = acceleration[i, j]
        state = mpmath.expm(rates * mpmath.mpf(t), method="taylor") * mpmath.matrix([*q0, *v0])
        return np.array([float(x) for x in state])


CASES = {
    "one oscillator": (np.diag([0.3]), np.diag([7.0])),
    "one free mass": (np.diag([0.3]), np.diag([0.0])),
    "three bodies, one drift": (
        np.diag([0.3, 2.0, 0.01]),
        3.7 * np.array([[1.0, -1.0, 0.0], [-1.0, 2.0, -1.0], [0.0, -1.0, 1.0]]),
    ),
    "coupled masses": (np.array([[2.0, 0.7], [0.7, 0.5]]), np.array([[5.0, -1.0], [-1.0, 0.9]])),
    "nearly equal": (np.eye(2), np.array([[1.0, 1e-9], [1e-9, 1.0]])),
    "far apart": (np.diag([1.0, 1e-6]), np.array([[1.0, 1.0], [1.0, 1e3]])),
}


@pytest.mark.parametrize("case", CASES)
@pytest.mark.parametrize("t", [0.0, -1.3, 2.0, 50.0])
def test_motion_is_the_exponential_of_the_system(case, t):
    T, V = CASES[case]
    n = len(T)
    q0, v0 = np.array([0.3, -0.2, 0.5])[:n], np.array([-0.1, 0.4, 1.1])[:n]
    expected = exact(T, V, q0, v0, t)
    q, v = motion(T, V, q0, v0, [t])
    omega, _ = normal_modes(T, V)
    # The rest is the rounding of the answer, on the scale of the largest swing.
    assert np.abs(q[0] - expected[:n]).max() < 1e-14 * np.abs(expected).max()
    assert np.abs(v[0] - expected[n:]).max() < 1e-14 * max(1, omega.max()) * np.abs(expected).max()


def test_phases_survive_thousands_of_turns():
    with mpmath.workdps(30):
        expected = float(mpmath.cos(mpmath.sqrt(mpmath.mpf(7.0) / mpmath.mpf(0.3)) * 12345))
    q, _ = motion([[0.3]], [[7.0]], [1.0], [0.0], [12345.0])
    # 6e4 rad at 64 bits is good to 3e-15; at 53 bits it would be 7e-12.
    assert abs(q[0, 0] - expected) < 1e-14


@given(systems(), st.floats(-5, 5))
def test_energy_and_momenta_of_zero_modes_are_kept(system, t):
    T, V = system
    n = len(T)
    q0, v0 = np.linspace(1, 2, n), np.linspace(-1, 0.5, n)
    q, v = motion(T, V, q0, v0, [0.0, t])
    kinetic, potential = (np.einsum("ti,ij,tj->t", x, M, x) for x, M in ((v, T), (q, V)))
    # Relative to the largest part: one rounding of q and v each.
    assert abs(np.diff(kinetic + potential)[0]) < 1e-12 * (kinetic + potential).max()
    np.testing.assert_allclose([q[0], v[0]], [q0, v0], rtol=0, atol=1e-14)


@given(systems(), st.floats(-3, 3), st.floats(-3, 3))
def test_motion_composes(system, first, second):
    T, V = system
    q0, v0 = np.linspace(1, 2, len(T)), np.linspace(-1, 0.5, len(T))
    q, v = motion(T, V, q0, v0, [first, first + second])
    q2, v2 = motion(T, V, q[0], v[0], [(first + second) - first])
    omega, _ = normal_modes(T, V)
    stiff = max(1.0, omega.max())
    size = (np.abs(q).max() + np.abs(v).max()) * stiff
    # The halfway state is rounded, and the rest of the way carries that along.
    np.testing.assert_allclose(q2[0], q[1], rtol=0, atol=1e-12 * size)
    np.testing.assert_allclose(v2[0], v[1], rtol=0, atol=1e-12 * size)


def test_two_pendulums_joined_by_a_spring_beat():
    # Equal oscillators, weakly coupled (Taylor § 11.3): ω² = k/m and (k + 2k')/m; energy passes over.
    m, k, coupling = 0.5, 8.0, 0.1
    T, V = np.diag([m, m]), np.array([[k + coupling, -coupling], [-coupling, k + coupling]])
    omega, A = normal_modes(T, V)
    np.testing.assert_allclose(omega, np.sqrt([k / m, (k + 2 * coupling) / m]), rtol=1e-15)
    np.testing.assert_allclose(A, np.array([[1, 1], [1, -1]]) / np.sqrt(2 * m), rtol=0, atol=1e-15)
    handover = np.pi / (omega[1] - omega[0])
    q, v = motion(T, V, [1.0, 0.0], [0.0, 0.0], [handover])
    energy = (m * v**2 + k * q**2)[0] / 2
    assert energy[0] < 1e-3 * energy[1]


def test_normal_coordinates_swing_one_by_one():
    T, V = CASES["three bodies, one drift"]
    t = np.linspace(-3, 3, 7)
    q, v = motion(T, V, [0.3, -0.2, 0.5], [1.0, 0.5, -0.7], t)
    xi, rate = normal_coordinates(T, V, q), normal_coordinates(T, V, v)
    omega, A = normal_modes(T, V)
    np.testing.assert_allclose(xi @ A.T, q, rtol=0, atol=1e-14)
    # A mode keeps its amplitude: ω²ξ² + ξ̇² is constant, and for the drift ξ̇ is.
    amplitude = omega**2 * xi**2 + rate**2
    np.testing.assert_allclose(amplitude, np.broadcast_to(amplitude[0], amplitude.shape), rtol=1e-13)
    np.testing.assert_allclose(xi[:, 0], xi[3, 0] + rate[3, 0] * t, rtol=0, atol=1e-14)


def test_relabelling_and_units_change_nothing_else():
    T, V = CASES["coupled masses"]
    omega, A = normal_modes(T, V)
    swapped, B = normal_modes(T[::-1, ::-1], V[::-1, ::-1])
    np.testing.assert_allclose(swapped, omega, rtol=1e-15)
    np.testing.assert_allclose(np.abs(B), np.abs(A[::-1]), rtol=1e-14)
    slower, C = normal_modes(T * 3e12, V * 3e-8)
    np.testing.assert_allclose(slower, omega * 1e-10, rtol=1e-14)
    np.testing.assert_allclose(C, A / np.sqrt(3e12), rtol=1e-14)


def test_soft_mode_beside_stiff_ones_is_not_taken_for_a_drift():
    omega, _ = normal_modes(np.diag([1.0, 1.0]), np.diag([1e-18, 1e18]))
    np.testing.assert_allclose(omega, [1e-9, 1e9], rtol=1e-15)


@given(systems())
def test_sign_of_modes_is_settled(system):
    _, A = normal_modes(*system)
    for mode in A.T:
        share = np.abs(mode) / np.abs(mode).max()
        # An entry that is half the largest but for rounding may or may not count.
        if np.abs(share - 0.5).min() > 1e-9:
            assert mode[np.argmax(share > 0.5)] > 0


def test_coordinate_that_no_spring_holds_drifts_however_it_shares_in_the_masses():
    random = np.random.default_rng(7)
    for _ in range(300):
        mixing = random.uniform(-1, 1, (3, 3))
        V = np.zeros((3, 3))
        V[::2, ::2] = random.integers(-9, 10, (2, 2))
        V = V.T @ V
        omega, _ = normal_modes(mixing.T @ mixing + np.eye(3) / 10, V)
        assert np.count_nonzero(omega == 0) == 3 - np.linalg.matrix_rank(V)


def test_unstable_equilibrium_is_refused_with_its_growth_rate():
    with pytest.raises(InputError, match=r"grows at 2 1/s"):
        normal_modes(np.diag([2.0, 1.0]), np.diag([-8.0, 3.0]))


@pytest.mark.parametrize(
    ("T", "V", "says"),
    [
        ([[1.0, 2.0], [2.0, 3.0]], np.eye(2), "T: got .* positive definite"),
        (np.diag([1.0, 0.0]), np.eye(2), "T: got diagonal"),
        (np.diag([1.0, -1.0]), np.eye(2), "T: got diagonal"),
        ([[1.0, 0.5], [0.0, 1.0]], np.eye(2), "T: .* symmetric"),
        (np.eye(2), [[1.0, 0.5], [0.0, 1.0]], "V: .* symmetric"),
        (np.eye(2), np.eye(3), "two equal ones"),
        (np.ones((2, 3)), np.eye(2), r"T: .* shape \(2, 3\)"),
        (np.eye(2), [[1.0, np.nan], [np.nan, 1.0]], "V: .* finite"),
        (np.zeros((0, 0)), np.zeros((0, 0)), "T: .* square"),
        (1.0, 1.0, "T: "),
    ],
)
def test_bad_matrices_are_refused(T, V, says):
    with pytest.raises(InputError, match=says):
        normal_modes(T, V)


def test_shapes_that_do_not_fit_are_refused():
    T, V = CASES["coupled masses"]
    for q0, v0, t in (([1.0], [0.0, 0.0], [0.0]), ([1.0, 0.0], [0.0], [0.0]), ([1.0, 0], [0, 0], [[0.0]])):
        with pytest.raises(InputError):
            motion(T, V, q0, v0, t)
    for eta in (1.0, [1.0, 2.0, 3.0]):
        with pytest.raises(InputError, match="eta"):
            normal_coordinates(T, V, eta)

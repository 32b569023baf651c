"""The three-atom chain against its matrices, the general solver and a measured molecule."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from poinsot.reference import co2_chain
from poinsot.reference.errors import InputError
from poinsot.reference.normal_modes import normal_modes

sizes = st.floats(1e-3, 1e3)


@given(sizes, sizes, sizes)
def test_closed_form_diagonalises_both_energies(m, M, k):
    T, V = co2_chain.energies(m, M, k)
    omega, A = co2_chain.frequencies(m, M, k), co2_chain.modes(m, M)
    # A few roundings, on the scale of the fastest mode.
    np.testing.assert_allclose(A.T @ T @ A, np.eye(3), rtol=0, atol=2e-15)
    np.testing.assert_allclose(A.T @ V @ A, np.diag(omega**2), rtol=0, atol=4e-15 * omega[2] ** 2)


@given(sizes, sizes, sizes)
def test_general_solver_finds_the_same(m, M, k):
    omega, A = normal_modes(*co2_chain.energies(m, M, k))
    np.testing.assert_allclose(omega, co2_chain.frequencies(m, M, k), rtol=8e-16, atol=0)
    expected = co2_chain.modes(m, M)
    sign = np.sign(np.einsum("ik,ik->k", expected, A))
    # Modes two and three merge as m/M goes to 0: extended rounding (1e-19, a few times) over their gap.
    atol = (4e-16 + 1e-18 * M / m) * np.abs(expected).max()
    np.testing.assert_allclose(A * sign, expected, rtol=0, atol=atol)


def test_energies_are_those_of_the_drawn_chain():
    m, M, k = 0.3, 0.7, 11.0
    T, V = co2_chain.energies(m, M, k)
    eta, rate = np.array([0.1, -0.4, 0.25]), np.array([1.0, 2.0, -3.0])
    assert rate @ T @ rate == pytest.approx(m * 1.0 + M * 4.0 + m * 9.0, rel=1e-15, abs=0)
    assert eta @ V @ eta == pytest.approx(k * ((-0.4 - 0.1) ** 2 + (0.25 + 0.4) ** 2), rel=1e-14, abs=0)


@given(sizes, sizes, st.lists(st.floats(-1, 1), min_size=3, max_size=3))
def test_normal_coordinates_invert_the_modes(m, M, eta):
    xi = co2_chain.normal_coordinates(m, M, eta)
    np.testing.assert_allclose(co2_chain.modes(m, M) @ xi, eta, rtol=0, atol=1e-13)
    T, V = co2_chain.energies(m, M, 1.0)
    omega = co2_chain.frequencies(m, M, 1.0)
    # The energies fall apart into squares: η'Tη = Σξ², η'Vη = Σω²ξ².
    assert xi @ xi == pytest.approx(eta @ T @ eta, rel=1e-13, abs=1e-13)
    assert (omega * xi) @ (omega * xi) == pytest.approx(eta @ V @ eta, rel=1e-12, abs=1e-12)


def test_third_coordinate_as_some_notes_print_it_sees_a_drift():
    m, M = 16.0, 12.0
    drift = np.ones(3)
    mended = co2_chain.normal_coordinates(m, M, drift)[2]
    printed = np.sqrt(m * M / (2 * m + M)) * ((1 + 1) - np.sqrt(2) * 1)
    assert mended == 0
    assert abs(printed) > 1
    # Nor is it normalised: on the mode itself it should read 1.
    mode = co2_chain.modes(m, M)[:, 2]
    assert co2_chain.normal_coordinates(m, M, mode)[2] == pytest.approx(1, abs=1e-15)
    eta1, eta2, eta3 = mode
    assert abs(np.sqrt(m * M / (2 * m + M)) * ((eta1 + eta3) - np.sqrt(2) * eta2) - 1) > 0.1


def test_equation_for_the_third_mode_lacks_a_mass_in_the_slides():
    # −k a1 + [2k − (k/m)(1 + 2m/M)] a2 − k a3 = 0 is printed; the bracket is 2k − ω²M.
    m, M, k = 16.0, 12.0, 5.0
    a1, a2, a3 = co2_chain.modes(m, M)[:, 2]
    square = k / m * (1 + 2 * m / M)
    assert -k * a1 + (2 * k - square * M) * a2 - k * a3 == pytest.approx(0, abs=1e-14)
    assert abs(-k * a1 + (2 * k - square) * a2 - k * a3) > 1


def test_carbon_dioxide_as_measured():
    # Herzberg, Infrared and Raman Spectra: ν1 = 1388, ν3 = 2349 cm⁻¹. Springs alone predict the ratio
    # √(1 + 2·16/12) = 1.915 where 1.69 is measured: right to the 15 % that this model is known to be off.
    _, slow, fast = co2_chain.frequencies(15.995, 12.0, 1.0)
    assert fast / slow == pytest.approx(np.sqrt(1 + 2 * 15.995 / 12.0), rel=1e-15, abs=0)
    assert fast / slow == pytest.approx(2349 / 1388, rel=0.15, abs=0)


def test_displacements_come_in_any_number():
    eta = np.arange(12.0).reshape(2, 2, 3)
    xi = co2_chain.normal_coordinates(0.3, 0.7, eta)
    assert xi.shape == eta.shape
    np.testing.assert_array_equal(xi[1, 0], co2_chain.normal_coordinates(0.3, 0.7, eta[1, 0]))


@pytest.mark.parametrize("bad", [0.0, -1.0, np.nan, np.inf, "x"])
def test_masses_and_springs_must_be_positive(bad):
    for arguments in ((bad, 1.0, 1.0), (1.0, bad, 1.0), (1.0, 1.0, bad)):
        with pytest.raises(InputError):
            co2_chain.energies(*arguments)
        with pytest.raises(InputError):
            co2_chain.frequencies(*arguments)
    for masses in ((bad, 1.0), (1.0, bad)):
        with pytest.raises(InputError):
            co2_chain.modes(*masses)
        with pytest.raises(InputError):
            co2_chain.normal_coordinates(*masses, [0.0, 0.0, 0.0])
    for eta in (0.0, [1.0, 2.0]):
        with pytest.raises(InputError, match="eta"):
            co2_chain.normal_coordinates(1.0, 1.0, eta)

"""The chain of beads against its energies, textbook chains and the general solver."""

import numpy as np
import pytest
from poinsot.reference import bead_chain
from poinsot.reference.errors import InputError
from poinsot.reference.normal_modes import normal_modes


@pytest.mark.parametrize("ends", bead_chain.ENDS)
@pytest.mark.parametrize("beads", [3, 4, 7, 16, 64])
def test_frequencies_are_those_of_the_matrices(beads, ends):
    m, k = 0.37, 1234.5
    omega, A = normal_modes(*bead_chain.energies(beads, m, k, ends))
    expected = bead_chain.frequencies(beads, m, k, ends)
    # Two roundings of each side; a zero must be exact.
    np.testing.assert_allclose(omega, expected, rtol=6e-16, atol=0)
    # Degenerate pairs of the ring included: orthogonal to a few roundings of a sum over the beads.
    np.testing.assert_allclose(m * A.T @ A, np.eye(beads), rtol=0, atol=2e-15)


@pytest.mark.parametrize(
    ("beads", "ends", "squares"),
    [
        # By hand, in units of k/m.
        (1, "walls", [2.0]),
        (2, "walls", [1.0, 3.0]),
        (3, "walls", [2 - np.sqrt(2), 2.0, 2 + np.sqrt(2)]),
        (1, "wall", [1.0]),
        (2, "wall", [(3 - np.sqrt(5)) / 2, (3 + np.sqrt(5)) / 2]),
        (1, "free", [0.0]),
        (2, "free", [0.0, 2.0]),
        (3, "free", [0.0, 1.0, 3.0]),
        (3, "ring", [0.0, 3.0, 3.0]),
        (4, "ring", [0.0, 2.0, 2.0, 4.0]),
    ],
)
def test_short_chains_solved_by_hand(beads, ends, squares):
    m, k = 0.5, 8.0
    np.testing.assert_allclose(
        bead_chain.frequencies(beads, m, k, ends) ** 2, np.array(squares) * k / m, rtol=1e-14, atol=0
    )


@pytest.mark.parametrize("ends", bead_chain.ENDS)
def test_potential_energy_is_the_sum_over_springs(ends):
    m, k = 0.3, 11.0
    x = np.array([0.1, -0.4, 0.25, 0.7])
    T, V = bead_chain.energies(4, m, k, ends)
    stretches = list(np.diff(x))
    stretches += {"walls": [x[0], x[-1]], "wall": [x[0]], "free": [], "ring": [x[0] - x[-1]]}[ends]
    assert x @ V @ x == pytest.approx(k * np.sum(np.square(stretches)), rel=1e-14, abs=0)
    np.testing.assert_array_equal(T, m * np.eye(4))


def test_wall_stands_on_the_left():
    _, V = bead_chain.energies(3, 1.0, 1.0, "wall")
    assert V[0, 0] == 2
    assert V[2, 2] == 1


def test_refuses_what_is_no_chain():
    for beads, ends in ((0, "walls"), (2, "ring"), (2.5, "free"), (-3, "wall")):
        with pytest.raises(InputError, match="beads"):
            bead_chain.energies(beads, 1.0, 1.0, ends)
        with pytest.raises(InputError, match="beads"):
            bead_chain.frequencies(beads, 1.0, 1.0, ends)
    with pytest.raises(InputError, match="walls, wall, free, ring"):
        bead_chain.energies(3, 1.0, 1.0, "open")
    for m, k in ((0.0, 1.0), (1.0, -1.0)):
        with pytest.raises(InputError):
            bead_chain.energies(3, m, k)
        with pytest.raises(InputError):
            bead_chain.frequencies(3, m, k)

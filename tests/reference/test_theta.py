"""Theta functions against mpmath's, on both sides of the square lattice."""

import numpy as np
import pytest
from poinsot.reference.precise import mp
from poinsot.reference.theta import at_origin, doubled, lattice, slope, theta, theta_above, waves

# A few units in the last place: five terms of a series and two elementary functions.
ROUNDING = 2e-15

#: K, K′: q from exp(−31) over exp(−π) to q′ = exp(−31); the square lattice counts as trigonometric.
LATTICES = [(1.0, 10.0), (1.0, 2.0), (1.0, 1.0), (1.001, 1.0), (2.0, 1.0), (10.0, 1.0)]
INDICES = (1, 2, 3, 4)


def truth(index, K, K_prime, u, depth):
    z = mp.pi * mp.mpc(u, depth) / (2 * K)
    return mp.jtheta(index, z, mp.exp(-mp.pi * mp.mpf(K_prime) / K))


def places(K):
    return np.linspace(-K / 2, K / 2, 9)


def evaluated(cell, K):
    u = places(K)
    return u, waves(cell, (u, np.zeros_like(u)))


@pytest.mark.parametrize(("K", "K_prime"), LATTICES)
@pytest.mark.parametrize("index", INDICES)
def test_on_the_real_axis_they_are_the_theta_functions_but_for_one_gaussian(index, K, K_prime):
    cell = lattice(mp.mpf(K), mp.mpf(K_prime))
    u, w = evaluated(cell, K)
    found = theta(cell, index, w)
    reference = theta(cell, 4, w)
    for place, value, beside in zip(u, found, reference, strict=True):
        ratio = truth(index, K, K_prime, place, 0) / truth(4, K, K_prime, place, 0)
        scale = (
            mp.diff(lambda x: truth(1, K, K_prime, x, 0), 0) if index == 1 else truth(index, K, K_prime, 0, 0)
        ) / truth(4, K, K_prime, 0, 0)
        own = at_origin(cell, index) / at_origin(cell, 4)
        assert abs(value / beside / own - ratio.real / scale.real) < ROUNDING * max(1, abs(ratio / scale))


@pytest.mark.parametrize(("K", "K_prime"), LATTICES)
@pytest.mark.parametrize("index", INDICES)
@pytest.mark.parametrize("share", [-0.9, 0.05, 0.5, 0.95])
def test_above_the_real_axis_they_have_the_argument_of_the_theta_functions(index, K, K_prime, share):
    cell = lattice(mp.mpf(K), mp.mpf(K_prime))
    depth = mp.mpf(share) * cell.K_prime
    u, w = evaluated(cell, K)
    real, imaginary = theta_above(cell, index, depth, w)
    for place, x, y in zip(u, real, imaginary, strict=True):
        value = truth(index, K, K_prime, place, depth)
        if cell.hyperbolic:
            # The Gaussian of Jacobi's transformation, which the function leaves out.
            value *= mp.expj(mp.pi * depth / (2 * cell.K_prime) * mp.mpf(float(place)) / cell.K)
        unit = complex(value / abs(value))
        # Near a zero (depth small or near K′) the argument is as much worse as the function is smaller.
        assert abs(complex(x, y) / abs(complex(x, y)) - unit) < 20 * ROUNDING


@pytest.mark.parametrize(("K", "K_prime"), LATTICES)
@pytest.mark.parametrize("index", INDICES)
def test_the_slope_is_that_of_the_argument(index, K, K_prime):
    cell = lattice(mp.mpf(K), mp.mpf(K_prime))
    depth = cell.K_prime / 3

    def angle(u):
        value = truth(index, K, K_prime, u, depth) / truth(index, K, K_prime, 0, depth)
        return mp.arg(value)

    expected = mp.diff(angle, 0)
    if cell.hyperbolic:
        expected += mp.pi * depth / (2 * cell.K_prime) / cell.K
    assert abs(slope(cell, index, depth) - expected) < 1e-20


def test_a_lattice_says_what_its_series_need():
    tall, wide = lattice(mp.mpf(1), mp.mpf(3)), lattice(mp.mpf(3), mp.mpf(1))
    assert not tall.hyperbolic
    assert wide.hyperbolic
    assert tall.nome == wide.nome == mp.exp(-3 * mp.pi)
    assert tall.scale == wide.scale == mp.pi / 2


def test_doubling_doubles_the_imaginary_period_only():
    once = lattice(mp.mpf(3), mp.mpf(2))
    assert doubled(once) == lattice(mp.mpf(3), mp.mpf(4))
    assert once.hyperbolic
    assert not doubled(once).hyperbolic


def test_an_infinite_period_leaves_elementary_functions():
    u = np.array([-800.0, -1.0, 0.0, 0.5, 5000.0])
    flat = lattice(mp.pi / 2, mp.inf)
    w = waves(flat, (u, np.zeros_like(u)))
    assert np.array_equal(theta(flat, 1, w), np.sin(u))
    assert np.array_equal(theta(flat, 3, w), np.ones(5))
    separatrix = lattice(mp.inf, mp.pi / 2)
    w = waves(separatrix, (u, np.zeros_like(u)))
    assert np.array_equal(theta(separatrix, 1, w), np.tanh(np.clip(u, -690, 690)))
    assert np.array_equal(theta(separatrix, 4, w), np.ones(5))
    # Each is over cosh u: 1/cosh u is what is left of θ2 and θ3.
    assert np.allclose(theta(separatrix, 2, w)[1:4], 1 / np.cosh(u[1:4]), rtol=1e-15)
    assert np.all(theta(separatrix, 3, w)[[0, 4]] < 1e-299)


def test_the_low_part_of_an_argument_counts():
    separatrix = lattice(mp.inf, mp.pi / 2)
    high, low = np.array([300.0]), np.array([2e-14])
    found = theta(separatrix, 2, waves(separatrix, (high, low)))[0]
    assert abs(found * mp.cosh(mp.mpf(300) + mp.mpf(2e-14)) - 1) < 5e-16

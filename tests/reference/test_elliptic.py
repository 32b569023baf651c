"""Jacobi's functions and the third-kind integral against mpmath's, at both ends of the modulus."""

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st
from poinsot.reference import elliptic
from poinsot.reference.double_double import turning
from poinsot.reference.errors import InputError
from poinsot.reference.precise import mp
from poinsot.reference.theta import doubled

#: 1 − m, written so that it stays exact where m is next to 1.
COMPLEMENTS = ["1", "0.999999", "0.9", "0.51", "0.49", "0.1", "1e-5", "1e-12", "1e-40", "0"]

# Measured 8e-16 over these; a quotient of two five-term series and one quarter-period shift.
ROUNDING = 2e-15

TIMES = np.array([-19.3, -7.1, -2.2, -1e-9, 0.0, 0.4, 1.6, 3.0, 11.7, 18.9])


def made(complement):
    m1 = mp.mpf(complement)
    return elliptic.modulus(1 - m1, m1)


def function(name, u, m, digits=120):
    with mp.workdps(digits):  # 1 − m itself has fifty digits
        return mp.ellipfun(name, u, m=m)


@pytest.mark.parametrize("complement", COMPLEMENTS)
def test_jacobi_functions_keep_their_last_digits(complement):
    modulus = made(complement)
    with mp.workdps(120):
        m = 1 - mp.mpf(complement)
    rate, start = mp.mpf(4) / 3, mp.mpf(1) / 7
    found = elliptic.jacobi(modulus, elliptic.phase(modulus, rate, start, TIMES))
    for name, values in zip(("sn", "cn", "dn"), found, strict=True):
        for t, value in zip(TIMES, values, strict=True):
            truth = function(name, start + rate * mp.mpf(float(t)), m)
            assert abs(value - truth) <= ROUNDING * abs(truth)


@pytest.mark.parametrize("complement", ["0.7", "0.2", "1e-6"])
def test_zeros_keep_their_relative_digits(complement):
    modulus = made(complement)
    K, near = modulus.lattice.K, np.array([1e-9])
    sn, _, _ = elliptic.jacobi(modulus, elliptic.phase(modulus, mp.mpf(1), 2 * K, near))
    _, cn, _ = elliptic.jacobi(modulus, elliptic.phase(modulus, mp.mpf(1), 3 * K, near))
    assert abs(sn[0] + 1e-9) < ROUNDING * 1e-9
    assert abs(cn[0] - float(mp.sqrt(modulus.m1)) * 1e-9) < ROUNDING * 1e-9


@given(st.floats(1e-300, 1.0), st.floats(-1e6, 1e6))
@example(1e-300, 0.3)
def test_the_squares_add_up(complement, t):
    m1 = mp.mpf(complement)
    modulus = elliptic.modulus(1 - m1, m1)
    sn, cn, dn = elliptic.jacobi(modulus, elliptic.phase(modulus, mp.mpf(1), mp.mpf(0), np.array([t])))
    assert abs(sn**2 + cn**2 - 1) < 4e-15
    assert abs(float(modulus.m) * sn**2 + dn**2 - 1) < 4e-15
    assert abs(dn**2 - float(modulus.m) * cn**2 - complement) < 4e-15


def test_late_phases_repeat():
    modulus = made("1e-8")
    period, late = 4 * modulus.lattice.K, 2.0**33
    there = elliptic.phase(modulus, period, mp.mpf(1) / 3, np.array([late]))
    here = elliptic.phase(modulus, period, mp.mpf(1) / 3, np.array([0.0]))
    for a, b in zip(elliptic.jacobi(modulus, there), elliptic.jacobi(modulus, here), strict=True):
        assert abs(a - b)[0] < 1e-15


def test_quarter_periods():
    assert abs(made("0.5").lattice.K - mp.ellipk(mp.mpf(1) / 2)) < 1e-45
    assert abs(made("0.3").lattice.K_prime - mp.ellipk(mp.mpf("0.3"))) < 1e-45
    # Whittaker & Watson § 22.8: K of the lemniscate is Γ(¼)²/(4√π).
    assert abs(made("0.5").lattice.K_prime - mp.gamma(0.25) ** 2 / (4 * mp.sqrt(mp.pi))) < 1e-45
    assert mp.isinf(made("0").lattice.K)
    assert mp.isinf(made("1").lattice.K_prime)


@pytest.mark.parametrize("complement", ["1", "0.9", "0.2", "1e-12", "1e-40", "0"])
@pytest.mark.parametrize("u", ["-0.9", "0", "1e-9", "1.1"])
def test_the_phase_is_found_from_the_functions(complement, u):
    with mp.workdps(120):
        m = 1 - mp.mpf(complement)
    sn, cn, dn = (function(name, mp.mpf(u), m) for name in ("sn", "cn", "dn"))
    assert abs(elliptic.first_kind(sn, cn, dn) - mp.mpf(u)) < 1e-40


def integral(n, u, m):
    """∫₀ᵘ du/(1 − n sn²u) by quadrature, piece by piece."""
    return mp.quad(lambda x: 1 / (1 - n * function("sn", x, m, 25) ** 2), mp.linspace(0, u, 9))


CIRCULAR = [
    ("0.9", "-2.5"),
    ("0.9", "-1e-3"),
    ("0.9", "0.3"),
    ("0.9", "0.99"),
    ("0.2", "-40"),
    ("0.2", "-0.1"),
    ("0.2", "0.82"),
    ("0.2", "0.999"),
    ("1e-6", "-3"),
    ("1e-6", "0.9999995"),
]


@pytest.mark.parametrize(("complement", "n"), CIRCULAR)
def test_the_third_kind_integral_is_a_rate_and_the_argument_of_a_theta_function(complement, n):
    modulus, n = made(complement), mp.mpf(n)
    third = elliptic.third_kind(modulus, n)
    assert abs(third.scale**2 - (1 - n) * (1 - modulus.m / n)) < 1e-40
    t = np.array([-4.4, 0.0, 0.7, 2.9, 6.1])
    phase = elliptic.phase(modulus, mp.mpf(1), mp.mpf(0), t)
    periodic = elliptic.turn(modulus.lattice, third.function, third.depth, phase)
    cosine, sine = turning(third.rate, 0, t)
    found = (cosine + 1j * sine) * periodic / periodic[1]
    with mp.workdps(20):
        for u, value in zip(t, found, strict=True):
            angle = third.scale * integral(n, mp.mpf(float(u)), modulus.m)
            assert abs(value - complex(mp.expj(angle))) < 3e-15


@pytest.mark.parametrize(("complement", "n"), [("0.2", "-3"), ("0.2", "0.9"), ("0.9", "0.3")])
def test_the_secular_rate_is_the_complete_integral_s(complement, n):
    modulus, n = made(complement), mp.mpf(n)
    third = elliptic.third_kind(modulus, n)
    complete = third.scale * mp.ellippi(n, modulus.m)
    # θ1 and θ2 turn by −π over a half period 2K when they lie above the axis, forwards below it.
    assert abs(third.rate * modulus.lattice.K + mp.pi / 2 - complete) < 1e-40


def test_given_differences_are_used():
    modulus = made("0.2")
    assert elliptic.third_kind(modulus, mp.mpf("0.9")) == elliptic.third_kind(
        modulus, mp.mpf("0.9"), mp.mpf("0.9") - modulus.m, 1 - mp.mpf("0.9")
    )
    shifted = elliptic.third_kind(modulus, mp.mpf("0.9"), mp.mpf("0.05"), mp.mpf("0.2"))
    assert abs(shifted.scale - mp.sqrt(mp.mpf("0.05") * mp.mpf("0.2") / mp.mpf("0.9"))) < 1e-45


@pytest.mark.parametrize("complement", ["0.9", "0.3", "1e-9"])
@pytest.mark.parametrize("index", [1, 2, 3, 4])
@pytest.mark.parametrize("twice", [False, True])
def test_a_turn_goes_on_smoothly_at_its_rate(complement, index, twice):
    modulus = made(complement)
    cell = doubled(modulus.lattice) if twice else modulus.lattice
    depth, step = cell.K_prime / 3, 1e-6
    across = np.array([-step, 0.0, step])
    around = elliptic.turn(cell, index, depth, elliptic.phase(modulus, mp.mpf(1), mp.mpf(0), across))
    rate = np.angle(around[2] / around[0]) / (2 * step)
    assert abs(rate - float(elliptic.turn_rate(cell, index, depth))) < 1e-9
    # Quarter periods are seams of the evaluation, not of the function.
    for quarter in range(-4, 5):
        seam = (mp.mpf(quarter) + mp.mpf(1) / 2) * modulus.lattice.K
        before, after = elliptic.turn(
            cell, index, depth, elliptic.phase(modulus, mp.mpf(1), seam, np.array([-1e-12, 1e-12]))
        )
        assert abs(before - after) < 1e-11
    # DLMF § 20.2(iii): over 2K the functions 1 and 2 change sign, the others return.
    start = elliptic.phase(modulus, 2 * modulus.lattice.K, mp.mpf("0.3"), np.array([0.0, 1.0, 2.0]))
    first, later, last = elliptic.turn(cell, index, depth, start)
    assert abs(later - (-first if index < 3 else first)) < 1e-14
    assert abs(last - first) < 1e-14


@pytest.mark.parametrize(("m", "m1"), [(-0.1, 1.1), (1.1, -0.1), (0.5, 0.4), (float("nan"), 0.5)])
def test_a_modulus_outside_its_range_is_refused(m, m1):
    with pytest.raises(InputError, match="m, m1: got"):
        elliptic.modulus(m, m1)


@pytest.mark.parametrize("n", [0, 0.5, 0.79, 1, 2])
def test_an_integral_that_is_not_circular_is_refused(n):
    with pytest.raises(InputError, match="n: got"):
        elliptic.third_kind(made("0.2"), n)

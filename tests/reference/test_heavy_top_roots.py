"""Turning points of heavy tops against roots found in many more digits, and what is decided exactly."""

import math
from fractions import Fraction

import mpmath
import numpy as np
import pytest
from poinsot.reference.heavy_top_case import case
from poinsot.reference.heavy_top_constants import constants, is_steady, is_weightless, real
from poinsot.reference.heavy_top_roots import roots

SEED = 20240614
HANDY = {"mass": 1.0, "length": 1.0, "moments": (1.0, 0.5), "gravity": 1.0}
LEVEL = [0.5, 0.5, 0.5, 0.5]


def of(q0, omega0, **change):
    return constants(**{**HANDY, **change}, q0=q0, omega0=omega0)


def random_motions():
    random = np.random.default_rng(SEED)
    for scale in (1.0, 1e-3, 1e4):
        for _ in range(6):
            q0 = random.normal(size=4)
            yield of(q0 / np.linalg.norm(q0), random.normal(size=3) * [3, 3, 9], gravity=scale)
    for kick in (1e-6, 1e-30, 1e-90):
        yield of([0, 0, 0, 1], [kick, 0, 3.0])
        yield of([0, 0, 0, 1], [kick, 0, 30.0])
        yield of([0, 0, 0, 1], [kick, 0, 4 * math.sqrt(2)])
        yield of([1, 0, 0, 0], [kick, 0, 3.0])
        yield of([1, kick, 0, 0], [0, 2, 3.0])
        yield of(LEVEL, [kick, 1, 2])


def polished(motion, d):
    """A root of (e + k d) d (2 − d) − (c + a d)², from a start that is good to many digits, by Newton."""
    k, a, c, e = (mpmath.mpf(v.numerator) / v.denominator for v in motion[:4])
    for _ in range(12):
        value = (e + k * d) * d * (2 - d) - (c + a * d) ** 2
        slope = k * d * (2 - d) + (e + k * d) * (2 - 2 * d) - 2 * a * (c + a * d)
        d -= value / slope
    return d


@pytest.mark.parametrize("motion", list(random_motions()))
def test_they_are_roots_and_their_differences_keep_their_digits(motion):
    found = roots(motion)
    with mpmath.workdps(500):
        k, a, _, e = (mpmath.mpf(v.numerator) / v.denominator for v in motion[:4])
        starts = (found.d1, found.from_upright[0], -found.from_upright[1])
        d1, d2, d3 = (polished(motion, mpmath.mpf(start._mpf_)) for start in starts)
        # No root was found twice: the sum of all is a coefficient.
        assert abs(d1 + d2 + d3 - (2 - (e + a * a) / k)) < mpmath.mpf(10) ** -400 * (1 + abs(d3))
        d0, rest = mpmath.mpf(motion.d0.numerator) / motion.d0.denominator, -e / k
        wanted = [
            (found.d1, d1),
            (found.d12, d1 - d2),
            (found.d13, d1 - d3),
            (found.d23, d2 - d3),
            *zip(found.from_start, (d1 - d0, d0 - d2, d0 - d3), strict=True),
            *zip(found.from_hanging, (2 - d1, 2 - d2, 2 - d3), strict=True),
            *zip(found.from_upright, (d2, -d3), strict=True),
            *zip(found.from_rest, (d1 - rest, d2 - rest, rest - d3), strict=True),
        ]
        for place, (got, exact) in enumerate(wanted):
            got = mpmath.mpf(got._mpf_)
            if got == 0:
                assert abs(exact) < mpmath.mpf(10) ** -400, place
            else:
                assert abs(got / exact - 1) < mpmath.mpf(10) ** -44, place


def test_constants_by_hand():
    """Level along −y with spin 8: I1 = 2, I3 = 0.5, Mgl = 3 · 0.5 · 4; ω2 is about the vertical."""
    half = math.sqrt(0.5)
    motion = constants(3.0, 0.5, (2.0, 0.5), 4.0, [half, 0, 0, half], [0.25, 3.0, 8.0])
    assert motion.k == 6
    assert motion.a == 2
    assert motion.d0 == 1
    assert motion.c == 3 - 2
    assert motion.across == Fraction(145, 16)
    assert motion.e == motion.across - 6
    # ω1 = ¼ about x lifts a point at −y ... downwards: e3 = −y, ω × e3 = −¼ z.
    assert motion.rise == Fraction(-1, 4)
    assert motion.spin == 6


def test_what_is_steady_is_decided_exactly():
    assert is_steady(of(LEVEL, [0, 1, 2]))
    assert not is_steady(of(LEVEL, [0, 1, np.nextafter(2, 3)]))
    assert not is_steady(of(LEVEL, [5e-324, 1, 2]))
    assert not is_steady(of(LEVEL, [0, -1, 2]))
    for spin in (0.0, 1.0, 4 * math.sqrt(2), 100.0):
        assert is_steady(of([0, 0, 0, 1], [0, 0, spin]))
        assert is_steady(of([0.6, 0.8, 0, 0], [0, 0, spin]))
        assert not is_steady(of([0, 0, 0, 1], [0, 5e-324, spin]))
        assert not is_steady(of([1, 0, 0, 5e-324], [0, 0, spin]))
    # At its turning point, but not steady.
    assert not is_steady(of(LEVEL, [0, 0, 2]))
    assert not is_steady(of([1, 0, 0, 0], [2, 0, 0]))


def test_what_gravity_cannot_turn_is_weightless():
    motion = of(LEVEL, [0, 0, 2], gravity=0.5)
    assert not is_weightless(motion, 1.1e-10)
    assert is_weightless(motion, 0.9e-10)
    assert is_weightless(motion, -0.9e-10)
    assert is_weightless(of(LEVEL, [0, 0, 2], gravity=0), 1e300)


def test_on_the_separatrix_the_upper_roots_are_one():
    found = roots(of([1, 0, 0, 0], [2, 0, 0]))
    assert found.d23 == 0
    assert found.from_upright == (0, 0)
    assert found.from_rest[1:] == (0, 0)
    assert found.d12 == found.d13 == found.d1
    assert abs(found.d1 - 2) < 1e-40
    this = case(of([1, 0, 0, 0], [2, 0, 0]), found)
    assert this.modulus.m1 == 0
    assert mpmath.isinf(this.modulus.lattice.K)


def test_roots_that_are_known_beforehand_are_exact():
    """Upright d2 = 0, or d3 = 0 if it stays below; hanging d1 = 2; released at rest d2 = dE."""
    assert roots(of([0, 0, 0, 1], [1, 0, 2])).from_upright[0] == 0
    below = roots(of(LEVEL, [0.5, 0.5, 1]))
    assert below.from_upright[1] == 0
    assert below.from_upright[0] > 0
    assert roots(of([1, 0, 0, 0], [1, 0, 2])).from_hanging[0] == 0
    released = roots(of([math.sqrt(0.5), 0, 0, math.sqrt(0.5)], [0, 0, 2]))
    assert released.from_rest[1] == 0
    assert released.from_start[1] == 0
    assert released.from_start[0] > 0


def test_real():
    assert real(Fraction(1, 4)) == 0.25
    assert abs(real(Fraction(1, 3)) * 3 - 1) < 1e-49

"""Pairs of doubles against exact rationals and fifty-digit numbers."""

from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from poinsot.reference.double_double import affine, fraction, pair, scale, turning, two_product, two_sum
from poinsot.reference.errors import InputError
from poinsot.reference.precise import mp

# Within these bounds neither a product nor its error leaves the range of normal doubles.
NUMBERS = st.floats(-1e100, 1e100).filter(lambda x: x == 0 or abs(x) > 1e-100)
FACTORS = st.floats(1e-3, 1e3)


def exact(x):
    return sum(Fraction(float(part)) for part in x)


@given(NUMBERS, NUMBERS)
def test_a_sum_and_its_error_are_exact(a, b):
    high, low = two_sum(a, b)
    assert high == a + b
    assert exact((high, low)) == Fraction(a) + Fraction(b)


@given(NUMBERS, NUMBERS)
def test_a_product_and_its_error_are_exact(a, b):
    high, low = two_product(a, b)
    assert high == a * b
    assert exact((high, low)) == Fraction(a) * Fraction(b)


@given(FACTORS, FACTORS, st.floats(-0.5, 0.5), st.floats(-0.5, 0.5))
def test_scaling_keeps_thirty_digits(a, b, low_a, low_b):
    x, y = two_sum(a, low_a * np.spacing(a)), two_sum(b, low_b * np.spacing(b))
    product = exact(x) * exact(y)
    # Three rounded terms of relative size 2⁻⁵³ each, rounded again: some 2⁻¹⁰⁴.
    assert abs(exact(scale(x, y)) - product) <= product * Fraction(1, 2**102)


def test_a_pair_holds_thirty_two_digits():
    high, low = pair(mp.pi)
    assert high == np.pi
    assert abs(mp.mpf(high) + low - mp.pi) < 1e-32


@pytest.mark.parametrize(
    ("rate", "start", "t"),
    [
        (mp.mpf(4000) / 3, mp.mpf(1) / 7, 1e3),
        (mp.mpf(4000) / 3, -mp.mpf(2) / 7, -1e3),
        (mp.mpf(10) ** 300 / 3, mp.mpf(0), 1e-297),
        (mp.mpf(10) ** -300 / 3, mp.mpf(1) / 3, 1e300),
        (mp.mpf(10) ** 12 / 3, mp.mpf(1) / 3, 987.0),
        (mp.mpf(0), mp.mpf(1) / 3, 1e300),
    ],
)
def test_a_phase_keeps_its_digits(rate, start, t):
    high, low = affine(rate, start, np.array([t]))
    truth = start + rate * mp.mpf(t)
    assert abs(mp.mpf(float(high[0])) + float(low[0]) - truth) <= 1e-31 * abs(truth)


@given(st.floats(-1e12, 1e12), st.floats(-0.5, 0.5))
def test_whole_and_rest_add_up_and_the_rest_is_short(high, part):
    x = two_sum(high, part * np.spacing(high))
    whole, rest = fraction(x)
    assert whole == np.rint(whole)
    assert Fraction(float(whole)) + exact(rest) == exact(x)
    assert abs(rest[0]) <= 0.5 + np.spacing(0.5)


@pytest.mark.parametrize("t", [0.0, 0.37, -2.5, 1e3, -7.7e8, 1.3e11])
def test_cosine_and_sine_of_a_late_angle(t):
    rate, start = mp.mpf(4000) / 3, mp.mpf(5) / 7
    cosine, sine = turning(rate, start, np.array([t]))
    angle = start + rate * mp.mpf(t)
    # Half a unit in the last place from the library's sine, half from each rounding after it.
    assert abs(cosine[0] - mp.cos(angle)) < 2.3e-16
    assert abs(sine[0] - mp.sin(angle)) < 2.3e-16


def test_a_phase_beyond_its_digits_is_refused():
    with pytest.raises(InputError, match=r"t: got 2000\.0, expected at most 1000\.0"):
        affine(mp.mpf(1e12), mp.mpf(0), np.array([1.0, -2e3]))
    assert affine(mp.mpf(1e12), mp.mpf(0), np.array([]))[0].size == 0

"""Fifty digits, whatever anybody sets mpmath to."""

import mpmath
import numpy as np
from poinsot.reference.precise import DIGITS, mp
from poinsot.reference.torque_free import motion


def test_it_has_fifty_digits_and_takes_doubles_exactly():
    assert mp.dps == DIGITS == 50
    assert abs(mp.mpf(1) / 3 * 3 - 1) < 1e-49
    assert mp.mpf(0.1) == mp.mpf(3602879701896397) / mp.mpf(2) ** 55


def test_a_caller_s_precision_changes_nothing():
    arguments = ([1.0, 2.0, 2.5], [0, 0, 0, 1], [0.123, 0.456, 2.789], [77.0])
    kept = motion(*arguments)
    with mpmath.workdps(3):
        # Other digits of the input, so that nothing is remembered from before.
        other = motion([1.0, 2.0, 2.5], [0, 0, 0, 1], [0.123, 0.456, -2.789], [77.0])
        again = motion(*arguments)
    free = motion([1.0, 2.0, 2.5], [0, 0, 0, 1], [0.123, 0.456, -2.789], [77.0])
    for a, b in zip((*kept, *other), (*again, *free), strict=True):
        assert np.array_equal(a, b)
    assert mp.dps == DIGITS

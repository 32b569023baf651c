"""Rates near a principal axis against the exact motion, and against each other."""

import math

import numpy as np
import pytest
from poinsot.reference.errors import InputError
from poinsot.reference.torque_free import body_cone_rate, motion
from poinsot.reference.wobble import flip_period, growth_rate, linear_rates, wobble_rate, wobble_ratio

AT_REST = [0.0, 0.0, 0.0, 1.0]
#: Each order puts another moment on each axis.
ORDERS = [
    [1.0, 2.0, 2.5],
    [2.0, 2.5, 1.0],
    [2.5, 1.0, 2.0],
    [1.0, 2.5, 2.0],
    [2.5, 2.0, 1.0],
    [2.0, 1.0, 2.5],
]
SPIN = 3.0
KICK = 1e-6


def released(axis, along, kick=KICK):
    """ω0 about ``axis`` with a small component along the axis ``along`` places further on."""
    omega = np.zeros(3)
    omega[axis] = SPIN
    omega[(axis + along) % 3] = kick
    return omega


@pytest.mark.parametrize("moments", ORDERS)
@pytest.mark.parametrize("axis", [0, 1, 2])
def test_linear_rates_are_euler_s_equations_to_first_order(moments, axis):
    Omega_i, Omega_j = linear_rates(moments, axis, SPIN)
    i, j = (axis + 1) % 3, (axis + 2) % 3
    step = 1e-5
    for along, moved, rate in ((2, i, -Omega_i), (1, j, Omega_j)):
        _, omega = motion(moments, AT_REST, released(axis, along), [-step, step])
        # Central difference, with KICK² left out by the linear equations.
        assert abs((omega[1, moved] - omega[0, moved]) / (2 * step) / KICK - rate) < 1e-8


def test_linear_rates_as_written_out_for_the_third_axis():
    """Ω1 = ω3(I3 − I2)/I1, Ω2 = ω3(I3 − I1)/I2."""
    assert linear_rates([1.0, 2.0, 2.5], 2, 3.0) == (3.0 * 0.5 / 1.0, 3.0 * 1.5 / 2.0)


@pytest.mark.parametrize("moments", ORDERS)
@pytest.mark.parametrize("spin", [SPIN, -SPIN])
def test_a_wobble_is_an_ellipse_of_that_rate_and_ratio(moments, spin):
    for axis in (int(np.argmin(moments)), int(np.argmax(moments))):
        i, j = (axis + 1) % 3, (axis + 2) % 3
        rate, ratio = wobble_rate(moments, axis, spin), wobble_ratio(moments, axis)
        quarter = 0.5 * math.pi / rate
        t = np.array([0.0, quarter, 2 * quarter, 4 * quarter])
        _, omega = motion(moments, AT_REST, np.sign(spin) * released(axis, 1), t)
        # The rate depends on the amplitude by its square, 1e-12.
        assert np.abs(omega[[1], [i]]).max() < 1e-10 * KICK
        assert abs(abs(omega[1, j]) / KICK - ratio) < 1e-10
        assert abs(omega[2, i] + omega[0, i]) < 1e-10 * KICK
        assert np.abs(omega[3] - omega[0]).max() < 1e-10 * KICK


def test_a_wobble_of_a_symmetric_top_is_its_body_cone():
    assert wobble_rate([2.0, 2.0, 3.0], 2, -4.0) == abs(body_cone_rate(2.0, 3.0, -4.0))
    assert wobble_ratio([2.0, 2.0, 3.0], 2) == 1.0
    assert wobble_rate([2.0, 2.0, 3.0], 0, 4.0) == 0.0


@pytest.mark.parametrize("moments", ORDERS)
@pytest.mark.parametrize("spin", [SPIN, -SPIN])
def test_about_the_middle_axis_a_kick_grows_at_the_rate(moments, spin):
    middle = int(np.argsort(moments)[1])
    rate = growth_rate(moments, spin)
    t = np.array([6.0, 7.0]) / rate
    _, omega = motion(moments, AT_REST, np.sign(spin) * released(middle, 1, 1e-9), t)
    i = (middle + 1) % 3
    # cosh grows as e, but for e⁻¹² at 6 e-foldings.
    assert abs(np.log(omega[1, i] / omega[0, i]) - 1) < 1e-5
    Omega_i, Omega_j = linear_rates(moments, middle, spin)
    assert abs(rate**2 + Omega_i * Omega_j) < 1e-14


def test_nothing_grows_where_two_moments_are_equal():
    assert growth_rate([2.0, 2.0, 3.0], 4.0) == 0.0
    assert growth_rate([2.0, 3.0, 3.0], 4.0) == 0.0


@pytest.mark.parametrize("kick", [1e-2, 1e-4, 1e-8])
def test_a_body_spun_about_its_middle_axis_flips_twice_in_a_period(kick):
    moments, omega0 = [1.0, 2.0, 2.5], np.array([0.0, SPIN, kick])
    period = flip_period(moments, omega0)
    quarter = period / 4
    _, omega = motion(moments, AT_REST, omega0, [0.0, 2 * quarter, 4 * quarter])
    # The period is rounded to double; e-folding 1e8 of the kick makes 1e-7 of that of ω1 and ω3 at most.
    assert abs(omega[1, 1] + SPIN) < 1e-12
    assert np.abs(omega[2] - omega0).max() < 1e-13
    # Near the separatrix ω2 stays and then goes: log(1/kick) e-foldings there and back.
    logarithm = 4 * math.log(4 / (kick / SPIN)) / growth_rate(moments, SPIN)
    assert abs(period / logarithm - 1) < 0.2


@pytest.mark.parametrize(
    ("moments", "axis"), [([1.0, 2.0, 2.5], 0), ([1.0, 2.0, 2.5], 2), ([2.0, 1.0, 2.5], 1)]
)
def test_for_a_small_wobble_the_period_is_that_of_the_ellipse(moments, axis):
    period = flip_period(moments, released(axis, 1))
    assert abs(period * wobble_rate(moments, axis, SPIN) / (2 * math.pi) - 1) < 1e-11


def test_the_period_has_no_end_on_the_separatrix_and_no_meaning_in_a_steady_spin():
    assert flip_period([1.0, 2.0, 2.25], [3.0, 0.5, 4.0]) == math.inf
    for omega in ([0.0, 3.0, 0.0], [0.0, 0.0, 0.0]):
        with pytest.raises(InputError, match="omega: got"):
            flip_period([1.0, 2.0, 2.25], omega)


@pytest.mark.parametrize("axis", [3, -1, 0.5])
def test_an_axis_is_one_of_three(axis):
    with pytest.raises(InputError, match="axis: got"):
        linear_rates([1.0, 2.0, 2.5], axis, 1.0)


def test_the_wrong_axis_is_refused():
    with pytest.raises(InputError, match="axis: got 1, that of the middle moment"):
        wobble_rate([1.0, 2.0, 2.5], 1, 1.0)
    for moments, axis in (([1.0, 2.0, 2.5], 1), ([2.0, 2.0, 2.5], 0)):
        with pytest.raises(InputError, match="axis: got"):
            wobble_ratio(moments, axis)
    for call in (growth_rate, lambda moments, spin: wobble_rate(moments, 0, spin)):
        with pytest.raises(InputError, match="moments: got"):
            call([1.0, 2.0, 4.0], 1.0)
        with pytest.raises(InputError, match="spin: got"):
            call([1.0, 2.0, 2.5], float("nan"))

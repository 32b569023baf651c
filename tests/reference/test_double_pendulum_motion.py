"""The double pendulum's integrated motion: against another method, itself, twenty-five digits, and time."""

import mpmath
import numpy as np
import pytest
from poinsot.reference import double_pendulum as double
from poinsot.reference.double_pendulum_motion import motion
from poinsot.reference.errors import InputError
from scipy.integrate import solve_ivp

LINKS = double.links((0.75, 1.0), (0.5, 0.5), 9.81, (0.4, 0.4), (0.03, 0.04))
ANGLES, RATES = (2.0, 1.5), (1.0, -3.0)


def test_it_is_what_another_method_makes_of_the_equations():
    t = np.linspace(0.0, 1.0, 26)

    def slope(_, state):
        return np.concatenate([state[2:], double.accelerations(LINKS, state[:2], state[2:])])

    found = solve_ivp(slope, (0.0, 1.0), (*ANGLES, *RATES), "DOP853", t, rtol=1e-12, atol=1e-13).y.T
    # What is left is the other method's error, a hundred of its tolerances.
    assert np.hstack(motion(LINKS, ANGLES, RATES, t)) == pytest.approx(found, abs=1e-9)


def test_a_short_stretch_is_right_to_the_last_digits_of_a_double():
    with mpmath.workdps(25):
        start = [mpmath.mpf(x) for x in (*ANGLES, *RATES)]

        def slope(_, state):
            A, B, D, G1, G2 = (mpmath.mpf(x) for x in LINKS[:5])
            th1, th2, w1, w2 = state
            cos, sin = mpmath.cos(th1 - th2), mpmath.sin(th1 - th2)
            push1 = -B * sin * w2**2 - G1 * mpmath.sin(th1)
            push2 = B * sin * w1**2 - G2 * mpmath.sin(th2)
            whole = A * D - (B * cos) ** 2
            return [w1, w2, (D * push1 - B * cos * push2) / whole, (A * push2 - B * cos * push1) / whole]

        expected = [float(x) for x in mpmath.odefun(slope, 0, start)(mpmath.mpf(0.125))]
    found = np.hstack(motion(LINKS, ANGLES, RATES, [0.125]))[0]
    # One rounding of the result, and one of the determinant among the constants.
    assert found == pytest.approx(expected, rel=2e-15)


def test_long_stretches_are_halved_until_they_settle():
    t = np.linspace(0.0, 2.0, 65)
    fine, coarse = (motion(LINKS, ANGLES, RATES, times) for times in (t, t[::32]))
    for near, far in zip(fine, coarse, strict=True):
        # A kick grows 130-fold here.
        assert far == pytest.approx(near[::32], abs=1e-12)


def test_energy_stays_to_round_off():
    angles, rates = motion(LINKS, ANGLES, RATES, np.linspace(0.0, 5.0, 251))
    energy = double.energy(LINKS, angles, rates)
    assert energy == pytest.approx(np.full(251, energy[0]), rel=1e-14)


def test_at_the_start_nothing_has_moved():
    angles, rates = motion(LINKS, ANGLES, RATES, [0.0, 0.0])
    assert angles.tolist() == [list(ANGLES)] * 2
    assert rates.tolist() == [list(RATES)] * 2


@pytest.mark.parametrize("t", [[0.2, 0.1], [-0.1, 0.2]])
def test_times_ascend_from_0(t):
    with pytest.raises(InputError, match="ascending"):
        motion(LINKS, ANGLES, RATES, t)


def test_a_motion_too_violent_to_follow_is_refused():
    with pytest.raises(InputError, match="does not settle"):
        motion(LINKS, ANGLES, (1e200, 0.0), [1.0])

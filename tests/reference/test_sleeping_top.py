"""The sleeping top's threshold and rates against the whole motion on both sides of it."""

import math

import numpy as np
import pytest
from poinsot.reference import quaternions
from poinsot.reference.errors import InputError
from poinsot.reference.heavy_top import motion
from poinsot.reference.sleeping_top import growth_rate, hanging_rates, threshold_spin, upright_rates

TOP = {"mass": 2.0, "length": 0.3, "moments": (0.5, 0.2), "gravity": 9.81}
# Mgl = 5.886 N m
THRESHOLD = 2 * math.sqrt(5.886 * 0.5) / 0.2
KICK = 1e-7


def horizontal(q0, omega3, t):
    """X + iy of e3 after a sideways kick to the vertical top."""
    q, _ = motion(**TOP, q0=q0, omega0=[KICK, 0, omega3], t=t)
    e3 = quaternions.rotated(q, np.array([0.0, 0.0, 1.0]))
    return e3[:, 0] + 1j * e3[:, 1]


def test_the_threshold():
    """Goldstein § 5.7: (I3ω3)² = 4MglI1; where I1 = I3 = Ml² that is ω3² = 4g/l."""
    assert threshold_spin(**TOP) == pytest.approx(THRESHOLD, rel=1e-15)
    assert threshold_spin(3.0, 2.0, (12.0, 12.0), 8.0) == 4.0


@pytest.mark.parametrize("share", [0.0, 0.5, 0.9, 0.99])
def test_below_it_a_tilt_grows_at_this_rate_and_goes_round_at_half_the_spin(share):
    omega3 = -share * THRESHOLD
    rate = growth_rate(**TOP, omega3=omega3)
    assert rate == pytest.approx(math.sqrt(5.886 / 0.5 - (0.2 * omega3) ** 2 / 1.0), rel=1e-14)
    t = np.array([0.5, 1.0, 1.5])
    tilt = horizontal([0, 0, 0, 1], omega3, t)
    # ζ = ζ̇0 sinh(λt)/λ · exp(iI3ω3 t/(2I1)); ω1 moves e3 along −y. Of third order in the tilt: 1e-9 at most.
    expected = -1j * KICK * np.sinh(rate * t) / rate * np.exp(0.5j * 0.2 * omega3 / 0.5 * t)
    assert np.abs(tilt / expected - 1).max() < 1e-8


@pytest.mark.parametrize("share", [1.01, 1.1, -3.0])
def test_above_it_the_axis_circles_at_two_rates(share):
    omega3 = share * THRESHOLD
    assert growth_rate(**TOP, omega3=omega3) == 0
    slow, fast = upright_rates(**TOP, omega3=omega3)
    assert abs(slow) < abs(fast)
    assert slow + fast == pytest.approx(0.2 * omega3 / 0.5, rel=1e-14)
    assert slow * fast == pytest.approx(5.886 / 0.5, rel=1e-14)
    t = np.linspace(0.1, 3, 7)
    expected = -KICK * (np.exp(1j * fast * t) - np.exp(1j * slow * t)) / (fast - slow)
    assert np.abs(horizontal([0, 0, 0, 1], omega3, t) - expected).max() < 1e-7 * np.abs(expected).max()


@pytest.mark.parametrize("omega3", [0.0, 2.0, -30.0])
def test_hanging_it_always_circles(omega3):
    slow, fast = hanging_rates(**TOP, omega3=omega3)
    assert slow + fast == pytest.approx(-0.2 * omega3 / 0.5, rel=1e-14)
    assert slow * fast == pytest.approx(-5.886 / 0.5, rel=1e-14)
    assert abs(slow) <= abs(fast)
    assert slow > 0 if omega3 == 0 else slow * omega3 > 0
    t = np.linspace(0.1, 3, 7)
    # Upside down by half a turn about x, ω1 moves e3 along +y.
    expected = KICK * (np.exp(1j * fast * t) - np.exp(1j * slow * t)) / (fast - slow)
    assert np.abs(horizontal([1, 0, 0, 0], omega3, t) - expected).max() < 1e-7 * np.abs(expected).max()


def test_at_the_threshold():
    assert growth_rate(3.0, 2.0, (12.0, 12.0), 8.0, 4.0) == 0
    assert upright_rates(3.0, 2.0, (12.0, 12.0), 8.0, 4.0) == (2.0, 2.0)
    assert growth_rate(3.0, 2.0, (12.0, 12.0), 8.0, -math.sqrt(12)) == pytest.approx(1, rel=1e-15)
    with pytest.raises(InputError, match=r"omega3: got 3\.9, too slow"):
        upright_rates(3.0, 2.0, (12.0, 12.0), 8.0, 3.9)


@pytest.mark.parametrize("function", [growth_rate, upright_rates, hanging_rates])
def test_what_cannot_be_is_refused(function):
    for change in ({"mass": -1}, {"moments": (1, 3)}, {"gravity": math.inf}, {"omega3": math.nan}):
        with pytest.raises(InputError):
            function(**{**TOP, "omega3": 100.0, **change})

"""Rates of the heavy top against its motion, against its cubic, and against what books work out by hand."""

import math

import numpy as np
import pytest
from poinsot.reference import quaternions
from poinsot.reference.errors import InputError
from poinsot.reference.heavy_top import motion, regular_precession
from poinsot.reference.heavy_top_equations import constants_of_motion
from poinsot.reference.heavy_top_rates import (
    fast_top_nutation,
    mean_precession,
    nutation_period,
    turning_points,
    weak_torque_error,
    weak_torque_precession,
)

HANDY = {"mass": 1.0, "length": 1.0, "moments": (1.0, 0.5), "gravity": 1.0}
LEVEL = [math.sqrt(0.5), 0.0, 0.0, math.sqrt(0.5)]
UPRIGHT = [0.0, 0.0, 0.0, 1.0]
HANGING = [1.0, 0.0, 0.0, 0.0]
SEED = 20240611


def tilted(theta):
    return [math.sin(theta / 2), 0.0, 0.0, math.cos(theta / 2)]


def random_tops(gravity):
    random = np.random.default_rng(SEED)
    for _ in range(12):
        q0, omega0 = random.normal(size=4), random.normal(size=3) * [2, 2, 10]
        yield {
            "mass": 2.0,
            "length": 0.3,
            "moments": (0.4, random.uniform(0.01, 0.8)),
            "gravity": gravity,
            "q0": q0 / np.linalg.norm(q0),
            "omega0": omega0,
        }


def axis(q):
    return quaternions.rotated(q, np.array([0.0, 0.0, 1.0]))


@pytest.mark.parametrize("gravity", [9.81, 0.0, 0.01])
def test_the_motion_has_these_turning_points_this_period_and_this_precession(gravity):
    for top in random_tops(gravity):
        period, turns, mean = nutation_period(**top), turning_points(**top), mean_precession(**top)
        t = np.linspace(0, 10 * period, 4001)
        x, y, height = axis(motion(**top, t=t)[0]).T
        # The height is the same every 400th time; between the times it misses its extremes by the square.
        assert np.abs(height[::400] - height[0]).max() < 1e-13
        width = turns.highest - turns.lowest
        assert np.all(height < turns.highest + 1e-15)
        assert np.all(height > turns.lowest - 1e-15)
        assert height.max() > turns.highest - 1e-4 * width
        assert height.min() > turns.lowest - 1e-15
        assert height.min() < turns.lowest + 1e-4 * width
        assert math.cos(turns.beta_lowest) == pytest.approx(turns.lowest, abs=1e-15)
        assert math.cos(turns.beta_highest) == pytest.approx(turns.highest, abs=1e-15)
        # Half that time is not a period.
        assert np.abs(height[200::400] - height[0]).max() > 1e-3 * width
        azimuth = np.unwrap(np.arctan2(y, x))
        assert (azimuth[-1] - azimuth[0]) / t[-1] == pytest.approx(mean, abs=2e-13 / period)


def test_turning_points_are_roots_of_the_cubic():
    for top in random_tops(9.81):
        p_alpha, p_gamma, energy = constants_of_motion(**{**_named(top)})
        I1, moment = top["moments"][0], 2.0 * 0.3 * 9.81
        for u in turning_points(**top)[:2]:
            # ½ I1 u̇² = (E′ − Mgl u)(1 − u²) − (p_α − p_γ u)²/(2 I1)
            terms = np.array(
                [(energy - moment * u) * (1 - u * u), -((p_alpha - p_gamma * u) ** 2) / (2 * I1)]
            )
            assert abs(terms.sum()) < 1e-13 * (abs(energy) + moment + (abs(p_alpha) + abs(p_gamma)) ** 2 / I1)


def _named(top):
    return {
        "mass": top["mass"],
        "length": top["length"],
        "moments": top["moments"],
        "gravity": top["gravity"],
        "q": top["q0"],
        "omega": top["omega0"],
    }


def test_a_plane_pendulum_has_its_tabled_period():
    """Swinging 90° to both sides: K(½)/½π times 2π√(l/g), K from Abramowitz & Stegun 17.1."""
    period = nutation_period(**HANDY, q0=LEVEL, omega0=[0, 0, 0])
    # The height has half the period of the swing.
    assert 2 * period == pytest.approx(2 * math.pi * 1.854074677301372 / (math.pi / 2), rel=1e-15)
    turns = turning_points(**HANDY, q0=LEVEL, omega0=[0, 0, 0])
    assert turns.lowest == -1
    assert turns.highest == pytest.approx(0, abs=1e-16)
    assert turns.beta_lowest == math.pi
    assert mean_precession(**HANDY, q0=LEVEL, omega0=[0, 0, 0]) == 0


def test_a_pendulum_that_goes_over_the_top_takes_both_poles():
    turns = turning_points(**HANDY, q0=HANGING, omega0=[2.5, 0, 0])
    assert turns[:2] == (-1, 1)
    assert turns[2:] == (math.pi, 0)
    # sin² of half the angle from below: ½χ̇ = 1.25 √(1 − sin²/1.25²), so T = 2 K(1/1.25²)/1.25 a turn.
    agm = [1.0, math.sqrt(1 - 1 / 1.25**2)]
    for _ in range(6):
        agm = [sum(agm) / 2, math.sqrt(agm[0] * agm[1])]
    period = nutation_period(**HANDY, q0=HANGING, omega0=[2.5, 0, 0])
    assert period == pytest.approx(math.pi / agm[0] / 1.25, rel=1e-15)


def test_released_at_rest_it_has_been_at_its_highest():
    """Goldstein § 5.7: cusps at u0; the lower root solves (1 − u²)k = a²(u0 − u), k = 2, a = 2.5 here."""
    turns = turning_points(**HANDY, q0=tilted(1.0), omega0=[0, 0, 5.0])
    assert turns.beta_highest == pytest.approx(1.0, rel=1e-15)
    u = turns.lowest
    assert 2 * (1 - u * u) == pytest.approx(6.25 * (math.cos(1.0) - u), rel=1e-14)
    assert mean_precession(**HANDY, q0=tilted(1.0), omega0=[0, 0, 5.0]) > 0


@pytest.mark.parametrize("which", [0, 1])
@pytest.mark.parametrize(("theta", "omega3"), [(0.4, 6.0), (1.3, -8.0), (2.4, 3.0), (2.0, 0.0)])
def test_regular_precession_and_the_least_nutation_about_it(theta, omega3, which):
    rate = regular_precession(**HANDY, theta=theta, omega3=omega3)[which]
    start = {"q0": tilted(theta), "omega0": [0, rate * math.sin(theta), omega3]}
    assert mean_precession(**HANDY, **start) == pytest.approx(rate, rel=1e-9)
    p_alpha, p_gamma, _ = constants_of_motion(
        *HANDY.values(), np.array(start["q0"]), np.array(start["omega0"])
    )
    a, b, c = p_gamma, p_alpha, math.cos(theta)
    # About a double root of f(u) = (2E′ − ku)(1 − u²) − (b − au)², k = 2 and I1 = 1: ν² = −½ f″.
    energy = rate**2 * math.sin(theta) ** 2 + 2 * c
    second = -2 * energy + 12 * c - 2 * a * a
    assert (b - a * c) == pytest.approx(rate * math.sin(theta) ** 2, rel=1e-13)
    expected = 2 * math.pi / math.sqrt(-second / 2)
    assert nutation_period(**HANDY, **start) == pytest.approx(expected, rel=1e-7)


def test_exactly_regular_precession_and_the_sleeping_top():
    level = {"q0": [0.5, 0.5, 0.5, 0.5], "omega0": [0, 1, 2]}
    assert mean_precession(**HANDY, **level) == 1
    assert turning_points(**HANDY, **level) == (0, 0, math.pi / 2, math.pi / 2)
    # ν² = a² + φ̇² for a level axis (−½ f″ with E = φ̇², c = 0): both are 1 here.
    assert nutation_period(**HANDY, **level) == pytest.approx(2 * math.pi / math.sqrt(2), rel=1e-15)
    # Asleep with a = 3, k = 2: ν = √(a² − 2k).
    asleep = {"q0": UPRIGHT, "omega0": [0, 0, 6.0]}
    assert nutation_period(**HANDY, **asleep) == pytest.approx(2 * math.pi / math.sqrt(5), rel=1e-15)
    assert turning_points(**HANDY, **asleep) == (1, 1, 0, 0)
    # Hanging: ν = √(a² + 2k).
    hanging = {"q0": HANGING, "omega0": [0, 0, 6.0]}
    assert nutation_period(**HANDY, **hanging) == pytest.approx(2 * math.pi / math.sqrt(13), rel=1e-15)
    for start in (asleep, hanging):
        with pytest.raises(InputError, match="vertical for ever"):
            mean_precession(**HANDY, **start)


@pytest.mark.parametrize("q0", [HANGING, tilted(2.0)])
def test_what_never_comes_back_has_no_period(q0):
    speed = 2 if q0 == HANGING else 0.0
    assert math.isinf(nutation_period(**HANDY, q0=HANGING, omega0=[2, 0, 0]))
    assert mean_precession(**HANDY, q0=HANGING, omega0=[2, 0, 0]) == 0
    assert math.isinf(nutation_period(**HANDY, q0=UPRIGHT, omega0=[0, 0, 1]))
    free = {**HANDY, "gravity": 0.0}
    assert math.isinf(nutation_period(**free, q0=q0, omega0=[0, 0, 0]))
    assert mean_precession(**free, q0=tilted(1.0), omega0=[0, 0, 0]) == 0
    assert turning_points(**free, q0=q0, omega0=[0, 0, 0]).lowest == pytest.approx(
        -1 if speed else math.cos(2.0)
    )


def test_without_weight_the_axis_goes_round_the_angular_momentum():
    """Landau & Lifshitz § 33: at L/I1, and about the vertical as often if that is inside the cone."""
    free = {**HANDY, "gravity": 0.0}
    # L is along the vertical: ω⊥ = L sinθ/I1, ω3 = L cosθ/I3, at 3 rad/s.
    start = {"q0": tilted(0.8), "omega0": [0, 3 * math.sin(0.8), 6 * math.cos(0.8)]}
    assert nutation_period(**free, **start) == pytest.approx(2 * math.pi / 3, rel=1e-15)
    assert mean_precession(**free, **start) == pytest.approx(3, rel=1e-15)
    turns = turning_points(**free, **start)
    assert turns.beta_lowest == pytest.approx(0.8, abs=1e-7)  # a double root of rounded numbers
    # L at right angles to the vertical cannot carry the axis round it.
    beside = {"q0": UPRIGHT, "omega0": [0.0, 1.0, 0.2]}
    assert mean_precession(**free, **{**beside, "q0": tilted(-0.1)}) == 0
    # The axis passes through the vertical: half of the two mean rates, √(1 + 0.1²) and 0.
    assert mean_precession(**free, **beside) == pytest.approx(math.sqrt(1.01) / 2, rel=1e-15)
    assert turning_points(**free, **beside).highest == 1


@pytest.mark.parametrize("spin", [3.0, -3.0])
def test_through_the_vertical_the_mean_is_that_of_both_sides(spin):
    top = {"omega0": [0.7, 0.4, spin]}
    on = mean_precession(**HANDY, q0=UPRIGHT, **top)
    sides = [mean_precession(**HANDY, q0=tilted(angle), **top) for angle in (1e-9, -1e-9)]
    assert abs(sides[0] - sides[1]) > 0.5
    assert on == pytest.approx(sum(sides) / 2, abs=1e-7)


# The textbook's limits


def test_weak_torque_precession():
    """Mgl/(I3ω3): 1 kg m²/s² over 0.5 kg m² times 40 rad/s."""
    assert weak_torque_precession(1, 1, 0.5, 1, 40.0) == 0.05
    assert weak_torque_precession(2, 3, 0.5, 9.81, -40.0) == pytest.approx(-2.943, rel=1e-15)
    with pytest.raises(InputError, match="omega3: got 0"):
        weak_torque_precession(1, 1, 0.5, 1, 0)
    with pytest.raises(InputError, match="above 0"):
        weak_torque_precession(1, 1, 0, 1, 1)


@pytest.mark.parametrize(("theta", "omega3"), [(0.3, 5.0), (1.0, -50.0), (2.0, 5.0), (2.8, 1.0)])
def test_the_error_of_weak_torque_precession(theta, omega3):
    slow, _ = regular_precession(**HANDY, theta=theta, omega3=omega3)
    error = weak_torque_error(**HANDY, theta=theta, omega3=omega3)
    assert error == pytest.approx(weak_torque_precession(1, 1, 0.5, 1, omega3) / slow - 1, rel=1e-12)
    # To first order −MglI1 cosθ/(I3ω3)².
    fast = weak_torque_error(**HANDY, theta=theta, omega3=1e6)
    assert fast == pytest.approx(-math.cos(theta) / 2.5e11, rel=1e-10)


def test_the_error_of_weak_torque_precession_at_its_ends():
    assert abs(weak_torque_error(**HANDY, theta=math.pi / 2, omega3=1.0)) < 1e-15
    assert weak_torque_error(**HANDY, theta=0.0, omega3=4.0) == -0.5
    for omega3 in (3.99, 0.0):
        with pytest.raises(InputError, match=f"omega3: got {omega3}, too slow .* theta = 0"):
            weak_torque_error(**HANDY, theta=0.0, omega3=omega3)


@pytest.mark.parametrize("theta", [0.5, 1.5, 2.7])
def test_a_fast_top_nutates_as_the_book_says(theta):
    """To first order: a hundred times faster, and the book's width and rate are 10⁴ times better."""
    off = []
    for omega3 in (100.0, -10000.0):
        rate, width = fast_top_nutation(**HANDY, theta=theta, omega3=omega3)
        turns = turning_points(**HANDY, q0=tilted(theta), omega0=[0, 0, omega3])
        period = nutation_period(**HANDY, q0=tilted(theta), omega0=[0, 0, omega3])
        off.append((width / (turns.beta_lowest - turns.beta_highest) - 1, rate * period / (2 * math.pi) - 1))
    for slow, fast in zip(*off, strict=True):
        assert 1e-5 < abs(slow) < 5e-3
        assert slow / fast == pytest.approx(1e4, rel=0.06)  # its own next order is 5 % at 100 rad/s
    assert fast_top_nutation(**HANDY, theta=theta, omega3=-7.0)[0] == 3.5
    with pytest.raises(InputError, match="omega3: got 0"):
        fast_top_nutation(**HANDY, theta=theta, omega3=0)

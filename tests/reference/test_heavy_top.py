"""Heavy tops against thirty-digit integrations, motions solved by hand, and their limits."""

import json
import math
import subprocess
import sys
from fractions import Fraction
from pathlib import Path

import mpmath
import numpy as np
import pytest
from poinsot.reference import quaternions, torque_free
from poinsot.reference.errors import InputError
from poinsot.reference.heavy_top import motion, regular_precession
from poinsot.reference.heavy_top_constants import constants, is_steady

HERE = Path(__file__).parent
GOLDENS = json.loads((HERE / "heavy_top_goldens.json").read_text(encoding="utf-8"))

# Measured over the goldens: 1.3e-15 rad and 8e-16. A handful of roundings, none of which grows with time.
ATTITUDE = 2e-15
OMEGA = 1.5e-15

UPRIGHT = [0.0, 0.0, 0.0, 1.0]
HANGING = [1.0, 0.0, 0.0, 0.0]
LEVEL = [math.sqrt(0.5), 0.0, 0.0, math.sqrt(0.5)]

# A top with k = 2Mgl/I1 = 2, on which much can be done by hand.
HANDY = {"mass": 1.0, "length": 1.0, "moments": (1.0, 0.5), "gravity": 1.0}


def angle_between(a, b):
    """Geodesic angle [rad] between attitudes, good to round-off at small angles."""
    turn = quaternions.product(quaternions.conjugate(a), b)
    return 2 * np.arctan2(np.linalg.norm(turn[..., :3], axis=-1), np.abs(turn[..., 3]))


def axis(q):
    """The axis e3 in the world (n, 3)."""
    return quaternions.rotated(q, np.array([0.0, 0.0, 1.0]))


def off(got, digits):
    """Length of ``got`` less the number that ``digits`` spell, relative to nothing."""
    exact = [Fraction(x) for x in digits]
    return math.sqrt(sum(float(Fraction(float(g)) - e) ** 2 for g, e in zip(got, exact, strict=True)))


# Goldens


def kinds():
    return sorted({golden["name"].split(" ")[0] for golden in GOLDENS})


@pytest.mark.parametrize("kind", kinds())
def test_thirty_digit_integrations(kind):
    for golden in (g for g in GOLDENS if g["name"].split(" ")[0] == kind):
        top = {key: golden[key] for key in ("mass", "length", "moments", "gravity", "q0", "omega0", "t")}
        q, omega = motion(**top)
        for i, (true_q, true_omega) in enumerate(zip(golden["q"], golden["omega"], strict=True)):
            speed = math.sqrt(sum(float(Fraction(x)) ** 2 for x in true_omega))
            # q goes on from q0 without a jump, so its sign is that of the integration.
            assert 2 * off(q[i], true_q) < ATTITUDE, golden["name"]
            assert off(omega[i], true_omega) <= OMEGA * speed, golden["name"]


def test_the_goldens_cover_what_is_asked():
    names = [golden["name"] for golden in GOLDENS]
    assert sum(name.startswith("random") for name in names) >= 200
    for epsilon in ("1e-08", "-1e-08", "1e-12", "-1e-12"):
        assert sum(name.startswith(f"separatrix {epsilon}") for name in names) == 3
        assert f"a thousand seconds, {epsilon} off" in names
    assert sum(1000.0 in golden["t"] for golden in GOLDENS) >= 12
    assert sum(golden["omega0"][2] == 4000.0 for golden in GOLDENS) >= 4
    assert sum(golden["moments"][1] == 2 * golden["moments"][0] for golden in GOLDENS) >= 3
    assert sum(golden["moments"][1] <= 1e-6 * golden["moments"][0] for golden in GOLDENS) >= 3


def test_the_goldens_come_from_their_script():
    command = [sys.executable, str(HERE / "make_heavy_top_goldens.py"), "--check"]
    subprocess.run(command, check=True, timeout=120)


# Solved by hand


def test_on_the_separatrix_a_pendulum_climbs_for_ever():
    """With χ from below, sin ½χ = tanh √(g/l) t (Landau & Lifshitz § 11, problem 1)."""
    t = np.array([-40.0, -3.0, -0.1, 0.0, 0.7, 2.0, 300.0])
    q, omega = motion(**HANDY, q0=HANGING, omega0=[2, 0, 0], t=t)
    half = np.pi / 2 + np.arcsin(np.tanh(t))
    expected = np.stack([np.sin(half), 0 * t, 0 * t, np.cos(half)], axis=-1)
    # arcsin loses half of its digits where the tanh is 1.
    assert np.abs(q - expected)[1:-1].max() < 1e-15
    assert np.allclose(axis(q)[[0, -1]], [0, 0, 1], atol=1e-15)
    assert np.allclose(omega[:, 0], 2 / np.cosh(t), rtol=1e-15, atol=0)


def test_a_pendulum_released_level_swings_down_in_K_of_one_half():
    """K(m = ½) = 1.85407 46773 01372 (Abramowitz & Stegun, table 17.1), and level again beyond."""
    quarter = 1.854074677301372
    q, omega = motion(**HANDY, q0=LEVEL, omega0=[0, 0, 0], t=quarter * np.arange(-2, 5))
    heights = axis(q)[:, 2]
    assert np.allclose(heights, [0, -1, 0, -1, 0, -1, 0], atol=2e-15)
    assert np.allclose(omega[:, 0], math.sqrt(2) * np.array([0, -1, 0, 1, 0, -1, 0]), atol=4e-15)
    assert not omega[:, 1:].any()


@pytest.mark.parametrize(("q0", "sense"), [(UPRIGHT, 1.0), ([0.6, 0.8, 0, 0], -1.0)])
@pytest.mark.parametrize("spin", [0.0, 2.8, -3000.0])
def test_asleep_or_hanging_it_only_spins(q0, sense, spin):
    t = np.array([-1000.0, 0.0, 0.4, 777.7])
    q, omega = motion(**HANDY, q0=q0, omega0=[0, 0, spin], t=t)
    assert np.all(omega == [0, 0, spin])
    assert np.allclose(axis(q), [0, 0, sense], atol=1e-15)
    for moment, attitude in zip(t, q, strict=True):
        with mpmath.workdps(40):
            half = mpmath.mpf(spin) * mpmath.mpf(moment) / 2
            turn = np.array([0, 0, float(mpmath.sin(half)), float(mpmath.cos(half))])
        assert angle_between(attitude, quaternions.product(np.array(q0), turn)) < ATTITUDE


@pytest.mark.parametrize(("rate", "omega3"), [(1, 2), (2, 1), (0.25, 8), (-1, -2)])
def test_a_level_axis_precesses_steadily_where_gravity_and_gyroscope_agree(rate, omega3):
    """θ = 90°: φ̇ = Mgl/(I3ω3), exactly so here, and ω = φ̇ẑ + ψ̇e3, ψ̇ = ω3."""
    t = np.array([-20.0, 0.0, 0.3, 5.0])
    q, omega = motion(**HANDY, q0=[0.5, 0.5, 0.5, 0.5], omega0=[0, rate, omega3], t=t)
    e3 = axis(q)
    assert np.allclose(e3, np.stack([np.cos(rate * t), np.sin(rate * t), 0 * t], axis=-1), atol=6e-16)
    assert np.allclose(quaternions.rotated(q, omega), omega3 * e3 + [0, 0, rate], atol=4e-15)
    # e2 was upright at first; e1 takes its place as the body turns about the level e3.
    e1 = quaternions.rotated(q, np.array([1.0, 0.0, 0.0]))
    assert np.allclose(e1[:, 2], np.sin(omega3 * t), atol=2e-15)


@pytest.mark.parametrize(("p", "q"), [(16415, 28360), (28360, 16415), (3353, 32596)])
def test_a_tilted_top_precesses_steadily_where_no_rounding_disturbs_it(p, q):
    """With x = p/2¹⁵, w = q/2¹⁵ and x² + w² = n = 1 + 2⁻³⁰, n sinθ and n cosθ are doubles.

    With I1 = 1, I3 = ½, ω2 = 2xw and ω3 = 6 the equation of regular precession asks of Mgl that it be
    n(3 − w² + x²), and gives φ̇ = n.
    """
    x, w, n = p / 2**15, q / 2**15, 1 + 2.0**-30
    top = {"mass": 1.0, "length": n, "moments": (1.0, 0.5), "gravity": 3 - w * w + x * x}
    start = {"q0": [x, 0, 0, w], "omega0": [0, 2 * x * w, 6]}
    assert is_steady(constants(**top, **start))
    t = np.array([-7.0, 0.0, 0.3, 5.0])
    attitude, omega = motion(**top, **start, t=t)
    sine, cosine = 2 * x * w / n, (w * w - x * x) / n
    e3 = np.stack([sine * np.sin(n * t), -sine * np.cos(n * t), cosine + 0 * t], axis=-1)
    assert np.allclose(axis(attitude), e3, atol=1e-15)
    # ω = φ̇ẑ + ψ̇e3, ψ̇ = ω3 − φ̇ cosθ: in the body it goes round backwards at ψ̇.
    spin = 6 - n * cosine
    assert np.allclose(quaternions.rotated(attitude, omega), spin * e3 + [0, 0, n], atol=8e-15)
    turning = 2 * x * w * np.stack([np.sin(spin * t), np.cos(spin * t)], axis=-1)
    assert np.allclose(omega[:, :2], turning, atol=8e-15)  # spin·t is rounded here


@pytest.mark.parametrize("which", [0, 1])
@pytest.mark.parametrize(("theta", "omega3"), [(0.3, 6.0), (1.2, -9.0), (2.0, 0.5), (2.9, -40.0), (2.2, 0.0)])
def test_regular_precession_keeps_its_tilt_and_its_rate(theta, omega3, which):
    rate = regular_precession(**HANDY, theta=theta, omega3=omega3)[which]
    q0 = [math.sin(theta / 2), 0, 0, math.cos(theta / 2)]
    t = np.linspace(-2, 2, 9)
    q, omega = motion(**HANDY, q0=q0, omega0=[0, rate * math.sin(theta), omega3], t=t)
    e3 = axis(q)
    # The start is rounded: at most one unit in the last place of the fastest rate, over 2 s.
    slack = 4e-15 * (1 + abs(rate) + abs(omega3))
    assert np.allclose(e3[:, 2], math.cos(theta), atol=slack)
    assert np.allclose(e3[:, 0], math.sin(theta) * np.sin(rate * t), atol=slack)
    assert np.allclose(e3[:, 1], -math.sin(theta) * np.cos(rate * t), atol=slack)
    assert np.allclose(np.hypot(omega[:, 0], omega[:, 1]), abs(rate) * math.sin(theta), atol=slack * 3)


@pytest.mark.parametrize(("push", "kind"), [(0.0, "cusps"), (-0.3, "loops"), (0.1, "one way")])
def test_cusps_loops_and_unidirectional_nutation(push, kind):
    """Goldstein § 5.7: at its highest the axis stands still, goes back, or goes on."""
    theta, spin = 1.0, 12.0
    q0 = [math.sin(theta / 2), 0, 0, math.cos(theta / 2)]
    t = np.linspace(0, 3, 3001)
    q, omega = motion(**HANDY, q0=q0, omega0=[0, push * math.sin(theta), spin], t=t)
    e3, rate = axis(q), quaternions.rotated(q, omega)
    velocity = np.cross(rate, e3)
    azimuthal = (e3[:, 0] * velocity[:, 1] - e3[:, 1] * velocity[:, 0]) / (1 - e3[:, 2] ** 2)
    highest = np.argmax(e3[1000:, 2]) + 1000
    assert (
        e3[:, 2].max() < math.cos(theta) + 1e-15
    )  # pushed less than for regular precession, it falls at first
    if kind == "cusps":
        assert azimuthal.min() > -1e-14
        assert np.abs(velocity[highest]).max() < 0.02  # at the nearest of the times
    assert (azimuthal.min() < -0.29) == (kind == "loops")
    if kind == "one way":
        assert azimuthal.min() > push - 1e-14


def test_a_top_released_at_rest_first_falls_and_then_moves_on_with_its_spin():
    q, _ = motion(**HANDY, q0=LEVEL, omega0=[0, 0, 5.0], t=[1e-3])
    # e3 starts along −y; gravity pulls it down by ½ Mgl/I1 t², and it is led towards +x by the spin.
    x, y, z = axis(q)[0]
    assert z == pytest.approx(-0.5e-6, rel=1e-5)
    # ω⊥ after t is Mgl t/I1, turned by I3ω3 t/(2I1) on average a third of it: ⅙ (I3ω3/I1)(Mgl/I1) t³.
    assert x == pytest.approx(2.5e-9 / 6, rel=1e-4)
    assert y == pytest.approx(-1.0)


def test_an_unstable_upright_top_takes_the_time_that_its_kick_asks_for():
    """A tilt grows as exp(λt): a kick 10⁸⁸ times weaker needs 88 ln 10/λ longer."""
    spin = 2.0  # a = 1, λ = ½√(2k − a²) = ½√3
    later = 88 * math.log(10) / (math.sqrt(3) / 2)
    t = np.array([30.0, 33.0])
    near, _ = motion(**HANDY, q0=UPRIGHT, omega0=[1e-12, 0, spin], t=t)
    far, _ = motion(**HANDY, q0=UPRIGHT, omega0=[1e-100, 0, spin], t=t + later)
    assert axis(near)[:, 2].min() < 0.5
    # `later` is a double of 2.3e2, rounded by 3e-14; e3 moves at some 2 rad/s.
    assert np.allclose(axis(near)[:, 2], axis(far)[:, 2], atol=1e-13)
    # Meanwhile it went round at I3ω3/(2I1).
    (x, y, _), (x_far, y_far, _) = axis(near)[0], axis(far)[0]
    turn = np.angle((x_far + 1j * y_far) / (x + 1j * y) * np.exp(-0.5j * later))
    assert abs(turn) < 1e-13


def test_a_kick_too_weak_to_square_still_has_its_direction():
    t = np.array([780.0, 783.0])
    q, omega = motion(**HANDY, q0=UPRIGHT, omega0=[1e-293, 0, 2.0], t=t)
    other, rates = motion(**HANDY, q0=UPRIGHT, omega0=[0, 1e-293, 2.0], t=t)
    quarter = np.array([0, 0, math.sqrt(0.5), math.sqrt(0.5)])
    # A quarter of a turn of the kick turns all by a quarter, and the body back.
    assert axis(q)[:, 2].min() < 0.5
    turned = quaternions.product(quaternions.product(quarter, q), quaternions.conjugate(quarter))
    assert angle_between(turned, other).max() < 2 * ATTITUDE
    assert np.abs(rates - quaternions.rotated(quarter, omega)).max() < 4e-15


@pytest.mark.parametrize("start", [1e-30, 1e-90, 1e-300])
def test_a_start_next_to_the_vertical_is_as_one_on_it(start):
    t = np.array([-2.0, 0.5, 7.0])
    for q0, near in ((UPRIGHT, [start, 0, 0, 1]), (HANGING, [1, start, 0, start])):
        exact = motion(**HANDY, q0=q0, omega0=[0.3, 1.1, 4.0], t=t)
        close = motion(**HANDY, q0=near, omega0=[0.3, 1.1, 4.0], t=t)
        assert angle_between(exact[0], close[0]).max() < ATTITUDE
        assert np.abs(exact[1] - close[1]).max() < 4e-15


def test_next_to_the_vertical_by_less_than_squares_can_hold_it_is_asleep():
    """A tilt of 1e-211: neither its square nor the nutation can be told from nothing."""
    t = np.array([-3.0, 0.0, 1.0, 50.0])
    for spin in (0.0, 7.0):
        for near, exact in (
            ([1e-120, 1, 1e-211, 0], [0, 1, 0, 0]),
            ([1e-211, 0, 0.6, 0.8], [0, 0, 0.6, 0.8]),
        ):
            if exact[1] == 0 and spin == 0:
                continue  # upright without spin it falls, sooner or later
            start = {"q0": near, "omega0": [0, 1e-308, spin]}
            expected, _ = motion(**HANDY, q0=exact, omega0=[0, 0, spin], t=t)
            q, omega = motion(**HANDY, **start, t=t)
            assert angle_between(q, expected).max() < ATTITUDE
            assert np.abs(omega - [0, 0, spin]).max() < 1e-100


def test_regular_precession_off_by_a_denormal_is_regular_precession():
    t = np.array([-3.0, 0.0, 1.0, 50.0])
    exact = motion(**HANDY, q0=[0.5] * 4, omega0=[0, 1, 2], t=t)
    near = motion(**HANDY, q0=[0.5] * 4, omega0=[1e-310, 1, 2], t=t)
    assert angle_between(exact[0], near[0]).max() < ATTITUDE
    assert np.abs(exact[1] - near[1]).max() < 4e-15


# Limits


@pytest.mark.parametrize("without", ["length", "gravity"])
@pytest.mark.parametrize("moments", [(0.7, 0.2), (0.7, 0.7), (0.7, 1.4), (0.7, 1e-6)])
def test_without_weight_it_is_the_free_symmetric_top(without, moments):
    q0, omega0 = np.array([0.1, -0.5, 0.7, 0.5]), [0.8, -1.3, 21.0]
    t = np.array([-1000.0, -3.0, 0.0, 0.5, 1000.0])
    top = {"mass": 2.0, "length": 0.3, "gravity": 9.81, "moments": moments, without: 0.0}
    q, omega = motion(**top, q0=q0, omega0=omega0, t=t)
    free_q, free_omega = torque_free.motion([moments[0], moments[0], moments[1]], q0, omega0, t)
    assert angle_between(q, free_q).max() < 2 * ATTITUDE
    assert np.abs(omega - free_omega).max() < 1e-14


def test_without_weight_and_at_rest_it_stays():
    q, omega = motion(1, 0, (1, 0.5), 9.81, [0.5, 0.5, 0.5, 0.5], [0, 0, 0], [-5.0, 1e9])
    assert np.all(q == 0.5)
    assert not omega.any()


@pytest.mark.parametrize("gravity", [1e-14, 1e-18, 1e-26, 1e-300])
def test_weak_gravity_comes_to_none(gravity):
    t = np.array([-5.0, 2.0])
    start = {"q0": [0.1, -0.5, 0.7, 0.5], "omega0": [0.8, -1.3, 2.0], "t": t}
    with_it, without = (motion(1, 1, (1, 0.5), g, **start) for g in (gravity, 0.0))
    # Half of g t² is what it can turn the body by.
    assert angle_between(with_it[0], without[0]).max() < ATTITUDE + 13 * gravity
    assert np.abs(with_it[1] - without[1]).max() < 2e-15 + 5 * gravity


def test_a_late_moment_is_told_from_the_next():
    """An hour at 4000 rad/s is 1.4e7 rad: the phase is as good there as at the start."""
    top = {**HANDY, "q0": LEVEL, "omega0": [0.1, 0.2, 4000.0]}
    t = 3600.0
    here, rates = motion(**top, t=[t])
    step = 2.0**-30
    there, _ = motion(**top, t=[t + step])
    assert angle_between(here, there)[0] == pytest.approx(np.linalg.norm(rates[0]) * step, rel=1e-8)


# What comes in and out


@pytest.mark.parametrize("omega0", [[0, 1, 2], [0.3, 1, 2], [2, 0, 0]])
def test_a_long_row_of_times_is_as_each_by_itself(omega0):
    t = np.linspace(-20, 20, 20001)
    q, omega = motion(**HANDY, q0=LEVEL, omega0=omega0, t=t)
    some = [0, 8191, 8192, 12345, 16384, 20000]
    for place in some:
        alone_q, alone_omega = motion(**HANDY, q0=LEVEL, omega0=omega0, t=t[place])
        assert np.abs(alone_q[0] - q[place]).max() < 1e-15
        assert np.abs(alone_omega[0] - omega[place]).max() < 4e-15


def test_one_time_and_no_time():
    q, omega = motion(**HANDY, q0=LEVEL, omega0=[1, 2, 3], t=0.0)
    assert q.shape == (1, 4)
    assert np.abs(q[0] - LEVEL).max() < 4e-16
    assert np.allclose(omega[0], [1, 2, 3], atol=1e-15)
    q, omega = motion(**HANDY, q0=LEVEL, omega0=[1, 2, 3], t=[])
    assert q.shape == (0, 4)
    assert omega.shape == (0, 3)


def test_a_quaternion_not_quite_unit_is_divided_by_its_length():
    start = np.array(LEVEL) * (1 + 5e-10)
    q, _ = motion(**HANDY, q0=start, omega0=[1, 2, 3], t=[0.0, 4.0])
    expected, _ = motion(**HANDY, q0=LEVEL, omega0=[1, 2, 3], t=[0.0, 4.0])
    assert angle_between(q, expected).max() < 4e-15


def test_arguments_are_left_as_they_are():
    q0, omega0, t = np.array(LEVEL), np.array([1.0, 2.0, 3.0]), np.array([1.0, 2.0])
    motion(**HANDY, q0=q0, omega0=omega0, t=t)
    assert q0.tolist() == LEVEL
    assert omega0.tolist() == [1, 2, 3]
    assert t.tolist() == [1, 2]


@pytest.mark.parametrize(
    ("change", "said"),
    [
        ({"mass": 0}, "mass: got 0"),
        ({"mass": math.nan}, "mass"),
        ({"length": -1}, "length: got -1"),
        ({"gravity": -9.81}, "gravity: got -9.81"),
        ({"moments": (1, 2.1)}, "exceeds the sum"),
        ({"moments": (0, 1)}, "moments"),
        ({"moments": (1, 1, 1)}, "shape"),
        ({"q0": [1, 1, 0, 0]}, "norm"),
        ({"q0": [1, 0, 0]}, "shape"),
        ({"omega0": [0, 0]}, "omega0"),
        ({"omega0": [0, 0, math.inf]}, "omega0"),
        ({"t": [[0.0]]}, "t: got an array of shape"),
        ({"t": [math.nan]}, "t: got"),
        ({"t": [1e30]}, r"t: got 1e\+30, expected at most"),
    ],
)
def test_what_cannot_be_is_refused(change, said):
    top = {**HANDY, "q0": LEVEL, "omega0": [1, 2, 3], "t": [1.0], **change}
    with pytest.raises(InputError, match=said):
        motion(**top)


# Regular precession


@pytest.mark.parametrize(("theta", "omega3"), [(0.0, 3.0), (0.5, 4.0), (1.5, -0.6), (2.5, 7.0), (3.0, -1e-3)])
def test_both_rates_solve_the_equation(theta, omega3):
    I1, I3, Mgl = 0.9, 1.3, 0.7
    slow, fast = regular_precession(0.7, 1.0, (I1, I3), 1.0, theta, omega3)
    for rate in (slow, fast):
        terms = np.array([I1 * math.cos(theta) * rate**2, -I3 * omega3 * rate, Mgl])
        assert abs(terms.sum()) < 4e-16 * np.abs(terms).sum()
    assert abs(slow) <= abs(fast)
    assert slow * omega3 > 0
    assert (fast * omega3 > 0) == (theta < np.pi / 2)


def test_regular_precession_by_hand():
    """A level axis: slow Mgl/(I3ω3), no fast one; a conical pendulum: φ̇² = g/(l cos) and both senses."""
    slow, fast = regular_precession(**HANDY, theta=math.pi / 2, omega3=4.0)
    assert slow == 0.5
    assert abs(fast) > 1e15
    slow, fast = regular_precession(**HANDY, theta=2 * math.pi / 3, omega3=0.0)
    assert slow == pytest.approx(math.sqrt(2), rel=1e-15)
    assert fast == -slow
    assert regular_precession(**{**HANDY, "gravity": 0.0}, theta=1.0, omega3=0.0) == (0.0, 0.0)
    slow, fast = regular_precession(**{**HANDY, "gravity": 0.0}, theta=1.0, omega3=3.0)
    assert slow == 0
    assert fast == pytest.approx(1.5 / math.cos(1.0), rel=1e-15)  # L/I1 of the free top


def test_too_little_spin_for_regular_precession():
    theta, top = 0.7, {"mass": 2.0, "length": 0.5, "moments": (0.9, 0.4), "gravity": 3.0}
    least = 2 * math.sqrt(3.0 * 0.9 * math.cos(theta)) / 0.4
    slow, fast = regular_precession(**top, theta=theta, omega3=least)
    # At the threshold the two meet, as the root of what rounding leaves.
    assert slow == pytest.approx(fast, rel=1e-7)
    assert slow == pytest.approx(math.sqrt(3.0 / (0.9 * math.cos(theta))), rel=1e-7)
    with pytest.raises(InputError, match=r"omega3: got 3, too slow .* theta = 0.7: at least 7\.185"):
        regular_precession(**top, theta=theta, omega3=3)
    with pytest.raises(InputError, match="too slow"):
        regular_precession(**top, theta=theta, omega3=least * (1 - 1e-14))

"""Free rotation against thirty-digit integrations, elementary solutions, conservation laws and symmetries."""

import json
import math
import subprocess
import sys
from pathlib import Path

import mpmath
import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from poinsot.reference import quaternions
from poinsot.reference.blocks import BLOCK
from poinsot.reference.errors import InputError
from poinsot.reference.torque_free import body_cone_rate, motion, space_cone_rate

HERE = Path(__file__).parent
GOLDENS = json.loads((HERE / "torque_free_goldens.json").read_text())

# Measured over the goldens: 9e-16 rad and 5e-16. A handful of roundings, none of which grows with time.
ATTITUDE = 2e-15
OMEGA = 1e-15

# A motion is followed through two evaluations and compared at |phase| up to 1e4 in double: see each use.
AT_REST = np.array([0.0, 0.0, 0.0, 1.0])


def angle_between(a, b):
    """Geodesic angle [rad] between attitudes, good to round-off at small angles."""
    turn = quaternions.product(quaternions.conjugate(a), b)
    return 2 * np.arctan2(np.linalg.norm(turn[..., :3], axis=-1), np.abs(turn[..., 3]))


def tumbling(moments, t):
    """Some motion of a body, for a start that is nothing special."""
    return motion(moments, [0.1, -0.5, 0.7, 0.5], [0.8, -1.3, 2.1], t)


# Goldens


@pytest.mark.parametrize("name", sorted({golden["name"] for golden in GOLDENS}))
def test_thirty_digit_integrations(name):
    for golden in (g for g in GOLDENS if g["name"] == name):
        q, omega = motion(golden["moments"], golden["q0"], golden["omega0"], [golden["t"]])
        with mpmath.workdps(40):
            true_q, true_omega = (
                np.array([mpmath.mpf(x) for x in golden[key]], dtype=object) for key in ("q", "omega")
            )
            # q goes on from q0 without a jump, so its sign is that of the integration.
            attitude = 2 * float(mpmath.sqrt(sum((q[0] - true_q) ** 2)))
            rate = float(mpmath.sqrt(sum((omega[0] - true_omega) ** 2) / sum(true_omega**2)))
        assert attitude < ATTITUDE, golden
        assert rate < OMEGA, golden


def test_the_goldens_cover_what_is_asked():
    names = [golden["name"] for golden in GOLDENS]
    assert len(names) >= 200
    assert sum("t = 1000 s" in name for name in names) >= 20
    assert {"separatrix +1e-12", "separatrix -1e-12", "on the separatrix", "needle", "plate"} <= set(names)


def test_the_goldens_come_from_their_script():
    command = [sys.executable, str(HERE / "make_torque_free_goldens.py"), "--check", "--every", "36"]
    subprocess.run(command, check=True, timeout=120)


# Solved by hand


@pytest.mark.parametrize("axis", [0, 1, 2])
@pytest.mark.parametrize("spin", [-3.0, 4000.0])
def test_spin_about_a_principal_axis_stays_as_it_is(axis, spin):
    moments, t = [1.0, 2.0, 2.5], np.array([-1000.0, 0.0, 0.3, 1000.0])
    omega0 = np.zeros(3)
    omega0[axis] = spin
    q0 = np.array([0.5, -0.5, 0.5, 0.5])
    q, omega = motion(moments, q0, omega0, t)
    assert np.array_equal(omega, np.tile(omega0, (4, 1)))
    for place, when in enumerate(t):
        turn = np.zeros(4)
        with mpmath.workdps(30):
            half = mpmath.mpf(spin) * mpmath.mpf(float(when)) / 2
            turn[axis], turn[3] = mpmath.sin(half), mpmath.cos(half)
        assert angle_between(q[place], quaternions.product(q0, turn)) < 1e-15


@pytest.mark.parametrize("moments", [[0.3, 0.3, 0.3], [0.3, 0.3, 0.5], [0.5, 0.3, 0.3], [0.3, 0.5, 0.3]])
def test_where_omega_lies_among_equal_moments_it_stays(moments):
    equal = [i for i in range(3) if moments[i] == 0.3]
    omega0 = np.zeros(3)
    omega0[equal] = [1.0, -2.0, 2.0][: len(equal)]
    q, omega = motion(moments, AT_REST, omega0, [2.0])
    assert np.array_equal(omega[0], omega0)
    turn = quaternions.from_rotation_vector(2.0 * omega0)
    assert angle_between(q[0], turn) < 1e-15


def test_a_body_at_rest_stays_at_rest():
    q0 = np.array([0.5, -0.5, 0.5, -0.5])
    q, omega = motion([1.0, 2.0, 2.5], q0, [0.0, 0.0, 0.0], [-1.0, 1e300])
    assert np.array_equal(q, [q0, q0])
    assert np.array_equal(omega, np.zeros((2, 3)))


@pytest.mark.parametrize(("I1", "I3"), [(0.01, 0.02), (0.01, 0.004), (1.0, 1e-6), (1.0, 2.0)])
@pytest.mark.parametrize("axis", [0, 1, 2])
@pytest.mark.parametrize("omega3", [5.0, -4000.0, 1e-3])
def test_a_symmetric_top_turns_about_L_and_about_its_axis(I1, I3, axis, omega3):
    """Landau & Lifshitz § 33: exp(L t/I1) exp(−Ω_b e3 t), in fifty digits."""
    moments, omega0 = np.full(3, I1), np.zeros(3)
    moments[axis], omega0[axis], omega0[axis - 2] = I3, omega3, 1.5
    t = 37.0
    q, omega = motion(moments, AT_REST, omega0, [t])
    with mpmath.workdps(50):
        Omega_b = (mpmath.mpf(I3) - I1) / I1 * omega3
        true_omega = np.zeros(3)
        true_omega[axis] = omega3
        true_omega[axis - 2] = mpmath.cos(Omega_b * t) * 1.5
        true_omega[axis - 1] = mpmath.sin(Omega_b * t) * 1.5
        L_over_I1 = [mpmath.mpf(float(i)) / I1 * float(w) for i, w in zip(moments, omega0, strict=True)]
        rate = mpmath.sqrt(sum(x * x for x in L_over_I1))
        about_L = [float(mpmath.sin(rate * t / 2) * x / rate) for x in L_over_I1]
        first = np.array([*about_L, float(mpmath.cos(rate * t / 2))])
        second = np.zeros(4)
        second[axis], second[3] = mpmath.sin(-Omega_b * t / 2), mpmath.cos(Omega_b * t / 2)
    # The limit for exact cases is 1e-14; the reference itself is rounded to double.
    assert angle_between(q[0], quaternions.product(first, second)) < ATTITUDE
    assert np.linalg.norm(omega[0] - true_omega) < OMEGA * np.linalg.norm(omega0)


def test_on_the_separatrix_omega_follows_hyperbolic_functions():
    """Landau & Lifshitz § 37 with M² = 2E·I2, exactly so for I = 1, 2, 2.25 and ω1 : ω3 = 3 : 4."""
    t = np.linspace(-400, 400, 41)
    _, omega = motion([1.0, 2.0, 2.25], AT_REST, [3.0, 0.0, 4.0], t)
    x = np.sqrt(2.5) * t
    expected = np.stack([3 / np.cosh(x), np.sqrt(22.5) * np.tanh(x), 4 / np.cosh(x)], axis=-1)
    # x is rounded here, to 1e-16 of itself, where 1/cosh x is still 0.04 at most (t = 20 is the next place).
    assert np.abs(omega - expected).max() < 2e-15
    # It ends as a spin about the middle axis, along L.
    q, _ = motion([1.0, 2.0, 2.25], AT_REST, [3.0, 0.0, 4.0], [400.0])
    assert np.allclose(quaternions.rotated(q[0], np.array([0.0, 1.0, 0.0])), [3 / 90**0.5, 0, 9 / 90**0.5])


def test_a_plate_keeps_the_speed_in_its_plane():
    """With I3 = I1 + I2 Euler's equations give ω1 dω1/dt = −ω1ω2ω3 = −ω2 dω2/dt."""
    _, omega = motion([0.25, 0.75, 1.0], AT_REST, [1.0, 0.2, 0.7], np.linspace(0, 30, 50))
    in_plane = omega[:, 0] ** 2 + omega[:, 1] ** 2
    assert np.abs(in_plane / in_plane[0] - 1).max() < 4e-15


# The whole parameter space


@st.composite
def bodies(draw):
    """Moments from a needle to a plate, ordinary, nearly equal or equal, at any scale and in any order."""
    decades = st.floats(-6, 0)
    a, b, c = (10 ** draw(decades) for _ in range(3))
    kind = draw(st.sampled_from(["any", "any", "equal", "nearly equal", "plate"]))
    if kind == "equal":
        b = a
    if kind == "nearly equal":
        b = a * (1 + 10 ** draw(st.floats(-15, -8)))
    if kind == "plate":
        c = 0.0
    moments = np.array([b + c, a + c, a + b]) * 10 ** draw(st.floats(-9, 9))
    return moments[draw(st.permutations(range(3)))]


@st.composite
def attitudes(draw):
    q = np.array([draw(st.floats(-1, 1)) for _ in range(4)])
    norm = np.linalg.norm(q)
    assume(norm > 1e-3)
    return q / norm


@st.composite
def motions(draw):
    """Moments, q0, ω0 and a time span: up to ±1000 rad of turning at 1e-3 to 4000 rad/s."""
    # Squares of smaller ones underflow in what the tests below sum up themselves.
    some = st.floats(-1, 1).map(lambda x: x if abs(x) > 1e-100 else 0.0)
    component = st.one_of(st.just(0.0), some, st.sampled_from([1.0, -1.0, 1e-8, 1e-12]))
    omega = np.array([draw(component) for _ in range(3)]) * 10 ** draw(st.floats(-3, 3.6))
    speed = np.linalg.norm(omega)
    span = draw(st.floats(-1000, 1000)) / (speed if speed > 1e-9 else 1.0)
    return draw(bodies()), draw(attitudes()), omega, span


def close(a, b, tolerance):
    """Whether two motions agree: attitudes [rad], angular velocities relative to the larger of them."""
    (q, omega), (p, other) = a, b
    speed = np.maximum(np.linalg.norm(omega, axis=-1), 1e-300)
    assert angle_between(q, p).max() < tolerance
    assert (np.linalg.norm(omega - other, axis=-1) / speed).max() < tolerance


def sensitivity(moments, q0, omega0, t):
    """By how much a relative change of ω0 comes out larger at ``t``, in attitude or in ω."""
    q, omega = motion(moments, q0, omega0, t)
    grown, speed = 1.0, np.linalg.norm(omega0)
    for kick in np.vstack([np.eye(3), omega0 / speed]) * 1e-7:
        p, other = motion(moments, q0, omega0 + kick * speed, t)
        off = np.linalg.norm(other - omega) / np.linalg.norm(omega) + angle_between(q, p)[0]
        grown = max(grown, off / 1e-7)
    return grown


@given(motions())
def test_quaternions_are_unit_and_L_and_T_stay(case):
    moments, q0, omega0, span = case
    t = np.linspace(-span, span, 7)
    q, omega = motion(moments, q0, omega0, t)
    assert np.abs(np.linalg.norm(q, axis=-1) - 1).max() < 6e-16
    L = quaternions.rotated(q, moments * omega)
    L0 = quaternions.rotated(q0, moments * omega0)
    # Required 1e-12; ten roundings or so are 2e-15.
    assert np.abs(L - L0).max() <= 6e-15 * np.linalg.norm(L0)
    T, T0 = np.sum(moments * omega**2, axis=-1), np.sum(moments * omega0**2)
    assert np.abs(T - T0).max() <= 6e-15 * T0


@given(motions())
def test_it_starts_where_it_is_released(case):
    moments, q0, omega0, _ = case
    q, omega = motion(moments, q0, omega0, 0.0)
    assert np.abs(q[0] - q0).max() < 5e-16
    assert np.linalg.norm(omega[0] - omega0) <= OMEGA * np.linalg.norm(omega0)


@given(motions())
def test_it_obeys_the_equations_of_motion(case):
    """Euler's equations and dq/dt = ½ q ω, with derivatives of Chebyshev series over a part of a turn."""
    moments, q0, omega0, span = case
    speed = np.linalg.norm(omega0)
    assume(speed > 0)
    I1, I2, I3 = moments
    fastest = np.sqrt(np.sum(moments * omega0**2) / moments.min())
    width = 0.25 / fastest
    t = span + width * np.cos(np.pi * (np.arange(33) + 0.5) / 33)
    x = (t - span) / width  # as the rounded times have it
    q, omega = motion(moments, q0, omega0, t)

    def derivative(y):
        fitted = np.polynomial.chebyshev.chebfit(x, y, 20)
        return np.polynomial.chebyshev.chebval(0.0, np.polynomial.chebyshev.chebder(fitted)).T / width

    q_mid, w = (
        np.polynomial.chebyshev.chebval(0.0, np.polynomial.chebyshev.chebfit(x, y, 20)) for y in (q, omega)
    )
    torque_free_rates = np.array(
        [(I2 - I3) * w[1] * w[2] / I1, (I3 - I1) * w[2] * w[0] / I2, (I1 - I2) * w[0] * w[1] / I3]
    )
    # A derivative of order-20 series multiplies round-off by some 20²/width.
    assert np.abs(derivative(q) - quaternions.rate(q_mid, w)).max() < 1e-12 * fastest
    assert np.abs(derivative(omega) - torque_free_rates).max() < 1e-12 * fastest**2


@given(motions())
def test_time_runs_backwards_as_well(case):
    moments, q0, omega0, span = case
    t = np.array([span, 0.3 * span])
    forwards = motion(moments, q0, omega0, -t)
    q, omega = motion(moments, q0, -omega0, t)
    close(forwards, (q, -omega), 2 * ATTITUDE)


@given(motions(), st.floats(-1, 1))
@settings(max_examples=60)
def test_motions_compose(case, share):
    moments, q0, omega0, span = case
    span = span / 20
    assume(np.linalg.norm(omega0) > 0)
    first = share * span
    q, omega = motion(moments, q0, omega0, [first, span])
    later = motion(moments, q[0], omega[0], [span - first])
    # The state in between is rounded, and so is the time left: what the motion makes of 1e-15 is allowed.
    grown = sensitivity(moments, q[0], omega[0], [span - first])
    close((q[1:], omega[1:]), later, 1e-14 + 4e-15 * grown)


@given(motions(), attitudes())
def test_a_turned_world_sees_the_same_motion_turned(case, turn):
    moments, q0, omega0, span = case
    t = np.array([span, 0.3 * span])
    q, omega = motion(moments, q0, omega0, t)
    turned = motion(moments, quaternions.product(turn, q0), omega0, t)
    close((quaternions.product(turn, q), omega), turned, 2 * ATTITUDE)


RELABELLINGS = [
    np.array([x, y, z, w], dtype=float) / np.linalg.norm([x, y, z, w])
    for x in (-1, 0, 1)
    for y in (-1, 0, 1)
    for z in (-1, 0, 1)
    for w in (0, 1)
    # The turns of a cube: 1, 2 or 4 of the components, all alike but for signs.
    if abs(x) + abs(y) + abs(z) + abs(w) in (1, 2, 4)
]


@given(motions(), st.sampled_from(RELABELLINGS))
def test_the_names_of_the_axes_do_not_matter(case, turn):
    moments, q0, omega0, span = case
    matrix = np.rint(quaternions.matrix(turn))
    t = np.array([span, 0.3 * span])
    q, omega = motion(moments, q0, omega0, t)
    renamed = motion(
        np.abs(matrix) @ moments, quaternions.product(q0, quaternions.conjugate(turn)), matrix @ omega0, t
    )
    close((quaternions.product(q, quaternions.conjugate(turn)), omega @ matrix.T), renamed, 2 * ATTITUDE)


@given(motions(), st.integers(-30, 30), st.integers(-10, 10))
def test_units_do_not_matter(case, mass_exponent, time_exponent):
    moments, q0, omega0, span = case
    t = np.array([span, 0.3 * span])
    mass, time = 2.0**mass_exponent, 2.0**time_exponent
    q, omega = motion(moments, q0, omega0, t)
    p, other = motion(moments * mass, q0, omega0 / time, t * time)
    # Powers of two change no digit.
    close((q, omega), (p, other * time), 4e-16)


@given(motions())
def test_the_quaternion_changes_without_a_jump(case):
    moments, q0, omega0, _ = case
    fastest = np.sqrt(np.sum(moments * omega0**2) / moments.min())
    t = np.linspace(0, 3 / fastest if fastest > 0 else 1.0, 31)
    q, _ = motion(moments, q0, omega0, t)
    assert np.all(np.sum(q[1:] * q[:-1], axis=-1) > 0.9)
    assert np.sum(q[0] * q0) > 0.9


@pytest.mark.parametrize(
    ("moments", "omega0"),
    [
        ([1.0, 2.0, 3.0], [5e-324, 3.0, 0.0]),
        ([1.0, 2.0, 3.0], [0.0, 3.0, 1e-200]),
        ([1.0, 2.0, 3.0], [1e-308, 1.0, 1e-308]),
        ([1.0, 2.0, 3.0], [1e-300, 0.0, 2e-300]),
        ([1e-300, 2e-300, 2.5e-300], [1.0, 2.0, 3.0]),
        ([1e300, 2e300, 2.5e300], [1.0, 2.0, 3.0]),
        ([1.0, 1.0, 1e-15], [1.0, 2.0, 3.0]),
        ([1.0, 1.0 + 2e-16, 1.0 - 1e-16], [1.0, 2.0, 3.0]),
        ([1.0, 2.0, 2.25], [3e-200, 1.0, 4e-200]),
    ],
)
def test_no_valid_input_comes_out_as_not_a_number(moments, omega0):
    t = np.array([-1e3, -1.0, 0.0, 1e-300, 1.0, 1e6])
    q, omega = motion(moments, AT_REST, omega0, t)
    L = quaternions.rotated(q, np.array(moments) * omega)
    assert np.abs(L - L[2]).max() <= 6e-15 * np.abs(L[2]).max()
    assert np.abs(omega[2] - omega0).max() <= OMEGA * np.abs(omega0).max()


def test_a_long_array_of_times_is_evaluated_in_blocks_that_join():
    t = np.linspace(-50.0, 50.0, 2 * BLOCK + 17)
    q, omega = tumbling([1.0, 2.0, 2.5], t)
    assert q.shape == (t.size, 4)
    assert np.abs(np.linalg.norm(np.diff(q, axis=0), axis=-1)).max() < 0.01
    for place in (0, BLOCK - 1, BLOCK, 2 * BLOCK - 1, 2 * BLOCK, t.size - 1):
        one = tumbling([1.0, 2.0, 2.5], t[place])
        # Vector and scalar sines of the library may differ by an ulp.
        assert np.abs(one[0] - q[place]).max() < 1e-15
        assert np.abs(one[1] - omega[place]).max() < 2e-15


def test_times_may_be_one_many_or_none():
    moments, t = [1.0, 2.0, 2.5], np.array([3.0, -1.0, 0.0, 3.0])
    q, omega = tumbling(moments, t)
    assert q.shape == (4, 4)
    assert omega.shape == (4, 3)
    for place, when in enumerate(t):
        one = tumbling(moments, float(when))
        assert np.abs(one[0] - q[place]).max() < 4e-16
        assert np.abs(one[1] - omega[place]).max() < 1e-15
    assert tumbling(moments, [])[0].shape == (0, 4)
    assert motion(moments, AT_REST, [1.0, 0.0, 0.0], [])[0].shape == (0, 4)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"moments": [1.0, 2.0, 3.5]}, "moments: got .*exceeds the sum"),
        ({"moments": [1.0, -2.0, 2.5]}, "moments: got .*above 0"),
        ({"moments": [1.0, 2.0]}, "moments: got an array of shape"),
        ({"q0": [0.0, 0.0, 0.0, 1.1]}, "q0: got norm"),
        ({"q0": [0.0, 0.0, 1.0]}, "q0: got an array of shape"),
        ({"omega0": [1.0, 2.0]}, "omega0: got an array of shape"),
        ({"omega0": [1.0, float("nan"), 0.0]}, "omega0: got .*finite"),
        ({"t": [[1.0]]}, "t: got an array of shape"),
        ({"t": [float("inf")]}, "t: got .*finite"),
        ({"t": [1e17]}, "t: got 1e\\+17, expected at most"),
    ],
)
def test_bad_input_is_refused(change, message):
    arguments = {"moments": [1.0, 2.0, 2.5], "q0": AT_REST, "omega0": [1.0, 2.0, 3.0], "t": [1.0]}
    with pytest.raises(InputError, match=message):
        motion(**(arguments | change))


# The two cones' rates


def phase_rate(I1, I3, omega0):
    """The rate at which ω1 + iω2 turns, from the motion."""
    t = np.array([0.0, 1e-3 / np.linalg.norm(omega0)])
    _, omega = motion([I1, I1, I3], AT_REST, omega0, t)
    z = omega[:, 0] + 1j * omega[:, 1]
    return np.angle(z[1] / z[0]) / t[1]


@pytest.mark.parametrize(("I1", "I3"), [(0.01, 0.02), (0.01, 0.004), (0.01, 0.01)])
@pytest.mark.parametrize("omega3", [5.0, -5.0])
def test_the_body_cone_rate_is_that_of_the_motion(I1, I3, omega3):
    rate = body_cone_rate(I1, I3, omega3)
    # An angle of 1e-3 rad taken as a difference keeps 12 digits.
    assert abs(phase_rate(I1, I3, [1.0, 0.5, omega3]) - rate) < 1e-11


def test_the_earth_wobbles_once_in_305_days():
    """Taylor § 10.8 and Goldstein § 5.6: (I3 − I1)/I1 = 1/305 for the Earth, some ten months."""
    day = 1.0
    turns_per_day = body_cone_rate(305.0, 306.0, 2 * math.pi / day) / (2 * math.pi)
    assert abs(1 / turns_per_day - 305) < 1e-9


def test_a_thrown_plate_wobbles_twice_as_fast_as_it_turns():
    """A thin disc, I3 = 2 I1, hardly tilted: Feynman's plate (Taylor, problem 10.39's ratio of two)."""
    omega3 = 3.0
    assert abs(space_cone_rate(1.0, 2.0, [1e-9, 0.0, omega3]) / omega3 - 2) < 1e-15


@pytest.mark.parametrize(("I1", "I3"), [(0.01, 0.02), (0.01, 0.004)])
def test_the_space_cone_rate_is_that_of_the_axis_about_L(I1, I3):
    omega0 = np.array([1.0, -0.5, 3.0])
    rate = space_cone_rate(I1, I3, omega0)
    assert abs(rate - np.linalg.norm(np.array([I1, I1, I3]) * omega0) / I1) < 1e-14
    t = np.array([0.0, 0.1])
    q, omega = motion([I1, I1, I3], AT_REST, omega0, t)
    turn = quaternions.from_rotation_vector(np.array([I1, I1, I3]) * omega0 / I1 * 0.1)
    for body_vectors in (np.tile([0.0, 0.0, 1.0], (2, 1)), omega):
        world = quaternions.rotated(q, body_vectors)
        assert np.abs(quaternions.rotated(turn, world[0]) - world[1]).max() < 1e-14


def test_rates_refuse_what_is_not_a_moment():
    for call in (
        lambda: body_cone_rate(0.0, 1.0, 1.0),
        lambda: body_cone_rate(1.0, -1.0, 1.0),
        lambda: body_cone_rate(1.0, 1.0, float("nan")),
        lambda: space_cone_rate(-1.0, 1.0, [0, 0, 1]),
        lambda: space_cone_rate(1.0, 0.0, [0, 0, 1]),
        lambda: space_cone_rate(1.0, 1.0, [0, 1]),
    ):
        with pytest.raises(InputError, match="got"):
            call()

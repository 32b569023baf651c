"""Heavy tops over their whole parameter space: what is kept, and what the motion may not depend on."""

import numpy as np
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from poinsot.reference import quaternions
from poinsot.reference.errors import InputError
from poinsot.reference.heavy_top import motion
from poinsot.reference.heavy_top_equations import accelerations, constants_of_motion

# Measured on thirty-digit motions: 1.3e-15 rad and 8e-16; two motions may be as far apart as twice that.
TWICE = 4e-15

# A few hundredths of a second each, most of it for the mpmath numbers of a motion.
SOME = settings(max_examples=25)


@st.composite
def attitudes(draw):
    """Any attitude, and those on and by the vertical."""
    special = st.sampled_from(
        [[0, 0, 0, 1], [1, 0, 0, 0], [0.6, 0.8, 0, 0], [0, 0, 1, 0], [0.5] * 4, [1e-9, 0, 0, 1]]
    )
    q = np.array(draw(st.one_of(special, st.lists(st.floats(-1, 1), min_size=4, max_size=4))), dtype=float)
    # A tilt of 1e-75 is no tilt to fifty digits: the motion is refused, as its phase is unknown.
    q[np.abs(q) < 1e-30] = 0.0
    assume(np.linalg.norm(q) > 1e-3)
    return q / np.linalg.norm(q)


@st.composite
def tops(draw):
    """Arguments of `motion` but for t: from needles to plates, at any scale, at rest or spinning."""
    decades = st.floats(-6, 6)
    mass, length, gravity = (10 ** draw(decades) for _ in range(3))
    I1 = mass * length**2 * 10 ** draw(st.floats(0, 2))
    I3 = I1 * draw(st.one_of(st.just(2.0), st.just(1.0), st.just(1e-6), st.floats(0.01, 2)))
    swing = np.sqrt(mass * gravity * length / I1)
    across = st.one_of(st.just(0.0), st.floats(-3, 3), st.sampled_from([2.0, 1e-8, 1e-3, 30.0]))
    spin = draw(st.one_of(st.just(0.0), st.floats(-3, 3), st.sampled_from([2.0, -2.1, 1.9, 30.0, -300.0])))
    omega = swing * np.array([draw(across), draw(across), spin * I1 / I3])
    return mass, length, (I1, I3), gravity, draw(attitudes()), omega


def natural_time(top):
    """One over the fastest rate of the motion [s]."""
    mass, length, (I1, _), gravity, _, omega = top
    return 1 / (np.linalg.norm(omega) + np.sqrt(mass * length * gravity / I1))


def times(top, *spans):
    """Times of the top at so many of its natural times."""
    return natural_time(top) * np.array(spans)


def angle_between(a, b):
    """Geodesic angle [rad] between attitudes, good to round-off at small angles."""
    turn = quaternions.product(quaternions.conjugate(a), b)
    return 2 * np.arctan2(np.linalg.norm(turn[..., :3], axis=-1), np.abs(turn[..., 3]))


def close(top, a, b, tolerance):
    """Whether two motions agree: attitudes [rad], rates relative to the fastest of the motion."""
    assert angle_between(a[0], b[0]).max() < tolerance
    assert np.abs(a[1] - b[1]).max() < tolerance / natural_time(top)


def sensitivity(top, t):
    """By how much a small change of the start comes out larger at ``t`` (1,)."""
    q, omega = motion(*top, t)
    grown, kick = 1.0, 1e-7
    for i in range(3):
        turn = np.zeros(4)
        turn[i], turn[3] = np.sin(kick / 2), np.cos(kick / 2)
        push = np.zeros(3)
        push[i] = kick / natural_time(top)
        for q0, omega0 in ((quaternions.product(turn, top[4]), top[5]), (top[4], top[5] + push)):
            other_q, other = motion(*top[:4], q0, omega0, t)
            off = angle_between(q, other_q).max() + np.abs(omega - other).max() * natural_time(top)
            grown = max(grown, off / kick)
    return grown


spans = st.floats(-300, 300)


@given(tops(), spans)
@SOME
def test_quaternions_are_unit_and_the_constants_stay(top, span):
    q, omega = motion(*top, times(top, span, 0.3 * span, 0.0, -span))
    assert np.abs(np.linalg.norm(q, axis=-1) - 1).max() < 5e-16
    mass, length, (I1, I3), gravity, q0, omega0 = top
    now, start = constants_of_motion(*top[:4], q, omega), constants_of_motion(*top[:4], q0, omega0)
    fastest = np.linalg.norm(omega, axis=-1).max()
    momentum, energy = max(I1, I3) * fastest, I1 * fastest**2 + mass * gravity * length
    # Required 1e-12; ten roundings of the largest term are 2e-15.
    assert np.abs(now[0] - start[0]).max() <= 8e-15 * momentum
    assert np.all(now[1] == start[1])
    assert np.abs(now[2] - start[2]).max() <= 8e-15 * energy


@given(tops())
@SOME
def test_it_starts_where_it_is_released(top):
    q, omega = motion(*top, 0.0)
    assert np.abs(q[0] - top[4]).max() < 1e-15
    assert np.abs(omega[0] - top[5]).max() < 1e-15 / natural_time(top)


@given(tops(), spans)
@SOME
def test_it_obeys_the_equations_of_motion(top, span):
    """Euler's equations and dq/dt = ½ q ω, with derivatives of Chebyshev series over a quarter radian."""
    width = 0.25 * natural_time(top) / (1 + top[2][1] / top[2][0])
    middle = span * natural_time(top)
    t = middle + width * np.cos(np.pi * (np.arange(33) + 0.5) / 33)
    x = (t - middle) / width  # as the rounded times have it
    q, omega = motion(*top, t)

    def value_and_rate(y):
        series = np.polynomial.chebyshev.chebfit(x, y, 20)
        rate = np.polynomial.chebyshev.chebval(0.0, np.polynomial.chebyshev.chebder(series)) / width
        return np.polynomial.chebyshev.chebval(0.0, series), rate

    (q_mid, q_rate), (w, w_rate) = value_and_rate(q), value_and_rate(omega)
    q_mid /= np.linalg.norm(q_mid)
    # A derivative of order-20 series multiplies round-off by some 20²/width.
    assert np.abs(q_rate - quaternions.rate(q_mid, w)).max() < 2e-12 / natural_time(top)
    assert np.abs(w_rate - accelerations(*top[:4], q_mid, w)).max() < 4e-12 / natural_time(top) ** 2


@given(tops(), spans)
@SOME
def test_time_runs_backwards_as_well(top, span):
    t = times(top, span, 0.1 * span)
    forwards = motion(*top, -t)
    q, omega = motion(*top[:5], -top[5], t)
    close(top, forwards, (q, -omega), TWICE)


@given(tops(), st.floats(-1, 1), st.floats(-20, 20))
@settings(max_examples=12)
def test_motions_compose(top, share, span):
    t = times(top, share * span, span)
    q, omega = motion(*top, t)
    halfway = (*top[:4], q[0], omega[0])
    later = motion(*halfway, [t[1] - t[0]])
    # The state in between is rounded, and so is the time left: what the motion makes of 1e-15 is allowed.
    grown = sensitivity(halfway, [t[1] - t[0]])
    assume(grown < 1e6)
    close(top, (q[1:], omega[1:]), later, 1e-14 + 8e-15 * grown)


@given(tops(), spans)
@SOME
def test_half_a_turn_of_the_world_or_of_the_body_turns_all(top, span):
    """About the vertical, and about e3: by 180°, which no rounding spoils."""
    half = np.array([0.0, 0.0, 1.0, 0.0])
    t = times(top, span, -0.2 * span)
    q, omega = motion(*top, t)
    world = motion(*top[:4], quaternions.product(half, top[4]), top[5], t)
    close(top, (quaternions.product(half, q), omega), world, TWICE)
    signs = np.array([-1.0, -1.0, 1.0])
    body = motion(*top[:4], quaternions.product(top[4], half), top[5] * signs, t)
    close(top, (quaternions.product(q, half), omega * signs), body, TWICE)


@given(tops(), st.floats(-3, 3), st.floats(-20, 20))
@settings(max_examples=12)
def test_any_turn_about_the_vertical_or_about_e3_turns_all(top, angle, span):
    turn = np.array([0.0, 0.0, np.sin(angle / 2), np.cos(angle / 2)])
    t = times(top, span)
    q, omega = motion(*top, t)
    # The turned start is rounded.
    grown = sensitivity(top, t)
    assume(grown < 1e6)
    world = motion(*top[:4], quaternions.product(turn, top[4]), top[5], t)
    close(top, (quaternions.product(turn, q), omega), world, TWICE + 4e-15 * grown)
    back = quaternions.conjugate(turn)
    body = motion(*top[:4], quaternions.product(top[4], turn), quaternions.rotated(back, top[5]), t)
    close(top, (quaternions.product(q, turn), quaternions.rotated(back, omega)), body, TWICE + 8e-15 * grown)


@given(tops(), spans)
@SOME
def test_the_mirror_image_moves_as_the_mirror_image(top, span):
    """In the plane y-z of the world and 2-3 of the body: x keeps, y and z of q and of ω change sign."""
    t = times(top, span, -0.2 * span)
    q, omega = motion(*top, t)
    attitude, rate = np.array([1.0, -1.0, -1.0, 1.0]), np.array([1.0, -1.0, -1.0])
    mirrored = motion(*top[:4], top[4] * attitude, top[5] * rate, t)
    close(top, (q * attitude, omega * rate), mirrored, TWICE)


@given(tops(), spans, st.integers(-20, 20), st.integers(-20, 20), st.integers(-10, 10))
@SOME
def test_units_do_not_matter(top, span, kilogram, metre, second):
    mass, length, (I1, I3), gravity, q0, omega0 = top
    M, L, T = 2.0**kilogram, 2.0**metre, 2.0**second
    t = times(top, span, 0.3 * span)
    q, omega = motion(*top, t)
    other = (mass * M, length * L, (I1 * M * L**2, I3 * M * L**2), gravity * L / T**2, q0, omega0 / T)
    p, rates = motion(*other, t * T)
    # Powers of two change no digit.
    close(top, (q, omega), (p, rates * T), 5e-16)


numbers = st.one_of(
    st.floats(-9, 9), st.floats(-1e100, 1e100), st.sampled_from([5e-324, 1e-160, 1e-30, 1e150])
)


@given(
    st.tuples(numbers, numbers, numbers).map(np.abs),
    st.one_of(st.floats(0.01, 10), st.floats(1e-150, 1e150)),
    st.floats(1e-9, 2),
    attitudes(),
    st.tuples(numbers, numbers, numbers),
    st.floats(-9, 9),
)
@SOME
def test_whatever_is_finite_gives_a_motion_or_says_why_not(weight, I1, ratio, q0, omega0, t):
    mass, length, gravity = weight
    try:
        q, omega = motion(mass, length, (I1, I1 * ratio), gravity, q0, omega0, t)
    except InputError:
        # No mass, or a phase that passes 10¹⁵.
        fastest = np.sqrt(mass / I1) * np.sqrt(length) * np.sqrt(gravity) + np.abs(omega0).max()
        assert mass == 0 or fastest * abs(t) > 1e14
        return
    assert abs(np.linalg.norm(q) - 1) < 5e-16
    assert np.all(np.isfinite(omega))
